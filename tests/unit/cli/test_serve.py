"""What keeps `reina serve` from starting is told in one line, with status 1."""

from __future__ import annotations

from pathlib import Path

import pytest

from reina.cli import main
from reina.cli.listening import listen

PAGE_FILE = "index.html"


@pytest.fixture
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A page that is built."""
    folder = tmp_path / "page"
    folder.mkdir()
    (folder / PAGE_FILE).write_text("<!doctype html>")
    monkeypatch.setenv("REINA_PAGE", str(folder))
    monkeypatch.setenv("REINA_DATA_DIR", str(tmp_path / "data"))
    return folder


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """The one line that is said."""
    assert main(["serve", *arguments]) == 1
    told = capsys.readouterr()
    assert told.out == ""
    [line] = told.err.splitlines()
    assert line.startswith("reina serve: ")
    return line


def test_a_port_in_use(page: Path, capsys: pytest.CaptureFixture[str]) -> None:
    [taken] = listen("127.0.0.1", 0)
    port = str(taken.getsockname()[1])
    assert f"port {port} is in use" in refusal(capsys, "--port", port)
    taken.close()


def test_a_data_directory_that_cannot_be_written(
    page: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "file"
    file.write_text("")
    for folder, why in (
        (file, "File exists"),
        (file / "below", "Not a directory"),
        (Path("/proc/reina"), ""),
    ):
        line = refusal(capsys, "--port", "0", "--data-dir", str(folder))
        assert f"the data directory {folder}: {why}" in line
        assert "--data-dir" in line


def test_a_page_that_is_not_built(page: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (page / PAGE_FILE).unlink()
    line = refusal(capsys, "--port", "0")
    assert str(page) in line
    assert "`make setup`" in line


def test_rigs_that_are_not_there(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("REINA_RIGS", str(tmp_path / "none"))
    assert str(tmp_path / "none") in refusal(capsys, "--port", "0")


def test_a_song_cache_that_is_no_number(
    page: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("REINA_SONG_CACHE_MB", "2 GB")
    assert "REINA_SONG_CACHE_MB" in refusal(capsys)


@pytest.mark.parametrize(
    ("variable", "value"),
    [
        ("REINA_LAB", "maybe"),
        ("REINA_TRUSTED_PROXY", "10.0.0.1 proxy"),
        ("REINA_RATES", "uploads"),
        ("REINA_MOST_CONNECTIONS", "0"),
        ("REINA_HEADER_S", "soon"),
    ],
)
def test_settings_that_cannot_be(
    variable: str,
    value: str,
    page: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv(variable, value)
    line = refusal(capsys, "--port", "0")
    assert value.split()[-1] in line


def test_a_port_that_is_no_number(
    page: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("REINA_PORT", "http")
    with pytest.raises(SystemExit) as ended:
        main(["serve"])
    assert ended.value.code == 2
    assert "argument --port: invalid int value: 'http'" in capsys.readouterr().err
