from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reina.sound.events import SAMPLE_RATE
from reina.sound.mix import FADE, Mix


def noise(seconds: float, level: float, seed: int = 0) -> NDArray[np.float32]:
    generator = np.random.default_rng(seed)
    return (generator.standard_normal((round(seconds * SAMPLE_RATE), 2)) * level).astype(np.float32)


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 0, 1), (1, 2, 0)])
def test_overlapping_passages_add_up_at_their_places_in_any_order(
    tmp_path: Path, order: tuple[int, int, int]
) -> None:
    passages = [noise(3, 0.05, 1), noise(2, 0.05, 2), noise(2, 0.05, 3)]
    starts = (SAMPLE_RATE, 2 * SAMPLE_RATE, 14 * SAMPLE_RATE)
    expected = np.zeros((17 * SAMPLE_RATE, 2), dtype=np.float32)
    for start, samples in zip(starts, passages, strict=True):
        faded = samples.copy()
        faded[-FADE:] *= np.linspace(1, 0, FADE, dtype=np.float32)[:, None]
        expected[start : start + len(samples)] += faded
    with Mix(tmp_path / "mix") as mix:
        for index in order:
            mix.add(starts[index], passages[index].copy())
        np.testing.assert_allclose(mix.read(0, len(expected)), expected, atol=1e-7)
        assert len(list(tmp_path.iterdir())) == 2, "a file for every ten seconds"
        mix.forget(12 * SAMPLE_RATE)
        np.testing.assert_allclose(
            mix.read(10 * SAMPLE_RATE, len(expected)), expected[10 * SAMPLE_RATE :], atol=1e-7
        )
        assert len(list(tmp_path.iterdir())) == 1
    assert list(tmp_path.iterdir()) == []


def test_around_the_sound_there_is_silence(tmp_path: Path) -> None:
    with Mix(tmp_path / "mix") as mix:
        assert not mix.read(-100, 200).any()
        mix.add(0, np.ones((SAMPLE_RATE, 2), dtype=np.float32))
        around = mix.read(-100, 2 * SAMPLE_RATE)
    assert len(around) == 100 + 2 * SAMPLE_RATE
    assert not around[:100].any()
    assert around[100:200].all()
    assert not around[100 + SAMPLE_RATE :].any()
