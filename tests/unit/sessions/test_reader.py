"""Long files are read in another process, and come out the same."""

from __future__ import annotations

import asyncio
import json
import pickle
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import pytest
from tests.integration.intake import large_show
from tests.integration.scores import duet

from reina.curves import interpolations
from reina.instruments import Cast, Casting
from reina.music.errors import ScoreError
from reina.sessions.frames import EncodedFrames
from reina.sessions.stage import Stage
from reina.sessions.workers import reader as module
from reina.sessions.workers.pool import WorkerPool
from reina.sessions.workers.reader import LONG_BYTES, Reader, shared_of
from reina.show import Show, ShowError

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine

RIGS = Path(__file__).parents[3] / "rigs"


@pytest.fixture(scope="module")
def stage() -> Stage:
    return Stage.load(RIGS)


def in_process(
    stage: Stage,
    monkeypatch: pytest.MonkeyPatch,
    scenario: Callable[[Reader, Reader], Coroutine[Any, Any, None]],
) -> None:
    """Run with a reader that reads everything on a thread, and one that reads everything in a process."""

    async def run() -> None:
        pool = WorkerPool(shared_of(stage))
        here, there = Reader(stage), Reader(stage, pool)
        monkeypatch.setattr(module, "LONG_BYTES", 10**9)

        async def elsewhere(size: int, function: Any, *arguments: Any, owner: Any = None) -> Any:
            return await pool.run(function, *arguments, owner=owner)

        monkeypatch.setattr(there, "_read", elsewhere)
        try:
            await scenario(here, there)
        finally:
            await there.aclose()

    asyncio.run(run())


def test_a_score_is_planned_to_the_same_frames(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    path = tmp_path / "score"
    path.write_bytes(duet())

    async def scenario(here: Reader, there: Reader) -> None:
        cast = Cast((Casting(transposition=-2), Casting(player="soloist", part=1)))
        asked: dict[str, Any] = {"filename": "a.mid", "cast": cast}
        one, other = await here.production(path, **asked), await there.production(path, **asked)
        assert other.stage is stage
        assert other.show == one.show
        frames = [EncodedFrames(made.performance, made.manifest) for made in (one, other)]
        assert [one.instrument is stage.kinds["trumpet"] for one in other.performers] == [True, True]
        for number in (0, 1, 3):
            assert frames[0].block(number).tobytes() == frames[1].block(number).tobytes()

    in_process(stage, monkeypatch, scenario)


def test_a_show_with_every_interpolation_comes_back_whole(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    keyframes = [
        {"key": f"k{number}", "time": number, "value": 1, "interpolation": name}
        for number, name in enumerate(interpolations())
    ]
    tracks = [
        {"parameter": "lights/key/intensity", "keyframes": keyframes},
        {"parameter": "nobody/knows", "keyframes": [{"x": [1, 2]}]},
    ]
    data = json.dumps({"version": 1, "tracks": tracks}).encode()

    registry = stage.registry()

    async def scenario(here: Reader, there: Reader) -> None:
        one, other = await here.show(data, registry), await there.show(data, registry)
        assert other == one
        assert [type(k) for k in other.track("lights/key/intensity").keyframes] == list(
            interpolations().values()
        )
        parameter = registry["lights/key/intensity"]
        track = json.dumps(tracks[0]).encode()
        unknown = json.dumps({f"x{number}": 1 for number in range(100)}).encode()
        assert await there.track(track, parameter, "seconds") == one.tracks[0]
        with pytest.raises(ShowError, match="no JSON"):
            await there.show(b"[", registry)
        with pytest.raises(ShowError, match="body names"):
            await there.track(b'{"parameter": "x", "keyframes": []}', parameter, "seconds")
        edits = (
            b'[{"edit": "put_track", "track": %b}, {"edit": "change_show", "changes": {"title": "T"}}]'
            % track
        )
        assert await there.edits(edits) == await here.edits(edits)
        with pytest.raises(ShowError, match="no such field") as caught:
            await there.edits(b'[{"edit": "change_show", "changes": {%b}}]' % unknown[1:-1])
        assert (len(caught.value.others), caught.value.more) == (19, 80)

    in_process(stage, monkeypatch, scenario)


def test_long_files_go_to_a_process_and_short_ones_do_not(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    class Pool:
        asked = 0
        owners: ClassVar[list[object]] = []

        async def run(self, function: Callable[..., Any], *arguments: Any, owner: object) -> Any:
            self.asked += 1
            self.owners.append(owner)
            return function(*arguments)

    async def scenario() -> None:
        pool: Any = Pool()
        reader = Reader(stage, pool)
        await reader.show(b'{"version": 1, "tracks": []}', stage.registry())
        assert pool.asked == 0
        long = large_show(3000)
        assert len(long) > LONG_BYTES
        await reader.show(long, stage.registry(), owner="a session")
        assert pool.asked == 1
        assert pool.owners == ["a session"]
        path = tmp_path / "score"
        path.write_bytes(b"\x1f\x8b" + bytes(LONG_BYTES // 20))
        with pytest.raises(ScoreError):
            await reader.production(path, filename="s.gz", cast=Cast())
        assert pool.asked == 2, "what is packed may hold much"

    asyncio.run(scenario())


def test_a_track_of_many_keyframes_is_sent_in_pieces(stage: Stage) -> None:
    show = Show.from_document(json.loads(large_show(14_000)), stage.registry())
    track = show.tracks[0]
    again = pickle.loads(pickle.dumps(track, protocol=5))
    assert again == track
    assert len(again.keyframes) == 2000
