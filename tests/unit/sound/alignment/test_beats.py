"""A tempo through onsets that may err."""

import numpy as np
import pytest

from reina.sound.alignment.beats import fit_beats

KNOTS = np.arange(0, 40, 0.5)
ONSETS = np.arange(0, 39.5, 0.25)


def bent(times: np.ndarray[tuple[int], np.dtype[np.float64]]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return 1.1 * times + 0.6 * np.sin(times / 3)


def test_a_smooth_tempo_is_found_through_wrong_onsets():
    random = np.random.default_rng(0)
    heard = bent(ONSETS) + random.normal(0, 0.004, len(ONSETS))
    wrong = random.random(len(ONSETS)) < 0.15
    heard[wrong] += random.uniform(-0.12, 0.12, int(wrong.sum()))
    line = fit_beats(KNOTS, ONSETS, heard, np.ones(len(ONSETS)))
    off = np.abs(line - bent(KNOTS))
    assert np.median(off) < 0.004
    assert np.percentile(off[1:-1], 95) < 0.02


def test_a_sudden_tempo_is_not_smeared():
    def jumps(times: np.ndarray[tuple[int], np.dtype[np.float64]]):
        return np.where(times < 20, times, 20 + 1.4 * (times - 20))

    line = fit_beats(KNOTS, ONSETS, jumps(ONSETS), np.ones(len(ONSETS)))
    assert np.abs(line - jumps(KNOTS)).max() < 0.012


def test_it_never_runs_backwards():
    random = np.random.default_rng(1)
    line = fit_beats(KNOTS, ONSETS, random.uniform(0, 40, len(ONSETS)), np.ones(len(ONSETS)))
    assert np.all(np.diff(line) > 0)


def test_one_onset_places_all():
    line = fit_beats(np.array([0.0, 1.0, 2.0]), np.array([1.0]), np.array([5.0]), np.ones(1))
    assert line == pytest.approx([4.0, 5.0, 6.0], abs=1e-3)
