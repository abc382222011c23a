"""The document of a show, as JSON has it: what every track and keyframe holds, whatever its parameter.

`reina.show.track_models` makes of these what reads the tracks of one parameter. OpenAPI, the JSON Schema of
shows and the page's types follow from both.
"""

from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, Strict

from reina.curves.extrapolation import Extrapolation
from reina.curves.spaces import ColorSpace
from reina.curves.value_types import Number
from reina.show.event_response import EventResponse
from reina.show.model import ShowModel, Text
from reina.show.time_map import TimeUnit

Slope = Number | Annotated[tuple[Number, ...], Strict(strict=False)]
"""Value per unit of time: a number, or as many as a value has."""


class ShowKeyframe(ShowModel):
    """A value at a time. Options of its interpolation stand beside its own fields."""

    model_config = ConfigDict(extra="allow")

    key: Annotated[str, Field(pattern="^[A-Za-z0-9_-]{1,64}$")] = ""
    """Its name within the track; the next free one where it is not given."""
    time: Number
    """In the track's unit."""
    value: Any
    """As its parameter has it."""
    interpolation: str = "linear"
    """How to come here from the keyframe before; `step` where nothing lies between two values."""
    in_tangent: Slope | None = None
    """The slope with which a spline comes to it, value per unit of time."""
    out_tangent: Slope | None = None
    """The slope with which a spline that ends at the next keyframe leaves it."""


class ShowTrack(ShowModel):
    """The keyframes of one parameter, and what it does where there are none."""

    model_config = ConfigDict(
        json_schema_extra={
            "anyOf": [
                {"properties": {"keyframes": {"minItems": 1}}, "required": ["keyframes"]},
                {"required": ["events"]},
            ]
        }
    )

    parameter: str
    """The parameter's path."""
    time: TimeUnit | None = None
    """The unit of its keyframes' times; the show's where it names none."""
    before: Extrapolation = "hold"
    """What happens before the first keyframe."""
    after: Extrapolation = "hold"
    """What happens after the last."""
    color_space: ColorSpace = "oklab"
    """What colours are mixed in."""
    muted: bool = False
    """Whether the show leaves the track out."""
    solo: bool = False
    """Whether the show leaves out all tracks that are not solo."""
    events: EventResponse | None = None
    """What it does at notes, beats or bars on top of its keyframes; it then needs none."""
    keyframes: Annotated[tuple[ShowKeyframe, ...], Strict(strict=False)] = ()
    """No two at one time, no two of one key."""


class Marker(ShowModel):
    """A named place, in the show's unit of time."""

    time: Number
    """Where."""
    name: Annotated[Text, Field(min_length=1)]
    """What to call it."""


class ShowHead(ShowModel):
    """What a show has beside its tracks."""

    schema_: Text = Field("", alias="$schema")
    """The address of the JSON Schema, for editors."""
    version: Literal[1]
    """Of this form of documents."""
    title: Text = ""
    """What the person calls it."""
    description: Text = ""
    """What else there is to say."""
    time: TimeUnit = "seconds"
    """The unit of times where a track names no other. Bars are counted by how many have gone by."""
    markers: Annotated[tuple[Marker, ...], Strict(strict=False)] = ()
    """Named places."""


class ShowDocument(ShowHead):
    """Keyframes on the parameters of stage, lights, camera and note blocks."""

    tracks: Annotated[tuple[ShowTrack, ...], Strict(strict=False)]
    """One a parameter. Tracks of unknown parameters are kept as they came, without effect."""
