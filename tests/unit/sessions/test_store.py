"""Sessions in memory and on disk, with the real stage."""

from __future__ import annotations

import asyncio
import threading
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from tests.integration.scores import duet, scale, song
from tests.kept import kept, sql
from tests.unit.sessions.fakes import HandClock, choose, draft_fields

from reina.protocol.transport import Pause, Play, Seek
from reina.sessions.stage import Stage
from reina.sessions.storage.errors import SessionDamagedError
from reina.sessions.storage.session_storage import SessionStorage
from reina.sessions.store import Draft, SessionEndedError, SessionStore
from reina.show import Show
from reina.sound.renderer import SongRenderer

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine
    from typing import Any

    from reina.sessions.record import SessionRecord
    from reina.sessions.session import Session

RIGS = Path(__file__).parents[3] / "rigs"


@pytest.fixture(scope="module")
def stage() -> Stage:
    return Stage.load(RIGS)


class Desk:
    """A store, and drafts for it."""

    def __init__(self, data_dir: Path, stage: Stage, loaded: int = 32) -> None:
        self.now = HandClock()
        self.data_dir = data_dir
        self.store = SessionStore(data_dir, stage, SongRenderer(data_dir), now=self.now, loaded=loaded)

    async def create(self, score: bytes, **options: Any) -> Session:
        async with self.store.staging() as folder:
            (folder / "score").write_bytes(score)
            (folder / "song").write_bytes(song(0.1))
            draft = Draft(folder=folder, score="score", song="song", **draft_fields(options))
            session, _ = await self.store.create(draft)
        return await self._searched(session)

    async def get(self, session_id: str) -> Session:
        session = await self.store.get(session_id)
        assert session is not None
        return await self._searched(session)

    async def _searched(self, session: Session) -> Session:
        """Once the score has been looked for in the song: until then the session stays loaded."""
        for _ in range(6000):
            if not session.alignment.is_searching:
                return session
            await asyncio.sleep(0.005)
        raise TimeoutError


def run(scenario: Callable[[], Coroutine[Any, Any, None]]) -> None:
    asyncio.run(scenario())


def test_a_session_is_found_again_by_another_store(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        first = Desk(tmp_path, stage)
        made = await first.create(duet(), part=0, transposition=-12, title="Mine", public=True)
        made.control(Seek(action="seek", song_time_s=0.75))
        await first.store.aclose()
        found = await Desk(tmp_path, stage).get(made.id)
        assert found is not made
        assert found.record == made.record.model_copy(update={"song_time_s": 0.75})
        assert found.transport().song_time_s == 0.75
        assert found.production.performance.evaluate(0).rotations.tobytes() == (
            made.production.performance.evaluate(0).rotations.tobytes()
        )

    run(scenario)


def test_idle_sessions_beyond_the_bound_are_unloaded_and_come_back(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage, loaded=3)
        made = [await desk.create(scale(4)) for _ in range(5)]
        assert desk.store.loaded == 3
        for session in made:
            assert (await desk.get(session.id)).id == session.id
        assert desk.store.loaded == 3

    run(scenario)


def test_a_session_that_plays_is_not_unloaded(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage, loaded=1)
        playing = await desk.create(scale(4))
        playing.control(Play(action="play"))
        other = await desk.create(scale(4))
        assert await desk.get(playing.id) is playing
        playing.control(Pause(action="pause"))
        await desk.get(other.id)
        await desk.create(scale(4))
        assert desk.store.loaded == 1
        assert await desk.get(playing.id) is not playing

    run(scenario)


def test_a_session_that_is_just_unloaded_comes_back_as_it_was(
    tmp_path: Path, stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    writing = threading.Event()
    write = SessionStorage.change

    def slowly(storage: SessionStorage, record: SessionRecord) -> SessionRecord:
        writing.wait(5)
        return write(storage, record)

    async def scenario() -> None:
        desk = Desk(tmp_path, stage, loaded=1)
        first = await desk.create(scale(8))
        first.control(Seek(action="seek", song_time_s=0.75))
        monkeypatch.setattr(SessionStorage, "change", slowly)
        await desk.create(scale(4))
        asking = asyncio.create_task(desk.get(first.id))
        await asyncio.sleep(0.05)
        assert not asking.done(), "it waits for the record"
        writing.set()
        assert (await asking).transport().song_time_s == 0.75

    run(scenario)


def test_those_who_ask_at_the_same_time_get_the_same_session(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        made = await Desk(tmp_path, stage).create(scale(4))
        desk = Desk(tmp_path, stage)
        found = await asyncio.gather(*(desk.get(made.id) for _ in range(8)))
        assert len({id(session) for session in found}) == 1

    run(scenario)


def test_another_part_keeps_the_show_and_begins_an_epoch(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        session = await desk.create(duet())
        show = Show(title="Kept")
        await desk.store.change_show(session, lambda history: history.then(show))
        epoch = session.transport().epoch
        await choose(desk.store, session, part=0)
        assert session.transport().epoch == epoch + 1
        assert session.production.show.title == "Kept"
        assert session.production.played.part == session.record.cast.lead.part == 0
        await choose(desk.store, session, title="Renamed")
        assert session.transport().epoch == epoch + 1, "a name is in no frame"
        again = await Desk(tmp_path, stage).get(session.id)
        assert (again.record.title, again.production.show.title) == ("Renamed", "Kept")
        assert again.record.cast.lead.part == 0

    run(scenario)


def test_an_ended_session_is_gone_from_disk(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        session = await desk.create(scale(4))
        await desk.store.delete(session)
        assert await desk.store.get(session.id) is None

    run(scenario)
    assert kept(tmp_path) == []


def test_whoever_comes_too_late_to_end_or_change_a_session_is_told_so(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        session = await desk.create(duet())
        outcomes = await asyncio.gather(
            desk.store.delete(session),
            desk.store.delete(session),
            choose(desk.store, session, part=0),
            desk.store.change_show(session, lambda history: history.then(Show(title="Late"))),
            return_exceptions=True,
        )
        assert outcomes[0] is None
        assert [type(outcome) for outcome in outcomes[1:]] == [SessionEndedError] * 3
        assert await desk.store.get(session.id) is None

    run(scenario)


def test_a_session_ended_while_it_is_read_does_not_come_back(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        made = await Desk(tmp_path, stage).create(scale(4))
        desk = Desk(tmp_path, stage)
        asked = asyncio.create_task(desk.store.get(made.id))
        await asyncio.sleep(0)
        await asyncio.to_thread(desk.store.storage.remove, made.id)
        assert await asked is None
        assert desk.store.loaded == 0

    run(scenario)


def test_an_endless_loop_that_nobody_watches_is_unloaded(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage, loaded=1)
        looping = await desk.create(scale(4))
        looping.clock.set_loop(0.0, 1.0)
        looping.clock.play()
        await desk.create(scale(4))
        assert desk.store.loaded == 1

    run(scenario)


def test_a_damaged_session_does_not_hide_the_others(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        whole = await desk.create(scale(4), public=True)
        damaged = await desk.create(scale(4), public=True)
        sql(tmp_path, "UPDATE sessions SET record = '{' WHERE id = ?", damaged.id)
        again = Desk(tmp_path, stage)
        entries, following = await again.store.listed(10)
        assert {entry.id for entry in entries} == {whole.id, damaged.id}
        assert following is None
        for _ in range(2):
            with pytest.raises(SessionDamagedError, match=f"{damaged.id!r} is kept and cannot be read"):
                await again.store.get(damaged.id)
        assert (await again.get(whole.id)).record == whole.record

    run(scenario)
