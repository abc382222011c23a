"""What keeps the server from being ready, each by its name."""

from __future__ import annotations

import asyncio
import shutil
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple
from unittest.mock import Mock

import pytest

from reina.api.http.ending import Ending
from reina.api.readiness import LEAST_ROOM_BYTES, Readiness
from reina.api.settings import Settings
from reina.errors import InputError
from reina.system.loop_delay import LONG_DELAY_S, TOO_LONG_S, LoopDelay

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path


class Usage(NamedTuple):
    """As `shutil.disk_usage` tells it."""

    total: int
    used: int
    free: int


@dataclass
class Workers:
    """A pool whose processes start or do not."""

    fails: bool = False
    starts: bool = True
    asked: int = 0

    async def run(self, function: Callable[[], None]) -> None:
        self.asked += 1
        if not self.starts:
            raise InputError("it has ended")
        self.fails = False
        function()


@dataclass
class Server:
    """What readiness looks at, all well at first."""

    settings: Settings
    now: float = 0.0
    workers: Workers = field(default_factory=Workers)
    database: Any = None

    def __post_init__(self) -> None:
        self.delay = LoopDelay(lambda: self.now)

    def reasons(self, *, ending: bool = False) -> list[str]:
        async def look() -> list[str]:
            end = Ending()
            end.announced = ending
            readiness = Readiness(
                self.settings,
                delay=self.delay,
                ending=end,
                workers=self.workers,  # type: ignore[arg-type]
                database=self.database,
            )
            await readiness.look()
            return [one.reason for one in readiness.missing()]

        return asyncio.run(look())


@pytest.fixture
def server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Server:
    font = tmp_path / "font.sf2"
    font.write_bytes(b"RIFF\0\0\0\0sfbk")
    monkeypatch.setenv("REINA_SOUNDFONT", str(font))
    for name in ("data", "page"):
        (tmp_path / name).mkdir()
    (tmp_path / "page" / "index.html").write_text("<!doctype html>")
    return Server(Settings(data_dir=tmp_path / "data", page_dir=tmp_path / "page"))


def test_all_is_well(server: Server) -> None:
    assert server.reasons() == []
    assert server.workers.asked == 0, "no process is started for being looked at"


def test_a_data_directory_that_is_gone(server: Server) -> None:
    server.settings.data_dir.rmdir()
    assert server.reasons() == ["data-directory"]


def test_a_full_disk(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    usage = Usage(10**9, 10**9, LEAST_ROOM_BYTES - 1)
    monkeypatch.setattr(shutil, "disk_usage", Mock(return_value=usage))
    assert server.reasons() == ["data-full"]


def test_a_soundfont_that_is_missing(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_SOUNDFONT", "/nowhere/font.sf2")
    assert server.reasons() == ["soundfont"]


def test_a_page_that_is_missing_where_there_is_to_be_one(server: Server) -> None:
    (server.settings.page_dir / "index.html").unlink()
    assert server.reasons() == ["page"]
    server.settings = Settings(
        data_dir=server.settings.data_dir, page_dir=server.settings.page_dir, page=False
    )
    assert server.reasons() == []


@pytest.mark.parametrize("is_async", [False, True])
def test_a_database_that_is_away(server: Server, is_async: bool) -> None:
    away = True

    def check() -> None:
        if away:
            raise ConnectionError("postgresql://reina:secret@db")

    async def check_later() -> None:
        check()

    server.database = check_later if is_async else check
    assert server.reasons() == ["database"]
    away = False
    assert server.reasons() == []


def test_workers_that_do_not_start_and_that_start_again(server: Server) -> None:
    server.workers = Workers(fails=True, starts=False)
    assert server.reasons() == ["workers"]
    server.workers.starts = True
    assert server.reasons() == []


def test_a_loop_that_is_late_for_long(server: Server) -> None:
    server.delay.note(2 * LONG_DELAY_S)
    assert server.reasons() == []
    server.now = TOO_LONG_S
    assert server.reasons() == ["event-loop"]


def test_the_end(server: Server) -> None:
    assert server.reasons(ending=True) == ["ending"]
