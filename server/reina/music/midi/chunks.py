"""The outside of a Standard MIDI File: RIFF wrapping, header, the bytes of each track.

Source: MIDI Manufacturers Association, Standard MIDI Files 1.0 (RP-001); RIFF MIDI (RP-029).
"""

from dataclasses import dataclass

from reina.music.errors import ScoreError
from reina.music.warnings import WarningLog

SEARCHED_FOR_HEADER = 64 * 1024
"""How many leading bytes may stand before the header (MacBinary, mail headers) and are skipped."""


@dataclass(frozen=True)
class Header:
    """The header chunk.

    Attributes:
        format: 0, 1 or 2; others are read as 1.
        tracks: How many tracks it claims.
        division: The 16 bits of the time division.
        end: Position of the byte after it.
    """

    format: int
    tracks: int
    division: int
    end: int


def unwrap(data: bytes, log: WarningLog) -> tuple[bytes, int]:
    """Return the MIDI file inside `data` and at which byte it begins: out of RIFF, past leading bytes.

    Raises:
        ScoreError: If there is no MIDI file inside.
    """
    start = 0
    if data[:4] == b"RIFF":
        start, data = _riff_data(data)
        if data[8:12] != b"RMID" or start == 0:
            log.add("bad_riff", "byte 0", "a RIFF file that is not as RIFF MIDI is; its MIDI data was read")
    found = data.find(b"MThd", start, start + SEARCHED_FOR_HEADER)
    if found < 0:
        raise ScoreError(
            "this is no MIDI file (it has no MThd header) and no JSON score; a file as written by a notation "
            "program or sequencer (.mid), or a JSON score, would be right",
            location="byte 0",
        )
    if found > start and data[:4] != b"RIFF":
        log.add(
            "leading_bytes", f"byte {start}", f"{found - start} bytes before the MIDI header were skipped"
        )
    return data[found:], found


def _riff_data(data: bytes) -> tuple[int, bytes]:
    """Return where a RIFF file's data chunk begins, 0 if it has none, and the file up to its end."""
    at = 12
    while at + 8 <= len(data):
        length = int.from_bytes(data[at + 4 : at + 8], "little")
        if data[at : at + 4] == b"data":
            return at + 8, data[: at + 8 + length]
        at += 8 + length + (length & 1)
    return 0, data


def read_header(data: bytes, log: WarningLog) -> Header:
    """Read the header at the beginning of `data`.

    Raises:
        ScoreError: If the file ends inside it.
    """
    if len(data) < 14:
        raise ScoreError(f"the file ends inside its header, after {len(data)} bytes of 14", location="byte 0")
    length = int.from_bytes(data[4:8], "big")
    header_format, tracks, division = (int.from_bytes(data[at : at + 2], "big") for at in (8, 10, 12))
    end = 8 + length
    if length < 6 or end > len(data):
        log.add("header_length", "byte 4", f"the header claims {length} bytes; it has 6")
        end = 14
    if header_format > 2:
        log.add("unknown_format", "byte 8", f"format {header_format} is unknown; read as format 1")
        header_format = 1
    return Header(header_format, tracks, division, end)


def next_track(data: bytes, at: int) -> int:
    """Return where the next track chunk begins at or after `at`, or the end of `data`."""
    found = data.find(b"MTrk", at)
    return len(data) if found < 0 else found


def is_chunk(data: bytes, at: int) -> bool:
    """Return whether `at` is the end of the file or looks like the beginning of a chunk that fits."""
    name = data[at : at + 4]
    if not name or name == b"MTrk":
        return True
    fits = at + 8 + int.from_bytes(data[at + 4 : at + 8], "big") <= len(data)
    return len(name) == 4 and fits and all(0x20 <= byte < 0x7F for byte in name)
