"""A session's cast: who plays what."""

from typing import Annotated, Any

from fastapi import APIRouter, Body

from reina.api.http.access import Controlled, Store, Watched
from reina.api.http.body import BoundedRoute
from reina.api.http.problems import ProblemError
from reina.instruments import INSTRUMENTS, MAX_PLAYERS, Cast, Casting, Instrument
from reina.notation import both_names
from reina.performance import SEATS
from reina.protocol import resources
from reina.sessions.description import cast_resource

router = APIRouter(tags=["cast"], route_class=BoundedRoute)

ALONE = ("part", "transposition", "written", "octave_fit", "joined_parts", "usual_fingerings", "player")
"""Fields of the form that are for one player."""

EXAMPLE = {"castings": [{"part": 0, "player": "soloist", "instrument": "cornet", "octave_fit": True}]}


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
                clef=INSTRUMENTS[name].clef,
                valves=INSTRUMENTS[name].valve_count,
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
    return cast_resource(session.production)


@router.put("/sessions/{session_id}/cast")
async def put_cast(
    session: Controlled, fields: Annotated[resources.CastFields, Body(examples=[EXAMPLE])], store: Store
) -> resources.Cast:
    """Let others play, or other parts, elsewhere; who watches is told by `hello` what frames now hold."""
    await store.change(session, recast=lambda cast: cast_of(fields, cast.sequence))
    return cast_resource(session.production)


def cast_of(fields: resources.CastFields, sequence: int | None = None) -> Cast:
    """The cast that is asked for; of no sequence in it that one."""
    castings = tuple(_casting(casting.model_dump()) for casting in fields.castings)
    return Cast(castings, sequence if fields.sequence is None else fields.sequence)


def cast_of_fields(fields: resources.SessionFields) -> Cast:
    """The cast that a form asks for.

    Raises:
        ProblemError: 422, it says both a cast and what one player plays.
    """
    if fields.cast is None:
        return Cast((_casting(fields.model_dump(include=set(ALONE))),), fields.sequence)
    both = sorted(fields.model_fields_set & set(ALONE))
    if both:
        raise ProblemError(
            422,
            "cast-twice",
            "The form does not fit",
            f"`cast` says what everybody plays; leave out {', '.join(both)}, or put it into the cast",
        )
    return cast_of(fields.cast, fields.sequence)


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
