"""How what takes longer is answered: on a thread, in turn, so that whoever watches a session comes first."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

    from fastapi import Request

    from reina.sessions.session import Session
    from reina.system.turns import Turns

T = TypeVar("T")


async def in_turn(request: Request, session: Session, work: Callable[[], T]) -> T:
    """Compute an answer on a thread, one at a time, the sessions one after the other.

    Args:
        request: What it answers.
        session: Whose turn it is.
        work: Gives the answer.
    """
    computing: Turns = request.app.state.computing
    async with computing.of(session.id):
        return await asyncio.to_thread(work)
