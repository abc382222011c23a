"""MP3's frame headers: ISO/IEC 11172-3 section 2.4.2.3, and the Xing, Info and VBRI headers of encoders."""

from dataclasses import dataclass
from typing import BinaryIO

from reina.sessions.sound_facts import AudioFacts, BrokenAudioError

SEARCH_BYTES = 64 * 1024
"""How far after the tags the first frame is looked for."""

SAMPLE_RATES = {3: (44100, 48000, 32000), 2: (22050, 24000, 16000), 0: (11025, 12000, 8000)}
"""By the header's version bits: 3 is MPEG-1, 2 is MPEG-2, 0 is MPEG-2.5."""

BIT_RATES_KBPS = {
    3: (0, 32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320),
    2: (0, 8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160),
    0: (0, 8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160),
}
"""Layer III, by the version bits and the bit rate's index."""

SAMPLES_PER_FRAME = {3: 1152, 2: 576, 0: 576}


@dataclass(frozen=True)
class FrameHeader:
    """The four bytes that begin each MP3 frame, read."""

    version: int
    sample_rate: int
    bit_rate: int
    channels: int
    length: int

    @property
    def side_info_bytes(self) -> int:
        """Length of the side information between the header and an encoder's Xing header."""
        if self.version == 3:
            return 17 if self.channels == 1 else 32
        return 9 if self.channels == 1 else 17


def parse_frame_header(data: bytes) -> FrameHeader | None:
    """Read a Layer III frame's header from four bytes, or None where they are none."""
    if len(data) < 4 or data[0] != 0xFF or data[1] & 0xE0 != 0xE0:
        return None
    version, layer = data[1] >> 3 & 3, data[1] >> 1 & 3
    bit_rate_index, sample_rate_index, padding = data[2] >> 4, data[2] >> 2 & 3, data[2] >> 1 & 1
    if version == 1 or layer != 1 or bit_rate_index in (0, 15) or sample_rate_index == 3:
        return None
    sample_rate = SAMPLE_RATES[version][sample_rate_index]
    bit_rate = BIT_RATES_KBPS[version][bit_rate_index] * 1000
    return FrameHeader(
        version=version,
        sample_rate=sample_rate,
        bit_rate=bit_rate,
        channels=1 if data[3] >> 6 == 3 else 2,
        length=SAMPLES_PER_FRAME[version] // 8 * bit_rate // sample_rate + padding,
    )


def is_mp3(head: bytes) -> bool:
    """Whether a file that begins so is MP3, with an ID3 tag before it or without."""
    return head.startswith(b"ID3") or parse_frame_header(head[:4]) is not None


def read_mp3(file: BinaryIO, size: int) -> AudioFacts:
    """Read rate, channels and length of an MP3.

    The length comes from the encoder's frame count, or else from the size at the first frame's bit rate,
    which is right for a constant rate; encoders of varying rates write the count.

    Raises:
        BrokenAudioError: No frame follows the tags.
    """
    start = _tag_bytes(file.read(10))
    file.seek(start)
    data = file.read(SEARCH_BYTES)
    offset, header = _first_frame(data, at_end=start + len(data) >= size)
    frames = _frame_count(data, offset, header)
    if frames is not None:
        duration_s = frames * SAMPLES_PER_FRAME[header.version] / header.sample_rate
    else:
        file.seek(max(0, size - 128))
        trailer = 128 if size >= 128 and file.read(3) == b"TAG" else 0
        duration_s = (size - start - offset - trailer) * 8 / header.bit_rate
    return AudioFacts(duration_s=duration_s, sample_rate=header.sample_rate, channels=header.channels)


def _tag_bytes(head: bytes) -> int:
    """Length of the ID3v2 tag at the file's begin, whose size is four times seven bits; 0 without one."""
    if not head.startswith(b"ID3") or len(head) < 10:
        return 0
    size = 0
    for byte in head[6:10]:
        size = size << 7 | byte & 0x7F
    return 10 + size + (10 if head[5] & 0x10 else 0)


def _first_frame(data: bytes, *, at_end: bool) -> tuple[int, FrameHeader]:
    """Find the first frame that a second one follows (or with which the file ends)."""
    offset = data.find(b"\xff")
    while offset >= 0:
        header = parse_frame_header(data[offset : offset + 4])
        if header is not None:
            following = offset + header.length
            next_header = parse_frame_header(data[following : following + 4])
            if next_header is not None and next_header.sample_rate == header.sample_rate:
                return offset, header
            if at_end and following == len(data):
                return offset, header
        offset = data.find(b"\xff", offset + 1)
    raise BrokenAudioError("no MP3 frame follows its tag")


def _frame_count(data: bytes, offset: int, header: FrameHeader) -> int | None:
    xing = offset + 4 + header.side_info_bytes
    if data[xing : xing + 4] in (b"Xing", b"Info") and data[xing + 7 : xing + 8] and data[xing + 7] & 1:
        return int.from_bytes(data[xing + 8 : xing + 12], "big")
    vbri = offset + 4 + 32
    if data[vbri : vbri + 4] == b"VBRI":
        return int.from_bytes(data[vbri + 14 : vbri + 18], "big")
    return None
