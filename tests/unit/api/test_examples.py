"""The bundled pieces and shows, some of which cannot be read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.unit.api.asking import ask

from reina.api.app import create_app
from reina.api.settings import Settings
from reina.system.resources import bundled

if TYPE_CHECKING:
    from pathlib import Path

    import pytest

TAPS = bundled("examples") / "scores" / "taps.mid"


def test_a_file_that_cannot_be_read_hides_no_other(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    scores, shows = tmp_path / "scores", tmp_path / "shows"
    for folder in (scores, shows):
        folder.mkdir()
    (scores / "a.mid").write_bytes(b"no MIDI")
    (scores / "b.mid").write_bytes(TAPS.read_bytes())
    (scores / "c.mid").symlink_to(tmp_path / "nothing")
    for name, text in (
        ("a", "[1"),
        ("b", '{"version": 1, "title": "B"}'),
        ("c", "[]"),
        ("d", '{"title": 3}'),
    ):
        (shows / f"{name}.json").write_text(text)
    app = create_app(Settings(examples_dir=tmp_path))
    for _ in range(2):
        examples = ask(app, "GET", "/api/v1/examples")
        assert [example["name"] for example in examples.json()["examples"]] == ["b"]
        listed = ask(app, "GET", "/api/v1/shows")
        assert [show["title"] for show in listed.json()["shows"]] == ["B"]
    told = [record.getMessage().split(" is left out")[0] for record in caplog.records]
    assert told == [
        "the example a.mid",
        "the example c.mid",
        "the show a.json",
        "the show c.json",
        "the show d.json",
    ], "each once"
