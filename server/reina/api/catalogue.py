"""What the server has for everybody: the show's parameters, lights to choose, and its health."""

import asyncio
from collections.abc import Sequence
from typing import TYPE_CHECKING

from fastapi import APIRouter, Request, Response

import reina
from reina.api.http.access import Store, Watched
from reina.api.http.work import in_turn
from reina.curves import Parameter, ParameterRegistry
from reina.protocol import SUBPROTOCOL
from reina.protocol.resources import Health, LightMood, LightMoodList, ShowParameterList
from reina.stage import LIGHT_MOODS, MOOD_REST
from reina.system.disk_room import has_room

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.api.settings import Settings

router = APIRouter(tags=["server"])

JSON = "application/json"


@router.get("/parameters", response_model=ShowParameterList)
async def list_parameters(request: Request, store: Store) -> Response:
    """Every parameter of the largest cast in the frame's order, and every interpolation of keyframes.

    What a session has of them says `GET /sessions/{id}/parameters`.
    """
    state, stage = request.app.state, store.stage
    if not hasattr(state, "parameters_text"):
        state.parameters_text = await asyncio.to_thread(
            lambda: _listed(stage.largest_registry(), stage.streamed())
        )
    return Response(state.parameters_text, media_type=JSON)


@router.get("/sessions/{session_id}/parameters", response_model=ShowParameterList)
async def list_session_parameters(request: Request, session: Watched) -> Response:
    """Every parameter of a session's cast in the frame's order, and every interpolation of keyframes."""
    production = session.production
    streamed = [parameter for performer in production.performers for parameter in performer.parameters]
    text = await in_turn(request, session, lambda: _listed(production.registry, streamed))
    return Response(text, media_type=JSON)


def _listed(registry: ParameterRegistry, streamed: Sequence[Parameter]) -> str:
    described = registry.describe()
    others = ParameterRegistry(streamed).describe()["parameters"]
    return ShowParameterList.model_validate({**described, "streamed": others}).model_dump_json()


@router.get("/moods")
async def list_moods() -> LightMoodList:
    """Lights for a whole piece, in the order in which they are offered."""
    return LightMoodList(
        moods=[
            LightMood(name=mood.name, title=mood.title, values=dict(mood.values), rest=list(MOOD_REST))
            for mood in LIGHT_MOODS
        ]
    )


@router.get("/health")
async def get_health(request: Request) -> Health:
    """Answers once the server can play."""
    now: Callable[[], float] = request.app.state.now
    settings: Settings = request.app.state.settings
    ready = await asyncio.to_thread(has_room, settings.data_dir)
    return Health(
        status="ok" if ready else "storage-full",
        ready=ready,
        version=reina.__version__,
        streams=[SUBPROTOCOL],
        server_time_s=now(),
    )
