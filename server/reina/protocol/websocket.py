"""Messages as they stand on the wire of a WebSocket: whole, and without a mask, as a server sends them.

RFC 6455, 5.2. Such a frame is the same for whoever receives it, so it is made once for all viewers.
"""

from __future__ import annotations

import struct

BINARY, TEXT = 0x82, 0x81
"""The first byte: the last frame of its message, and what it holds."""
SHORT = 126
"""From this length on the length itself takes two bytes more."""
LONG = 1 << 16
"""From this one on eight."""


def binary_frame(data: bytes) -> bytes:
    """A binary message as it is sent."""
    return _head(BINARY, len(data)) + data


def text_frame(text: str) -> bytes:
    """A text message as it is sent."""
    data = text.encode()
    return _head(TEXT, len(data)) + data


def message_of(frame: bytes) -> bytes | str:
    """What a frame of `binary_frame` or `text_frame` was made of."""
    kind, length = frame[0], frame[1]
    data = frame[2 if length < SHORT else 4 if length == SHORT else 10 :]
    return data.decode() if kind == TEXT else data


def _head(kind: int, length: int) -> bytes:
    if length < SHORT:
        return bytes((kind, length))
    if length < LONG:
        return struct.pack("!BBH", kind, SHORT, length)
    return struct.pack("!BBQ", kind, SHORT + 1, length)
