"""A player's part on paper."""

import asyncio
from typing import Annotated

from fastapi import APIRouter, Query, Response

from reina.api.http.access import Watched
from reina.api.http.problems import ProblemError
from reina.protocol.written_part import WrittenPart
from reina.sessions.written_part import written_part

router = APIRouter(tags=["sessions"])


@router.get("/sessions/{session_id}/part", response_model=WrittenPart)
async def get_part(
    session: Watched,
    player: Annotated[int, Query(ge=0, description="Whose: a place in the cast, 0 being the first.")] = 0,
) -> Response:
    """What a player plays as notation: bars of note values, spelled, each note with its fingering."""
    production = session.production
    if player >= len(production.performers):
        last = len(production.performers) - 1
        raise ProblemError(
            404, "unknown-player", "There is no such player", f"the players are 0 to {last}, not {player}"
        )

    def body() -> str:
        return written_part(production, session.record.title, player).model_dump_json()

    return Response(await asyncio.to_thread(body), media_type="application/json")
