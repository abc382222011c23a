"""A session's cast: who plays what."""

import asyncio
from collections.abc import Iterable
from typing import Annotated, Any

from fastapi import APIRouter, Body

from reina.api.http.access import Controlled, Store, Watched
from reina.api.http.body import BoundedRoute
from reina.api.http.problems import ProblemError
from reina.instruments import INSTRUMENTS, MAX_PLAYERS, Cast, Casting, Instrument
from reina.instruments.player import SEATS
from reina.notation import both_names
from reina.protocol import resources
from reina.sessions.description import cast_resource

router = APIRouter(tags=["cast"], route_class=BoundedRoute)

ALONE = (
    "part",
    "transposition",
    "written",
    "octave_fit",
    "joined_parts",
    "usual_fingerings",
    "player",
    "handedness",
)
"""Fields of the form that are for one player."""

EXAMPLE = {"castings": [{"part": 0, "player": "soloist", "instrument": "cornet", "octave_fit": True}]}
EXAMPLES = [EXAMPLE, {"cast": "auto"}]


@router.get("/instruments")
async def list_instruments(store: Store) -> resources.InstrumentList:
    """What a cast can be made of: instruments and who can play them, seats, how many players."""
    return resources.InstrumentList(
        instruments=[
            resources.InstrumentSummary(
                name=name,
                title=INSTRUMENTS[name].title,
                rig=INSTRUMENTS[name].rig,
                players=list(store.stage.players(name)),
                handedness=list(INSTRUMENTS[name].handedness),
                clef=INSTRUMENTS[name].clef,
                valves=INSTRUMENTS[name].valve_count,
                pieces=list(INSTRUMENTS[name].pieces),
                seat=INSTRUMENTS[name].seat,
                chart=_chart(INSTRUMENTS[name]),
            )
            for name in store.stage.instruments
        ],
        seats=list(SEATS),
        max_players=MAX_PLAYERS,
    )


@router.get("/sessions/{session_id}/cast")
async def get_cast(session: Watched) -> resources.Cast:
    """Who plays what, and why."""
    return await asyncio.to_thread(cast_resource, session.production)


@router.put("/sessions/{session_id}/cast")
async def put_cast(
    session: Controlled,
    fields: Annotated[resources.CastFields | resources.AutoCast, Body(examples=EXAMPLES)],
    store: Store,
) -> resources.Cast:
    """Let others play, or other parts, elsewhere; who watches is told by `hello` what frames now hold.

    `{"cast": "auto"}` goes back to the cast that the score asks for by itself.
    """
    await store.edits.change(session, recast=lambda cast: cast_of(fields, cast.sequence))
    return await asyncio.to_thread(cast_resource, session.production)


def cast_of(fields: resources.CastFields | resources.AutoCast, sequence: int | None = None) -> Cast:
    """The cast that is asked for; of no sequence in it that one."""
    if isinstance(fields, resources.AutoCast):
        return Cast(sequence=sequence if fields.sequence is None else fields.sequence, auto=True)
    castings = tuple(_casting(casting.model_dump()) for casting in fields.castings)
    return Cast(castings, sequence if fields.sequence is None else fields.sequence)


def cast_of_fields(fields: resources.SessionFields) -> Cast:
    """The cast that a form asks for; where it says nothing of one, the score's own.

    Raises:
        ProblemError: 422, it says both a cast and what one player plays.
    """
    alone = fields.model_fields_set & set(ALONE)
    if fields.cast is None and alone:
        return Cast((_casting(fields.model_dump(include=set(ALONE))),), fields.sequence)
    refuse_twice(alone)
    if fields.cast is None or fields.cast == "auto":
        return Cast(sequence=fields.sequence, auto=True)
    return cast_of(fields.cast, fields.sequence)


def refuse_twice(alone: Iterable[str]) -> None:
    """Refuse fields for one player beside `cast`.

    Raises:
        ProblemError: 422, there are some.
    """
    both = sorted(alone)
    if both:
        raise ProblemError(
            422,
            "cast-twice",
            "The cast is said twice",
            f"`cast` says what everybody plays; leave out {', '.join(both)}, or put it into the cast",
        )


def _casting(fields: dict[str, Any]) -> Casting:
    fields["joined_parts"] = tuple(fields["joined_parts"])
    return Casting(**fields)


def _chart(instrument: Instrument) -> list[resources.ChartLine]:
    return [
        resources.ChartLine(
            sounding_pitch=note.sounding_pitch,
            written_pitch=note.written_pitch,
            sounding_names=list(both_names(note.sounding_pitch)),
            written_names=list(both_names(note.written_pitch)),
            fingerings=[list(fingering) for fingering in note.fingerings],
        )
        for note in instrument.fingering_chart
    ]
