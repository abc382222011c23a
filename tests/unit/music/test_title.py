"""A score without a title is called after its file."""

from __future__ import annotations

import pytest

from reina.music import read_score

SCORE = b'{"tracks": [{"notes": [{"midi": 60, "time": 0, "duration": 1}]}]}'


@pytest.mark.parametrize(
    ("filename", "title"),
    [
        ("song.mid", "song"),
        ("song.MID", "song"),
        ("song", "song"),
        ("a.b.mid", "a.b"),
        ("Wait for it....mid", "Wait for it..."),
        ("Symphony No. 5", "Symphony No. 5"),
        ("Op.9", "Op.9"),
        ('My "song".mid', 'My "song"'),
        (".mid", "Untitled"),
        ("..mid", "Untitled"),
        ("...", "Untitled"),
        (" .mid", "Untitled"),
        ("", "Untitled"),
        (None, "Untitled"),
    ],
)
def test_a_file_name_without_its_ending(filename: str | None, title: str) -> None:
    assert read_score(SCORE, filename=filename).title == title
