"""What the server has for everybody: the show's parameters, lights to choose, and its health."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from fastapi import APIRouter, Request

import reina
from reina.api.http.access import Store, Watched
from reina.curves import Parameter, ParameterRegistry
from reina.protocol import SUBPROTOCOL
from reina.protocol.resources import Health, LightMood, LightMoodList, ShowParameterList
from reina.stage import LIGHT_MOODS, MOOD_REST

if TYPE_CHECKING:
    from collections.abc import Callable

router = APIRouter(tags=["server"])


@router.get("/parameters")
async def list_parameters(store: Store) -> ShowParameterList:
    """Every parameter of the largest cast in the frame's order, and every interpolation of keyframes.

    What a session has of them says `GET /sessions/{id}/parameters`.
    """
    stage = store.stage
    return _listed(stage.largest_registry(), stage.streamed())


@router.get("/sessions/{session_id}/parameters")
async def list_session_parameters(session: Watched) -> ShowParameterList:
    """Every parameter of a session's cast in the frame's order, and every interpolation of keyframes."""
    performers = session.production.performers
    streamed = [parameter for performer in performers for parameter in performer.parameters]
    return _listed(session.production.registry, streamed)


def _listed(registry: ParameterRegistry, streamed: Sequence[Parameter]) -> ShowParameterList:
    described = registry.describe()
    others = ParameterRegistry(streamed).describe()["parameters"]
    return ShowParameterList.model_validate({**described, "streamed": others})


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
    return Health(
        status="ok", ready=True, version=reina.__version__, streams=[SUBPROTOCOL], server_time_s=now()
    )
