"""Edits of a show as JSON: several at once, all or none. The one way to change a show."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, ClassVar, Literal, cast, get_args

from pydantic import Field, Strict, ValidationError

from reina.curves.extrapolation import Extrapolation
from reina.curves.parameter import Parameter
from reina.curves.parameter_registry import ParameterRegistry
from reina.curves.shown import shown
from reina.curves.spaces import ColorSpace
from reina.curves.value_types import Number
from reina.show.document import Marker, ShowKeyframe, ShowTrack
from reina.show.errors import MAX_FAULTS, ShowError, together
from reina.show.event_response import EventResponse
from reina.show.faults import show_error
from reina.show.look import Look
from reina.show.model import ShowModel, Text, read_later
from reina.show.show import Show
from reina.show.show_draft import ShowDraft
from reina.show.time_map import TimeMap, TimeUnit
from reina.show.track import Track

MIN_FACTOR = 1e-6
"""Nothing is stretched further than so far, or than its inverse."""


class TrackChanges(ShowModel):
    """Fields of a track to change; null takes one back to its default."""

    null_is_said: ClassVar[bool] = True

    time: TimeUnit | None = None
    """With another unit the keyframes stay where they are in the music, and get other numbers."""
    before: Extrapolation | None = None
    after: Extrapolation | None = None
    color_space: ColorSpace | None = None
    muted: bool | None = None
    solo: bool | None = None
    events: EventResponse | None = None


class ShowChanges(ShowModel):
    """Fields of a show to change; null takes one back to its default."""

    null_is_said: ClassVar[bool] = True

    title: Text | None = None
    description: Text | None = None
    markers: Annotated[tuple[Marker, ...], Strict(strict=False)] | None = None


class Stretch(ShowModel):
    """How far times are stretched, and about which."""

    about: Number = 0.0
    """What stays where it is."""
    factor: Annotated[float, Field(ge=MIN_FACTOR, le=1.0 / MIN_FACTOR)] = 1.0
    """Greater than 0; slopes become so much flatter."""


class NewKeyframe(ShowKeyframe):
    """A keyframe to add: without a value it gets the one that the others have at its time."""

    value: Any = None


class AddKeyframe(ShowModel):
    """One keyframe more; a track is made where there is none."""

    edit: Literal["add_keyframe"]
    parameter: str
    keyframe: Annotated[dict[str, Any], read_later(NewKeyframe)]
    """Without a key it gets the next free one."""
    replace: bool = False
    """Whether one that stands at its time gives way, and leaves it its key."""

    def make(self, draft: ShowDraft) -> None:
        """Do it to a draft."""
        track = draft.track_or_new(_parameter(self.parameter, draft.registry))
        track.add(self.keyframe, replaces=self.replace, time_map=draft.time_map)


class ChangeKeyframe(ShowModel):
    """Some fields of a keyframe changed; null takes one back to its default."""

    edit: Literal["change_keyframe"]
    parameter: str
    key: str
    changes: dict[str, Any]
    """Another interpolation drops the old one's options."""

    def make(self, draft: ShowDraft) -> None:
        """Do it to a draft."""
        draft.track(_parameter(self.parameter, draft.registry)).change(self.key, self.changes)


class RemoveKeyframe(ShowModel):
    """One keyframe less; a track that loses its last and answers no events goes with it."""

    edit: Literal["remove_keyframe"]
    parameter: str
    key: str

    def make(self, draft: ShowDraft) -> None:
        """Do it to a draft."""
        draft.track(_parameter(self.parameter, draft.registry)).remove(self.key)


class MoveKeyframes(ShowModel):
    """Keyframes of several tracks moved to about + factor · (time - about) + by.

    What stands there gives way.
    """

    edit: Literal["move_keyframes"]
    keyframes: dict[str, list[str]]
    """Keys by their parameters."""
    by: Number = 0.0
    stretch: Stretch = Stretch()
    time: TimeUnit | None = None
    """The unit of `by` and `about`; the show's where it is not given."""
    value_by: Any = None
    """What is added to the values, held within their range: a number, or three for vectors."""

    def make(self, draft: ShowDraft) -> None:
        """Do it to a draft."""
        for path, keys in self.keyframes.items():
            parameter = _parameter(path, draft.registry, "keyframes")
            draft.track(parameter).move(
                keys,
                by=self.by,
                about=self.stretch.about,
                factor=self.stretch.factor,
                unit=self.time or draft.show.time,
                time_map=draft.time_map,
                value_by=None if self.value_by is None else _value_by(self.value_by, parameter),
            )


class PutTrack(ShowModel):
    """A track in the place of its parameter's own, if there is any."""

    edit: Literal["put_track"]
    track: Annotated[dict[str, Any], read_later(ShowTrack)]

    def make(self, draft: ShowDraft) -> None:
        """Do it to a draft."""
        parameter = _parameter(self.track.get("parameter"), draft.registry, "track/parameter")
        draft.put_track(self.track, parameter)


class ChangeTrack(ShowModel):
    """What a track has beside its keyframes, changed."""

    edit: Literal["change_track"]
    parameter: str
    changes: TrackChanges

    def make(self, draft: ShowDraft) -> None:
        """Do it to a draft."""
        track = draft.track(_parameter(self.parameter, draft.registry))
        track.change_head(_given(self.changes), draft.show.time, draft.time_map)


class CopyTrack(ShowModel):
    """A track for another parameter of the same type as well; values are held within its range."""

    edit: Literal["copy_track"]
    parameter: str
    to: str
    """The other parameter."""

    def make(self, draft: ShowDraft) -> None:
        """Do it to a draft."""
        track = draft.track(_parameter(self.parameter, draft.registry))
        draft.replace(track.copied_to(_parameter(self.to, draft.registry, "to")))


class RemoveTrack(ShowModel):
    """A track less, of an unknown parameter too."""

    edit: Literal["remove_track"]
    parameter: str

    def make(self, draft: ShowDraft) -> None:
        """Do it to a draft."""
        draft.remove_track(self.parameter)


class ApplyLook(ShowModel):
    """Many parameters given values at once, from a time on or throughout."""

    edit: Literal["apply_look"]
    look: Look
    at: Number | None = None
    """From when on: what was before stays, and each track goes on to its next keyframe from there. Throughout
    where it is not given: what the tracks were is gone."""
    time: TimeUnit | None = None
    """The unit of `at`; the show's where it is not given."""

    def make(self, draft: ShowDraft) -> None:
        """Do it to a draft."""
        if self.at is None:
            self.look.put_throughout(draft)
        else:
            self.look.put_at(draft, self.at, self.time or draft.show.time)


class ChangeShow(ShowModel):
    """What a show has beside its tracks, changed."""

    edit: Literal["change_show"]
    changes: ShowChanges

    def make(self, draft: ShowDraft) -> None:
        """Do it to a draft."""
        draft.change_head(_given(self.changes))


Edit = Annotated[
    AddKeyframe
    | ChangeKeyframe
    | RemoveKeyframe
    | MoveKeyframes
    | PutTrack
    | ChangeTrack
    | CopyTrack
    | RemoveTrack
    | ApplyLook
    | ChangeShow,
    Field(discriminator="edit"),
]
EDITS: dict[str, type[ShowModel]] = {
    get_args(model.model_fields["edit"].annotation)[0]: model for model in get_args(get_args(Edit)[0])
}
"""Every edit by its name."""


def read_edits(document: object) -> list[Edit]:
    """Read a list of edits from JSON.

    Raises:
        ShowError: It is none; the error knows of what else is wrong.
    """
    if not isinstance(document, list | tuple):
        raise ShowError(f"{shown(document)} is no list; a list of edits is needed here", field="edits")
    edits: list[Edit] = []
    errors: list[ShowError] = []
    # One by one: as a whole, many thousands would be read without a turn for another thread.
    for index, entry in enumerate(cast("Sequence[object]", document)):
        try:
            edits.append(_read_edit(entry))
        except ShowError as error:
            errors.append(error.within(f"edits/{index}"))
            if len(errors) == MAX_FAULTS:
                break
    if errors:
        raise together(errors)
    return edits


def with_edits(
    show: Show, edits: object, registry: ParameterRegistry, time_map: TimeMap | None = None
) -> Show:
    """The show with a list of edits made, one after another; only their outcome has to be a show.

    So two keyframes may change places. docs/shows.md says what each does.

    Args:
        show: As it is.
        edits: The list, as JSON.
        registry: The parameters.
        time_map: How the music's time runs, for edits in another unit than a track's; 120 beats a minute in
            4/4 where it is not given.

    Raises:
        ShowError: An edit, or what comes of them, is not as it should be.
        KeyNotFoundError: A track or keyframe is not there.
    """
    return with_read_edits(show, read_edits(edits), registry, time_map)


def with_read_edits(
    show: Show, edits: Sequence[Edit], registry: ParameterRegistry, time_map: TimeMap | None = None
) -> Show:
    """`with_edits` of edits that are read already."""
    draft = ShowDraft(show, registry, time_map or TimeMap.steady())
    for index, edit in enumerate(edits):
        try:
            edit.make(draft)
        except ShowError as error:
            raise error.within(f"edits/{index}") from None
    return draft.finished()


def with_edit(show: Show, edit: Edit, registry: ParameterRegistry, time_map: TimeMap | None = None) -> Show:
    """The show with one edit made; an error names its fields alone. See `with_edits`."""
    draft = ShowDraft(show, registry, time_map or TimeMap.steady())
    edit.make(draft)
    return draft.finished()


def with_track(show: Show, track: Track, registry: ParameterRegistry) -> Show:
    """The show with a track that is read already in the place of its parameter's own: `put_track`.

    Raises:
        ShowError: The show would be too large.
    """
    draft = ShowDraft(show, registry, TimeMap.steady())
    draft.put(track)
    return draft.finished()


def _read_edit(document: object) -> Edit:
    name = cast("Mapping[str, object]", document).get("edit") if isinstance(document, Mapping) else document
    model = EDITS.get(name) if isinstance(name, str) else None
    if model is None:
        raise ShowError(f"{shown(name)} is none of {', '.join(EDITS)}", field="edit")
    try:
        return cast("Edit", model.model_validate(document))
    except ValidationError as error:
        raise show_error(error, model) from None


def _given(changes: ShowModel) -> dict[str, Any]:
    """What is to be changed: the fields that were given, null among them."""
    return {name: getattr(changes, name) for name in changes.model_fields_set}


def _parameter(path: object, registry: ParameterRegistry, field: str = "parameter") -> Parameter:
    parameter = registry.get(path) if isinstance(path, str) else None
    if parameter is None:
        raise ShowError(f"there is no parameter {shown(path)}; GET /parameters lists them all", field=field)
    return parameter


_STEPS = {
    "number": Parameter("value_by", "number", 0.0),
    "vector": Parameter("value_by", "vector", (0.0, 0.0, 0.0)),
}


def _value_by(value: object, parameter: Parameter) -> Any:
    step = _STEPS.get(parameter.type)
    try:
        if step is None:
            raise ValueError(  # noqa: TRY301
                f"a {parameter.type} has nothing that could be added to it; only numbers and vectors have"
            )
        return step.parse(value)
    except ValueError as error:
        raise ShowError(str(error), track=parameter.path, field="value_by") from None
