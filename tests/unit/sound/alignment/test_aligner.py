"""Recordings whose truth is known, aligned: a few such as bench_alignment.py measures."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from tests.unit.sound.alignment.bed import Result, measure
from tests.unit.sound.alignment.renditions import RATE, Recording, Rendition, example, record, render
from tests.unit.sound.material import Row, a_part, a_score

from reina.errors import InputError
from reina.sound.alignment import Alignment, align

MEDIAN_MS, P95_MS = 10.0, 40.0
ODE, TAPS, VENICE, MARCH = "ode-to-joy", "taps", "carnival-of-venice", "prince-of-denmarks-march"
SAINTS = "when-the-saints"

EXACT = Rendition(ODE)
SMOOTH = Rendition(VENICE, (1.15, 0.12), lead_in_s=3.1, tail_s=4, noise_db=-25, seed=3)
SUDDEN = Rendition(ODE, (0.9, 0.25), sudden=True, reverberation_s=1.5, seed=4)
CUT = Rendition(MARCH, (0.9, 0.15), cut=(20.0, 12.0), lead_in_s=1, noise_db=-25, seed=5)
SPOILT = Rendition(VENICE, (1.2, 0.1), programs=(71, 0, 42), wrong=0.2, noise_db=-20, seed=6)
MOVED = Rendition(TAPS, (0.85, 0.1), transposition=-3, cents=35, seed=7)
COUNTED = Rendition(
    VENICE, (1.0, 0.08), count_in=4, lead_in_s=3.5, repeat=(8.0, 8.0), without_parts=(1,), seed=8
)
ALL = (EXACT, SMOOTH, SUDDEN, CUT, SPOILT, MOVED, COUNTED)


@cache
def aligned(rendition: Rendition) -> tuple[Recording, Alignment, Result]:
    recording = record(rendition)
    alignment = align(recording.samples, RATE, recording.score)
    return recording, alignment, measure(recording, alignment)


@pytest.mark.parametrize("rendition", ALL, ids=lambda rendition: rendition.score)
def test_onsets_are_found(rendition: Rendition):
    _, alignment, result = aligned(rendition)
    assert alignment.is_same_music
    assert result.median_ms <= MEDIAN_MS
    assert result.p95_ms <= P95_MS
    assert alignment.confidence > 0.6


def test_a_rendering_of_the_score_itself_is_in_time_with_it():
    _, alignment, result = aligned(EXACT)
    assert result.p95_ms < 12
    assert alignment.transposition == 0
    assert alignment.gaps == ()
    assert not alignment.sounds_after


def test_what_stands_before_and_after_the_music_is_told():
    _, alignment, _ = aligned(SMOOTH)
    assert alignment.begins_s == pytest.approx(3.1, abs=0.05)
    assert alignment.sounds_after
    assert alignment.count_in == 0


def test_a_cut_is_told_with_what_is_missing():
    recording, alignment, _ = aligned(CUT)
    onset_s = recording.score.notes.onset_s
    heard = ~np.isnan(recording.onset_s)
    (gap,) = alignment.gaps
    missing = onset_s[~heard]
    assert gap.score_from_s == pytest.approx(float(missing.min()), abs=0.7)
    assert gap.score_to_s == pytest.approx(float(missing.max()), abs=0.7)
    assert gap.song_length_s < 0.5
    assert np.mean(alignment.is_heard(onset_s) == heard) > 0.98
    beside = heard & (np.abs(onset_s - gap.score_from_s) < 3) | heard & (np.abs(onset_s - gap.score_to_s) < 3)
    off_s = np.abs(alignment.song_times(onset_s[beside]) - recording.onset_s[beside])
    assert np.percentile(off_s, 95) < 0.1


def test_another_key_and_tuning_are_told():
    _, alignment, _ = aligned(MOVED)
    assert alignment.transposition == -3
    assert alignment.tuning_cents == pytest.approx(35, abs=8)


def test_a_count_in_and_a_repeat_are_told():
    _, alignment, _ = aligned(COUNTED)
    assert alignment.count_in == 4
    (gap,) = alignment.gaps
    assert gap.song_length_s == pytest.approx(8, abs=0.7)
    assert gap.score_length_s < 0.5


def test_a_scale_in_another_key_is_not_the_same_scale_a_note_later():
    scale = Rendition("chromatic-scale", (0.9, 0.1), transposition=3, cents=30, seed=203)
    _, alignment, result = aligned(scale)
    assert alignment.transposition == 3
    assert result.median_ms <= MEDIAN_MS
    assert result.p95_ms <= P95_MS


def test_a_part_alone_is_found_where_the_tune_is_not_played():
    accompaniment = Rendition(ODE, (1.1, 0.1), without_parts=(0,), noise_db=-35, lead_in_s=1, seed=4)
    _, alignment, result = aligned(accompaniment)
    assert alignment.is_same_music
    assert alignment.transposition == 0
    assert result.p95_ms < 100


def test_as_people_play_it_is_found_to_within_what_they_are_late_or_early_by():
    played = Rendition(
        VENICE,
        (1.1, 0.08),
        lead_in_s=1.7,
        tail_s=3,
        noise_db=-32,
        reverberation_s=1.2,
        rubato=0.05,
        jitter_s=0.02,
        missing=0.05,
        wrong=0.05,
        vibrato_cents=20,
        breath_db=-22,
        seed=9,
    )
    recording, alignment, result = aligned(played)
    late_ms = 1000 * np.abs(recording.onset_s - recording.beat_s)
    assert np.nanmedian(late_ms) > 10
    assert result.median_ms < 25
    assert np.percentile(result.beat_errors_ms, 95) < 80
    assert alignment.confidence > 0.5


def test_it_is_less_sure_of_what_is_spoilt():
    assert aligned(SPOILT)[1].confidence < aligned(SMOOTH)[1].confidence


@pytest.mark.parametrize(("played", "written"), [(SMOOTH, MARCH), (MOVED, ODE), (EXACT, VENICE)])
def test_other_music_is_told_and_both_left_at_the_beginning(played: Rendition, written: str):
    alignment = align(record(played).samples, RATE, example(written))
    assert not alignment.is_same_music
    assert alignment.confidence == 0
    assert alignment.song_times([0, 5]) == pytest.approx([0, 5])


def test_noise_and_silence_are_no_music():
    noise = np.random.default_rng(0).normal(0, 0.1, 20 * RATE).astype(np.float32)
    for samples in (noise, np.zeros(5 * RATE, dtype=np.float32), noise[: RATE // 10], noise[:1]):
        assert not align(samples, RATE, example(TAPS)).is_same_music


def test_what_is_too_long_to_be_listened_to_is_refused_with_what_can_be_done():
    with pytest.raises(InputError, match=r"lasts 167 minutes, and in 70 at most .* by hand"):
        align(np.ones(10_000, dtype=np.float32), 1, example(TAPS))


def test_progress_rises_to_the_whole():
    recording = record(MOVED)
    told: list[float] = []
    align(recording.samples, RATE, recording.score, told.append)
    assert told == sorted(told)
    assert told[-1] == 1
    assert len(told) > 10


def test_the_same_recording_gives_the_same_map():
    recording, alignment, _ = aligned(MOVED)
    assert align(recording.samples, RATE, recording.score) == alignment


def test_drums_beside_a_melody_are_listened_for_too():
    random = np.random.default_rng(2)
    steps = np.cumsum(random.choice((0.25, 0.5, 0.75), 60))
    parts = (a_part(0, program=56), a_part(1, "Drums", is_drums=True))
    tune: list[Row] = [(0, float(at), 0.2, int(random.integers(60, 80)), 0.8) for at in steps]
    beats: list[Row] = [(1, 0.5 * at, 0.1, (36, 42, 38, 42)[at % 4], 0.8) for at in range(int(steps[-1] * 2))]
    score = a_score([*tune, *beats], parts)
    sound = np.concatenate((np.zeros(RATE, dtype=np.float32), render(score)))
    alignment = align(sound, RATE, score)
    off_ms = 1000 * np.abs(alignment.song_times(score.notes.onset_s) - score.notes.onset_s - 1)
    assert np.median(off_ms) <= MEDIAN_MS
    assert np.percentile(off_ms, 95) <= P95_MS


def test_a_score_of_drums_alone_is_no_reason_to_fail():
    score = a_score([(0, 0.5 * at, 0.1, 38, 0.9) for at in range(20)], (a_part(0, is_drums=True),))
    recording = record(replace(MOVED))
    assert not align(recording.samples, RATE, score).is_same_music


def test_drums_alone_before_the_first_tone_are_heard_where_there_is_time_for_them():
    played = Rendition(SAINTS, (1.25, 0.08), lead_in_s=2.0, noise_db=-40)
    _, alignment, result = aligned(played)
    assert alignment.gaps == ()
    assert alignment.begins_s == pytest.approx(2.0, abs=0.3)
    assert result.median_ms <= MEDIAN_MS
    _, alignment, _ = aligned(replace(played, lead_in_s=0.0, cut=(0.1, 6.0)))
    assert [gap.score_from_s for gap in alignment.gaps] == [0.0]
    assert alignment.gaps[0].score_to_s == pytest.approx(5.0, abs=0.4)
