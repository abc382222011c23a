"""The notes of single lines are found, and mixes are refused."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest
from tests.unit.sound.alignment.renditions import RATE, Rendition, example, record
from tests.unit.sound.transcription.solos import SOLOS, f1, found, hard, matched, solo

from reina.errors import InputError
from reina.instruments import INSTRUMENTS
from reina.music import read_score
from reina.music.midi.writer import write_midi
from reina.sound.transcription.posteriors import NoRuntimeError
from reina.sound.transcription.pulse import find_pulse
from reina.sound.transcription.score import HeardNotes, make_score
from reina.sound.transcription.transcribe import Line, MixError, line_of, transcribe

LEAST_F1 = 0.93
LEAST_HARD_F1 = 0.6


@pytest.mark.parametrize(("score", "part"), [each for each in SOLOS if example(each[0]).duration_s < 40])
def test_the_solos_of_the_examples(score: str, part: int) -> None:
    recording = solo(score, part)
    assert f1(recording, found(recording)) >= LEAST_F1


def test_a_solo_in_a_room_with_noise() -> None:
    recording = solo("amazing-grace", 0, reverberation_s=1.5, noise_db=-25.0, lead_in_s=2.0)
    notes = found(recording)
    # 33 notes; one more or less is not heard.
    assert matched(recording, notes) >= 32
    assert len(notes) <= 34


def test_a_hard_one() -> None:
    recording = hard(1)
    assert f1(recording, found(recording)) >= LEAST_HARD_F1


def test_onsets_are_near_and_the_file_has_them() -> None:
    recording = solo("taps", 0, tempo=(1.0, 0.08), lead_in_s=0.7)
    score = transcribe(recording.samples, RATE, Line(), title="Taps")
    near = np.abs(score.notes.onset_s[:, None] - recording.onset_s).min(axis=1)
    assert np.median(near) < 0.015
    again = read_score(write_midi(score), filename="taps.mid")
    np.testing.assert_allclose(again.notes.onset_s, score.notes.onset_s, atol=0.001)
    assert again.parts[0].program == 56


@pytest.mark.parametrize(
    ("score", "without", "spoilt"),
    [
        ("prince-of-denmarks-march", (), {}),
        ("carnival-of-venice", (), {}),
        ("ode-to-joy", (), {"reverberation_s": 0.8}),
        ("trumpet-duet", (2, 3), {}),
    ],
)
def test_mixes_are_refused(score: str, without: tuple[int, ...], spoilt: dict[str, Any]) -> None:
    recording = record(Rendition(score, without_parts=without, **spoilt))
    with pytest.raises(MixError, match="this is a mix"):
        transcribe(recording.samples, RATE, Line(), title=score)


def test_drums_beside_a_solo_are_refused() -> None:
    recording = solo("taps", 0)
    random = np.random.default_rng(1)
    samples = recording.samples.copy()
    level = float(np.abs(samples).max())
    for at in range(0, len(samples) - RATE, RATE // 4):
        # A tuned drum: a tone of 180 Hz that dies away, and its skin.
        times = np.arange(RATE // 5) / RATE
        stroke = np.exp(-12 * times) * (
            np.sin(2 * np.pi * 180 * times) + 0.2 * random.standard_normal(len(times))
        )
        samples[at : at + len(stroke)] += (level * stroke).astype(np.float32)
    with pytest.raises(MixError):
        transcribe(samples, RATE, Line(), title="drums")


def test_beats_and_bars() -> None:
    recording = solo("amazing-grace", 0)
    score = transcribe(recording.samples, RATE, Line(), title="grace")
    truth = example("amazing-grace")
    tempos = 60 / np.diff(score.tempo_map.seconds(np.arange(score.duration_beats)))
    assert np.median(tempos) == pytest.approx(truth.tempo_map.tempos[0].beats_per_minute, rel=0.02)
    assert not score.warnings
    # Three beats a bar, after a pickup of one.
    assert score.metre_map.signatures[-1].numerator == 3
    assert score.metre_map.pickup_beats == 1


def test_no_beat_is_told() -> None:
    at = np.array([0.31, 0.9, 2.2])
    notes = HeardNotes(at, at + 0.2, np.array([60, 62, 64]), np.full(3, 0.8))
    score = make_score(notes, find_pulse(at, 2.4), title="three", part_name="Solo", program=56)
    assert [warning.kind for warning in score.warnings] == ["no_beat"]
    np.testing.assert_allclose(score.notes.onset_s, at)
    np.testing.assert_allclose(score.tempo_map.seconds(np.array([4.0, 6.0])) - 0.31, [0.0, 1.0])


def test_an_instrument_bounds_what_is_looked_for() -> None:
    line = line_of(INSTRUMENTS["trumpet"])
    assert (line.program, line.lowest, line.highest) == (56, 52, 89)
    recording = solo("taps", 0)
    notes = found(recording, Line(lowest=70, highest=96))
    assert notes.sounding_pitch.min() >= 70
    with pytest.raises(InputError, match="in order"):
        Line(lowest=80, highest=60)


@pytest.mark.parametrize(
    ("samples", "says"),
    [
        (np.zeros(3 * RATE, dtype=np.float32), "silent"),
        (np.zeros(0, dtype=np.float32), "silent"),
        (np.zeros(1000, dtype=np.float32) + np.float32(0.5), "no notes"),
        (np.zeros(901 * RATE, dtype=np.float32), "15 minutes"),
    ],
)
def test_what_has_no_line(samples: np.ndarray, says: str) -> None:
    with pytest.raises(InputError, match=says):
        transcribe(samples, RATE, Line(), title="nothing")


def test_progress_rises_to_the_end() -> None:
    shares: list[float] = []
    recording = solo("taps", 0)
    transcribe(recording.samples, RATE, Line(), title="taps", tell=shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert len(shares) > 10


def test_without_the_runtime(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "onnxruntime", None)
    recording = solo("taps", 0)
    with pytest.raises(NoRuntimeError, match=r'pip install "reina\[transcribe\]"'):
        found(recording)
