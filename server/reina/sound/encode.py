"""Writes sound for the page: segments as Ogg Opus, the whole as FLAC; and FLAC as WAV again."""

import io
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np
import soundfile
from numpy.typing import NDArray

from reina.sound.events import SAMPLE_RATE
from reina.sound.recording.wav import wav_header
from reina.system.checked_file import checked_file

SEGMENT_MEDIA_TYPE = "audio/ogg"
SONG_MEDIA_TYPE = "audio/flac"
WAV_MEDIA_TYPE = "audio/wav"
PIECE = SAMPLE_RATE
"""So many samples are handed to libsndfile at once."""

Samples = NDArray[np.int16]


def opus(samples: Samples) -> bytes:
    """Ogg Opus of samples at 48 kHz, (F, 2); whoever honours its pre-skip decodes F samples, in place."""
    written = io.BytesIO()
    with soundfile.SoundFile(written, "w", SAMPLE_RATE, 2, subtype="OPUS", format="OGG") as file:
        for first in range(0, len(samples), PIECE):
            file.write(samples[first : first + PIECE])
    return written.getvalue()


def write_flac(path: Path, pieces: Iterable[Samples]) -> None:
    """Write samples at 48 kHz, each piece (F, 2), as FLAC: without loss.

    Raises:
        OSError: The disk does not take it.
    """
    with (
        checked_file(path) as written,
        soundfile.SoundFile(written, "w", SAMPLE_RATE, 2, subtype="PCM_16", format="FLAC") as file,
    ):
        for piece in pieces:
            file.write(piece)


def wav_of(path: Path) -> tuple[int, Iterator[bytes]]:
    """A FLAC file of 16 bits as WAV: its size in bytes, and the bytes as they are decoded.

    Raises:
        soundfile.LibsndfileError: It cannot be read.
    """
    file = soundfile.SoundFile(path)
    header = wav_header(file.frames, sample_rate=file.samplerate, channels=file.channels)
    return len(header) + file.frames * 2 * file.channels, _wav(header, file)


def _wav(header: bytes, file: soundfile.SoundFile) -> Iterator[bytes]:
    with file:
        yield header
        for block in file.blocks(blocksize=PIECE, dtype="int16"):
            yield block.astype("<i2").tobytes()
