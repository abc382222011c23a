"""Recordings as one channel at the rate at which they are listened to."""

import io

import numpy as np
import pytest
import soundfile
from tests.unit.sound.recording.recordings import mp4

from reina.errors import InputError
from reina.sound.recording.mono import Thinner, read_mono

FORMS = {"WAV": "PCM_16", "FLAC": "PCM_16", "MP3": "MPEG_LAYER_III", "OGG": "VORBIS", "OGG Opus": "OPUS"}

KINDS = [
    *((form, rate) for form in ("WAV", "FLAC") for rate in (22_050, 44_100, 48_000, 96_000)),
    *((form, rate) for form in ("MP3", "OGG") for rate in (22_050, 44_100, 48_000)),
    ("OGG Opus", 48_000),
]
"""Formats and the rates that they have."""


def a_file(samples: np.ndarray[tuple[int, ...], np.dtype[np.float64]], rate: int, form: str = "WAV") -> bytes:
    file = io.BytesIO()
    channels = 1 if samples.ndim == 1 else samples.shape[1]
    with soundfile.SoundFile(
        file, "w", samplerate=rate, channels=channels, format=form.split()[0], subtype=FORMS[form]
    ) as sound:
        sound.write(samples)
    return file.getvalue()


def clicks(
    rate: int, at_s: list[float], seconds: float = 2.0
) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Short bursts of 1 kHz, on the right alone."""
    sound = np.zeros((round(seconds * rate), 2))
    for second in at_s:
        place = round(second * rate)
        length = rate // 50
        sound[place : place + length, 1] = 0.8 * np.sin(2 * np.pi * 1000 * np.arange(length) / rate)
    return sound


@pytest.mark.parametrize(("form", "rate"), KINDS)
def test_what_sounds_stays_where_it_is(form: str, rate: int):
    samples, kept = read_mono(a_file(clicks(rate, [0.5, 1.25]), rate, form))
    assert 20_000 <= kept < 40_000
    assert len(samples) / kept == pytest.approx(2.0, abs=2e-3)
    for second in (0.5, 1.25):
        around = np.abs(samples[round((second - 0.2) * kept) : round((second + 0.2) * kept)])
        first = np.flatnonzero(around > 0.4 * around.max())[0] / kept + second - 0.2
        assert first == pytest.approx(second, abs=0.002)
    assert np.abs(samples).max() == pytest.approx(0.4, rel=0.25)


def test_blocks_of_any_size_give_the_same():
    sound = np.random.default_rng(0).normal(0, 0.1, (20_000, 2)).astype(np.float32)
    whole, pieces = Thinner(), Thinner()
    whole.take(sound, 96_000)
    for block in np.split(sound, [1, 2, 50, 51, 4000, 4001, 15_000]):
        pieces.take(block, 96_000)
    assert whole.whole()[1] == pieces.whole()[1] == 24_000
    assert pieces.whole()[0][:5000] == pytest.approx(whole.whole()[0][:5000], abs=1e-6)


def test_what_is_too_high_does_not_come_back_lower():
    times = np.arange(96_000) / 96_000
    samples, kept = read_mono(a_file(0.8 * np.sin(2 * np.pi * 17_000 * times), 96_000))
    assert kept == 24_000
    assert np.abs(samples[500:-500]).max() < 0.01


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "empty file"),
        (b"not audio at all, but some text that is long enough", "no audio file"),
        (mp4(), "MP4 is not decoded here"),
        (a_file(np.zeros(2000), 8000)[:44], "WAV"),
    ],
)
def test_what_cannot_be_listened_to_is_refused(data: bytes, says: str):
    with pytest.raises(InputError, match=says):
        read_mono(data)
