"""How the laboratory's calls do their work."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

    from fastapi import Request

T = TypeVar("T")


async def compute(request: Request, work: Callable[[], T]) -> T:
    """Work in a thread, one piece at a time, so that whoever watches a session comes first."""
    computing: asyncio.Semaphore = request.app.state.computing
    async with computing:
        return await asyncio.to_thread(work)
