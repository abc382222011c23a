"""A session's own stances: poses of motion files that its players can stand in."""

from typing import Annotated

from fastapi import APIRouter, Path, Query, Request, Response

from reina.api.http.access import Controlled, Store, Watched
from reina.api.http.body import BoundedRoute
from reina.api.http.problems import ProblemError
from reina.api.lab.clips import BODY, Positions, unreadable_clip
from reina.api.lab.long_work import pose_in_clip
from reina.api.lab.work import compute_long
from reina.instruments.player import STANCES
from reina.protocol import resources
from reina.protocol.resources import Fault
from reina.sessions.description import stance_resource, stances_of
from reina.sessions.record import StanceRecord
from reina.skeleton import BvhError, PoseError, pose_numbers

router = APIRouter(tags=["stances"], route_class=BoundedRoute)

MAX_STANCES = 16
LONGEST_NAME = 40
LATEST_S = 360_000.0
_NAME = r"^[^\s/\x00-\x1f\x7f](?:[^/\x00-\x1f\x7f]*[^\s/\x00-\x1f\x7f])?$"
"""Any line without a slash, which begins and ends with no space."""

Name = Annotated[
    str,
    Query(
        min_length=1,
        max_length=LONGEST_NAME,
        pattern=_NAME,
        description="What the show calls it: a line without slashes. One that is there already is replaced.",
    ),
]
Time = Annotated[
    float,
    Query(ge=0, le=LATEST_S, description="Which frame: seconds from the first."),
]
Filename = Annotated[str | None, Query(max_length=200, description="What the file is called.")]


@router.get("/sessions/{session_id}/stances")
async def list_stances(session: Watched) -> resources.StanceList:
    """The stances that were made for this session, in the order of `player/stance`'s choices."""
    return resources.StanceList(stances=stances_of(session.record))


@router.post("/sessions/{session_id}/stances", status_code=201, openapi_extra=BODY)
async def make_stance(
    request: Request,
    response: Response,
    session: Controlled,
    store: Store,
    name: Name,
    time_s: Time = 0.0,
    filename: Filename = None,
    positions: Positions = "replace",
) -> resources.Stance:
    """Make a stance of a frame of a BVH file: how hips, spine, legs and feet are turned there.

    The file shows a humanoid whose rest pose (all rotations 0) stands, a T-pose say; its joints may have the
    names of CMU, Mixamo, Rokoko, Blender, 3ds Max, Unreal or Daz. It is put on each player by the turns from
    the rest pose: its size, place and unit do not matter. Feet stand on the floor, the hips face where the
    seat does, and arms, head and instrument are held as in every stance. From then on `player/stance` of the
    session's show has the choice; no keyframe is written.
    """
    data = await request.body()
    try:
        pose = await compute_long(request, len(data), pose_in_clip, data, positions, time_s, owner=session.id)
    except BvhError as error:
        raise unreadable_clip(error) from error
    except PoseError as error:
        fault = Fault(detail=error.detail, location=error.location)
        raise ProblemError(
            422, "pose-unusable", "The BVH file has no such pose", str(error), errors=[fault]
        ) from error
    made = StanceRecord(name=name, file=filename, time_s=time_s, turns=tuple(map(_four, pose_numbers(pose))))
    if name in STANCES:
        raise ProblemError(
            409,
            "stance-name-taken",
            "That name is taken",
            f"{name!r} is one of {', '.join(STANCES)}, which there always are; choose another name",
        )

    def with_it(known: tuple[StanceRecord, ...]) -> tuple[StanceRecord, ...]:
        if any(one.name == name for one in known):
            return tuple(made if one.name == name else one for one in known)
        if len(known) == MAX_STANCES:
            raise ProblemError(
                409,
                "too-many-stances",
                "There are too many stances",
                f"a session has {MAX_STANCES} of its own at most; take one away first",
            )
        return (*known, made)

    await store.edits.change(session, restance=with_it)
    stance = stance_resource(session.id, made)
    response.headers["Location"] = stance.href
    return stance


@router.delete("/sessions/{session_id}/stances/{name}", status_code=204, response_class=Response)
async def remove_stance(
    session: Controlled, store: Store, name: Annotated[str, Path(description="Its name.")]
) -> None:
    """Take a stance away. A track that names it is kept, without effect, until the stance is there again."""

    def without_it(known: tuple[StanceRecord, ...]) -> tuple[StanceRecord, ...]:
        left = tuple(one for one in known if one.name != name)
        if len(left) == len(known):
            names = ", ".join(one.name for one in known) or "none"
            raise ProblemError(
                404, "unknown-stance", "There is no such stance", f"the session's own stances are: {names}"
            )
        return left

    await store.edits.change(session, restance=without_it)


def _four(numbers: list[float]) -> tuple[float, float, float, float]:
    x, y, z, w = numbers
    return x, y, z, w
