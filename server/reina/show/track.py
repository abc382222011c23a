"""A track: the keyframes of one parameter, and what it does where there are none."""

import pickle
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, cast

from reina.curves.extrapolation import Extrapolation
from reina.curves.keyframe import Keyframe
from reina.curves.spaces import ColorSpace
from reina.show.errors import KeyNotFoundError, ShowError
from reina.show.event_response import EventResponse
from reina.show.time_map import TimeUnit
from reina.system.json_text import read_json

NEAREST = 1e-9
"""Keys that are nearer than this stand at one time: a slope between them would be beyond all measure."""

PIECE = 500
"""Keyframes that are sent to another process at a time."""


@dataclass(frozen=True)
class Track:
    """The keyframes of one parameter.

    Attributes:
        parameter: The parameter's path.
        keyframes: In the order of their times, no two at one time, no two with one key. Their values are as
            JSON writes them (`reina.curves.value_types.Value`).
        time: The unit of the keyframes' times.
        before: What happens before the first keyframe.
        after: What happens after the last.
        color_space: What colours are mixed in.
        muted: Whether the show leaves the track out.
        solo: Whether the show leaves out all tracks but those that are solo.
        events: What it does at notes, beats or bars on top of its keyframes; a track that has this needs no
            keyframes.
    """

    parameter: str
    keyframes: tuple[Keyframe[Any], ...]
    time: TimeUnit = "seconds"
    before: Extrapolation = "hold"
    after: Extrapolation = "hold"
    color_space: ColorSpace = "oklab"
    muted: bool = False
    solo: bool = False
    events: EventResponse | None = None

    def __post_init__(self) -> None:
        ordered = tuple(sorted(self.keyframes, key=lambda keyframe: keyframe.time))
        seen: set[str] = set()
        for index, keyframe in enumerate(ordered):
            if index and keyframe.time - ordered[index - 1].time < NEAREST:
                raise ShowError(
                    f"{ordered[index - 1].key} stands at {keyframe.time:g} {self.time} already;"
                    " keys have times of their own, and a step makes a jump",
                    track=self.parameter,
                    key=keyframe.key,
                    field="time",
                )
            if keyframe.key in seen:
                raise ShowError(
                    f"the key {keyframe.key} is given twice; every key of a track has its own",
                    track=self.parameter,
                    key=keyframe.key,
                    field="key",
                )
            seen.add(keyframe.key)
        object.__setattr__(self, "keyframes", ordered)

    def __getstate__(self) -> dict[str, Any]:
        """What is sent to another process (pickle): the keyframes in pieces, each as the rows of its numbers.

        As one, the memory of which of 100,000 have been met would be let go of in one step, in which no other
        thread had its turn. Pieces that travel beside the pickle are let go of one by one.
        """
        pieces = (self.keyframes[at : at + PIECE] for at in range(0, len(self.keyframes), PIECE))
        return {**self.__dict__, "keyframes": [pickle.PickleBuffer(_packed(piece)) for piece in pieces]}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take over what `__getstate__` gave in one of the server's own processes."""
        pieces: list[bytes] = state.pop("keyframes")
        keyframes: list[Keyframe[Any]] = []
        pieces.reverse()
        while pieces:
            rows = cast("_Rows", pickle.loads(pieces.pop()))  # noqa: S301
            keyframes += [kind(*row) for kind, row in rows]
        self.__dict__.update(state, keyframes=tuple(keyframes))

    def keyframe(self, key: str) -> Keyframe[Any]:
        """The keyframe of a key.

        Raises:
            KeyNotFoundError: The track has none.
        """
        for keyframe in self.keyframes:
            if keyframe.key == key:
                return keyframe
        raise KeyNotFoundError("there is no such keyframe", track=self.parameter, key=key)


_Rows = list[tuple[type[Keyframe[Any]], tuple[Any, ...]]]


def _packed(keyframes: tuple[Keyframe[Any], ...]) -> bytes:
    names = {kind: tuple(declared.name for declared in fields(kind)) for kind in set(map(type, keyframes))}
    rows: _Rows = [
        (type(keyframe), tuple([getattr(keyframe, name) for name in names[type(keyframe)]]))
        for keyframe in keyframes
    ]
    return pickle.dumps(rows, protocol=5)


@dataclass(frozen=True)
class UnknownTrack:
    """A track of a parameter, or with a choice, that is not in the registry: kept as it came, without effect.

    It is kept as text: as objects it would take thirty times the memory.

    Attributes:
        parameter: The path.
        text: The track as JSON, UTF-8.
        choices: What it chooses, each once, where its parameter is known and has choices that may be added.
    """

    parameter: str
    text: bytes
    choices: tuple[str, ...] = ()

    @property
    def document(self) -> Mapping[str, Any]:
        """The track as JSON; read anew each time."""
        return cast("Mapping[str, Any]", read_json(self.text))
