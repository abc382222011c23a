"""Rendered songs of sessions: made anew when what is played changes, shared, pruned, and removed."""

from __future__ import annotations

import asyncio
import gc
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from tests.integration.scores import duet, relay, scale, show, song
from tests.kept import kept
from tests.unit.sessions.fakes import HandClock, Wire, choose, draft_fields

from reina.sessions.draft import Draft
from reina.sessions.note_messages import NoteMessages
from reina.sessions.production import Production
from reina.sessions.session import Session
from reina.sessions.song import RenderedSong
from reina.sessions.stage import Stage
from reina.sessions.store import SessionStore
from reina.sessions.viewer import Viewer
from reina.show import Show
from reina.sound.events import SAMPLE_RATE
from reina.sound.hearing import AS_WRITTEN, Hearing
from reina.sound.renderer import SongRenderer, SongRequest
from reina.sound.song_cache import SONG_CACHE_BYTES, most_bytes_of

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine, Hashable, Sequence

    from reina.music import Score
    from reina.sound.plan import PlayedParts

RIGS = Path(__file__).parents[3] / "rigs"
SONG_BYTES = 1000


@pytest.fixture(scope="module")
def stage() -> Stage:
    return Stage.load(RIGS)


class HandRenderer(SongRenderer):
    """Renders when it is let, a thousand zeros each time, and remembers what it was asked for."""

    def __init__(self, data_dir: Path, most_bytes: int) -> None:
        soundfont = data_dir / "font.sf2"
        soundfont.write_bytes(b"a soundfont")
        super().__init__(data_dir, soundfont=soundfont, most_bytes=most_bytes)
        self.asked: list[tuple[int, int]] = []
        self.hearings: list[Hearing] = []
        self.let = asyncio.Event()
        self.let.set()

    async def request(
        self,
        score: Score,
        played: Sequence[PlayedParts] = (),
        hearing: Hearing = AS_WRITTEN,
        *,
        owner: Hashable = None,
    ) -> SongRequest:
        self.asked.append((played[0].parts[0], played[0].transposition))
        self.hearings.append(hearing)
        return await super().request(score, played, hearing, owner=owner)

    async def _run(self, rendering: object, plan: object, heard: object, soundfont: Path, path: Path) -> None:
        await self.let.wait()
        await asyncio.to_thread(path.write_bytes, bytes(SONG_BYTES))


class Desk:
    """A store with a renderer that is held in hand."""

    def __init__(
        self, data_dir: Path, stage: Stage, *, song_cache_bytes: int = SONG_CACHE_BYTES, **options: Any
    ) -> None:
        self.data_dir = data_dir
        self.renderer = HandRenderer(data_dir, song_cache_bytes)
        self.store = SessionStore(data_dir, stage, self.renderer, now=HandClock(), **options)

    async def create(self, score: bytes, *, with_song: bool = False, **options: Any) -> Session:
        async with self.store.staging.folder() as folder:
            (folder / "score").write_bytes(score)
            if with_song:
                (folder / "song").write_bytes(song(0.1))
            if "show" in options:
                (folder / "show").write_bytes(options.pop("show"))
                options["show"] = "show"
            draft = Draft(
                folder=folder, score="score", song="song" if with_song else None, **draft_fields(options)
            )
            session, _ = await self.store.create(draft)
        return session

    def songs(self) -> list[Path]:
        return sorted((self.data_dir / "songs").glob("*/song.flac"))


async def until(met: Callable[[], bool]) -> None:
    for _ in range(5000):
        if met():
            return
        await asyncio.sleep(0.001)
    raise TimeoutError


async def ready(session: Session) -> Path:
    """The path of a session's song, once it is there."""
    await until(lambda: session.song.path is not None)
    assert session.song.path is not None
    return session.song.path


def run(scenario: Callable[[], Coroutine[Any, Any, None]]) -> None:
    asyncio.run(scenario())


def test_the_song_is_of_the_part_and_the_transposition(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        session = await desk.create(duet(), part=0, transposition=-12)
        first = await ready(session)
        assert desk.renderer.asked == [(0, -12)]
        href = session.song_state().href
        await choose(desk.store, session, transposition=-10)
        assert session.song_state().href != href
        second = await ready(session)
        await choose(desk.store, session, part=1)
        third = await ready(session)
        assert desk.renderer.asked == [(0, -12), (0, -10), (1, -10)]
        assert len({first, second, third}) == 3
        await choose(desk.store, session, part=0, transposition=-12)
        assert (await ready(session), session.song_state().href) == (first, href)
        await choose(desk.store, session, title="Other", public=True)
        assert len(desk.renderer.asked) == 4, "a name is not heard"
        await desk.store.aclose()

    run(scenario)


def test_the_song_is_of_the_joined_parts_too(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        session = await desk.create(relay(), transposition=-2)
        alone, href = await ready(session), session.song_state().href
        await choose(desk.store, session, joined_parts=[1, 2])
        assert session.song_state().href == f"{href}&joined_parts=1,2"
        joined = await ready(session)
        assert joined != alone
        await choose(desk.store, session, joined_parts=[2, 1])
        assert await ready(session) == joined, "the order says nothing"
        await choose(desk.store, session, joined_parts=[])
        assert (await ready(session), session.song_state().href) == (alone, href)
        await desk.store.aclose()

    run(scenario)


def test_viewers_are_told_of_the_song_twice(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        session = await desk.create(duet())
        await ready(session)
        page = Wire()
        viewer = Viewer(page)
        session.join(viewer)
        desk.renderer.let.clear()
        await choose(desk.store, session, transposition=2)
        await until(lambda: any('"score_changed"' in text for text in page.texts))
        told = next(text for text in page.texts if '"score_changed"' in text)
        assert '"status":"rendering"' in told
        assert '"transposition":2' in told
        assert not any('"song_ready"' in text for text in page.texts)
        desk.renderer.let.set()
        await until(lambda: any('"song_ready"' in text for text in page.texts))
        made = next(text for text in page.texts if '"song_ready"' in text)
        assert '"status":"ready"' in made
        assert session.song_state().href in made
        session.leave(viewer)
        viewer.let_go()
        await desk.store.aclose()

    run(scenario)


def test_a_rendering_that_is_overtaken_is_never_announced(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        desk.renderer.let.clear()
        session = await desk.create(duet())
        await until(lambda: len(desk.renderer.asked) == 1)
        for transposition in (1, 2, 3):
            await choose(desk.store, session, transposition=transposition)
            await until(lambda count=transposition: len(desk.renderer.asked) == count + 1)
        desk.renderer.let.set()
        await ready(session)
        await until(lambda: len(desk.songs()) == 1)
        assert session.song_state().href.endswith("transposition=3")
        await desk.store.aclose()
        assert len(desk.songs()) == 1, "what nobody waits for is not made"

    run(scenario)


def test_an_uploaded_song_stays_as_it_is(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        session = await desk.create(duet(), with_song=True)
        before = session.song_state()
        await choose(desk.store, session, part=0, transposition=5)
        assert session.song_state() == before
        assert session.song.path is not None
        assert session.song.path.read_bytes() == song(0.1)
        assert desk.renderer.asked == []

    run(scenario)


def test_songs_beyond_the_bound_go_and_those_that_are_listened_to_go_last(
    tmp_path: Path, stage: Stage
) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage, song_cache_bytes=most_bytes_of(20 * SAMPLE_RATE))
        session = await desk.create(duet())
        kept = await ready(session)
        session.join(Viewer(Wire()))
        other = await desk.create(scale(4))
        for transposition in range(1, 6):
            await choose(desk.store, other, transposition=transposition)
            await ready(other)
        desk.renderer.cache.most_bytes = SONG_BYTES
        await desk.store.loaded.prune_songs()
        assert desk.songs() == [kept]
        await desk.store.aclose()
        again = Desk(tmp_path, stage, song_cache_bytes=0)
        await again.store.loaded.prune_songs()
        assert again.songs() == [], "no session is loaded: none needs a song"

    run(scenario)


def test_ending_a_session_removes_its_song_unless_another_has_the_same(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        one, two = await desk.create(duet()), await desk.create(duet())
        assert await ready(one) == await ready(two)
        await desk.store.delete(one)
        assert len(desk.songs()) == 1
        await desk.store.delete(two)
        await desk.store.aclose()

    run(scenario)
    assert kept(tmp_path) == ["font.sf2"]


def test_a_session_without_a_show_gets_one_written_for_its_music(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        written = await desk.create(scale(64), with_song=True)
        assert {"camera/position", "blocks/color"} <= {t.parameter for t in written.production.show.tracks}
        assert (await desk.create(scale(64), with_song=True)).production.show == written.production.show
        assert (
            await desk.create(scale(32, beats=2.0), with_song=True)
        ).production.show != written.production.show
        own = await desk.create(scale(64), with_song=True, show=show(2.0))
        assert [track.parameter for track in own.production.show.tracks] == ["lights/key/intensity"]
        empty = await desk.create(scale(4), with_song=True, show=b'{"version": 1, "tracks": []}')
        assert empty.production.show == Show()
        await desk.store.aclose()
        found = await Desk(tmp_path, stage).store.get(written.id)
        assert found is not None
        assert found.production.show == written.production.show
        assert found.show_revision.text.etag == written.show_revision.text.etag

    run(scenario)


def test_what_a_viewer_hears_instead_of_the_song_is_their_own(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        session = await desk.create(duet())
        own = await ready(session)
        state_of_all = session.song_state()
        part, rest, higher = Hearing("part"), Hearing("rest"), Hearing(transposition=3)
        paths: set[Path] = set()
        for hearing in (part, rest, higher):
            state = session.song_state(hearing)
            assert state.href != session.song_state().href
            await until(lambda hearing=hearing: session.song_state(hearing).status == "ready")
            path = session.heard.song(hearing).path
            assert path is not None
            paths.add(path)
        assert desk.renderer.hearings == [AS_WRITTEN, part, rest, higher]
        assert len(paths | {own}) == 4
        assert session.song_state() == state_of_all, "for everybody else nothing has changed"
        # What is heard is in use; once another part is played, it is not.
        assert paths | {own} == desk.store.loaded.songs_in_use()
        await choose(desk.store, session, transposition=2)
        assert session.heard.paths == set()
        await desk.store.delete(session)
        await desk.store.aclose()

    run(scenario)


def test_only_so_many_are_kept_at_hand(tmp_path: Path, stage: Stage) -> None:
    async def scenario() -> None:
        desk = Desk(tmp_path, stage)
        session = await desk.create(scale(8))
        await ready(session)
        desk.renderer.let.clear()
        songs = [session.heard.song(Hearing(transposition=semitones)) for semitones in range(-12, 12)]
        assert session.heard.song(Hearing(transposition=-12)) is songs[0]
        session.heard.song(Hearing(transposition=12))
        assert session.heard.song(Hearing(transposition=-12)) is songs[0], "it was asked for since"
        assert session.heard.song(Hearing(transposition=-11)) is not songs[1]
        desk.renderer.let.set()
        await desk.store.delete(session)
        assert session.heard.paths == set()
        await desk.store.aclose()

    run(scenario)


WEIGHTY = (Session, Production, NoteMessages, RenderedSong, Show, Viewer, asyncio.Task)


def weighty() -> Counter[str]:
    """What is in memory of sessions and of work for them; nobody looks for what could be let go of."""
    kinds = (kind.__name__ for one in gc.get_objects() for kind in WEIGHTY if isinstance(one, kind))
    return Counter(kinds)


@pytest.mark.parametrize("with_song", [False, True], ids=["rendered", "searched"])
@pytest.mark.parametrize("is_ended", [False, True], ids=["unloaded", "ended"])
def test_a_session_that_goes_is_let_go_of_without_the_collector(
    tmp_path: Path, stage: Stage, *, is_ended: bool, with_song: bool
) -> None:
    """The server's collector looks through everything once in thousands of sessions."""

    async def scenario() -> None:
        desk = Desk(tmp_path, stage, loaded=1)
        desk.renderer.let.clear()

        async def come_and_go() -> None:
            session = await desk.create(scale(8), with_song=with_song)
            viewer = Viewer(Wire())
            session.join(viewer)
            retitled = replace(session.production.show, title="Other")
            await desk.store.edits.change_show(session, lambda history: history.then(retitled))
            if not with_song:
                session.song_state(Hearing(transposition=2))
                await until(lambda: session.song.request is not None)
            session.leave(viewer)
            viewer.let_go()
            if is_ended:
                await desk.store.delete(session)
            else:
                # What is idle gives way to the next; a search would keep it.
                session.alignment.close()

        await come_and_go()
        await come_and_go()
        gc.collect()
        gc.disable()
        try:
            before = weighty()
            for _ in range(3):
                await come_and_go()
            for _ in range(50):
                # What was given up winds down.
                if weighty() <= before:
                    break
                await asyncio.sleep(0.02)
            assert weighty() <= before
        finally:
            gc.enable()
            desk.renderer.let.set()
            await desk.store.aclose()

    run(scenario)
