"""What the server has for everybody: the show's parameters, lights to choose, and its health."""

import asyncio
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

from fastapi import APIRouter, Query, Request, Response

import reina
from reina.api.http.access import Store, Watched
from reina.api.http.problems import ProblemError
from reina.api.http.work import in_turn
from reina.curves import Parameter, ParameterRegistry
from reina.protocol import SUBPROTOCOL
from reina.protocol.resources import (
    Fault,
    Health,
    LightMood,
    LightMoodList,
    Problem,
    ShowParameterList,
    Unready,
)
from reina.stage import LIGHT_MOODS, MOOD_REST

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.api.readiness import Readiness

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
async def get_health(
    request: Request,
    probe: Annotated[  # noqa: ARG001 - nothing follows from it
        str | None, Query(max_length=100, description="Anything: it makes another address of each request.")
    ] = None,
) -> Health:
    """Answers while the server lives, and says whether it is ready; see `/health/ready`."""
    return _health(request)


@router.get("/health/ready", responses={503: {"model": Problem, "description": "It is not ready; why not."}})
async def get_readiness(request: Request, response: Response) -> Health:
    """Answers 200 while the server can do all that it is there for, else 503 with each reason in `errors`."""
    health = _health(request)
    if not health.ready:
        faults = [Fault(detail=one.detail, location=one.reason) for one in health.not_ready]
        detail = "; ".join(fault.detail for fault in faults)
        raise ProblemError(503, "not-ready", "The server is not ready", detail, errors=faults)
    response.headers["Cache-Control"] = "no-store"
    return health


def _health(request: Request) -> Health:
    now: Callable[[], float] = request.app.state.now
    readiness: Readiness | None = request.app.state.readiness
    starting = Unready(reason="starting", detail="the server has not started yet")
    missing = [starting] if readiness is None else readiness.missing()
    return Health(
        status="not-ready" if missing else "ok",
        ready=not missing,
        not_ready=missing,
        version=reina.__version__,
        streams=[SUBPROTOCOL],
        server_time_s=now(),
    )
