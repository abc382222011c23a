"""Sequences, written pitch and octave fit: planned, heard and kept."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.integration.scores import chords, collection, duet, relay, scale, show, song, two_duets
from tests.kept import sql
from tests.unit.sessions.fakes import HandClock, choose, draft_fields
from tests.unit.sound.material import Row, a_part, a_score

from reina.errors import InputError
from reina.instruments.describe import NO_PITCH, NOT_IN_LINE
from reina.music import NotInScoreError
from reina.protocol.links import rendering_href
from reina.protocol.transport import Seek, SetLoop
from reina.sessions.draft import Draft
from reina.sessions.stage import Stage
from reina.sessions.store import SessionStore
from reina.sound.plan import PlayedParts, plan_sound
from reina.sound.renderer import SongRenderer

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine

    from reina.sessions.session import Session

RIGS = Path(__file__).parents[3] / "rigs"


@pytest.fixture(scope="module")
def stage() -> Stage:
    return Stage.load(RIGS)


def a_store(data_dir: Path, stage: Stage) -> SessionStore:
    return SessionStore(data_dir, stage, SongRenderer(data_dir), now=HandClock())


async def create(store: SessionStore, score: bytes, **options: Any) -> Session:
    async with store.staging.folder() as folder:
        (folder / "score").write_bytes(score)
        (folder / "song").write_bytes(song(0.1))
        if "show" in options:
            (folder / "show").write_bytes(options.pop("show"))
            options["show"] = "show"
        session, _ = await store.create(
            Draft(folder=folder, score="score", song="song", **draft_fields(options))
        )
    return session


def run(scenario: Callable[[], Coroutine[Any, Any, None]]) -> None:
    asyncio.run(scenario())


def pitches(session: Session) -> list[int]:
    return session.production.played.line.sounding_pitch.tolist()


def test_a_record_of_before_the_choices_still_loads(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        made = await create(a_store(tmp_path, stage), scale(4))
        stored = json.loads(sql(tmp_path, "SELECT record FROM sessions")[0][0])
        del stored["cast"]
        # As the first version wrote it, and as the last one before there were casts did.
        before: dict[str, Any] = {"instrument": "trumpet", "part": 0, "transposition": -2}
        chosen: dict[str, Any] = {"written": True, "octave_fit": True, "joined_parts": [], "sequence": 0}
        chosen["player"] = "soloist"
        for fields, pitch in ((before, 56), (before | chosen, 54)):
            sql(tmp_path, "UPDATE sessions SET record = ?", json.dumps(stored | fields))
            found = await a_store(tmp_path, stage).get(made.id)
            assert found is not None
            lead = found.record.cast.lead
            assert (lead.part, lead.transposition, lead.written) == (0, -2, fields.get("written", False))
            assert (lead.player, lead.octave_fit) == (
                fields.get("player", "trumpeter"),
                fields.get("octave_fit", False),
            )
            assert found.record.cast.sequence == fields.get("sequence")
            assert pitches(found)[0] == pitch

    run(scenario)


def test_choices_are_kept(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        store = a_store(tmp_path, stage)
        made = await create(store, collection())
        await choose(store, made, written=True, octave_fit=True, sequence=1)
        await choose(store, made, title="Walk")
        found = await a_store(tmp_path, stage).get(made.id)
        assert found is not None
        assert found.record == made.record.model_copy(update={"clock": found.record.clock})
        assert pitches(found) == pitches(made) == [pitch - 2 for pitch in range(60, 68)]
        assert found.resource().warnings == made.resource().warnings

    run(scenario)


def test_joined_parts_are_kept_until_another_part_is_chosen(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        store = a_store(tmp_path, stage)
        made = await create(store, relay(), joined_parts=(2, 1))
        assert made.record.cast.lead.joined_parts == made.production.played.joined_parts == (1, 2)
        found = await a_store(tmp_path, stage).get(made.id)
        assert found is not None
        assert found.record == made.record.model_copy(update={"clock": found.record.clock})
        assert pitches(found) == pitches(made)
        await choose(store, made, part=0, transposition=1)
        assert made.record.cast.lead.joined_parts == (1, 2), "the part is the same"
        await choose(store, made, sequence=0)
        assert made.record.cast.lead.joined_parts == (1, 2), "the sequence is the same"
        await choose(store, made, part=1)
        assert made.record.cast.lead.joined_parts == ()
        assert pitches(made) == [70, 71]
        await choose(store, made, part=0, joined_parts=[1])
        assert pitches(made) == [66, 68, 70, 71]
        await choose(store, made, joined_parts=[])
        assert pitches(made) == [66, 68]
        found = await a_store(tmp_path, stage).get(made.id)
        assert found is not None
        assert found.record.cast.lead.joined_parts == ()

    run(scenario)


def test_of_another_sequence_no_parts_are_joined(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        store = a_store(tmp_path, stage)
        session = await create(store, two_duets(), joined_parts=(1,))
        assert len(pitches(session)) == 4
        await choose(store, session, sequence=1)
        assert session.record.cast.lead.joined_parts == ()
        assert len(pitches(session)) == 2
        await choose(store, session, sequence=0, joined_parts=[1])
        assert (session.record.cast.lead.part, session.record.cast.lead.joined_parts) == (0, (1,))

    run(scenario)


def test_parts_that_cannot_be_joined_change_nothing(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        store = a_store(tmp_path, stage)
        session = await create(store, relay(), joined_parts=(1,))
        record, production = session.record, session.production
        with pytest.raises(NotInScoreError, match=r"joined_parts/1: part 3 \(“Drums”\) is drums"):
            await choose(store, session, joined_parts=[2, 3], title="Never")
        assert (session.record, session.production) == (record, production)

    run(scenario)


def test_that_a_file_holds_several_sequences_is_told_until_one_is_chosen(
    tmp_path: Path, stage: Stage
) -> None:
    async def scenario() -> None:
        store = a_store(tmp_path, stage)
        made = await create(store, collection())
        found = await a_store(tmp_path, stage).get(made.id)
        for session in (made, found):
            assert session is not None
            assert "sequences" in {warning.kind for warning in session.resource().warnings}
        await choose(store, made, sequence=0)
        assert "sequences" not in {warning.kind for warning in made.resource().warnings}

    run(scenario)


def test_another_sequence_begins_anew_and_the_same_goes_on(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        store = a_store(tmp_path, stage)
        session = await create(store, collection(), show=show(2.0))
        session.control(Seek(action="seek", song_time_s=1.0))
        session.control(SetLoop(action="loop", start_s=0.5, end_s=1.5))
        choices: list[dict[str, Any]] = [{"sequence": 0}, {"written": True}, {"octave_fit": True}]
        for choice in choices:
            await choose(store, session, **choice)
            state = session.transport()
            assert state.song_time_s == 1.0
            assert state.loop is not None
        before = session.clock.duration_s
        await choose(store, session, sequence=2)
        assert (session.transport().song_time_s, session.transport().loop) == (0.0, None)
        assert session.clock.duration_s < before
        assert session.show_revision.show.tracks[0].parameter == "lights/key/intensity", "an own show stays"

    run(scenario)


def test_a_show_written_for_one_sequence_is_written_anew_for_another(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        store = a_store(tmp_path, stage)
        session = await create(store, collection())
        fresh = await create(store, collection(), sequence=1)
        before = session.show_revision.show
        await choose(store, session, sequence=1)
        assert session.production.show == session.show_revision.show == fresh.production.show != before
        assert session.show_revision.history.past == (before,)
        assert session.record.title == fresh.record.title == "Walk"
        await choose(store, session, sequence=2, title="Mine")
        await choose(store, session, sequence=1)
        assert session.record.title == "Mine"
        found = await a_store(tmp_path, stage).get(session.id)
        assert found is not None
        assert found.production.show == fresh.production.show

    run(scenario)


def test_what_cannot_be_chosen_changes_nothing(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        store = a_store(tmp_path, stage)
        session = await create(store, collection())
        record, production, epoch = session.record, session.production, session.transport().epoch
        with pytest.raises(NotInScoreError, match="holds 3 sequences, 0 to 2; there is no sequence 9"):
            await choose(store, session, sequence=9, title="Never")
        with pytest.raises(NotInScoreError, match="no part 3"):
            await choose(store, session, sequence=1, part=3)
        assert (session.record, session.production) == (record, production)
        assert session.transport().epoch == epoch

    run(scenario)


def test_a_song_has_one_address_for_what_sounds_the_same(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        store = a_store(tmp_path, stage)
        async with store.staging.folder() as folder:
            (folder / "score").write_bytes(duet())
            session, _ = await store.create(
                Draft(folder=folder, score="score", **draft_fields({"written": True}))
            )
        href = rendering_href(session.id, 0, [((1,), -2)])
        assert session.song_state().href == href
        await choose(store, session, written=False, transposition=-2)
        assert session.song_state().href == href
        await choose(store, session, octave_fit=True)
        assert session.song_state().href == href, "it lies in range as it is"
        await store.aclose()

    run(scenario)


def test_notes_that_are_left_out_move_with_their_part(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        store = a_store(tmp_path, stage)
        session = await create(store, chords(), written=True)
        table = session.production.note_table
        assert [table.note(index).sounding_pitch for index in range(4)] == [58, 62, 60, 63]
        assert table.note(0).reason == NOT_IN_LINE
        await choose(store, session, written=False, transposition=64)
        top = session.production.note_table.note(3)
        assert (top.sounding_pitch, top.valves, top.reason) == (65, None, NO_PITCH)

    run(scenario)


def test_what_is_moved_out_of_midi_is_not_heard() -> None:
    rows: list[Row] = [(0, 0.0, 1.0, 60, 0.8), (0, 1.0, 1.0, 100, 0.8), (1, 0.0, 1.0, 100, 0.8)]
    parts = [a_part(0), a_part(1, "Flute", 73)]
    plan = plan_sound(a_score(rows, parts), [PlayedParts((0,), 40)])
    assert sorted(plan.notes["key"].tolist()) == [100, 100]
    assert np.all(plan.notes["on"] == 0)
    with pytest.raises(InputError, match="moved by 40 semitones, no note"):
        plan_sound(a_score([(0, 0.0, 1.0, 100, 0.8)], [a_part(0)]), [PlayedParts((0,), 40)])
