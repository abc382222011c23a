"""Writes shows as JSON: what `show_reader` reads, without what is so anyway."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pickle import PickleBuffer
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from reina.curves.interpolation import interpolation_name
from reina.curves.keyframe import Keyframe
from reina.curves.options import options_of
from reina.show.time_map import TimeUnit
from reina.show.track import Track
from reina.system.json_text import json_text, with_list

_WRITTEN = "_written"
"""Where a track has its text with it on its way from one process to another."""


@dataclass(frozen=True)
class WrittenTrack:
    """A track as JSON text.

    Attributes:
        default_time: The unit of times of which the text does not speak.
        text: The text, UTF-8.
        begins: ``(K,)`` where each keyframe begins in it.
        ends: ``(K,)`` where each ends.
    """

    default_time: TimeUnit
    text: bytes
    begins: NDArray[np.int32]
    ends: NDArray[np.int32]

    def keyframes(self) -> list[bytes]:
        """Each keyframe's text."""
        text = self.text
        return [text[begin:end] for begin, end in zip(self.begins.tolist(), self.ends.tolist(), strict=True)]

    def __getstate__(self) -> dict[str, Any]:
        """What is sent to another process (pickle): the text beside the pickle."""
        return {**self.__dict__, "text": PickleBuffer(self.text)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take over what `__getstate__` gave."""
        self.__dict__.update(state, text=bytes(state["text"]))


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
    """A keyframe as JSON text."""
    return json_text(_fields(keyframe))


def write_with(track: Track, default_time: TimeUnit) -> None:
    """Write a track, and put the text with it until `written_track` takes it, in another process mostly."""
    object.__setattr__(track, _WRITTEN, written_track(track, default_time))


def written_track(
    track: Track, default_time: TimeUnit, known: Mapping[int, bytes] | None = None
) -> WrittenTrack:
    """`track_document` as JSON text.

    Args:
        track: The track.
        default_time: The unit of the show's times.
        known: Texts of keyframes by their ids (`id`): of a long track an edit writes what it changed alone.
    """
    # Taken from the track: the history holds many states of one, and needs the text of none.
    brought: WrittenTrack | None = track.__dict__.pop(_WRITTEN, None)
    if brought is not None and brought.default_time == default_time:
        return brought
    known = known or {}
    texts = [known.get(id(keyframe)) or keyframe_text(keyframe) for keyframe in track.keyframes]
    head = track_document(replace(track, keyframes=()), default_time)
    del head["keyframes"]
    text = with_list(head, "keyframes", texts)
    lengths = np.fromiter(map(len, texts), np.int32, len(texts))
    # The keyframes end the text: "…[a,b,c]}".
    ends = len(text) - len("]}") + 1 - np.cumsum(lengths[::-1] + 1, dtype=np.int32)[::-1] + lengths
    return WrittenTrack(default_time, text, ends - lengths, ends)


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
