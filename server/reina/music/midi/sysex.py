"""System exclusive messages that say which channel is drums.

Sources: General MIDI 2 (RP-024); Roland's GS (SC-55mkII owner's manual, "Use for rhythm part" at 40 1x 15);
Yamaha's XG specification 2.00 ("Part mode" at 08 nn 07, "XG System On").
"""

from typing import Literal, NamedTuple

Standard = Literal["GM", "GM2", "GS", "XG"]

LONGEST_SYSEX = 16
"""Bytes that are looked at; the messages that are known are shorter."""

UNIVERSAL, ROLAND, YAMAHA = 0x7E, 0x41, 0x43
GS_MODEL, XG_MODEL = 0x42, 0x4C
GS_DATA_SET = 0x12
GS_RESETS = (b"\x40\x00\x7f\x00", b"\x00\x00\x7f\x00", b"\x00\x00\x7f\x01")
GM_SYSTEM: dict[bytes, Standard] = {b"\x09\x01": "GM", b"\x09\x03": "GM2"}


class PartMode(NamedTuple):
    """Whether a channel (0 to 15) is drums."""

    channel: int
    is_drums: bool


def read_standard(data: bytes) -> Standard | None:
    """Return the standard that a message switches a synthesizer to.

    Args:
        data: The message after its status F0, at least its first `LONGEST_SYSEX` bytes.
    """
    if data[:1] == bytes([UNIVERSAL]):
        return GM_SYSTEM.get(data[2:4])
    if _is_gs(data) and data[4:8] in GS_RESETS:
        return "GS"
    return "XG" if _is_xg(data) and data[3:7] == b"\x00\x00\x7e\x00" else None


def read_part_mode(data: bytes) -> PartMode | None:
    """Return what a message says of the channel of a part, where parts have the channels of their numbers.

    Args:
        data: The message after its status F0, at least its first `LONGEST_SYSEX` bytes.
    """
    if _is_gs(data) and len(data) > 7 and data[4] == 0x40 and data[5] >> 4 == 1 and data[6] == 0x15:
        # GS numbers its blocks 1 to 9, 0 for part 10, then 10 to 15.
        block = data[5] & 0xF
        channel = 9 if block == 0 else block - 1 if block < 10 else block
        return PartMode(channel, data[7] > 0)
    if _is_xg(data) and len(data) > 6 and data[3] == 0x08 and data[4] < 16 and data[5] == 0x07:
        return PartMode(data[4], data[6] > 0)
    return None


def rhythm_part(channel: int, *, on: bool) -> bytes:
    """The GS message that makes a channel (0 to 15) drums or not, between its status F0 and F7."""
    block = 0 if channel == 9 else channel + 1 if channel < 9 else channel
    body = bytes([0x40, 0x10 | block, 0x15, int(on)])
    return bytes([ROLAND, 0x10, GS_MODEL, GS_DATA_SET]) + body + bytes([-sum(body) & 0x7F])


def _is_gs(data: bytes) -> bool:
    return data[:1] == bytes([ROLAND]) and data[2:4] == bytes([GS_MODEL, GS_DATA_SET])


def _is_xg(data: bytes) -> bool:
    return data[:1] == bytes([YAMAHA]) and data[1:2] >= b"\x10" and data[2:3] == bytes([XG_MODEL])
