import wave
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reina.sound.events import SAMPLE_RATE
from reina.sound.mix import FADE, LARGEST_GAIN, LARGEST_PEAK, TARGET_RMS, Mix


def noise(seconds: float, level: float, seed: int = 0) -> NDArray[np.float32]:
    generator = np.random.default_rng(seed)
    return (generator.standard_normal((round(seconds * SAMPLE_RATE), 2)) * level).astype(np.float32)


def mixed(
    tmp_path: Path, *passages: tuple[int, NDArray[np.float32]], at_least: int = 0
) -> NDArray[np.float64]:
    scratch, out = tmp_path / "mix", tmp_path / "out.wav"
    with Mix(scratch) as mix:
        for start, samples in passages:
            mix.add(start, samples)
        mix.write_wav(out, at_least=at_least)
    assert not scratch.exists()
    with wave.open(str(out)) as file:
        assert file.getparams()[:3] == (2, 2, SAMPLE_RATE)
        return np.frombuffer(file.readframes(file.getnframes()), dtype="<i2").reshape(-1, 2) / 32767


def test_overlapping_passages_add_up_at_their_places(tmp_path: Path) -> None:
    first, second, third = noise(3, 0.05, 1), noise(2, 0.05, 2), noise(2, 0.05, 3)
    starts = (SAMPLE_RATE, 2 * SAMPLE_RATE, 14 * SAMPLE_RATE)
    expected = np.zeros((16 * SAMPLE_RATE, 2))
    for start, samples in zip(starts, (first, second, third), strict=True):
        faded = samples.astype(np.float64)
        faded[-FADE:] *= np.linspace(1, 0, FADE)[:, None]
        expected[start : start + len(samples)] += faded
    got = mixed(tmp_path, *zip(starts, (first, second, third), strict=True))
    assert np.all(got[:SAMPLE_RATE] == 0)
    kept = slice(0, len(got) - 2 * FADE)
    gain = np.sum(got[kept] * expected[kept]) / np.sum(expected[kept] ** 2)
    np.testing.assert_allclose(got[kept], gain * expected[kept], atol=1 / 32767)


@pytest.mark.parametrize("level", [0.004, 0.03, 3.0])
def test_loudness_is_the_same_whatever_the_rendering_s(tmp_path: Path, level: float) -> None:
    got = mixed(tmp_path, (0, noise(5, level)))
    assert np.sqrt((got[: 4 * SAMPLE_RATE] ** 2).mean()) == pytest.approx(TARGET_RMS, rel=0.02)


def test_rests_do_not_make_a_piece_louder(tmp_path: Path) -> None:
    got = mixed(tmp_path, (0, noise(5, 0.02)), (60 * SAMPLE_RATE, noise(5, 0.02, 1)))
    assert np.sqrt((got[: 4 * SAMPLE_RATE] ** 2).mean()) == pytest.approx(TARGET_RMS, rel=0.05)


def test_a_lone_peak_does_not_clip(tmp_path: Path) -> None:
    samples = noise(5, 0.01)
    samples[SAMPLE_RATE] = (2.5, -2.5)
    got = mixed(tmp_path, (0, samples))
    assert np.abs(got).max() == pytest.approx(LARGEST_PEAK, abs=1e-4)


def test_what_is_hardly_there_is_not_blown_up(tmp_path: Path) -> None:
    samples = noise(5, 1e-4)
    got = mixed(tmp_path, (0, samples.copy()))
    assert np.abs(got).max() == pytest.approx(np.abs(samples[:-FADE]).max() * LARGEST_GAIN, rel=0.05)


def test_the_file_ends_with_the_sound_but_not_before_the_score(tmp_path: Path) -> None:
    sound = np.concatenate((noise(2, 0.05), np.zeros((5 * SAMPLE_RATE, 2), dtype=np.float32)))
    assert len(mixed(tmp_path, (0, sound.copy()))) == pytest.approx(2 * SAMPLE_RATE + FADE, abs=100)
    assert len(mixed(tmp_path, (0, sound.copy()), at_least=10 * SAMPLE_RATE)) == 10 * SAMPLE_RATE


@pytest.mark.parametrize("seconds", [0.05, 0.3, 9.999, 10.0, 10.1])
def test_any_length_is_measured_to_its_end(tmp_path: Path, seconds: float) -> None:
    got = mixed(tmp_path, (0, noise(seconds, 0.02)))
    assert len(got) == pytest.approx((seconds + FADE / SAMPLE_RATE) * SAMPLE_RATE, abs=200)
    assert np.abs(got).max() > 0.1


def test_silence_stays_silent(tmp_path: Path) -> None:
    got = mixed(tmp_path, (0, np.zeros((SAMPLE_RATE, 2), dtype=np.float32)), at_least=SAMPLE_RATE)
    assert got.shape == (SAMPLE_RATE, 2)
    assert not got.any()
