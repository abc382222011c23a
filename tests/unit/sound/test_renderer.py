"""The renderer with its real process; the soundfont is a single click, so that it takes no time."""

import asyncio
import hashlib
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import TypeVar

import numpy as np
import pytest
import soundfile
from tests.unit.sound.material import CLICK_HZ, Row, a_score, write_click_soundfont

from reina.errors import InputError
from reina.music import Score
from reina.sound.encode import wav_of
from reina.sound.events import SAMPLE_RATE, SoundPlan
from reina.sound.recording.peaks import peaks_path, read_peaks
from reina.sound.recording.probe import probe_recording
from reina.sound.rendered import SONG, segment_path
from reina.sound.renderer import MissingSoundfontError, SongRenderer, SongRequest, SoundError
from reina.sound.segments import OVERLAP, SEGMENT
from reina.sound.song_cache import SONG_CACHE_BYTES, most_bytes_of

SHORT = a_score([(0, 0.5, 0.15, 60, 1.0), (0, 1.25, 0.15, 60, 1.0)])


def long_score(first_pitch: int = 60) -> Score:
    """Minutes in which something always sounds, which take long to render; two may be rendered at once."""
    rows: list[Row] = [(0, at * 0.2, 0.2, first_pitch + at % 12, 0.5) for at in range(5 * 590)]
    return a_score(rows)


@pytest.fixture(scope="module")
def soundfont(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_click_soundfont(tmp_path_factory.mktemp("font") / "click.sf2")


R = TypeVar("R")


def with_renderer(
    data_dir: Path, soundfont: Path | None, use: Callable[[SongRenderer], Awaitable[R]], timeout_s: float = 60
) -> R:
    """Run `use` on a renderer that is closed afterwards."""

    async def run() -> R:
        renderer = SongRenderer(data_dir, soundfont=soundfont, timeout_s=timeout_s)
        try:
            return await asyncio.wait_for(use(renderer), 60)
        finally:
            await renderer.aclose()

    return asyncio.run(run())


async def until_it_runs(request: SongRequest) -> None:
    for _ in range(1000):
        if request.progress > 0:
            return
        await asyncio.sleep(0.01)
    raise TimeoutError


def files(data_dir: Path) -> list[str]:
    return sorted(path.name for path in data_dir.rglob("*") if path.is_file())


def test_a_score_becomes_a_song_whose_time_is_the_score_s(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> Path:
        request = await renderer.request(SHORT)
        assert not request.ready
        assert request.progress < 1
        path = await request.wait()
        assert request.ready
        assert request.progress == 1
        assert request.error is None
        return path

    path = with_renderer(tmp_path, soundfont, use)
    assert path.parent.parent == tmp_path / "songs"
    assert files(tmp_path) == ["0.opus", SONG, "song.peaks"]
    info, _ = probe_recording(path.read_bytes())
    assert (info.format, info.sample_rate, info.channels) == ("FLAC", 48000, 2)
    samples, _ = soundfile.read(path)
    sound = samples[:, 0]
    for onset_s in (0.5, 1.25):
        begin = round((onset_s - 0.2) * 48000)
        around = np.abs(sound[begin : begin + 48000 // 2])
        first = begin + int(np.flatnonzero(around > 0.1 * around.max())[0])
        assert first / 48000 == pytest.approx(onset_s, abs=0.0015)
    note = sound[24500 : 24500 + 4800]
    assert np.argmax(np.abs(np.fft.rfft(note))) * 10 == pytest.approx(CLICK_HZ, abs=10)


def test_the_same_score_is_rendered_once(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> tuple[Path, Path, Path]:
        one, two = await asyncio.gather(renderer.request(SHORT), renderer.request(SHORT))
        paths = await one.wait(), await two.wait()
        modified = paths[0].stat().st_ino
        again = await renderer.request(SHORT)
        assert again.ready
        assert again.path.stat().st_ino == modified
        return *paths, again.path

    assert len(set(with_renderer(tmp_path, soundfont, use))) == 1

    async def in_another_server(renderer: SongRenderer) -> bool:
        return (await renderer.request(SHORT)).ready

    assert with_renderer(tmp_path, soundfont, in_another_server)


def test_rendering_twice_gives_the_same_bytes(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> str:
        return hashlib.sha256((await (await renderer.request(SHORT)).wait()).read_bytes()).hexdigest()

    assert with_renderer(tmp_path / "1", soundfont, use) == with_renderer(tmp_path / "2", soundfont, use)


def test_progress_rises(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> list[float]:
        request = await renderer.request(a_score([(0, at * 0.5, 0.4, 60, 0.5) for at in range(400)]))
        seen = [request.progress]
        while not request.ready:
            await asyncio.sleep(0.005)
            assert request.error is None
            seen.append(request.progress)
        return seen

    seen = with_renderer(tmp_path, soundfont, use)
    assert seen == sorted(seen)
    assert seen[0] == 0
    assert seen[-1] == 1
    assert len(set(seen)) > 4


def test_it_stops_when_nobody_waits_any_more(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> None:
        one, two = await renderer.request(long_score()), await renderer.request(long_score())
        await until_it_runs(one)
        one.cancel()
        one.cancel()
        await asyncio.sleep(0.05)
        assert two.error is None
        two.cancel()
        with pytest.raises(SoundError, match="cancelled"):
            await two.wait()
        assert files(tmp_path) == []
        # The turn is free again, and the same score can be asked for anew.
        await (await renderer.request(SHORT)).wait()
        assert not (await renderer.request(long_score())).ready

    with_renderer(tmp_path, soundfont, use)
    assert [path.name for path in (tmp_path / "songs").glob("*/*.flac")] == [SONG]


def test_closing_leaves_no_process_and_nothing_half_made(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> None:
        running, other = await renderer.request(long_score()), await renderer.request(long_score(61))
        waiting = await renderer.request(long_score(62))
        await until_it_runs(running)
        await until_it_runs(other)
        await renderer.aclose()
        assert waiting.progress == 0
        assert running.error is not None
        assert waiting.error is not None

    with_renderer(tmp_path, soundfont, use)
    assert files(tmp_path) == []


def test_what_takes_too_long_is_stopped(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> None:
        request = await renderer.request(long_score())
        with pytest.raises(SoundError, match="took over"):
            await request.wait()
        assert not request.ready

    with_renderer(tmp_path, soundfont, use, timeout_s=0.5)
    assert files(tmp_path) == []


def test_a_broken_soundfont_is_told(tmp_path: Path, soundfont: Path) -> None:
    broken = tmp_path / "broken.sf2"
    broken.write_bytes(soundfont.read_bytes()[:4000])

    async def use(renderer: SongRenderer) -> None:
        request = await renderer.request(SHORT)
        with pytest.raises(SoundError, match="could not be rendered: the synthesizer"):
            await request.wait()

    with_renderer(tmp_path / "data", broken, use)
    assert files(tmp_path / "data") == []


def test_a_missing_soundfont_is_told_at_once(tmp_path: Path) -> None:
    async def use(renderer: SongRenderer) -> None:
        with pytest.raises(MissingSoundfontError, match="cannot be read"):
            await renderer.request(SHORT)

    with_renderer(tmp_path, tmp_path / "none.sf2", use)


def test_too_long_a_score_is_refused_at_once(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> None:
        with pytest.raises(InputError, match="at most 60"):
            await renderer.request(a_score([(0, 3600.0, 1.0, 60, 0.5)]))

    with_renderer(tmp_path, soundfont, use)


def test_prune_removes_what_was_not_asked_for_the_longest(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> None:
        paths = [
            await (await renderer.request(a_score([(0, 0.5, 0.1, 60, velocity)]))).wait()
            for velocity in (0.3, 0.6, 0.9)
        ]
        sizes = [size(path) for path in paths]
        await renderer.request(a_score([(0, 0.5, 0.1, 60, 0.3)]))
        small = SongRenderer(tmp_path, soundfont=soundfont, most_bytes=sizes[0] + sizes[2])
        assert small.prune(in_use=[paths[2]]) == sizes[1]
        assert [path.exists() for path in paths] == [True, False, True]
        # The bound holds for what is listened to as well, which goes last.
        small = SongRenderer(tmp_path, soundfont=soundfont, most_bytes=sizes[2])
        assert small.prune(in_use=[paths[2]]) == sizes[0]
        assert SongRenderer(tmp_path, soundfont=soundfont, most_bytes=0).prune(in_use=[paths[2]]) == sizes[2]

    with_renderer(tmp_path, soundfont, use)


class CountedRenderer(SongRenderer):
    """Renders when it is let, as large as it may become, and remembers what was there meanwhile."""

    def __init__(self, data_dir: Path, soundfont: Path, most_bytes: int = SONG_CACHE_BYTES) -> None:
        super().__init__(data_dir, soundfont=soundfont, most_bytes=most_bytes)
        self.begun: list[float] = []
        self.largest = 0
        self.let = asyncio.Semaphore(0)

    async def _run(
        self, rendering: object, plan: SoundPlan, heard: object, soundfont: Path, path: Path
    ) -> None:
        self.begun.append(round(plan.duration_s))
        path.with_name("mix").write_bytes(bytes(most_bytes_of(round(plan.duration_s * SAMPLE_RATE)) // 100))
        self.largest = max(self.largest, sum(map(size, path.parent.parent.glob(f"*/{SONG}"))))
        await self.let.acquire()
        path.with_name("mix").unlink()
        await asyncio.to_thread(path.write_bytes, bytes(1_000_000))


async def until(met: Callable[[], bool]) -> None:
    for _ in range(3000):
        if met():
            return
        await asyncio.sleep(0.01)
    raise TimeoutError


def lasting(seconds: int, pitch: int = 60) -> Score:
    return a_score([(0, seconds - 0.5, 0.5, pitch, 0.5)])


def test_an_honest_song_does_not_wait_behind_many_long_ones(tmp_path: Path, soundfont: Path) -> None:
    async def run() -> list[float]:
        renderer = CountedRenderer(tmp_path, soundfont)
        for pitch in range(40):
            await renderer.request(lasting(3500, 40 + pitch), owner="many")
        await until(lambda: len(renderer.begun) == 1)
        await renderer.request(lasting(180), owner="one")
        await until(lambda: len(renderer.begun) == 2)
        await renderer.request(lasting(300), owner="many")
        await renderer.request(lasting(200), owner="many")
        await renderer.request(lasting(3400), owner="one")
        for count in range(3, 6):
            renderer.let.release()
            await until(lambda count=count: len(renderer.begun) == count)
        for _ in range(2):
            renderer.let.release()
        await until(lambda: len(renderer.begun) == 6)
        begun = list(renderer.begun)
        await renderer.aclose()
        return begun

    # Of long ones one is made at a time, so there is room for a short one; of one owner's the short go first;
    # the long ones go round by owner.
    assert asyncio.run(run()) == [3500, 180, 200, 300, 3500, 3400]


def test_the_bound_holds_while_songs_are_made(tmp_path: Path, soundfont: Path) -> None:
    most = most_bytes_of(60 * SAMPLE_RATE) + 3_000_000

    async def run() -> int:
        renderer = CountedRenderer(tmp_path, soundfont, most_bytes=most)
        requests = [await renderer.request(lasting(50, 40 + pitch)) for pitch in range(8)]
        for number in range(8):
            # Two turns there are, and room for the making of one.
            await until(lambda number=number: len(renderer.begun) == number + 1)
            renderer.let.release()
        for request in requests:
            await request.wait()
        with pytest.raises(SoundError, match="REINA_SONG_CACHE_MB"):
            await (await renderer.request(lasting(120))).wait()
        await renderer.aclose()
        return renderer.largest

    needed = most_bytes_of(50 * SAMPLE_RATE)
    assert 0 < asyncio.run(run()) <= most - needed
    assert sum(map(size, tmp_path.glob(f"songs/*/{SONG}"))) <= most


def size(song: Path) -> int:
    return sum(path.stat().st_size for path in song.parent.iterdir())


def test_prune_removes_what_is_no_whole_song_but_nothing_that_is_being_rendered(
    tmp_path: Path, soundfont: Path
) -> None:
    songs = tmp_path / "songs"

    def leave() -> None:
        (songs / "half").mkdir(parents=True)
        for left in ("half/0.opus", "earlier.wav", "earlier.peaks"):
            (songs / left).write_bytes(b"12345")

    async def use(renderer: SongRenderer) -> None:
        request = await renderer.request(long_score())
        await until_it_runs(request)
        leave()
        assert renderer.prune() == 15
        assert [entry.name for entry in songs.iterdir()] == [request.path.parent.name]
        request.cancel()

    with_renderer(tmp_path, soundfont, use)


async def arrived(request: SongRequest, number: int) -> Path:
    for _ in range(60):
        if (path := await request.segment(number, within_s=1)) is not None:
            return path
    raise TimeoutError


def test_the_first_segment_can_be_had_long_before_the_whole(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> None:
        request = await renderer.request(long_score())
        path = await arrived(request, 0)
        assert not request.ready
        assert request.progress < 0.05, "of ten minutes ten seconds are rendered, and little more"
        samples, rate = soundfile.read(path)
        assert (rate, len(samples)) == (SAMPLE_RATE, SEGMENT + 2 * OVERLAP)
        peaks = request.peaks
        assert peaks is not None
        begun = peaks.highest[: 200 * 10]
        assert begun.max() > 0.1
        assert not peaks.highest[len(peaks.highest) // 2 :].any()
        request.cancel()

    with_renderer(tmp_path, soundfont, use)


def test_a_segment_that_is_asked_for_is_rendered_next(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> None:
        request = await renderer.request(long_score())
        await arrived(request, 0)
        await arrived(request, 50)
        assert request.progress < 0.5, "what lies between is left for later"
        assert await request.segment(30, within_s=0) is None
        request.cancel()

    with_renderer(tmp_path, soundfont, use)


def test_segments_in_any_order_are_the_whole(tmp_path: Path, soundfont: Path) -> None:
    score = a_score([(0, at * 0.5, 0.4, 60 + at % 5, 0.5) for at in range(90)])

    async def backwards(renderer: SongRenderer) -> Path:
        request = await renderer.request(score)
        for number in reversed(range(request.segments.count)):
            await arrived(request, number)
        return await request.wait()

    async def onwards(renderer: SongRenderer) -> Path:
        return await (await renderer.request(score)).wait()

    one = with_renderer(tmp_path / "1", soundfont, backwards)
    two = with_renderer(tmp_path / "2", soundfont, onwards)
    assert one.read_bytes() == two.read_bytes()
    whole, _ = soundfile.read(one)
    peaks = read_peaks(peaks_path(one))
    assert peaks is not None
    assert peaks.duration_s == len(whole) / SAMPLE_RATE
    assert peaks.highest.max() == pytest.approx(whole.max(), abs=1e-4)
    for number in range(-(-len(whole) // SEGMENT)):
        segment, _ = soundfile.read(segment_path(one, number))
        core, meant = segment[OVERLAP:-OVERLAP], whole[number * SEGMENT : (number + 1) * SEGMENT]
        assert len(core) == len(meant)
        if meant.any():
            assert ((core - meant) ** 2).mean() < 0.03 * (meant**2).mean()


def test_the_whole_can_be_taken_away_as_wav(tmp_path: Path, soundfont: Path) -> None:
    async def use(renderer: SongRenderer) -> Path:
        return await (await renderer.request(SHORT)).wait()

    path = with_renderer(tmp_path, soundfont, use)
    claimed, content = wav_of(path)
    wav = b"".join(content)
    assert len(wav) == claimed
    info, _ = probe_recording(wav)
    assert (info.format, info.warnings) == ("WAV", ())
    samples, _ = soundfile.read(path, dtype="int16")
    assert wav[44:] == samples.astype("<i2").tobytes()
