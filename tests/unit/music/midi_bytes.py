"""MIDI files made byte by byte, right ones and wrong ones."""

from collections.abc import Iterable

END = (0, b"\xff\x2f\x00")


def varlen(number: int) -> bytes:
    """A variable-length number."""
    digits = [number & 0x7F]
    while number := number >> 7:
        digits.append(number & 0x7F | 0x80)
    return bytes(reversed(digits))


def on(delta: int, pitch: int, velocity: int = 100, channel: int = 0) -> tuple[int, bytes]:
    return delta, bytes([0x90 | channel, pitch, velocity])


def off(delta: int, pitch: int, channel: int = 0) -> tuple[int, bytes]:
    return delta, bytes([0x80 | channel, pitch, 64])


def program(delta: int, number: int, channel: int = 0) -> tuple[int, bytes]:
    return delta, bytes([0xC0 | channel, number])


def meta(delta: int, kind: int, data: bytes) -> tuple[int, bytes]:
    return delta, bytes([0xFF, kind]) + varlen(len(data)) + data


def name(text: str | bytes) -> tuple[int, bytes]:
    return meta(0, 0x03, text.encode() if isinstance(text, str) else text)


def tempo(delta: int, microseconds: int) -> tuple[int, bytes]:
    return meta(delta, 0x51, microseconds.to_bytes(3, "big"))


def metre(delta: int, numerator: int, power: int) -> tuple[int, bytes]:
    return meta(delta, 0x58, bytes([numerator, power, 24, 8]))


def events(*items: tuple[int, bytes]) -> bytes:
    return b"".join(varlen(delta) + data for delta, data in items)


def chunk(kind: bytes, data: bytes, length: int | None = None) -> bytes:
    return kind + (len(data) if length is None else length).to_bytes(4, "big") + data


def header(form: int = 1, tracks: int = 1, division: int = 480) -> bytes:
    return chunk(b"MThd", b"".join(number.to_bytes(2, "big") for number in (form, tracks, division)))


def midi(*tracks: Iterable[tuple[int, bytes]], form: int = 1, division: int = 480) -> bytes:
    """A file whose tracks end as they should."""
    chunks = [chunk(b"MTrk", events(*track, END)) for track in tracks]
    return header(form, len(tracks), division) + b"".join(chunks)
