"""Where MP3 begins in a file (ISO/IEC 11172-3, 2.4.2.3), past tags, zeros and encoders' own first frame."""

from dataclasses import dataclass

from reina.sound.recording.facts import BrokenAudioError
from reina.sound.recording.stream import Data, SoundStream, Splice

SEARCH_BYTES = 1 << 20
"""How far the first frame is looked for."""
FRAMES_IN_A_ROW = 3
"""How many frames must follow one another, so that other bytes are not taken for one."""

SAMPLE_RATES = {3: (44100, 48000, 32000), 2: (22050, 24000, 16000), 0: (11025, 12000, 8000)}
"""By the header's version bits: 3 is MPEG-1, 2 is MPEG-2, 0 is MPEG-2.5."""

BIT_RATES_KBPS = {
    3: (0, 32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320),
    2: (0, 8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160),
    0: (0, 8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160),
}
"""Layer III, by the version bits and the bit rate's index."""

SAMPLES_PER_FRAME = {3: 1152, 2: 576, 0: 576}

COUNTED_BY = (b"Xing", b"Info")
"""What encoders call the frame without sound that they put first."""
DECODER_DELAY = 529
"""Frames by which a decoder is late, beside what the encoder says of itself."""


@dataclass(frozen=True)
class FrameHeader:
    """The four bytes that begin each MP3 frame, read; `length` is the whole frame's, in bytes."""

    version: int
    sample_rate: int
    length: int


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
        version, sample_rate, SAMPLES_PER_FRAME[version] // 8 * bit_rate // sample_rate + padding
    )


def find_first_frame(data: Data, start: int) -> tuple[int, FrameHeader] | None:
    """Find the first frame that two more follow, or with which the file ends; None where there is none."""
    at = data.find(b"\xff", start, start + SEARCH_BYTES)
    while at >= 0:
        header = parse_frame_header(data[at : at + 4])
        if header is not None and _goes_on(data, at, header):
            return at, header
        at = data.find(b"\xff", at + 1, start + SEARCH_BYTES)
    return None


def mp3_streams(data: Data, start: int) -> list[SoundStream]:
    """Return the frames of sound from the first to the end of the file, be it one MP3 or several joined.

    The encoder's own frame is left out, whose count the decoder would stop at.

    Raises:
        BrokenAudioError: There is no frame.
    """
    found = find_first_frame(data, start)
    if found is None:
        raise BrokenAudioError("no MP3 frame follows its tag")
    at, header = found
    claimed, leading, trailing = None, 0, 0
    frame = data[at : at + header.length]
    marks = [mark for mark in (frame.find(name, 4, 44) for name in COUNTED_BY) if mark > 0]
    if marks:
        at += header.length
        claimed, leading, trailing = _encoder_says(frame[marks[0] :], SAMPLES_PER_FRAME[header.version])
    elif frame[36:40] == b"VBRI":
        at += header.length
        claimed = int.from_bytes(frame[50:54], "big") * SAMPLES_PER_FRAME[header.version]
    splice = Splice(data, range(at, len(data)))
    return [SoundStream(splice, claimed, piped=True, leading=leading, trailing=trailing)]


def _encoder_says(tag: bytes, samples_per_frame: int) -> tuple[int | None, int, int]:
    """Samples that a Xing or Info tag claims, and how many LAME says were put before and behind."""
    if len(tag) < 12 or not tag[7] & 1:
        return None, 0, 0
    claimed = int.from_bytes(tag[8:12], "big") * samples_per_frame
    # The extension follows a count of bytes, a table and a quality; 21 bytes into it stand two times 12 bits.
    at = 12 + 4 * bool(tag[7] & 2) + 100 * bool(tag[7] & 4) + 4 * bool(tag[7] & 8) + 21
    delays = int.from_bytes(tag[at : at + 3], "big")
    before, behind = delays >> 12, delays & 0xFFF
    if not before:
        return claimed, 0, 0
    return max(0, claimed - before - behind), before + DECODER_DELAY, max(0, behind - DECODER_DELAY)


def _goes_on(data: Data, at: int, first: FrameHeader) -> bool:
    header = first
    for _ in range(FRAMES_IN_A_ROW - 1):
        at += header.length
        if at >= len(data):
            return at == len(data)
        following = parse_frame_header(data[at : at + 4])
        if following is None or following.sample_rate != first.sample_rate:
            return False
        header = following
    return True
