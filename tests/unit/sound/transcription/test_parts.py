"""What a line is found by: resampling, the search, beats."""

from __future__ import annotations

import numpy as np
import pytest

from reina.sound.transcription.line import likeliest_line
from reina.sound.transcription.posteriors import HOP, PITCHES, RATE, Posteriors
from reina.sound.transcription.pulse import find_pulse
from reina.sound.transcription.resample import resampled


@pytest.mark.parametrize("rate", [20_050, 22_050, 24_000, 44_100])
def test_resampling_keeps_time_and_tone(rate: int) -> None:
    # Longer than a piece, so that there is a seam; its length is no whole number of seconds.
    times = np.arange(int(31.3 * rate)) / rate
    made = resampled(np.sin(2 * np.pi * 441.3 * times).astype(np.float32), rate, RATE)
    assert len(made) == round(len(times) * RATE / rate)
    wanted = np.sin(2 * np.pi * 441.3 * np.arange(len(made)) / RATE)
    inside = slice(RATE // 10, -RATE // 10)
    np.testing.assert_allclose(made[inside], wanted[inside], atol=2e-3)


def heard(frames: int, notes: list[tuple[int, int, int]]) -> tuple[Posteriors, np.ndarray]:
    """What a network would hear of (pitch, first frame, frame after the last), without doubt."""
    note = np.full((frames, PITCHES), 0.02, dtype=np.float32)
    onset = np.full((frames, PITCHES), 0.01, dtype=np.float32)
    for pitch, begin, end in notes:
        note[begin:end, pitch - 21] = 0.85
        onset[begin - 1 : begin + 2, pitch - 21] = (0.5, 0.95, 0.5)
    return Posteriors(note, onset), np.zeros(frames)


def test_a_line_with_a_rest_a_repeat_and_a_leap() -> None:
    notes = [(60, 10, 40), (60, 40, 60), (72, 90, 100), (60, 100, 140)]
    line = likeliest_line(*heard(160, notes), 40, 96)
    assert list(zip(line.pitch.tolist(), line.begin.tolist(), line.end.tolist(), strict=True)) == notes


def test_a_weak_place_does_not_split_a_note() -> None:
    posteriors, novelty = heard(100, [(65, 10, 80)])
    posteriors.note[40:43, 65 - 21] = 0.1
    line = likeliest_line(posteriors, novelty, 40, 96)
    assert line.pitch.tolist() == [65]


def test_silence_has_no_line() -> None:
    assert len(likeliest_line(*heard(50, []), 40, 96).pitch) == 0


def test_what_is_all_but_silent_is_not_heard() -> None:
    posteriors, _ = heard(20, [(60, 2, 18)])
    samples = np.ones(20 * HOP, dtype=np.float32)
    samples[10 * HOP :] = 1e-4
    gated = posteriors.where_audible(samples)
    assert np.all(gated.note[2:9, 60 - 21] > 0.5)
    assert np.all(gated.note[12:] == 0)


@pytest.mark.parametrize("bpm", [66, 90, 120, 150])
def test_beats_follow_a_bent_tempo(bpm: int) -> None:
    random = np.random.default_rng(bpm)
    beats = np.cumsum(random.choice([0.5, 1.0, 1.0, 2.0, 0.5, 1.0], 60))
    onset_s = 1.0 + (beats + 0.8 * np.sin(beats / 12)) * 60 / bpm + random.normal(0, 0.006, len(beats))
    pulse = find_pulse(np.sort(onset_s), float(onset_s.max()) + 0.5)
    assert pulse.is_clear
    assert pulse.beats_s[0] <= onset_s.min()
    assert pulse.beats_s[-1] >= onset_s.max()
    found = 60 / float(np.median(np.diff(pulse.beats_s)))
    # Half or twice as fast is as good a reading.
    assert min(abs(np.log2(found / bpm) - octave) for octave in (-1, 0, 1)) < 0.08


def test_few_notes_tell_no_beat() -> None:
    pulse = find_pulse(np.array([0.31, 0.9, 2.2]), 3.0)
    assert not pulse.is_clear
    assert pulse.bar_beats == 4
    np.testing.assert_allclose(np.diff(pulse.beats_s), 0.5)


def test_onsets_by_chance_mostly_tell_no_beat() -> None:
    clear = 0
    for seed in range(12):
        at = np.cumsum(np.random.default_rng(seed).uniform(0.15, 1.1, 60))
        clear += find_pulse(at, float(at[-1]) + 0.3).is_clear
    assert clear <= 4
