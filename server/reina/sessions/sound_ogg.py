"""Ogg (RFC 3533) with Vorbis, Opus (RFC 7845) or FLAC inside: the first page and the last."""

import struct
from typing import BinaryIO

from reina.sessions.sound_facts import AudioFacts, BrokenAudioError

TAIL_BYTES = 128 * 1024
"""Where the last page is looked for; a page has at most 65,307 bytes."""

OPUS_RATE = 48000
"""Opus counts in samples at this rate, whatever the rate of what was encoded."""


def is_ogg(head: bytes) -> bool:
    """Whether a file that begins so is Ogg."""
    return head.startswith(b"OggS")


def read_ogg(file: BinaryIO, size: int) -> AudioFacts:
    """Read the codec's header on the first pages and the last page's granule position."""
    first = file.read(4096)
    granule_rate = skipped = sample_rate = channels = 0
    if (at := first.find(b"OpusHead")) >= 0 and len(first) >= at + 16:
        channels, skipped, sample_rate = struct.unpack_from("<BHI", first, at + 9)
        granule_rate, sample_rate = OPUS_RATE, sample_rate or OPUS_RATE
    elif (at := first.find(b"\x01vorbis")) >= 0 and len(first) >= at + 16:
        channels, sample_rate = struct.unpack_from("<BI", first, at + 11)
        granule_rate = sample_rate
    elif (at := first.find(b"\x7fFLAC")) >= 0 and len(first) >= at + 35:
        packed = int.from_bytes(first[at + 27 : at + 35], "big")
        sample_rate, channels = packed >> 44, (packed >> 41 & 7) + 1
        granule_rate = sample_rate
    if not granule_rate or not channels:
        raise BrokenAudioError("it holds no Vorbis, Opus or FLAC stream")
    file.seek(max(0, size - TAIL_BYTES))
    tail = file.read()
    last = tail.rfind(b"OggS")
    duration_s = None
    if last >= 0 and len(tail) >= last + 14:
        (granule,) = struct.unpack_from("<q", tail, last + 6)
        duration_s = (granule - skipped) / granule_rate if granule > skipped else None
    return AudioFacts(duration_s=duration_s, sample_rate=sample_rate, channels=channels)
