import numpy as np
import pytest
from numpy.typing import NDArray
from tests.unit.sound.material import Row, a_part, a_score

from reina.sound.events import SAMPLE_RATE
from reina.sound.level import (
    EXCERPT,
    EXCERPTS,
    FULL_SCALE,
    KNEE,
    LARGEST_GAIN,
    LARGEST_PEAK,
    TARGET_RMS,
    choose_excerpts,
    levelled,
    song_gain,
)
from reina.sound.plan import plan_sound


def noise(seconds: float, level: float, seed: int = 0) -> NDArray[np.float32]:
    generator = np.random.default_rng(seed)
    return (generator.standard_normal((round(seconds * SAMPLE_RATE), 2)) * level).astype(np.float32)


@pytest.mark.parametrize("level", [0.004, 0.03, 3.0])
def test_loudness_is_the_same_whatever_the_rendering_s(level: float) -> None:
    excerpts = [noise(2, level, seed) for seed in range(3)]
    heard = np.concatenate(excerpts) * song_gain(excerpts)
    assert np.sqrt((heard**2).mean()) == pytest.approx(TARGET_RMS, rel=0.02)


def test_soft_excerpts_do_not_make_a_piece_louder() -> None:
    excerpts = [noise(2, 0.02), noise(2, 0.001, 1), np.zeros((EXCERPT, 2), dtype=np.float32)]
    assert song_gain(excerpts) == pytest.approx(song_gain(excerpts[:1]), rel=0.02)


def test_a_measured_peak_stays_below_the_knee() -> None:
    excerpt = noise(2, 0.01)
    excerpt[SAMPLE_RATE] = (2.5, -2.5)
    assert 2.5 * song_gain([excerpt]) == pytest.approx(KNEE)


def test_what_is_hardly_there_is_not_blown_up_and_silence_stays_silent() -> None:
    assert song_gain([noise(2, 1e-4)]) == pytest.approx(LARGEST_GAIN)
    assert song_gain([np.zeros((EXCERPT, 2), dtype=np.float32)]) == 1.0
    assert song_gain([]) == 1.0


def test_samples_are_what_they_are_up_to_the_knee_and_never_reach_full_scale() -> None:
    ramp = np.linspace(-40, 40, 20_001, dtype=np.float32)[:, None].repeat(2, axis=1)
    got = levelled(ramp.copy(), 0.5)
    small = np.abs(ramp * 0.5) <= KNEE
    np.testing.assert_array_equal(got[small], np.rint(ramp[small] * np.float32(0.5 * FULL_SCALE)))
    assert np.all(np.diff(got.astype(np.int32), axis=0) >= 0)
    assert np.abs(got.astype(np.int32)).max() == round(LARGEST_PEAK * FULL_SCALE)


def test_a_stretch_is_levelled_as_the_whole_is() -> None:
    whole = noise(1, 0.4)
    pieces = [levelled(whole[first : first + 1000], 1.7) for first in range(0, len(whole), 1000)]
    np.testing.assert_array_equal(np.concatenate(pieces), levelled(whole, 1.7))


def test_excerpts_are_where_the_most_is_played() -> None:
    soft: list[Row] = [(0, float(second), 0.9, 60, 0.3) for second in range(90)]
    loud: list[Row] = [
        (index % 20, at + 0.05 * index, 1.0, 64, 0.9) for at in (12.2, 47.7, 80.1) for index in range(20)
    ]
    plan = plan_sound(a_score([*soft, *loud], [a_part(index, "Part", index) for index in range(20)]))
    excerpts = list(choose_excerpts(plan))
    assert len(excerpts) == EXCERPTS
    for passages, at in zip(excerpts, (12.2, 47.7, 80.1), strict=True):
        assert {passage.port for passage in passages} == {0, 1}
        assert {passage.length for passage in passages} == {EXCERPT}
        assert abs(passages[0].start / SAMPLE_RATE - at) < 2.5


@pytest.mark.parametrize(
    "rows", [[(0, 0.0, 0.05, 60, 0.5)], [(0, 5.0, 0.5, 60, 0.5)], [(0, 0.0, 100.0, 60, 0.5)]]
)
def test_the_shortest_and_the_longest_notes_have_excerpts(rows: list[Row]) -> None:
    plan = plan_sound(a_score(rows))
    excerpts = list(choose_excerpts(plan))
    assert excerpts
    assert all(passage.notes.tolist() == [0] for passages in excerpts for passage in passages)
