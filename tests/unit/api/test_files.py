"""Files as they are answered with."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from fastapi import FastAPI
from tests.unit.api.asking import ask

from reina.api.http.files import ServedFile

if TYPE_CHECKING:
    from pathlib import Path


def tag(path: Path) -> str:
    """The validator that a file is sent with."""

    app = FastAPI()
    app.add_api_route("/", lambda: ServedFile(path))
    return ask(app, "GET", "/").headers["ETag"]


def test_the_same_content_has_the_same_validator_on_every_server(tmp_path: Path) -> None:
    one, other = tmp_path / "one", tmp_path / "other"
    for number, path in enumerate((one, other)):
        path.write_bytes(b"notes")
        os.utime(path, (1000.0 + number, 1000.0 + number))
    assert tag(one) == tag(other)
    # Of the same length: what it holds tells, whenever it was written.
    other.write_bytes(b"tones")
    assert tag(one) != tag(other)
    other.write_bytes(b"notes")
    assert tag(one) == tag(other)
