"""The shape of a song's sound."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

import numpy as np
import pytest

from reina.sound.recording.decode import BLOCK_FRAMES
from reina.sound.recording.peaks import Peaks, peaks_path, read_peaks, write_peaks
from reina.sound.recording.probe import probe_recording
from reina.sound.recording.wav import wav_header

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from reina.music.arrays import FloatArray

RATE = 8000


def peaks_of(data: bytes) -> Peaks:
    _, peaks = probe_recording(data)
    assert peaks is not None
    return peaks


def wav(samples: bytes, *, encoding: int, bits: int, channels: int = 1, extensible: bool = False) -> bytes:
    frame = bits // 8 * channels
    fields = (encoding, channels, RATE, RATE * frame, frame, bits)
    form = struct.pack("<HHIIHH", *fields)
    if extensible:
        form = struct.pack("<HHIIHH", 0xFFFE, *fields[1:]) + struct.pack("<HHIH", 22, bits, 0, encoding)
        form += bytes.fromhex("000000001000800000aa00389b71")
    chunks = b"fmt " + struct.pack("<I", len(form)) + form + b"data" + struct.pack("<I", len(samples))
    return b"RIFF" + struct.pack("<I", 4 + len(chunks) + len(samples)) + b"WAVE" + chunks + samples


def ramp() -> FloatArray:
    """(2 s, 2 channels): silence, then the left goes up to 0.5 while the right goes down to -1."""
    up = np.concatenate([np.zeros(RATE), np.linspace(0.0, 1.0, RATE)])
    return np.stack([0.5 * up, -up], axis=1)


def of_24_bits(values: FloatArray) -> bytes:
    whole = np.rint(values * (2**23 - 1)).astype("<i4").reshape(-1, 1).view(np.uint8)
    return whole[:, :3].tobytes()


CODINGS: dict[str, tuple[int, int, Callable[[FloatArray], bytes]]] = {
    "8 bits": (1, 8, lambda v: np.clip(np.rint(v * 128 + 128), 0, 255).astype(np.uint8).tobytes()),
    "16 bits": (1, 16, lambda v: np.rint(v * 32767).astype("<i2").tobytes()),
    "24 bits": (1, 24, of_24_bits),
    "32 bits": (1, 32, lambda v: np.rint(v * (2**31 - 1)).astype("<i4").tobytes()),
    "floats": (3, 32, lambda v: v.astype("<f4").tobytes()),
    "doubles": (3, 64, lambda v: v.astype("<f8").tobytes()),
}


@pytest.mark.parametrize("extensible", [False, True])
@pytest.mark.parametrize("coding", CODINGS)
def test_every_coding_of_samples_has_the_same_shape(coding: str, extensible: bool) -> None:
    encoding, bits, write = CODINGS[coding]
    peaks = peaks_of(wav(write(ramp()), encoding=encoding, bits=bits, channels=2, extensible=extensible))
    assert peaks.duration_s == pytest.approx(2.0)
    drawn = peaks.reduced(4)
    assert drawn.lowest == pytest.approx([0, 0, -0.5, -1], abs=0.012)
    assert drawn.highest == pytest.approx([0, 0, 0.25, 0.5], abs=0.012)


def test_peaks_are_those_of_the_samples_however_long_the_song() -> None:
    frames = 65 * BLOCK_FRAMES + 1_234
    samples = np.random.default_rng(3).integers(-32768, 32768, frames).astype("<i2")
    peaks = peaks_of(wav_header(frames, sample_rate=RATE, channels=1) + samples.tobytes())
    stretch = RATE // 200
    assert peaks.lowest.size == -(-frames // stretch)
    for number in (0, 1, 102, 103, 6553, 6554, peaks.lowest.size - 1):
        own = samples[number * stretch : (number + 1) * stretch] / 32768.0
        assert peaks.lowest[number] == pytest.approx(own.min(), abs=1e-9)
        assert peaks.highest[number] == pytest.approx(own.max(), abs=1e-9)
    assert peaks.reduced(1).lowest == pytest.approx([samples.min() / 32768.0])
    assert peaks.reduced(50_000).highest.size == 50_000


def test_no_number_counts_as_silence_and_more_than_full_scale_as_full() -> None:
    samples = np.zeros(RATE, dtype="<f4")
    samples[100:200] = np.nan
    samples[4000:4040] = np.inf
    samples[6000:6040] = -3.0
    peaks = peaks_of(wav(samples.tobytes(), encoding=3, bits=32))
    assert peaks.reduced(4).highest.tolist() == [0.0, 0.0, 1.0, 0.0]
    assert peaks.reduced(4).lowest.tolist() == [0.0, 0.0, 0.0, -1.0]


def test_peaks_are_kept_beside_the_song(tmp_path: Path) -> None:
    song = tmp_path / "song.wav"
    assert read_peaks(peaks_path(song)) is None
    encoding, bits, write = CODINGS["16 bits"]
    first = peaks_of(wav(write(ramp()), encoding=encoding, bits=bits, channels=2))
    write_peaks(peaks_path(song), first)
    again = read_peaks(peaks_path(song))
    assert again is not None
    assert again.lowest == pytest.approx(first.lowest, abs=1 / 32767)
    assert again.duration_s == first.duration_s
