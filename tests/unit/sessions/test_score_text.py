"""A score's JSON, packed: whole as gzip, whole as it is, and of one part."""

from __future__ import annotations

import gzip
import json
from pathlib import Path
from typing import Any

import pytest

from reina.music import read_score
from reina.sessions.production import Production
from reina.sessions.score_text import packed_score
from reina.sessions.stage import Stage

SCORES = Path(__file__).parents[3] / "examples" / "scores"
RIGS = Path(__file__).parents[3] / "rigs"


@pytest.fixture(scope="module")
def production() -> Production:
    return Production.plan(
        Stage.load(RIGS), read_score((SCORES / "prince-of-denmarks-march.mid").read_bytes())
    )


def test_packed_and_plain_are_the_same_document(production: Production) -> None:
    text = packed_score(production)
    plain = b"".join(text.plain("A “title”"))
    pieces, size = text.gzipped("A “title”")
    packed = b"".join(pieces)
    assert len(packed) == size
    assert gzip.decompress(packed) == plain
    document: dict[str, Any] = json.loads(plain)
    assert document["title"] == "A “title”"
    assert [note["index"] for note in document["notes"]] == list(range(len(production.score.notes)))


@pytest.mark.parametrize("piece", [50, 1 << 18])
def test_the_notes_of_one_part_are_those_of_the_whole(
    production: Production, monkeypatch: pytest.MonkeyPatch, piece: int
) -> None:
    monkeypatch.setattr("reina.sessions.packed_score.PIECE", piece)
    text = packed_score(production)
    whole = json.loads(b"".join(text.plain("T")))
    parts = range(len(production.score.parts))
    for part in parts:
        wanted = [note["part"] == part for note in whole["notes"]]
        some = json.loads(b"".join(text.plain("T", wanted)))
        assert some["notes"] == [note for note in whole["notes"] if note["part"] == part]
        assert {**some, "notes": []} == {**whole, "notes": []}
    assert json.loads(b"".join(text.plain("T", [False] * len(whole["notes"]))))["notes"] == []


def test_the_validator_changes_with_what_is_answered(production: Production) -> None:
    text, again = packed_score(production), packed_score(production)
    assert text == again
    assert len({text.etag("A", None), text.etag("B", None), text.etag("A", 0), text.etag("A", 1)}) == 4
