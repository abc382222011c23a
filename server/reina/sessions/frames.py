"""Encoded frames of one performance: evaluated once, shared by all viewers."""

from __future__ import annotations

import asyncio
import itertools
import math
import threading
import time
from collections import OrderedDict
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

from reina.performance import BLOCK_FRAMES
from reina.protocol import FrameFlag, bytes_of, encode_block, join, stamp
from reina.system.metrics import EVALUATION

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from concurrent.futures import Future

    from reina.performance import Performance
    from reina.protocol import Frames, Manifest
    from reina.sessions.schedule import DueFrame

BLOCKS_KEPT = 8
FEWEST_KEPT = 3
"""The block that is sent, the next, and one before: so many are kept in any case."""
KEPT_BYTES = 200_000_000
"""How large the blocks of all performances may be together beyond those."""
_PLAYING, _FIRST, _CUT = (int(flag) for flag in (FrameFlag.PLAYING, FrameFlag.FIRST, FrameFlag.CUT))
_EVALUATING = ThreadPoolExecutor(1, thread_name_prefix="frames")
"""Blocks are evaluated ahead here: on the event loop, which sends them, and would else have to wait."""


class KeptBytes:
    """Counts the bytes of the blocks that several `EncodedFrames` keep. For several threads.

    Args:
        most: How many are kept gladly.
    """

    def __init__(self, most: int = KEPT_BYTES) -> None:
        self._most = most
        self._counting = threading.Lock()
        self._bytes: WeakKeyDictionary[EncodedFrames, int] = WeakKeyDictionary()

    @property
    def is_over(self) -> bool:
        """Whether all keep more than that together."""
        with self._counting:
            return sum(self._bytes.values()) > self._most

    def of(self, frames: EncodedFrames) -> int:
        """How many one has."""
        with self._counting:
            return self._bytes.get(frames, 0)

    def add(self, frames: EncodedFrames, count: int) -> None:
        """One has so many more, or less."""
        with self._counting:
            self._bytes[frames] = self._bytes.get(frames, 0) + count

    def drop(self, frames: EncodedFrames) -> None:
        """One has none any more."""
        with self._counting:
            self._bytes.pop(frames, None)


ALL_KEPT = KeptBytes()
"""Of the whole process."""


class EncodedFrames:
    """A performance's frames as they go out, in aligned blocks of 60 of which the last used are kept.

    Frames are always evaluated by whole aligned blocks: floating point differs in the last bit between a
    block and a row of it, and a frame's bytes are to be the same however it was reached.

    All of them together keep so many bytes; whoever evaluates another block beyond that lets go of its own.

    May be used by several threads.

    Args:
        performance: What is evaluated.
        manifest: What its frames hold.
        kept: How many blocks are kept at most.
        together: Where the bytes of all are counted.
    """

    thread = _EVALUATING
    """Where they are evaluated ahead, and packed."""

    def __init__(
        self,
        performance: Performance,
        manifest: Manifest,
        *,
        kept: int = BLOCKS_KEPT,
        together: KeptBytes | None = None,
    ) -> None:
        self._together = together or ALL_KEPT
        self.manifest = manifest
        self._performance = performance
        self._kept = kept
        self._blocks: OrderedDict[int, Frames] = OrderedDict()
        self._evaluating = threading.Lock()
        self._ahead: Future[Frames] | None = None
        self._sent: tuple[Frames, memoryview] | None = None
        """The block that was read last, and its bytes."""

    async def ready(self, first_s: float, last_s: float) -> None:
        """Have the blocks from one song time to another evaluated on a thread."""
        loop = asyncio.get_running_loop()
        numbers = self.numbers(first_s, last_s)
        for number in numbers:
            if number not in self._blocks:
                # The first alone would be there sooner, but nothing goes out before all of them are.
                await loop.run_in_executor(_EVALUATING, self.block, number, numbers.stop - number)

    def numbers(self, first_s: float, last_s: float) -> range:
        """The blocks from one song time to another."""
        return range(self._number(first_s), self._number(last_s) + 1)

    def has(self, blocks: Iterable[int]) -> bool:
        """Whether all of some blocks are there, by their numbers."""
        return all(number in self._blocks for number in blocks)

    def prefetch(self, number: int) -> None:
        """Begin to evaluate a block on a thread, unless one is being evaluated."""
        if number not in self._blocks and (self._ahead is None or self._ahead.done()):
            self._ahead = _EVALUATING.submit(self.block, number)

    def _number(self, song_time_s: float) -> int:
        return max(0, math.floor(song_time_s * self.manifest.fps + 0.5)) // BLOCK_FRAMES

    def block(self, number: int, needed: int = 1) -> Frames:
        """(60,) frames 60·number ... 60·number + 59, not to be written to.

        Args:
            number: The block's.
            needed: How many blocks from this one on are needed soon.
        """
        frames = self._kept_block(number)
        if frames is not None:
            # Not even for a moment does whoever sends wait for whoever evaluates ahead.
            return frames
        with self._evaluating:
            frames = self._kept_block(number)
            if frames is None:
                frames = self._evaluate(number, self._at_once(number, needed))
            return frames

    def span(self, first: int, last: int) -> Frames:
        """(last - first + 1,) frames first ... last, a copy."""
        blocks = range(first // BLOCK_FRAMES, last // BLOCK_FRAMES + 1)
        start = first - blocks.start * BLOCK_FRAMES
        joined = join([self.block(number) for number in blocks])
        return joined[start : start + last - first + 1]

    def message(self, due: Sequence[DueFrame], *, epoch: int, playing: bool) -> bytes:
        """One binary message of the stream: the frames that are due, stamped, back to back."""
        messages: list[bytes] = []
        for frame in due:
            flags = _PLAYING if playing else 0
            if frame.first:
                flags |= _FIRST
            if frame.cut or (frame.skipped and self._cut_within(frame)):
                flags |= _CUT
            messages.append(
                stamp(self._row(frame.index), epoch=epoch, due_time_s=frame.due_time_s, flags=flags)
            )
        return b"".join(messages)

    def forget(self) -> None:
        """Drop every block: what an idle session need not keep."""
        self._blocks.clear()
        self._sent = None
        self._together.drop(self)

    def count(self, added: int) -> None:
        """Count so many bytes more, or less, as kept of them."""
        self._together.add(self, added)

    @property
    def weight(self) -> int:
        """How many bytes the blocks that are kept have."""
        return self._together.of(self)

    def _evaluate(self, number: int, count: int) -> Frames:
        """Evaluate so many blocks from one on; the frames of the first."""
        begun_s = time.perf_counter()
        blocks = self._performance.evaluate_blocks(number, count)
        made = [encode_block(self.manifest, block) for block in blocks]
        spent_s = time.perf_counter() - begun_s
        for place, frames in enumerate(made):
            EVALUATION.observe(spent_s / len(made))
            frames.flags.writeable = False
            self._blocks[number + place] = frames
            self._together.add(self, frames.nbytes)
        while len(self._blocks) > self._most_kept():
            _, gone = self._blocks.popitem(last=False)
            self._together.add(self, -gone.nbytes)
        return made[0]

    def _at_once(self, number: int, needed: int) -> int:
        """How many blocks are evaluated from one on.

        What is shown first after a seek or an edit comes alone, as fast as may be. As more and more blocks
        are there that come just before, somebody plays on, and several at once cost less each.
        """
        before = next(count for count in itertools.count() if number - count - 1 not in self._blocks)
        ahead = min(before, self._performance.blocks_at_once)
        most = max(1, min(max(ahead, needed), self._most_kept() - 1))
        return next((count for count in range(1, most) if number + count in self._blocks), most)

    def _most_kept(self) -> int:
        return min(self._kept, FEWEST_KEPT) if self._together.is_over else self._kept

    def _kept_block(self, number: int) -> Frames | None:
        frames = self._blocks.get(number)
        if frames is not None:
            try:  # noqa: SIM105 - for each frame that is sent
                self._blocks.move_to_end(number)
            except KeyError:
                pass  # another thread has just let go of it
        return frames

    def _row(self, index: int) -> memoryview:
        number, row = divmod(index, BLOCK_FRAMES)
        frames, sent = self.block(number), self._sent
        if sent is None or sent[0] is not frames:
            self._sent = sent = (frames, bytes_of(frames))
        size = self.manifest.frame_size
        return sent[1][row * size : (row + 1) * size]

    def _cut_within(self, frame: DueFrame) -> bool:
        """Whether one of the frames that were passed over just before is a cut."""
        passed = self.span(frame.index - frame.skipped, frame.index - 1)
        return bool((passed["flags"] & _CUT).any())
