"""Choices that a track names and that are not there, of parameters whose choices a session may add to."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, cast

from reina.curves.parameter import Parameter
from reina.show.track import Track


def unknown_choices(track: Track | Mapping[str, Any], parameter: Parameter) -> tuple[str, ...]:
    """Names of choices that a track has and its parameter has not; none where choices are not open.

    Args:
        track: The track, or its document, which may be anything.
        parameter: What it moves.
    """
    if not parameter.open_choices:
        return ()
    named = _of_track(track) if isinstance(track, Track) else _of_document(track)
    names = (name for name in named if isinstance(name, str) and name not in parameter.choices)
    return tuple(dict.fromkeys(names))


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
