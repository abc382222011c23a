"""How the laboratory's calls do their work."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, TypeVar

from reina.sessions.workers.pool import WorkerPool
from reina.sessions.workers.reader import LONG_BYTES

if TYPE_CHECKING:
    from collections.abc import Callable

    from fastapi import Request

    from reina.system.turns import Turns

T = TypeVar("T")

OWNER = "lab"
LONGEST_S = 60.0
"""How long a piece of work may take before it is stopped."""


async def compute(request: Request, work: Callable[[], T]) -> T:
    """Work of milliseconds, in a thread, one piece at a time: whoever watches a session comes first."""
    computing: Turns = request.app.state.computing
    async with computing.of(OWNER):
        return await asyncio.to_thread(work)


def lab_pool() -> WorkerPool:
    """The process that reads long motion files, one after the other."""
    return WorkerPool(most_at_once=1, timeout_s=LONGEST_S, name="laboratory")


async def compute_long(
    request: Request, size: int, function: Callable[..., T], *arguments: object, owner: str = OWNER
) -> T:
    """Work on a file: of a long one in a process that is stopped when it takes too long or the server ends.

    Args:
        request: What it answers.
        size: How long the file is, bytes.
        function: A function of a module; see `WorkerPool.run`.
        arguments: Its arguments.
        owner: For whom.

    Raises:
        InputError: What the function raises, or it took too long.
    """
    if size <= LONG_BYTES:
        return await compute(request, lambda: function(*arguments))
    pool: WorkerPool = request.app.state.lab_pool
    return await pool.run(function, *arguments, owner=owner)
