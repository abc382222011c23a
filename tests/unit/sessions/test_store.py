"""Sessions in memory and on disk, with the real stage."""

from __future__ import annotations

import asyncio
import gc
import threading
import time
import tracemalloc
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from tests.integration.scores import duet, scale, song
from tests.kept import kept, sql
from tests.unit.sessions.fakes import HandClock, choose, draft_fields

from reina.protocol.transport import Play, Seek, SetLoop, SetRate
from reina.sessions.clock_keeping import ClockKeeping
from reina.sessions.draft import Draft
from reina.sessions.limit_errors import NoRoomError, PieceTooLargeError, SenderLimitError, ServerBusyError
from reina.sessions.session_edits import SessionEndedError
from reina.sessions.sightings import DAY_S
from reina.sessions.stage import Stage
from reina.sessions.storage.errors import SessionDamagedError
from reina.sessions.storage.session_storage import SessionStorage
from reina.sessions.store import SessionStore
from reina.sessions.usage import DiskBound
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

    def __init__(self, data_dir: Path, stage: Stage, **options: Any) -> None:
        self.now = HandClock()
        self.wall = HandClock(0.0)
        """What the calendar is ahead of server time."""
        self.data_dir = data_dir
        self.store = SessionStore(
            data_dir,
            stage,
            SongRenderer(data_dir),
            now=self.now,
            wall=lambda: self.wall() + self.now(),
            **options,
        )

    async def create(self, score: bytes, **options: Any) -> Session:
        async with self.store.staging.folder() as folder:
            (folder / "score").write_bytes(score)
            (folder / "song").write_bytes(song(0.1))
            # The score is not looked for in a song that is none.
            fields: dict[str, Any] = {"in_time": True, **draft_fields(options)}
            draft = Draft(folder=folder, score="score", song="song", **fields)
            session, _ = await self.store.create(draft)
        return session

    async def get(self, session_id: str) -> Session:
        session = await self.store.get(session_id)
        assert session is not None
        return session


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
        assert found.record == made.record.model_copy(update={"clock": found.record.clock})
        assert found.transport().song_time_s == 0.75
        assert found.production.performance.evaluate(0).rotations.tobytes() == (
            made.production.performance.evaluate(0).rotations.tobytes()
        )

    run(scenario)


def test_idle_sessions_beyond_the_bound_are_unloaded_and_come_back(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage, loaded=3)
        made = [await desk.create(scale(4)) for _ in range(5)]
        assert len(desk.store.loaded) == 3
        for session in made:
            assert (await desk.get(session.id)).id == session.id
        assert len(desk.store.loaded) == 3

    run(scenario)


def test_a_session_that_plays_unwatched_is_unloaded_and_goes_on(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage, loaded=1)
        playing = await desk.create(scale(40))
        playing.control(SetRate(action="rate", rate=0.5))
        before = playing.control(Play(action="play"))
        await desk.create(scale(4))
        assert len(desk.store.loaded) == 1
        desk.now.time_s += 5.0
        found = await desk.get(playing.id)
        assert found is not playing
        after = found.transport()
        assert (after.playing, after.rate) == (True, 0.5)
        assert after.song_time_s == pytest.approx(2.5)
        assert after.epoch > before.epoch

    run(scenario)


def test_what_is_asked_of_a_session_keeps_it_loaded(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage, loaded=1)
        asked = await desk.create(scale(4))
        with asked.asked():
            await desk.create(scale(4))
            assert await desk.get(asked.id) is asked
        await desk.create(scale(4))
        assert await desk.get(asked.id) is not asked

    run(scenario)


def test_another_server_goes_on_where_the_clock_is(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        made = await desk.create(scale(16))
        made.control(SetLoop(action="loop", start_s=1.0, end_s=3.0))
        made.control(Seek(action="seek", song_time_s=1.0))
        epoch = made.control(Play(action="play")).epoch
        await desk.store.aclose()
        again = Desk(tmp_path, stage)
        # Server time begins anew, the calendar goes on.
        again.now.time_s = 3.0
        again.wall.time_s = desk.wall.time_s + desk.now.time_s + 4.5 - again.now.time_s
        found = (await again.get(made.id)).transport()
        assert (found.playing, found.song_time_s) == (True, pytest.approx(1.5))
        assert found.epoch > epoch

    run(scenario)


def test_a_song_that_has_ended_meanwhile_stands_at_its_end(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        made = await desk.create(scale(4))
        made.control(Play(action="play"))
        await desk.store.aclose()
        again = Desk(tmp_path, stage)
        again.wall.time_s = desk.wall.time_s + 1e6
        found = await again.get(made.id)
        assert not found.transport().playing
        assert found.transport().song_time_s == found.clock.duration_s

    run(scenario)


def test_a_clock_is_kept_once_for_all_that_it_is_told(
    tmp_path: Path, stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    written: list[SessionRecord] = []
    write = SessionStorage.keep_clock

    def counted(storage: SessionStorage, record: SessionRecord, version: int) -> bool:
        written.append(record)
        return write(storage, record, version)

    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        session = await desk.create(scale(40))
        monkeypatch.setattr(SessionStorage, "keep_clock", counted)
        for number in range(60):
            session.control(Seek(action="seek", song_time_s=number / 30))
        for _ in range(600):
            if written:
                break
            await asyncio.sleep(0.01)
        assert [record.clock.song_time_s for record in written] == [pytest.approx(59 / 30)]
        await desk.store.aclose()
        assert len(written) == 1, "it has not changed since"

    run(scenario)


def test_sessions_that_play_unwatched_stay_within_the_bytes(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        one = await Desk(tmp_path / "one", stage).create(scale(400))
        desk = Desk(tmp_path / "many", stage, memory_bytes=int(3.5 * one.weight))
        made = [await desk.create(scale(400)) for _ in range(6)]
        for session in made:
            (await desk.get(session.id)).control(Play(action="play"))
            assert desk.store.loaded.weight <= 3.5 * one.weight
        assert len(desk.store.loaded) == 3
        desk.now.time_s += 20.0
        for session in made:
            found = await desk.get(session.id)
            assert found.transport().song_time_s == pytest.approx(20.0)

    run(scenario)


def test_what_does_not_fit_beside_what_is_asked_is_refused_and_not_kept(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        one = await Desk(tmp_path / "one", stage).create(scale(400))
        desk = Desk(tmp_path / "many", stage, memory_bytes=int(1.5 * one.weight))
        asked = await desk.create(scale(400))
        with asked.asked():
            with pytest.raises(ServerBusyError, match="try again") as refused:
                await desk.create(scale(400))
            assert refused.value.retry_after_s
            assert desk.store.storage.usage().sessions == 1
        await desk.create(scale(400))
        with pytest.raises(PieceTooLargeError, match="REINA_MEMORY_MB"):
            await desk.create(scale(1600))

    run(scenario)


def test_one_sender_keeps_so_much(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        disk = DiskBound(most_bytes=0, most_bytes_of_sender=0, most_sessions_of_sender=2)
        desk = Desk(tmp_path, stage, disk=disk)
        made = [await desk.create(scale(4), sender="one") for _ in range(2)]
        with pytest.raises(SenderLimitError, match="2 sessions came from your address, and 2 is the most"):
            await desk.create(scale(4), sender="one")
        await desk.create(scale(4), sender="other")
        await desk.store.delete(made[0])
        await desk.create(scale(4), sender="one")
        # Another server knows who sent them.
        again = Desk(tmp_path, stage, disk=disk)
        with pytest.raises(SenderLimitError):
            await again.store.require_disk("one")
        await again.store.require_disk("nobody")

    run(scenario)


def test_all_together_keep_so_many_bytes(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        most = 1_000_000
        desk = Desk(tmp_path, stage, disk=DiskBound(most, 0, 0))
        made = await desk.create(scale(4))
        taken = await desk.store.usage(None)
        assert taken.sessions == 1
        assert {file.name for file in made.record.files} == {"score", "song.wav", "song.peaks"}
        assert taken.bytes > sum(file.size for file in made.record.files), "the show counts too"
        await desk.store.require_disk("", most - taken.bytes)
        with pytest.raises(NoRoomError, match=r"the server keeps 1\.0 MB at most"):
            await desk.store.require_disk("", most - taken.bytes + 1)

    run(scenario)


def test_sessions_that_nobody_sees_are_ended(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        desk.wall.time_s = time.time()
        seen, unseen, idle = [await desk.create(scale(4)) for _ in range(3)]
        # As after a restart, when two of three are not loaded.
        await desk.store.aclose()
        again = Desk(tmp_path, stage)
        again.wall.time_s = desk.wall.time_s + 9 * DAY_S
        loaded = await again.get(idle.id)
        told = await again.store.ends_at(loaded, 10 * DAY_S)
        assert told is not None
        assert await again.store.ends_at(loaded, 30 * DAY_S) is None, "that is far"
        assert await again.store.ends_at(loaded, 0.0) is None
        again.store.sightings.note(seen.id)
        assert await again.store.end_unseen(10 * DAY_S) == 0
        again.wall.time_s += 2 * DAY_S
        assert await again.store.end_unseen(10 * DAY_S) == 2
        assert sql(tmp_path, "SELECT id FROM sessions") == [(seen.id,)]
        assert await again.store.get(unseen.id) is None

    run(scenario)


def _nothing(*_: object) -> None:
    """In place of what is not to be done."""


def test_a_session_that_is_just_unloaded_comes_back_as_it_was(
    tmp_path: Path, stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    writing = threading.Event()
    write = SessionStorage.keep_clock

    def slowly(storage: SessionStorage, record: SessionRecord, version: int) -> bool:
        writing.wait(5)
        return write(storage, record, version)

    async def scenario() -> None:
        monkeypatch.setattr(ClockKeeping, "note", _nothing)
        desk = Desk(tmp_path, stage, loaded=1)
        first = await desk.create(scale(8))
        first.control(Seek(action="seek", song_time_s=0.75))
        monkeypatch.setattr(SessionStorage, "keep_clock", slowly)
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
        await desk.store.edits.change_show(session, lambda history: history.then(show))
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
            desk.store.edits.change_show(session, lambda history: history.then(Show(title="Late"))),
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
        assert len(desk.store.loaded) == 0

    run(scenario)


def test_an_endless_loop_that_nobody_watches_is_unloaded(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage, loaded=1)
        looping = await desk.create(scale(4))
        looping.clock.set_loop(0.0, 1.0)
        looping.clock.play()
        await desk.create(scale(4))
        assert len(desk.store.loaded) == 1

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


def test_what_an_idle_session_and_one_that_plays_take_in_memory(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        await desk.create(scale(150))  # what all share is there
        gc.collect()
        tracemalloc.start()
        try:
            made = [await desk.create(scale(150)) for _ in range(3)]
            gc.collect()
            idle = tracemalloc.get_traced_memory()[0] / len(made)
            for session in made:
                # As many frames as are kept, and more.
                for second in range(int(session.clock.duration_s)):
                    await session.ready(float(second))
            playing = tracemalloc.get_traced_memory()[0] / len(made)
        finally:
            tracemalloc.stop()
        assert idle <= 500_000
        assert idle < playing <= 5_000_000
        assert all(session.audience.frames.weight for session in made)

    run(scenario)
