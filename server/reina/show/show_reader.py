"""Reads tracks and keyframes from JSON, and says exactly what is wrong with them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import count
from typing import Any, cast

from pydantic import TypeAdapter, ValidationError

from reina.curves.keyframe import Keyframe
from reina.curves.parameter import Parameter
from reina.show.errors import ShowError
from reina.show.event_response import EventResponse
from reina.show.faults import Location, field_name, show_error
from reina.show.time_map import TimeUnit
from reina.show.track import Track
from reina.show.track_models import track_models

Json = Mapping[str, Any]
LONGEST_TRACK = 100_000
_NUMBERS = Parameter("amount", "vector", (0.0, 0.0, 0.0))
_FREE = {"number": Parameter("amount", "number", 0.0), "vector": _NUMBERS, "color": _NUMBERS}
"""What is added or multiplied may lie outside of a parameter's range."""


def read_track(
    document: object, parameter: Parameter, default_time: TimeUnit, *, may_be_empty: bool = False
) -> Track:
    """Read a track of a parameter.

    Args:
        document: The track.
        parameter: What it moves.
        default_time: The unit of its times where it names none.
        may_be_empty: Whether it may have neither keyframes nor an answer to events, since it will yet.

    Raises:
        ShowError: A field or a keyframe is not as it should be; it knows of the other faults too.
    """
    entries = _entries(document)
    if len(entries) > LONGEST_TRACK:
        raise ShowError(
            f"{len(entries)} keyframes are more than a track may have, {LONGEST_TRACK}",
            track=parameter.path,
            field="keyframes",
        )
    models = track_models(parameter)
    try:
        read = models.track_reader.model_validate(document)
    except ValidationError as error:
        keys = _keys(entries)
        raise show_error(
            _told(TypeAdapter(models.track), document) or error,
            models.track,
            unit=parameter.unit,
            at=lambda location: _place(location, parameter, keys),
        ) from None
    if not read.keyframes and read.events is None and not may_be_empty:
        detail = "a track has a list of one keyframe at least, or answers events"
        raise ShowError(detail, track=parameter.path, field="keyframes")
    keyframes = cast("tuple[Keyframe[Any], ...]", read.keyframes)
    free = _free_keys({keyframe.key for keyframe in keyframes})
    return Track(
        parameter=parameter.path,
        keyframes=tuple([k if k.key else replace(k, key=next(free)) for k in keyframes]),
        time=read.time or default_time,
        before=read.before,
        after=read.after,
        color_space=read.color_space,
        muted=read.muted,
        solo=read.solo,
        events=None if read.events is None else fitted(read.events, parameter),
    )


def read_keyframe(document: object, parameter: Parameter, free_key: str) -> Keyframe[Any]:
    """Read a keyframe of a parameter; one that names no key takes the free one.

    Raises:
        ShowError: A field is not as it should be.
    """
    models = track_models(parameter)
    try:
        read = models.keyframe_reader.validate_python(document)
    except ValidationError as error:
        keys = [free_key if key == "k1" else key for key in _keys([document])]
        raise show_error(
            _told(TypeAdapter(models.keyframe), document) or error,
            models.keyframe,
            unit=parameter.unit,
            at=lambda location: _place(("keyframes", 0, *location), parameter, keys),
        ) from None
    return read if read.key else replace(read, key=free_key)


def fitted(events: EventResponse, parameter: Parameter) -> EventResponse:
    """An answer to events with its values checked: they are those of a parameter.

    Raises:
        ShowError: They are not.
    """
    field = "blend"
    try:
        if events.blend != "replace" and parameter.type not in ("number", "vector", "color"):
            raise ValueError(f"a {parameter.type} can only be replaced")  # noqa: TRY301
        field = "amount"
        amount = events.amount
        if amount is not None:
            amount = (parameter if events.blend == "replace" else _FREE[parameter.type]).parse(amount)
        field = "cycle"
        cycle = tuple(parameter.parse(value) for value in events.cycle)
    except ValueError as error:
        raise ShowError(str(error), track=parameter.path, field=f"events/{field}") from None
    return events.model_copy(update={"amount": amount, "cycle": cycle})


def _free_keys(taken: set[str]) -> Iterator[str]:
    """k1, k2 and so on, without those that are taken."""
    return (key for number in count(1) if (key := f"k{number}") not in taken)


def _told(model: TypeAdapter[Any], document: object) -> ValidationError | None:
    """What a model says of a document that was refused: the faults by the models' names."""
    try:
        model.validate_python(document)
    except ValidationError as error:
        return error
    return None


def _entries(document: object) -> Sequence[object]:
    """The keyframes of a track, as far as it has any."""
    fields: Json = cast("Json", document) if isinstance(document, Mapping) else {}
    entries: object = fields.get("keyframes")
    return cast("Sequence[object]", entries) if isinstance(entries, list | tuple) else ()


def _keys(entries: Sequence[object]) -> list[str | None]:
    """What each keyframe of a track is called in an error; None where its key is no text."""
    given: list[object] = [
        cast("Json", entry).get("key", "") if isinstance(entry, Mapping) else None for entry in entries
    ]
    free = _free_keys({key for key in given if isinstance(key, str)})
    return [(key or next(free)) if isinstance(key, str) else None for key in given]


def _place(
    location: Location, parameter: Parameter, keys: Sequence[str | None]
) -> tuple[str | None, str | None, str | None]:
    """Track, key and field of a location in a track."""
    if location[:1] != ("keyframes",) or len(location) < 3:
        return parameter.path, None, field_name(location[:1] if location[:1] == ("keyframes",) else location)
    return parameter.path, keys[cast("int", location[1])], field_name(location[2:])
