"""Packed blocks of one performance: packed once, shared by all viewers and all caches."""

from __future__ import annotations

import asyncio
import threading
from collections import OrderedDict
from typing import TYPE_CHECKING, Literal

from reina.protocol import Steps, pack

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.performance import FrameLayout
    from reina.sessions.frames import EncodedFrames

Form = Literal["packed", "lossless"]
"""Rounded so that nobody sees it, or bit for bit."""
PACKED_KEPT = 64
"""How many blocks of a session are kept packed at most: a minute."""


class PackedBlocks:
    """The blocks of encoded frames as they are sent and cached; the last used are kept.

    May be used by several threads.

    Args:
        frames: The frames; what is kept here counts as theirs.
        layout: What they hold: how finely it is to be kept follows from it.
        revision: Which state of score, cast and show they are of, 64 bits.
        kept: How many blocks are kept at most.
    """

    def __init__(
        self, frames: EncodedFrames, layout: FrameLayout, revision: int, *, kept: int = PACKED_KEPT
    ) -> None:
        self.frames = frames
        """The frames as they are."""
        self._layout = layout
        self._revision = revision
        self._kept = kept
        self._packed: OrderedDict[tuple[int, Form], bytes] = OrderedDict()
        self._packing = threading.Lock()
        self._steps: dict[Form, Steps] = {}

    @property
    def revision(self) -> str:
        """The same as 16 hexadecimal digits."""
        return f"{self._revision:016x}"

    @property
    def fps(self) -> int:
        """Frames a second of song time."""
        return self.frames.manifest.fps

    def packed(self, number: int, form: Form) -> bytes | None:
        """A block, where it is at hand."""
        return self._packed.get((number, form))

    def block(self, number: int, form: Form) -> bytes:
        """A block; takes some milliseconds where it is not at hand."""
        key = (number, form)
        with self._packing:
            data = self._packed.get(key)
            if data is None:
                frames, manifest = self.frames.block(number), self.frames.manifest
                data = pack(manifest, frames, self._steps_of(form), revision=self._revision)
                self._packed[key] = data
                self.frames.count(len(data))
            self._packed.move_to_end(key)
            while len(self._packed) > self._kept:
                _, gone = self._packed.popitem(last=False)
                self.frames.count(-len(gone))
        return data

    async def ready(self, first_s: float, last_s: float, forms: Iterable[Form]) -> None:
        """Have the blocks from one song time to another evaluated on a thread, and packed in some forms."""
        await self.frames.ready(first_s, last_s)
        for form in forms:
            await self.made(self.frames.numbers(first_s, last_s), form)

    async def made(self, numbers: Iterable[int], form: Form) -> None:
        """Have some blocks packed on a thread, those that are not at hand."""
        loop = asyncio.get_running_loop()
        for number in numbers:
            if self.packed(number, form) is None:
                await loop.run_in_executor(self.frames.thread, self.block, number, form)

    def forget(self) -> None:
        """Drop every block, and every frame: what an idle session need not keep."""
        self._packed.clear()
        self.frames.forget()

    def _steps_of(self, form: Form) -> Steps:
        steps = self._steps.get(form)
        if steps is None:
            manifest = self.frames.manifest
            steps = Steps.exact(manifest) if form == "lossless" else Steps.of(self._layout)
            self._steps[form] = steps
        return steps
