"""Any score that people have, from its bytes."""

import re
from dataclasses import replace
from pathlib import PurePath

from reina.music.errors import NotInScoreError, ScoreError, ScoreLimitError
from reina.music.file_kinds import kind_of
from reina.music.limits import DEFAULT_LIMITS, Limits
from reina.music.musicxml.detect import is_musicxml
from reina.music.packed import unpack
from reina.music.score import Score
from reina.music.warnings import ScoreWarning

ENDING = re.compile(r"\.(?=[0-9]*[A-Za-z])(?:[A-Za-z0-9]{1,5}|musicxml)$", re.IGNORECASE)
"""What tells a file's kind in its name: ``.mid``, but not the ``. 5`` of a symphony."""
JSON_BEGINNINGS = (b"{", b"[", b"\0{", b"\0\0\0{", b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff", b"\0\0\xfe\xff")
"""Of an object or a list in UTF-8, UTF-16 or UTF-32, with a byte order mark or without."""


def read_score(
    data: bytes,
    *,
    filename: str | None = None,
    sequence: int | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Score:
    """Read a MIDI file, MusicXML or a JSON score, compressed too; what it is is told by its bytes alone.

    What was repaired is in the score's `warnings`; docs/music.md lists every case.

    Args:
        data: The file.
        filename: Its name; gives the title where the file has none.
        sequence: Which sequence of a MIDI file of format 2 to read, counted from 0; the first by default.
        limits: How large a score may be.

    Raises:
        ScoreError: If there is no score in it, with the reason and the place.
        NotInScoreError: If it holds no such sequence.
        ScoreLimitError: If it is beyond `limits`.
    """
    limits.check("size_bytes", len(data), what="size in bytes")
    unpacked = unpack(data, filename=filename, limits=limits)
    if unpacked is None:
        return _read(data, filename, sequence, limits)
    score = _read(unpacked.data, unpacked.name or filename, sequence, limits)
    if not unpacked.told:
        return score
    opened = ScoreWarning("unpacked", "whole file", unpacked.told)
    return replace(score, warnings=(opened, *score.warnings))


def _read(data: bytes, filename: str | None, sequence: int | None, limits: Limits) -> Score:
    if not data:
        raise ScoreError("the file is empty", location="byte 0")
    title = _title(filename) if filename else "Untitled"
    if is_musicxml(data):
        _check_sequence(sequence, "a MusicXML document")
        # Each kind's reader is imported when the first of its kind comes: nobody sends all of them.
        from reina.music.musicxml.reader import read_musicxml

        return read_musicxml(data, title=title, limits=limits)
    is_json = data[:64].lstrip(b" \t\r\n").startswith(JSON_BEGINNINGS)
    if is_json:
        _check_sequence(sequence, "a JSON score")
    try:
        if is_json:
            from reina.music.document.reader import read_json

            return read_json(data, title=title, limits=limits)
        from reina.music.midi import read_midi

        return read_midi(data, title=title, sequence=sequence, limits=limits)
    except (NotInScoreError, ScoreLimitError):
        raise
    except ScoreError as error:
        kind = kind_of(data)
        if kind is None:
            raise
        raise ScoreError(str(kind), location="byte 0") from error


def _check_sequence(sequence: int | None, what: str) -> None:
    if sequence not in {None, 0}:
        raise NotInScoreError(
            f"{what} holds one sequence, 0; there is no sequence {sequence}", location="sequence"
        )


def _title(filename: str) -> str:
    title = ENDING.sub("", PurePath(filename).name).strip()
    return title if title.strip(". ") else "Untitled"
