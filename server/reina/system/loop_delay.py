"""How late the event loop comes to what is due."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from reina.system.metrics import LOOP_DELAY

if TYPE_CHECKING:
    from collections.abc import Callable

SAMPLE_S = 0.1
LONG_DELAY_S = 0.25
TOO_LONG_S = 5.0
"""A loop that comes too late to everything for so long is too busy for anybody else."""


class LoopDelay:
    """Samples the event loop's delay by sleeping.

    Args:
        now: Seconds; the event loop's own time.
    """

    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._late_since: float | None = None
        self._sampling: asyncio.Task[None] | None = None

    def start(self) -> None:
        """Begin to sample, on the running loop."""
        self._sampling = asyncio.create_task(self._sample())

    async def aclose(self) -> None:
        """Sample no more."""
        if self._sampling is not None:
            self._sampling.cancel()
            await asyncio.wait([self._sampling])

    def note(self, delay_s: float) -> None:
        """Take a sample in: how much too late it came, seconds."""
        LOOP_DELAY.observe(max(delay_s, 0.0))
        if delay_s <= LONG_DELAY_S:
            self._late_since = None
        elif self._late_since is None:
            self._late_since = self._now()

    @property
    def long_s(self) -> float:
        """For how long every sample has come more than `LONG_DELAY_S` too late, seconds; 0 where none has."""
        return 0.0 if self._late_since is None else self._now() - self._late_since

    @property
    def is_too_long(self) -> bool:
        """Whether that goes on for `TOO_LONG_S` by now."""
        return self.long_s >= TOO_LONG_S

    async def _sample(self) -> None:
        while True:
            due = self._now() + SAMPLE_S
            await asyncio.sleep(SAMPLE_S)
            self.note(self._now() - due)
