"""Recordings made worse at random, and what may come of them."""

from __future__ import annotations

import functools
import random
from pathlib import Path
from typing import TYPE_CHECKING

from tests.mutations import Format, mutate
from tests.unit.sound.recording.recordings import flac_in_ogg, id3, mp4, recording, wav, webm

from reina.errors import InputError
from reina.sound.recording.probe import probe_recording

if TYPE_CHECKING:
    from collections.abc import Iterator

CASES = Path(__file__).parents[2] / "cases"

RECORDINGS = Format(
    interesting=(0x00, 0x01, 0x02, 0x7F, 0x80, 0xFE, 0xFF, 0xFB, 0xF8),
    tokens=(
        b"RIFF", b"data", b"fmt ", b"fLaC", b"OggS", b"ID3", b"Xing", b"OpusHead", b"\x01vorbis", b"moov",
        b"\xff\xfb\x90\x00", b"\xff\xff\xff\xff", b"\x00\x00\x00\x00",
    ),
    numbers=(b"0", b"9", b"\x00", b"\xff"),
)  # fmt: skip


@functools.cache
def seeds() -> tuple[bytes, ...]:
    """Small recordings of every kind to begin from."""
    flac = recording("FLAC", "PCM_16", seconds=0.2, channels=1)
    mp3 = recording("MP3", "MPEG_LAYER_III", seconds=0.3)
    vorbis = recording("OGG", "VORBIS", seconds=0.2)
    return (
        *(path.read_bytes() for path in sorted(CASES.glob("aud-*"))),
        wav(seconds=0.05),
        recording("AIFF", "PCM_16", seconds=0.05),
        recording("WAV", "IMA_ADPCM", seconds=0.05, channels=1),
        recording("RF64", "FLOAT", seconds=0.05),
        flac,
        id3(20) + flac + flac,
        flac_in_ogg(flac, 200),
        mp3,
        id3(10) + id3(10) + bytes(300) + mp3,
        mp3 + mp3,
        vorbis,
        vorbis + vorbis,
        recording("OGG", "OPUS", seconds=0.2, rate=48_000),
        mp4(),
        webm(),
    )


def mutate_recording(data: bytes, rng: random.Random) -> bytes:
    """A recording with one mutation or more."""
    # Most of a recording is samples: two of three are mutated where headers stand.
    head = rng.choice((64, 256, len(data)))
    return mutate(data[:head], RECORDINGS, rng) + data[head:]


def mutated(count: int, seed: int) -> Iterator[bytes]:
    """Yield `count` files, each a seed with one mutation or more."""
    rng = random.Random(seed)
    for _ in range(count):
        yield mutate_recording(rng.choice(seeds()), rng)


def check_recording(data: bytes) -> bool:
    """Probe a recording in this process; True if it could be read.

    Raises:
        AssertionError: What came of it is no possible sound, or the complaint says nothing.
        Exception: Anything but `InputError`: a fault of ours.
    """
    try:
        info, peaks = probe_recording(data)
    except InputError as error:
        if not error.detail:
            raise AssertionError("refused without a reason") from error
        return False
    assert info.duration_s is None or 0 <= info.duration_s <= 4 * 3600
    if peaks is not None:
        assert peaks.lowest.size == peaks.highest.size > 0
        assert (peaks.lowest <= peaks.highest).all()
        assert peaks.lowest.min() >= -1.0
        assert peaks.highest.max() <= 1.0
    return True
