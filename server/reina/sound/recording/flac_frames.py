"""Finds FLAC's frames (RFC 9639, 9.1): where decoding can go on behind damage, at which the decoder stops."""

from reina.sound.recording.stream import Data

SYNC = b"\xff"
FIXED, VARIABLE = 0xF8, 0xF9
"""The second byte: blocks of one size, whose frames are numbered, or of several, whose samples are."""
SIZE_BYTES = {6: 1, 7: 2}
"""By the code of the block's size: how many bytes of it stand behind the number."""
RATE_BYTES = {12: 1, 13: 2, 14: 2}
"""By the code of the sample rate, likewise."""
LONGEST_HEADER = 16


def _checksums() -> bytes:
    """CRC-8 of each byte, polynomial x⁸ + x² + x + 1."""
    table = bytearray()
    for byte in range(256):
        for _ in range(8):
            byte = (byte << 1 ^ (0x107 if byte & 0x80 else 0)) & 0x1FF
        table.append(byte & 0xFF)
    return bytes(table)


_CRC = _checksums()


def next_frame(data: Data, place: range, block_frames: int, after: int) -> tuple[int, int] | None:
    """Find the first frame whose sound begins later than at a sample.

    Args:
        data: The file.
        place: Where to look in it.
        block_frames: Samples of each channel in a frame, where all have as many.
        after: The sample, counted from the beginning of the FLAC.

    Returns:
        Where it stands in the file, and the sample that it begins with; None where there is none.
    """
    at = data.find(SYNC, place.start, place.stop)
    while at >= 0:
        number = _number(data[at : at + LONGEST_HEADER])
        if number is not None:
            first = number * block_frames if data[at + 1] == FIXED else number
            if first > after:
                return at, first
        at = data.find(SYNC, at + 1, place.stop)
    return None


def _number(header: bytes) -> int | None:
    """The number in a frame's header, or None where bytes are none or their checksum is wrong."""
    if len(header) < 6 or header[1] not in (FIXED, VARIABLE) or header[3] & 1:
        return None
    # As UTF-8 writes numbers: as many ones as there are bytes, unless it is one byte.
    ones = 8 - (header[4] ^ 0xFF).bit_length()
    if ones == 1 or ones == 8:
        return None
    length = max(1, ones)
    end = 4 + length + SIZE_BYTES.get(header[2] >> 4, 0) + RATE_BYTES.get(header[2] & 15, 0)
    if end >= len(header):
        return None
    checksum = 0
    for byte in header[:end]:
        checksum = _CRC[checksum ^ byte]
    if checksum != header[end]:
        return None
    number = header[4] & (0x7F >> ones)
    for byte in header[5 : 4 + length]:
        number = number << 6 | byte & 0x3F
    return number
