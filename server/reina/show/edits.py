"""Edits of a show as JSON: several at once, all or none."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, cast

from reina.curves.parameter import Parameter
from reina.curves.parameter_registry import ParameterRegistry
from reina.curves.shown import shown
from reina.curves.value_types import parse_number, parse_numbers
from reina.show.errors import ShowError
from reina.show.location import Json, Location
from reina.show.show import Show
from reina.show.show_draft import ShowDraft
from reina.show.time_map import TIME_UNITS, TimeMap
from reina.show.track_draft import TrackDraft


def with_edits(
    show: Show, edits: object, registry: ParameterRegistry, time_map: TimeMap | None = None
) -> Show:
    """The show with a list of edits made, one after another; only their outcome has to be a show.

    So two keyframes may change places. Each edit is a JSON object with ``edit``, a name of `EDITS`, and that
    edit's fields; docs/shows.md says what each does.

    Args:
        show: As it is.
        edits: The list.
        registry: The parameters.
        time_map: How the music's time runs, for edits in another unit than a track's; 120 beats a minute in
            4/4 where it is not given.

    Raises:
        ShowError: An edit, or what comes of them, is not as it should be.
        KeyNotFoundError: A track or keyframe is not there.
    """
    location = Location()
    draft = ShowDraft(show, registry, time_map or TimeMap.steady())
    for index, entry in enumerate(location.items(edits, "edits")):
        given: Json = cast("Json", entry) if isinstance(entry, Mapping) else {}
        name: object = given.get("edit")
        kind = EDITS.get(name) if isinstance(name, str) else None
        if kind is None:
            raise location.error(f"{shown(name)} is none of {', '.join(EDITS)}", f"edits/{index}/edit")
        try:
            edit = location.fields(given, ("edit", *kind.fields, *kind.optional), what=f"the edit {name}")
            for field in kind.fields:
                if field not in edit:
                    raise location.error("it is missing", field)
            kind.make(draft, edit)
        except ShowError as error:
            field = "/".join(part for part in (f"edits/{index}", error.field) if part)
            raise type(error)(error.detail, track=error.track, key=error.key, field=field) from None
    return draft.finished()


def _parameter(path: object, registry: ParameterRegistry, field: str = "parameter") -> Parameter:
    parameter = registry.get(path) if isinstance(path, str) else None
    if parameter is None:
        raise ShowError(f"there is no parameter {shown(path)}; GET /parameters lists them all", field=field)
    return parameter


def _track(draft: ShowDraft, edit: Json) -> TrackDraft:
    return draft.track(_parameter(edit["parameter"], draft.registry))


def _changes(edit: Json, location: Location) -> Json:
    if not isinstance(edit["changes"], Mapping):
        raise location.error("a JSON object of the fields to change is needed here", "changes")
    return cast("Json", edit["changes"])


def _add_keyframe(draft: ShowDraft, edit: Json) -> None:
    parameter = _parameter(edit["parameter"], draft.registry)
    location = Location(parameter.path)
    replaces = location.flag(edit, "replace")
    if not isinstance(edit["keyframe"], Mapping):
        raise location.error("a keyframe is a JSON object", "keyframe")
    track = draft.track_or_new(parameter)
    track.add(cast("Json", edit["keyframe"]), replaces=replaces, time_map=draft.time_map)


def _change_keyframe(draft: ShowDraft, edit: Json) -> None:
    track = _track(draft, edit)
    track.change(edit["key"], _changes(edit, Location(track.parameter.path, str(edit["key"]))))


def _remove_keyframe(draft: ShowDraft, edit: Json) -> None:
    _track(draft, edit).remove(edit["key"])


def _move_keyframes(draft: ShowDraft, edit: Json) -> None:
    location = Location()
    if not isinstance(edit["keyframes"], Mapping):
        raise location.error("an object is needed here: parameters, and for each a list of keys", "keyframes")
    unit = location.choice(edit, "time", TIME_UNITS, draft.show.time)
    by = _number(edit.get("by", 0.0), "by")
    stretch = location.fields(edit.get("stretch", {}), ("about", "factor"), what="stretch")
    about = _number(stretch.get("about", 0.0), "stretch/about")
    factor = _number(stretch.get("factor", 1.0), "stretch/factor")
    if not MIN_FACTOR <= factor <= 1.0 / MIN_FACTOR:
        lies = f"it is greater than 0, and lies within {MIN_FACTOR:g} and {1.0 / MIN_FACTOR:g}"
        raise location.error(f"{factor:g} is no factor; {lies}", "stretch/factor")
    for path, keys in cast("Json", edit["keyframes"]).items():
        parameter = _parameter(path, draft.registry, "keyframes")
        draft.track(parameter).move(
            location.items(keys, f"keyframes/{path}"),
            by=by,
            about=about,
            factor=factor,
            unit=unit,
            time_map=draft.time_map,
            value_by=_value_by(edit["value_by"], parameter) if "value_by" in edit else None,
        )


def _number(value: object, field: str) -> float:
    try:
        return parse_number(value)
    except ValueError as error:
        raise ShowError(str(error), field=field) from None


def _value_by(value: object, parameter: Parameter) -> float | tuple[float, ...]:
    if parameter.type not in ("number", "vector"):
        raise ShowError(
            f"a {parameter.type} has nothing that could be added to it; only numbers and vectors have",
            track=parameter.path,
            field="value_by",
        )
    try:
        return parse_number(value) if parameter.type == "number" else parse_numbers(value, 3)
    except ValueError as error:
        raise ShowError(str(error), track=parameter.path, field="value_by") from None


def _put_track(draft: ShowDraft, edit: Json) -> None:
    if not isinstance(edit["track"], Mapping):
        raise Location().error("a track is a JSON object", "track")
    fields = cast("Json", edit["track"])
    draft.put_track(fields, _parameter(fields.get("parameter"), draft.registry, "track/parameter"))


def _change_track(draft: ShowDraft, edit: Json) -> None:
    track = _track(draft, edit)
    location = Location(track.parameter.path)
    changes = location.fields(
        _changes(edit, location), CHANGED_OF_TRACK, what="what can be changed of a track"
    )
    track.change_head(changes, draft.show.time, draft.time_map)


def _copy_track(draft: ShowDraft, edit: Json) -> None:
    track = _track(draft, edit)
    draft.replace(track.copied_to(_parameter(edit["to"], draft.registry, "to")))


def _remove_track(draft: ShowDraft, edit: Json) -> None:
    draft.remove_track(str(edit["parameter"]))


def _change_show(draft: ShowDraft, edit: Json) -> None:
    draft.change_head(
        Location().fields(_changes(edit, Location()), CHANGED_OF_SHOW, what="what can be changed")
    )


MIN_FACTOR = 1e-6
"""Nothing is stretched further than so far, or than its inverse."""
CHANGED_OF_TRACK = ("time", "before", "after", "color_space", "muted", "solo", "events")
CHANGED_OF_SHOW = ("title", "description", "markers")


@dataclass(frozen=True)
class EditKind:
    """One kind of edit.

    Attributes:
        make: Does it to a draft; its second argument has all of `fields`.
        fields: What it needs.
        optional: What it may have besides.
    """

    make: Callable[[ShowDraft, Json], Any]
    fields: tuple[str, ...]
    optional: tuple[str, ...] = ()


EDITS: dict[str, EditKind] = {
    "add_keyframe": EditKind(_add_keyframe, ("parameter", "keyframe"), ("replace",)),
    "change_keyframe": EditKind(_change_keyframe, ("parameter", "key", "changes")),
    "remove_keyframe": EditKind(_remove_keyframe, ("parameter", "key")),
    "move_keyframes": EditKind(_move_keyframes, ("keyframes",), ("by", "stretch", "time", "value_by")),
    "put_track": EditKind(_put_track, ("track",)),
    "change_track": EditKind(_change_track, ("parameter", "changes")),
    "copy_track": EditKind(_copy_track, ("parameter", "to")),
    "remove_track": EditKind(_remove_track, ("parameter",)),
    "change_show": EditKind(_change_show, ("changes",)),
}
"""Every edit by its name."""
