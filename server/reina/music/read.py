"""Any score that people have, from its bytes."""

import re
from pathlib import PurePath

from reina.music.document.reader import read_json
from reina.music.errors import NotInScoreError, ScoreError
from reina.music.limits import DEFAULT_LIMITS, Limits
from reina.music.midi import read_midi
from reina.music.score import Score

ENDING = re.compile(r"\.(?=[0-9]*[A-Za-z])[A-Za-z0-9]{1,5}$")
"""What tells a file's kind in its name: ``.mid``, but not the ``. 5`` of a symphony."""
JSON_BEGINNINGS = (b"{", b"[", b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff")


def read_score(
    data: bytes,
    *,
    filename: str | None = None,
    sequence: int | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Score:
    """Read a MIDI file or a JSON score; what it is is told by its bytes, not by its name.

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
    if not data:
        raise ScoreError("the file is empty", where="byte 0")
    limits.check("size_bytes", len(data), what="size in bytes")
    title = _title(filename) if filename else "Untitled"
    if data[:64].lstrip(b" \t\r\n").startswith(JSON_BEGINNINGS):
        if sequence not in {None, 0}:
            raise NotInScoreError(
                f"a JSON score holds one sequence, 0; there is no sequence {sequence}", where="sequence"
            )
        return read_json(data, title=title, limits=limits)
    return read_midi(data, title=title, sequence=sequence, limits=limits)


def _title(filename: str) -> str:
    title = ENDING.sub("", PurePath(filename).name).strip()
    return title if title.strip(". ") else "Untitled"
