"""Choices that a track names and that are not there, of parameters whose choices a session may add to."""

from collections.abc import Iterator, Mapping
from typing import Any

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
    keyframes = document.get("keyframes")
    for keyframe in keyframes if isinstance(keyframes, list | tuple) else ():
        if isinstance(keyframe, Mapping):
            yield keyframe.get("value")
    events = document.get("events")
    if isinstance(events, Mapping):
        yield events.get("amount")
        cycle = events.get("cycle")
        yield from cycle if isinstance(cycle, list | tuple) else ()
