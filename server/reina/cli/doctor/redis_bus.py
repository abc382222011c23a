"""What connects servers that serve the same sessions: whether it answers, and whether they share the rest."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from reina.api.settings import require_shared
from reina.cli.doctor.finding import fail, ok
from reina.errors import InputError
from reina.sessions.bus.redis_bus import RedisBus

if TYPE_CHECKING:
    from reina.api.settings import Settings
    from reina.cli.doctor.finding import Finding


def bus_finding(settings: Settings) -> Finding:
    """Look at the bus that the settings name."""
    try:
        require_shared(settings)
    except InputError as error:
        return fail("redis", str(error), "name what is missing, or leave REINA_BUS_URL out")
    try:
        asyncio.run(_check(settings.bus))
    except InputError as error:
        return fail("redis", str(error), "see that Redis runs, and that address and password are right")
    return ok("redis", "the servers can reach one another")


async def _check(url: str) -> None:
    bus = RedisBus(url)
    try:
        await bus.check()
    finally:
        await bus.aclose()
