"""What is watched of a server while it runs: its event loop, its readiness, what is loaded, its disk."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from reina.api.readiness import Readiness
from reina.system.disk_metrics import DiskMetrics
from reina.system.loop_delay import LoopDelay
from reina.system.metrics import REGISTRY, SESSIONS_LOADED, VIEWERS

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from reina.api.http.ending import Ending
    from reina.api.settings import Settings
    from reina.sessions.store import SessionStore

PARTS = ("staging", "songs", "files", "sessions")
"""Folders of the data directory whose size is told."""


class Observation:
    """Begins and ends with the server.

    Args:
        settings: Where its files are.
        store: Its sessions.
        now: Server time, seconds.
        ending: Whether it ends.
    """

    def __init__(
        self, settings: Settings, store: SessionStore, *, now: Callable[[], float], ending: Ending
    ) -> None:
        self._delay = LoopDelay(now)
        self._disk = DiskMetrics(settings.data_dir, PARTS)
        self.readiness = Readiness(
            settings,
            delay=self._delay,
            ending=ending,
            workers=store.reader.workers,
            # A store that keeps its sessions in files alone has no database to ask.
            bus=store.check_bus,
            database=cast("Callable[[], Awaitable[None] | None] | None", getattr(store, "check", None)),
        )
        SESSIONS_LOADED.set_function(lambda: len(store.loaded))
        VIEWERS.set_function(lambda: store.loaded.viewers)

    async def start(self) -> None:
        """Begin to watch."""
        REGISTRY.register(self._disk)
        self._delay.start()
        await self.readiness.start()

    async def aclose(self) -> None:
        """Watch no more."""
        await self.readiness.aclose()
        await self._delay.aclose()
        REGISTRY.unregister(self._disk)
        for gauge in (SESSIONS_LOADED, VIEWERS):
            gauge.set_function(lambda: 0)
