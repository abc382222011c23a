"""What the server has for everybody: the show's parameters, lights to choose, and its health."""

from typing import TYPE_CHECKING

from fastapi import APIRouter, Request

import reina
from reina.api.http.access import Store
from reina.protocol import SUBPROTOCOL
from reina.protocol.resources import Health, LightMood, LightMoodList, ShowParameterList
from reina.stage import LIGHT_MOODS

if TYPE_CHECKING:
    from collections.abc import Callable

router = APIRouter(tags=["server"])


@router.get("/parameters")
async def list_parameters(store: Store) -> ShowParameterList:
    """Every show parameter in the frame's order, and every interpolation that a keyframe may name."""
    return ShowParameterList.model_validate(store.stage.registry().describe())


@router.get("/moods")
async def list_moods() -> LightMoodList:
    """Lights for a whole piece, in the order in which they are offered."""
    return LightMoodList(
        moods=[LightMood(name=mood.name, title=mood.title, values=dict(mood.values)) for mood in LIGHT_MOODS]
    )


@router.get("/health")
async def get_health(request: Request) -> Health:
    """Answers once the server can play."""
    now: Callable[[], float] = request.app.state.now
    return Health(
        status="ok", ready=True, version=reina.__version__, streams=[SUBPROTOCOL], server_time_s=now()
    )
