"""Writes shows as JSON: what `show_reader` reads, without what is so anyway."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, cast

from reina.curves.interpolation import interpolation_name
from reina.curves.keyframe import Keyframe
from reina.curves.options import options_of
from reina.show.time_map import TimeUnit
from reina.show.track import Track
from reina.system.json_text import json_text, with_list

_TEXT = "_json_text"
"""Where a keyframe keeps its text."""


def keyframe_document(keyframe: Keyframe[Any]) -> dict[str, Any]:
    """A keyframe as JSON."""
    return json_value(_fields(keyframe))


def _fields(keyframe: Keyframe[Any]) -> dict[str, Any]:
    document: dict[str, Any] = {
        "key": keyframe.key,
        "time": keyframe.time,
        "value": keyframe.value,
        "interpolation": interpolation_name(keyframe),
    }
    for tangent in ("in_tangent", "out_tangent"):
        if getattr(keyframe, tangent) is not None:
            document[tangent] = getattr(keyframe, tangent)
    for declared in options_of(type(keyframe)):
        if getattr(keyframe, declared.name) != declared.default:
            document[declared.name] = getattr(keyframe, declared.name)
    return document


def keyframe_text(keyframe: Keyframe[Any]) -> bytes:
    """A keyframe as JSON text. Kept with it: of a large show an edit writes what it changed alone."""
    kept: bytes | None = keyframe.__dict__.get(_TEXT)
    if kept is None:
        kept = json_text(_fields(keyframe))
        object.__setattr__(keyframe, _TEXT, kept)
    return kept


def track_text(track: Track, default_time: TimeUnit) -> bytes:
    """`track_document` as JSON text."""
    head = track_document(replace(track, keyframes=()), default_time)
    del head["keyframes"]
    return with_list(head, "keyframes", [keyframe_text(keyframe) for keyframe in track.keyframes])


def track_document(track: Track, default_time: TimeUnit) -> dict[str, Any]:
    """A track as JSON."""
    document: dict[str, Any] = {"parameter": track.parameter}
    if track.time != default_time:
        document["time"] = track.time
    if track.before != "hold":
        document["before"] = track.before
    if track.after != "hold":
        document["after"] = track.after
    if track.color_space != "oklab":
        document["color_space"] = track.color_space
    if track.muted:
        document["muted"] = True
    if track.solo:
        document["solo"] = True
    if track.events is not None:
        document["events"] = track.events.model_dump(mode="json", exclude_defaults=True, exclude_none=True)
    document["keyframes"] = [keyframe_document(keyframe) for keyframe in track.keyframes]
    return document


def json_value(value: Any) -> Any:
    """A value as JSON has it: tuples become lists."""
    if isinstance(value, tuple):
        return [json_value(item) for item in cast("tuple[Any, ...]", value)]
    if isinstance(value, Mapping):
        return {name: json_value(item) for name, item in cast("Mapping[str, Any]", value).items()}
    return value
