"""Edits of a show as JSON: several at once, all or none, and a history that can be walked back."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, cast

from reina.keyframes.errors import KeyNotFoundError, ShowError
from reina.keyframes.parameter import Parameter
from reina.keyframes.parameter_registry import ParameterRegistry
from reina.keyframes.place import Json, Place
from reina.keyframes.show import Show, changed_keyframe_document
from reina.keyframes.show_reader import read_keyframe, read_track
from reina.keyframes.show_writer import keyframe_document, track_document
from reina.keyframes.track import Track

Tracks = dict[str, dict[str, Any]]
"""Tracks as JSON by their parameters' paths, while they are being edited."""


def with_edits(show: Show, edits: object, registry: ParameterRegistry) -> Show:
    """The show with a list of edits made, one after another; only their outcome has to be a show.

    So two keyframes may change places. Each edit is a JSON object with ``edit``:

    - ``add_keyframe``: ``parameter``, ``keyframe``;
    - ``change_keyframe``: ``parameter``, ``key``, ``changes`` (fields; null goes back to the default);
    - ``remove_keyframe``: ``parameter``, ``key``;
    - ``put_track``: ``track``, which takes the place of the one of its parameter;
    - ``remove_track``: ``parameter``.

    Raises:
        ShowError: An edit, or what comes of them, is not as it should be.
        KeyNotFoundError: A track or keyframe is not there.
    """
    place = Place()
    named = _named(place.items(edits, "edits"))
    tracks: Tracks = {
        track.parameter: track_document(track, show.time)
        for track in show.tracks
        if isinstance(track, Track) and track.parameter in named
    }
    touched: dict[str, None] = {}
    for index, entry in enumerate(place.items(edits, "edits")):
        given: Json = cast("Json", entry) if isinstance(entry, Mapping) else {}
        name: object = given.get("edit")
        kind = _EDITS.get(str(name))
        if kind is None:
            raise place.error(f"{name!r} is none of {', '.join(_EDITS)}", f"edits/{index}/edit")
        fields, make = kind
        edit = place.fields(given, ("edit", *fields), what=f"the edit {name}")
        for field in fields:
            if field not in edit:
                raise place.error("it is missing", f"edits/{index}/{field}")
        touched[make(tracks, edit, registry)] = None
    for path in touched:
        document = tracks.get(path)
        if document is None or not (document["keyframes"] or "events" in document):
            if any(track.parameter == path for track in show.tracks):
                show = show.without_track(path)
            continue
        show = show.with_track(read_track(document, _parameter(path, registry), show.time))
    return show


def _named(edits: Iterable[object]) -> set[str]:
    """The parameters that edits name, so that no other track has to be written out and read again."""
    found: set[str] = set()
    for entry in edits:
        given: Json = cast("Json", entry) if isinstance(entry, Mapping) else {}
        track = given.get("track")
        inner: Json = cast("Json", track) if isinstance(track, Mapping) else {}
        found |= {path for path in (given.get("parameter"), inner.get("parameter")) if isinstance(path, str)}
    return found


def _parameter(path: object, registry: ParameterRegistry) -> Parameter:
    parameter = registry.get(path) if isinstance(path, str) else None
    if parameter is None:
        raise ShowError(f"there is no parameter {path!r}; GET /parameters lists them all", field="parameter")
    return parameter


def _add_keyframe(tracks: Tracks, edit: Json, registry: ParameterRegistry) -> str:
    parameter = _parameter(edit["parameter"], registry)
    track = tracks.setdefault(parameter.path, {"parameter": parameter.path, "keyframes": []})
    keys = {keyframe["key"] for keyframe in track["keyframes"]}
    free = (f"k{number}" for number in range(1, len(keys) + 2) if f"k{number}" not in keys)
    track["keyframes"].append(keyframe_document(read_keyframe(edit["keyframe"], parameter, free)))
    return parameter.path


def _change_keyframe(tracks: Tracks, edit: Json, registry: ParameterRegistry) -> str:
    parameter = _parameter(edit["parameter"], registry)
    index = _find(tracks, parameter.path, edit["key"])
    keyframes = tracks[parameter.path]["keyframes"]
    place = Place(parameter.path, str(edit["key"]))
    if not isinstance(edit["changes"], Mapping):
        raise place.error("a JSON object of the fields to change is needed here", "changes")
    changed = changed_keyframe_document(keyframes[index], cast("Json", edit["changes"]))
    keyframes[index] = keyframe_document(read_keyframe(changed, parameter, ()))
    return parameter.path


def _remove_keyframe(tracks: Tracks, edit: Json, registry: ParameterRegistry) -> str:
    path = _parameter(edit["parameter"], registry).path
    index = _find(tracks, path, edit["key"])
    tracks[path]["keyframes"].pop(index)
    return path


def _put_track(tracks: Tracks, edit: Json, registry: ParameterRegistry) -> str:
    document = edit["track"]
    if not isinstance(document, Mapping):
        raise Place().error("a track is a JSON object", "track")
    fields = dict(cast("Json", document))
    parameter = _parameter(fields.get("parameter"), registry)
    if fields.get("keyframes") or "events" in fields:
        # Keyframes get their keys here, so that later edits of the list can name them.
        written = track_document(read_track(fields, parameter, "seconds"), "seconds")
        written.pop("time", None)
        fields = written | {name: fields[name] for name in ("time",) if name in fields}
    else:
        fields["keyframes"] = []
    tracks[parameter.path] = fields
    return parameter.path


def _remove_track(tracks: Tracks, edit: Json, _: ParameterRegistry) -> str:
    path = str(edit["parameter"])
    if tracks.pop(path, None) is None:
        raise KeyNotFoundError("the show has no such track", track=path)
    return path


def _find(tracks: Tracks, path: str, key: object) -> int:
    keyframes: list[dict[str, Any]] = tracks[path]["keyframes"] if path in tracks else []
    for index, keyframe in enumerate(keyframes):
        if keyframe.get("key") == key:
            return index
    raise KeyNotFoundError("there is no such keyframe", track=path, key=str(key))


_EDITS: dict[str, tuple[tuple[str, ...], Callable[[Tracks, Json, ParameterRegistry], str]]] = {
    "add_keyframe": (("parameter", "keyframe"), _add_keyframe),
    "change_keyframe": (("parameter", "key", "changes"), _change_keyframe),
    "remove_keyframe": (("parameter", "key"), _remove_keyframe),
    "put_track": (("track",), _put_track),
    "remove_track": (("parameter",), _remove_track),
}
"""Each kind of edit: its fields, and what it does to the tracks; returns the parameter's path."""


@dataclass(frozen=True)
class ShowHistory:
    """A show with what it was before and what was taken back. Never changed; each step gives a new history.

    Shows share the tracks that did not change, so that a step costs no more than the track it touched.

    Attributes:
        show: As it is.
        past: What it was, the latest last.
        future: What was taken back, the next to be done again last.
        longest: How many steps are kept.
    """

    show: Show
    past: tuple[Show, ...] = ()
    future: tuple[Show, ...] = ()
    longest: int = 200

    def then(self, show: Show) -> "ShowHistory":
        """The history after an edit; what was taken back is forgotten."""
        if show == self.show:
            return self
        return ShowHistory(show, (*self.past, self.show)[-self.longest :], (), self.longest)

    def undone(self) -> "ShowHistory":
        """One step back, or the same where there is none."""
        if not self.past:
            return self
        return ShowHistory(self.past[-1], self.past[:-1], (*self.future, self.show), self.longest)

    def redone(self) -> "ShowHistory":
        """One step forward again, or the same where nothing was taken back."""
        if not self.future:
            return self
        return ShowHistory(self.future[-1], (*self.past, self.show), self.future[:-1], self.longest)
