"""A small performance whose frames tell their numbers, and a clock that is moved by hand."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from reina.instruments import Cast, Casting
from reina.protocol import build_manifest, decode
from reina.protocol.websocket import message_of
from reina.sessions.frames import EncodedFrames, KeptBytes
from reina.sessions.packed_blocks import PackedBlocks

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from reina.performance import FrameLayout, Performance
    from reina.protocol import Frames
    from reina.sessions.session import Session
    from reina.sessions.store import SessionStore


@dataclass(frozen=True)
class Skeleton:
    name: str = "player"
    rig: str = "trumpeter"
    joints: tuple[str, ...] = ("hips", "spine", "head")
    player: int = 0
    reaches: tuple[float, ...] = (1.0, 0.5, 0.2)


@dataclass(frozen=True)
class Parameter:
    path: str
    type: str = "number"
    length: int = 1
    blend: bool = True
    minimum: float | None = None
    maximum: float | None = None


@dataclass(frozen=True)
class Layout:
    fps: int = 60
    # One skeleton and seven floats, so that both sections end in padding.
    skeletons: tuple[Skeleton, ...] = (Skeleton(),)
    parameters: tuple[Parameter, ...] = (
        Parameter("number"),
        Parameter("blocks/color", "color", 3),
        Parameter("camera/target", "vector", 3),
    )


@dataclass(frozen=True)
class Block:
    first_frame: int
    fps: int
    song_time_s: NDArray[np.float64]
    rotations: NDArray[np.float32]
    root_positions: NDArray[np.float32]
    parameters: NDArray[np.float32]
    cuts: NDArray[np.bool_]


@dataclass
class NumberedPerformance:
    """Frame k holds k as its first parameter; `cuts` are cuts."""

    layout: Layout = field(default_factory=Layout)
    cuts: frozenset[int] = frozenset()
    evaluated: list[int] = field(default_factory=list[int])
    broken: bool = False
    threads: list[str] = field(default_factory=list[str])
    blocks_at_once: int = 4

    spans: list[int] = field(default_factory=list[int])
    """How many blocks were asked for each time."""

    def evaluate_blocks(self, first: int, count: int) -> list[Block]:
        self.spans.append(count)
        return [self.evaluate(block) for block in range(first, first + count)]

    def evaluate(self, block: int) -> Block:
        if self.broken:
            raise RuntimeError("this performance is broken")
        self.evaluated.append(block)
        self.threads.append(threading.current_thread().name)
        index = 60 * block + np.arange(60)
        joints = sum(len(skeleton.joints) for skeleton in self.layout.skeletons)
        parameters = np.zeros((60, 7), np.float32)
        parameters[:, 0] = index
        return Block(
            first_frame=60 * block,
            fps=self.layout.fps,
            song_time_s=index / self.layout.fps,
            rotations=np.tile(np.array([0, 0, 0, 1], np.float32), (60, joints, 1)),
            root_positions=np.zeros((60, len(self.layout.skeletons), 3), np.float32),
            parameters=parameters,
            cuts=np.isin(index, list(self.cuts)),
        )


def encoded(
    performance: NumberedPerformance | None = None, *, kept: int = 8, together: KeptBytes | None = None
) -> EncodedFrames:
    """The frames of a numbered performance."""
    numbered = performance or NumberedPerformance()
    manifest = build_manifest(cast("FrameLayout", numbered.layout))
    return EncodedFrames(cast("Performance", numbered), manifest, kept=kept, together=together)


def packed(frames: EncodedFrames, *, kept: int = 64) -> PackedBlocks:
    """The same, packed."""
    return PackedBlocks(frames, cast("FrameLayout", Layout()), 1, kept=kept)


def read(frames: EncodedFrames, messages: list[bytes]) -> Frames:
    """The frames of binary messages, in order."""
    return decode(frames.manifest, b"".join(messages))


class Wire:
    """A viewer's connection that records, and that can be held up: then it takes one frame more."""

    def __init__(self) -> None:
        self.frames: list[bytes] = []
        self.closed: tuple[int, str] | None = None
        self.is_full = False
        self.on_free: Callable[[], None] | None = None
        self._held = False

    @property
    def sent(self) -> list[str | bytes]:
        """What was written, as messages."""
        return [message_of(frame) for frame in self.frames]

    @property
    def texts(self) -> list[str]:
        return [message for message in self.sent if isinstance(message, str)]

    def hold(self) -> None:
        self._held = True

    def let(self) -> None:
        """All that was written is taken."""
        self._held = self.is_full = False
        if self.on_free:
            self.on_free()

    def write(self, frame: bytes) -> None:
        assert not self.is_full, "what is full is not written into"
        self.frames.append(frame)
        self.is_full = self._held

    async def close(self, code: int, reason: str) -> None:
        self.closed = (code, reason)


class HandClock:
    """Server time that stands until it is moved."""

    def __init__(self, time_s: float = 1000.0) -> None:
        self.time_s = time_s

    def __call__(self) -> float:
        return self.time_s


CASTING_FIELDS = ("part", "transposition", "written", "octave_fit", "joined_parts", "player")


def draft_fields(options: dict[str, Any]) -> dict[str, Any]:
    """The fields of a draft, those of the only player's casting put into a cast."""
    casting = {name: options.pop(name) for name in CASTING_FIELDS if name in options}
    of_one = Cast((Casting(**casting),), options.pop("sequence", None))
    return {**options, "cast": of_one}


async def choose(store: SessionStore, session: Session, **fields: Any) -> None:
    """Change a session's title, or what its first player plays, as `PATCH` does."""
    named = {name: fields.pop(name) for name in ("title", "public") if name in fields}
    if "joined_parts" in fields:
        fields["joined_parts"] = tuple(fields["joined_parts"])
    await store.edits.change(session, **named, recast=lambda cast: cast.changed(**fields))
