"""What a file is: by its content, whatever it is called."""

from __future__ import annotations

import gzip
import json
from pathlib import Path

import pytest
from tests.integration.scores import scale, show, song

from reina.sessions.file_role import LOOKED_AT_BYTES, role_of

EXAMPLES = Path(__file__).parents[3] / "examples"
TONE = {"header": {"ppq": 480}, "tracks": [{"name": "A", "notes": [{"midi": 60, "time": 0}]}]}
LATE_NOTES: dict[str, object] = {"tracks": [{"controlChanges": {"7": [{"value": 1}] * 5000}, "notes": []}]}
LONG_SHOW = {"tracks": [{"keyframes": [{"key": f"k{n}", "time": n, "value": 1} for n in range(5000)]}]}


def as_json(document: object, encoding: str = "utf-8") -> bytes:
    return json.dumps(document).encode(encoding)


@pytest.mark.parametrize(
    ("data", "role"),
    [
        (scale(), "score"),
        (b"RIFF\0\0\0\0RMIDdata", "score"),
        (b"\0" * 128 + scale(), "score"),
        (gzip.compress(scale()), "score"),
        (b"PK\3\4", "score"),
        (song(), "song"),
        (b"ID3\4", "song"),
        (b"OggS", "song"),
        (b"FORM\0\0\0\0AIFF", "song"),
        (show(), "show"),
        (as_json(TONE), "score"),
        (as_json(TONE, "utf-16"), "score"),
        (as_json(LATE_NOTES), "score"),
        (as_json(LONG_SHOW), "show"),
        (b'{"version": 1, "tracks": {}}', "show"),
        (b'{"tracks": [null, {"notes": []}]}', "score"),
        (as_json({"parts": [], "notes": [], "tracks": []}), "score"),
        (as_json({"title": '"tracks": [{"parameter":', "parts": []}), "score"),
        (b"{", "score"),
        (b'{"hello": 1}', "score"),
        (b"%PDF-1.7", None),
        (b"\x89PNG", None),
        (b"<score-partwise>", "score"),
        ('\ufeff<?xml version="1.0"?><score-timewise>'.encode(), "score"),
        ('<?xml version="1.0"?><score-partwise>'.encode("utf-16"), "score"),
        (b'<?xml version="1.0"?><museScore version="4.0">', None),
        (b"Hello, world", None),
        (b"", None),
    ],
)
def test_content_says_what_a_file_is(data: bytes, role: str | None) -> None:
    for name in (None, "x", "x.mid", "x.mp3", "x.json"):
        told = role_of(data, name)
        if data != b"Hello, world":
            assert told.role == role
        assert (told.advice == "") == (told.role is not None)
    assert role_of(data).role == role


def test_a_name_counts_where_content_says_nothing() -> None:
    assert role_of(b"Hello, world", "tune.MID").role == "score"
    assert role_of(b"\0\0\0\0", "take.mp3").role == "song"
    assert role_of(b"<?xml", "tune.musicxml").role == "score"
    assert role_of(b"Hello, world", "notes.txt").role is None


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("s*/*.*")), ids=lambda path: path.name)
def test_examples(path: Path) -> None:
    wanted = {"scores": "score", "songs": "song", "shows": "show"}[path.parent.name]
    data = path.read_bytes()
    assert role_of(data).role == wanted
    assert role_of(data[:LOOKED_AT_BYTES]).role == wanted


@pytest.mark.parametrize(
    "beginning", [b"[" * LOOKED_AT_BYTES, b'{"a":' * 20_000, b'"' * LOOKED_AT_BYTES, b"{\\" * 9]
)
def test_odd_json_ends(beginning: bytes) -> None:
    assert role_of(beginning).role in {"score", None}
