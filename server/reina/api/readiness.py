"""Whether the server can do what it is there for, and what keeps it from that."""

from __future__ import annotations

import asyncio
import contextlib
import shutil
import tempfile
from inspect import isawaitable
from typing import TYPE_CHECKING, Literal

from reina.errors import InputError
from reina.protocol.resources import Unready
from reina.sound.font import MissingSoundfontError, find_soundfont
from reina.system.logs import logger
from reina.system.metrics import READY

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable
    from pathlib import Path

    from reina.api.http.ending import Ending
    from reina.api.settings import Settings
    from reina.sessions.workers.pool import WorkerPool
    from reina.system.loop_delay import LoopDelay

    Reason = Literal[
        "data-directory",
        "data-full",
        "database",
        "bus",
        "workers",
        "soundfont",
        "page",
        "event-loop",
        "ending",
    ]

EVERY_S = 5.0
"""How often what takes long to see is looked at."""
STARTING_S = 20.0
"""Time for a worker to start."""
LEAST_ROOM_BYTES = 100_000_000
"""With less room in the data directory than a song takes, uploads are about to fail."""

_log = logger(__name__)


class Readiness:
    """Looks at what the server needs, in the background; whoever asks hears what was seen last.

    Args:
        settings: Where its files are.
        delay: Of the event loop.
        ending: Whether the server ends.
        workers: Those who read scores.
        database: Raises an error where the sessions' database is away; None where there is none to ask.
        bus: The same of what connects it with other servers.
        every_s: How often it is looked.
    """

    def __init__(
        self,
        settings: Settings,
        *,
        delay: LoopDelay,
        ending: Ending,
        workers: WorkerPool,
        database: Callable[[], Awaitable[None] | None] | None = None,
        bus: Callable[[], Awaitable[None]] | None = None,
        every_s: float = EVERY_S,
    ) -> None:
        self._settings = settings
        self._delay = delay
        self._ending = ending
        self._workers = workers
        self._database = database
        self._bus = bus
        self._every_s = every_s
        self._seen: list[Unready] = []
        self._looking: asyncio.Task[None] | None = None

    async def start(self) -> None:
        """Look once, and then again and again."""
        await self.look()
        self._looking = asyncio.create_task(self._look_on())

    async def aclose(self) -> None:
        """Look no more."""
        if self._looking is not None:
            self._looking.cancel()
            await asyncio.wait([self._looking])

    def missing(self) -> list[Unready]:
        """What keeps the server from being ready now; empty when it is ready."""
        missing = list(self._seen)
        if self._delay.is_too_long:
            detail = "the server comes too late to everything: it has too much to do"
            missing.append(_unready("event-loop", detail))
        if self._ending.announced:
            missing.append(_unready("ending", "the server is being stopped"))
        return missing

    async def look(self) -> None:
        """Look at the disk, the database, the bus, the workers, the soundfont and the page."""
        seen = await asyncio.to_thread(_of_files, self._settings)
        looked = await self._of_database(), await self._of_bus(), await self._of_workers()
        seen += [one for one in looked if one is not None]
        before = {one.reason for one in self._seen}
        now = {one.reason for one in seen}
        self._seen = seen
        READY.set(not self.missing())
        for one in seen:
            if one.reason not in before:
                _log.error("not ready", kind=one.reason, detail=one.detail)
        if before and not now:
            _log.info("ready again")

    async def _look_on(self) -> None:
        while True:
            await asyncio.sleep(self._every_s)
            await self.look()

    async def _of_database(self) -> Unready | None:
        if self._database is None:
            return None
        try:
            asked = self._database()
            if isawaitable(asked):
                await asked
        except Exception as error:
            # Whatever a driver raises: the database cannot be used.
            _log.warning("the database is away", exc_info=error)
            return _unready("database", "the sessions' database does not answer")
        return None

    async def _of_bus(self) -> Unready | None:
        if self._bus is None:
            return None
        try:
            await self._bus()
        except InputError:
            return _unready("bus", "what connects the server with the others does not answer")
        return None

    async def _of_workers(self) -> Unready | None:
        if not self._workers.fails:
            return None
        # Nobody else finds out that they start again: no work is sent to a server that is not ready.
        with contextlib.suppress(InputError, OSError):
            try:
                async with asyncio.timeout(STARTING_S):
                    await self._workers.run(_nothing)
            except TimeoutError:
                return None  # They have so much to do that it was not this one's turn.
        if not self._workers.fails:
            return None
        return _unready("workers", "the processes that read scores cannot be started")


def _nothing() -> None:
    """What a worker that works can do."""


def _unready(reason: Reason, detail: str) -> Unready:
    return Unready(reason=reason, detail=detail)


def _of_files(settings: Settings) -> list[Unready]:
    seen: list[Unready] = []
    on_disk = _of_data(settings.data_dir)
    if on_disk is not None:
        seen.append(on_disk)
    try:
        find_soundfont(settings.data_dir)
    except MissingSoundfontError:
        seen.append(_unready("soundfont", "there is no soundfont to make sound with"))
    if settings.page and not (settings.page_dir / "index.html").is_file():
        seen.append(_unready("page", "the page is not built"))
    return seen


def _of_data(data_dir: Path) -> Unready | None:
    # What strangers hear says nothing of where it is.
    try:
        with tempfile.TemporaryFile(dir=data_dir) as file:
            file.write(bytes(4096))
            file.flush()
        free_bytes = shutil.disk_usage(data_dir).free
    except OSError as error:
        detail = f"nothing can be written to the data directory: {error.strerror}"
        return _unready("data-directory", detail)
    if free_bytes < LEAST_ROOM_BYTES:
        return _unready("data-full", f"the data directory has room for {free_bytes / 1e6:.0f} MB only")
    return None
