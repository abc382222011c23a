import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.music import TempoMap

changes = st.lists(
    st.tuples(st.floats(0, 1000), st.floats(0.05, 4.0)), max_size=12, unique_by=lambda change: change[0]
)


def test_without_a_tempo_120_beats_pass_in_a_minute():
    tempo_map = TempoMap()
    assert tempo_map.seconds(120.0) == 60.0
    assert tempo_map.beats(60.0) == 120.0
    assert [tempo.beats_per_minute for tempo in tempo_map.tempos] == [120.0]


def test_a_change_of_tempo():
    tempo_map = TempoMap([0, 4], [1.0, 0.25])
    assert tempo_map.seconds(np.array([0.0, 2.0, 4.0, 6.0])).tolist() == [0.0, 2.0, 4.0, 4.5]
    assert [(t.onset_beats, t.onset_s, t.beats_per_minute) for t in tempo_map.tempos] == [
        (0, 0, 60),
        (4, 4, 240),
    ]


def test_before_the_first_tempo_120_hold_and_of_one_beat_the_last():
    tempo_map = TempoMap([8, 4, 8], [9.0, 1.0, 2.0])
    assert tempo_map.onset_beats.tolist() == [0.0, 4.0, 8.0]
    assert tempo_map.seconds_per_beat.tolist() == [0.5, 1.0, 2.0]


def test_before_the_beginning_the_first_tempo_holds():
    tempo_map = TempoMap([0], [2.0])
    assert tempo_map.seconds(-3.0) == -6.0
    assert tempo_map.beats(-6.0) == -3.0


@given(changes, st.lists(st.floats(0, 2000), min_size=1, max_size=20))
def test_beats_and_seconds_are_inverse(entries: list[tuple[float, float]], beats: list[float]):
    tempo_map = TempoMap([beat for beat, _ in entries], [length for _, length in entries])
    seconds = tempo_map.seconds(np.array(beats))
    np.testing.assert_allclose(tempo_map.beats(seconds), beats, rtol=1e-12, atol=1e-9)
    assert np.all(np.diff(tempo_map.seconds(np.sort(beats))) >= 0)


def test_a_ramp_of_small_steps_is_exact_to_a_microsecond_over_an_hour():
    # An accelerando and back, a new tempo every 1/24 beat in whole microseconds, as files have it.
    steps = 24 * 7200
    lengths = [int(500_000 + 100_000 * math.sin(step / 5000)) for step in range(steps)]
    tempo_map = TempoMap(np.arange(steps) / 24, np.array(lengths) / 1e6)
    exact = Fraction(0)
    places = set(range(0, steps, 9973)) | {steps - 1}
    for step, length in enumerate(lengths):
        if step in places:
            seconds = tempo_map.seconds(step / 24)
            assert abs(Fraction(seconds) - exact) < Fraction(1, 10**6)
            assert abs(tempo_map.beats(seconds) - step / 24) < 1e-6
        exact += Fraction(length, 24 * 10**6)
    assert exact > 3500


@pytest.mark.parametrize(
    ("beats", "lengths"),
    [([-1], [0.5]), ([0], [0]), ([0], [-1]), ([math.nan], [1]), ([0], [math.inf]), ([0, 1], [1])],
)
def test_what_is_no_tempo_is_refused(beats: list[float], lengths: list[float]):
    with pytest.raises(ValueError, match="beat"):
        TempoMap(beats, lengths)
