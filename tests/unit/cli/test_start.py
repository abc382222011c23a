"""What a server that starts does not load: each would cost every start, and every process beside it."""

from __future__ import annotations

import subprocess
import sys

import pytest

NOT_AT_START = {
    "reina.cli.serve": (
        # The schema is the present one, as at every start but the first.
        "alembic",
        # The first file of its kind brings its reader.
        "mido",
        "reina.music.document.reader",
        "reina.music.midi.reader",
        "reina.music.musicxml.reader",
        # What the server has its own processes for.
        "midirenderer",
        "onnxruntime",
        "reina.sound.alignment.aligner",
        "reina.sound.render",
        # What other commands and other stores need.
        "distributed",
        "obstore",
        "playwright",
        "psycopg",
        "scipy",
    ),
    "reina.sound.recording.worker": ("asyncio", "fastapi", "logging", "pydantic", "sqlalchemy", "structlog"),
    "reina.sound.render": ("asyncio", "fastapi", "logging", "pydantic", "sqlalchemy", "structlog"),
    "reina.sound.alignment.worker": ("asyncio", "fastapi", "pydantic", "sqlalchemy", "structlog"),
    "reina.sound.transcription.worker": ("asyncio", "fastapi", "pydantic", "sqlalchemy", "structlog"),
    "reina.sessions.workers.worker": ("asyncio", "fastapi", "numpy", "pydantic", "sqlalchemy", "structlog"),
}


@pytest.mark.parametrize("program", NOT_AT_START)
def test_a_program_starts_without_what_it_does_not_need(program: str) -> None:
    script = f"import sys, {program}; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    modules = set(loaded.stdout.split())
    assert program in modules
    assert modules.isdisjoint(NOT_AT_START[program])
