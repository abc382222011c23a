"""Keeps the clocks of sessions: soon after they are changed, and not for each of very many changes."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING

from reina.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from reina.sessions.session import Session

KEPT_WITHIN_S = 1.0
"""What a clock was told is on disk so soon; a power cut loses no more than that of it."""

_log = logging.getLogger(__name__)


class ClockKeeping:
    """Has each clock written once for all that it is told within a second.

    Args:
        keep: Writes a session's clock as it is then.
        within_s: How soon.
    """

    def __init__(
        self, keep: Callable[[Session], Awaitable[None]], *, within_s: float = KEPT_WITHIN_S
    ) -> None:
        self._keep = keep
        self._within_s = within_s
        self._waiting: dict[Session, asyncio.Task[None]] = {}
        self._writing: set[asyncio.Task[None]] = set()

    def note(self, session: Session) -> None:
        """A session's clock has been changed."""
        if session not in self._waiting:
            self._waiting[session] = asyncio.create_task(self._keep_soon(session))

    async def written(self) -> None:
        """Wait until none is being written: a session whose clock is cannot be put away."""
        while self._writing:
            await asyncio.wait(self._writing)

    async def aclose(self) -> None:
        """Wait for what is being written; what still waits is left to who puts the sessions away."""
        for task in self._waiting.values():
            task.cancel()
        tasks = {*self._waiting.values(), *self._writing}
        if tasks:
            await asyncio.wait(tasks)

    async def _keep_soon(self, session: Session) -> None:
        try:
            await asyncio.sleep(self._within_s)
        finally:
            # What is told from now on is written once more.
            own = self._waiting.pop(session)
        self._writing.add(own)
        try:
            await self._keep(session)
        except (InputError, OSError) as error:
            _log.warning("the clock of session %s could not be kept: %s", session.id, error)
        finally:
            self._writing.discard(own)
