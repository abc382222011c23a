"""Choices that a track names and that are not there, of parameters whose choices a session may add to."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, cast

from reina.curves.parameter import Parameter
from reina.show.track import Track, UnknownTrack


def unknown_choices(track: Track | UnknownTrack, parameter: Parameter) -> tuple[str, ...]:
    """Names of choices that a track has and its parameter has not; none where choices are not open."""
    if not parameter.open_choices:
        return ()
    named = track.choices if isinstance(track, UnknownTrack) else _distinct(_of_track(track))
    return tuple(name for name in named if name not in parameter.choices)


def choices_of(document: Mapping[str, Any], parameter: Parameter) -> tuple[str, ...]:
    """What a track's document, which may be anything, chooses; nothing where choices are not open."""
    return _distinct(_of_document(document)) if parameter.open_choices else ()


def _distinct(named: Iterable[object]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(name for name in named if isinstance(name, str)))


def _of_track(track: Track) -> Iterator[object]:
    yield from (keyframe.value for keyframe in track.keyframes)
    if track.events is not None:
        yield track.events.amount
        yield from track.events.cycle


def _of_document(document: Mapping[str, Any]) -> Iterator[object]:
    for keyframe in _items(document.get("keyframes")):
        yield _fields(keyframe).get("value")
    events = _fields(document.get("events"))
    yield events.get("amount")
    yield from _items(events.get("cycle"))


def _fields(value: object) -> Mapping[str, object]:
    return cast("Mapping[str, object]", value) if isinstance(value, Mapping) else {}


def _items(value: object) -> Sequence[object]:
    return cast("Sequence[object]", value) if isinstance(value, list | tuple) else ()
