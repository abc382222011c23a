"""Scores rendered with the real soundfont, judged by the samples."""

import asyncio
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from reina.music import Score, read_score
from reina.sound import passages as sound_passages
from reina.sound.hearing import AS_WRITTEN, Hearing
from reina.sound.plan import PlayedParts, plan_sound
from reina.sound.render import Wanted, render_plan
from reina.sound.rendered import SONG
from reina.sound.renderer import SongRenderer, find_soundfont
from reina.system.resources import default_data_dir

RATE = 48000
Samples = NDArray[np.float64]


def track(
    name: str,
    pitches: Sequence[int],
    step_s: float,
    duration_s: float,
    *,
    program: int | None = None,
    channel: int = 0,
) -> dict[str, Any]:
    """A part that plays one note after another, as web musicians' converters write it."""
    notes = [
        {"midi": pitch, "time": index * step_s, "duration": duration_s, "velocity": 0.8}
        for index, pitch in enumerate(pitches)
    ]
    instrument = {} if program is None else {"instrument": {"number": program}}
    return {"name": name, "channel": channel, "notes": notes, **instrument}


def score_of(*tracks: dict[str, Any]) -> Score:
    document = {"header": {"ppq": 480, "tempos": [{"ticks": 0, "bpm": 120}]}, "tracks": tracks}
    return read_score(json.dumps(document).encode(), filename="score.json")


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("sound")


def listen(
    data_dir: Path, score: Score, played: Sequence[PlayedParts] = (), hearing: Hearing = AS_WRITTEN
) -> Samples:
    """Return the song of a score, (F, 2) with full scale 1."""

    async def render() -> Path:
        renderer = SongRenderer(data_dir, soundfont=find_soundfont(default_data_dir()))
        try:
            return await (await renderer.request(score, played, hearing)).wait()
        finally:
            await renderer.aclose()

    return read_song(asyncio.run(render()))


def read_song(path: Path) -> Samples:
    samples, rate = soundfile.read(path)
    assert rate == RATE
    return samples


def band_db(sound: Samples, low_hz: float, high_hz: float) -> float:
    """Level of a band of frequencies, dB of full scale."""
    power = np.abs(np.fft.rfft(sound.mean(axis=1))) ** 2
    frequency = np.fft.rfftfreq(len(sound), 1 / RATE)
    inside = power[(frequency >= low_hz) & (frequency < high_hz)].sum()
    return float(10 * np.log10(2 * inside / len(sound) ** 2 + 1e-20))


def rms(sound: Samples, begin_s: float, end_s: float) -> float:
    return float(np.sqrt((sound[round(begin_s * RATE) : round(end_s * RATE)] ** 2).mean()))


def test_the_first_attack_and_a_late_one_are_in_time(data_dir: Path) -> None:
    onsets_s = [0.0, 0.77, 31.2345, 95.001, 156.6667]
    wood_block = {"name": "Wood block", "instrument": {"number": 115}, "channel": 0}
    notes = [{"midi": 76, "time": onset_s, "duration": 0.1, "velocity": 0.9} for onset_s in onsets_s]
    sound = np.abs(listen(data_dir, score_of({**wood_block, "notes": notes}))).max(axis=1)
    for onset_s in onsets_s:
        begin = max(0, round((onset_s - 0.1) * RATE))
        around = sound[begin : begin + RATE // 5]
        attack_s = (begin + int(np.flatnonzero(around > 0.05 * around.max())[0])) / RATE
        # The sample itself takes 2 ms to speak.
        assert attack_s - onset_s == pytest.approx(0.002, abs=0.0015)


def test_passages_add_up_to_the_whole(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    score = score_of(
        track("Trumpet", [67, 69, 71, 72, 74, 72, 71, 69] * 12, 0.5, 0.6, program=56),
        track("Piano", [48, 52, 55, 60] * 48, 0.25, 0.9, program=0),
        track("Drums", [36, 42, 38, 46] * 48, 0.25, 0.1, channel=9),
    )
    plan, soundfont = plan_sound(score), find_soundfont(default_data_dir()).read_bytes()
    sounds: list[Samples] = []
    for name, shortest, longest in (("cut", 5 * RATE, 10 * RATE), ("whole", 1000 * RATE, 2000 * RATE)):
        monkeypatch.setattr(sound_passages, "SHORTEST", shortest)
        monkeypatch.setattr(sound_passages, "LONGEST", longest)
        told: list[dict[str, object]] = []
        song = data_dir / name / SONG
        song.parent.mkdir()
        render_plan(plan, soundfont, song, told.append, Wanted())
        shares = [cast("float", message["progress"]) for message in told if "progress" in message]
        assert shares == sorted(shares)
        assert shares[-1] == 1
        sounds.append(read_song(song))
    length = min(len(sound) for sound in sounds)
    difference = sounds[0][:length] - sounds[1][:length]
    assert np.sqrt((difference**2).mean() / (sounds[1] ** 2).mean()) < 0.002


def test_a_part_and_the_rest_add_up_to_the_whole(data_dir: Path) -> None:
    score = score_of(
        track("Trumpet", [67, 69, 71, 72] * 4, 0.5, 0.45, program=56),
        track("Piano", [48, 52, 55, 60] * 8, 0.25, 0.9, program=0),
        track("Tacet", [], 1.0, 1.0, program=71),
    )
    played = [PlayedParts((0,)), PlayedParts((2,))]
    whole = listen(data_dir, score, played)
    part, rest = (listen(data_dir, score, played, Hearing(stem)) for stem in ("part", "rest"))
    assert part.shape == rest.shape == whole.shape
    assert np.sqrt(((part + rest - whole) ** 2).mean() / (whole**2).mean()) < 0.002
    # 784 Hz is the trumpet's, 130 Hz the piano's.
    assert band_db(part, 100, 240) < band_db(whole, 100, 240) - 30
    assert rms(part, 0.5, 6.0) > 0.01
    assert rms(rest, 0.5, 6.0) > 0.01
    nothing = listen(data_dir, score, played, Hearing("part", player=1))
    assert nothing.shape == whole.shape
    assert not np.any(nothing)
    assert np.array_equal(listen(data_dir, score, played, Hearing("rest", player=1)), whole)


def test_what_sounds_higher_is_played_higher_but_for_the_drums(data_dir: Path) -> None:
    trumpet = track("Trumpet", [69] * 4, 1.0, 0.9, program=56)
    drums = track("Drums", [42] * 16, 0.25, 0.1, channel=9)
    written = listen(data_dir, score_of(trumpet, drums))
    higher = listen(data_dir, score_of(trumpet, drums), hearing=Hearing(transposition=7))
    assert band_db(written, 430, 450) - band_db(higher, 430, 450) > 20
    assert band_db(higher, 645, 675) - band_db(written, 645, 675) > 20
    assert band_db(higher, 12000, 16000) == pytest.approx(band_db(written, 12000, 16000), abs=3)


def test_every_part_is_heard(data_dir: Path) -> None:
    bass = track("Bass", [33] * 16, 0.5, 0.45, program=33)
    trumpet = track("Trumpet", [81] * 16, 0.5, 0.45, program=56)
    drums = track("Drums", [42] * 32, 0.25, 0.1, channel=9)
    together = listen(data_dir, score_of(bass, trumpet, drums))
    bands = {"Bass": (45, 120), "Trumpet": (840, 920), "Drums": (12000, 16000)}
    for name, (low_hz, high_hz) in bands.items():
        others = [part for part in (bass, trumpet, drums) if part["name"] != name]
        heard = band_db(together, low_hz, high_hz)
        assert heard > -60
        assert heard - band_db(listen(data_dir, score_of(*others)), low_hz, high_hz) > 12


def test_parts_without_a_program_are_trumpet_or_piano(data_dir: Path) -> None:
    long_note = track("Track 1", [67], 4.0, 4.0)
    trumpet = listen(data_dir, score_of(long_note), [PlayedParts((0,), program=56)])
    named = listen(data_dir, score_of({**long_note, "name": "B-flat Trumpet"}))
    piano = listen(data_dir, score_of(long_note))
    assert np.array_equal(trumpet, named)
    # A trumpet holds its note, a piano's string dies away.
    assert rms(trumpet, 3.0, 3.9) / rms(trumpet, 0.3, 1.2) > 0.8
    assert rms(piano, 3.0, 3.9) / rms(piano, 0.3, 1.2) < 0.4


def test_level_headroom_and_end(data_dir: Path) -> None:
    soft = listen(data_dir, score_of(track("Trumpet", [60, 64, 67, 72], 1.0, 0.9, program=56)))
    brass = [track(f"Brass {k}", [40 + 3 * k] * 8, 1.0, 0.95, program=61) for k in range(14)]
    loud = listen(data_dir, score_of(*brass))
    for sound, end_s in ((soft, 3.9), (loud, 7.95)):
        assert np.abs(sound).max() < 0.9
        assert -22 < 20 * np.log10(rms(sound, 0, end_s)) < -15
        assert end_s + 0.1 < len(sound) / RATE < end_s + 5.1
        assert rms(sound, len(sound) / RATE - 0.05, len(sound) / RATE) < 1e-3
        # Clipping shows as a run of equal samples at the top.
        top = np.abs(sound).max(axis=1) >= np.abs(sound).max() - 1e-9
        assert np.sum(top[1:] & top[:-1]) == 0
