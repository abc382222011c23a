"""A score as the HTTP interface writes it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.sessions.description import score_head, wire_note
from reina.sessions.packed_score import PackedScore
from reina.system.json_text import json_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from reina.sessions.production import Production

AT_ONCE = 500
"""Notes that are packed at a time, and let other threads have their turns between."""


def packed_score(production: Production) -> PackedScore:
    """The score of a production, written note by note."""
    return PackedScore.of(_written(production))


def _written(production: Production) -> Iterator[bytes]:
    """The document without its title and its last brace: a line for the head, for each note, for the end."""
    yield json_text(score_head(production)).removesuffix(b"}") + b',"notes":[\n'
    table, count = production.note_table, len(production.score.notes)
    for begin in range(0, count, AT_ONCE):
        notes = (
            wire_note(table.note(n)).model_dump_json() for n in range(begin, min(begin + AT_ONCE, count))
        )
        yield "".join(f",{note}\n" if n or begin else f"{note}\n" for n, note in enumerate(notes)).encode()
    yield b"]"
