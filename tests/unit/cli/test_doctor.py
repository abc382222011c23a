"""What `reina doctor` finds, each kind of fault by its name, and what it changes: nothing."""

from __future__ import annotations

import contextlib
import http.server
import importlib.metadata
import json
import os
import shutil
import sqlite3
import stat
import sys
import threading
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from unittest.mock import Mock

import pytest
from tests.servers.redis import redis_server

from reina.api.settings import Settings
from reina.cli import main
from reina.cli.doctor import data, database, machine, network, parts, redis_bus, scheduler
from reina.cli.listening import listen
from reina.sessions.storage.archive import DATABASE
from reina.system.cluster import ClusterError

if TYPE_CHECKING:
    from collections.abc import Generator, Iterable

    from reina.cli.doctor.finding import Finding


class Usage(NamedTuple):
    """As `shutil.disk_usage` tells it."""

    total: int
    used: int
    free: int


RIGS = Path(__file__).parents[3] / "rigs"


def by_name(found: Iterable[Finding]) -> dict[str, Finding]:
    return {finding.what: finding for finding in found}


@pytest.fixture
def settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Settings:
    """All that is needed is there."""
    font = tmp_path / "font.sf2"
    font.write_bytes(b"RIFF\0\0\0\0sfbk")
    page = tmp_path / "page"
    page.mkdir()
    (page / "index.html").write_text("<!doctype html>")
    folder = tmp_path / "data"
    folder.mkdir(0o700)
    browser = tmp_path / "chromium"
    browser.write_text("#!/bin/sh\n")
    browser.chmod(0o700)
    for name, value in (
        ("REINA_SOUNDFONT", font),
        ("REINA_PAGE", page),
        ("REINA_DATA_DIR", folder),
        ("REINA_RIGS", RIGS),
        ("REINA_BROWSER", browser),
    ):
        monkeypatch.setenv(name, str(value))
    monkeypatch.delenv("REINA_DATABASE", raising=False)
    return Settings()


@contextlib.contextmanager
def answering(body: bytes) -> Generator[int]:
    """Something that speaks HTTP."""

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format: str, *args: Any) -> None:  # noqa: A002
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        threading.Thread(target=server.serve_forever).start()
        yield server.server_port
        server.shutdown()


def told(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, dict[str, Any]]:
    status = main(["doctor", "--json", *arguments])
    return status, {finding["what"]: finding for finding in json.loads(capsys.readouterr().out)}


def test_all_is_well(settings: Settings, capsys: pytest.CaptureFixture[str]) -> None:
    status, found = told(capsys, "--port", "0")
    assert status == 0
    assert {finding["status"] for what, finding in found.items() if what not in {"room", "processors"}} == {
        "ok"
    }
    assert all(not finding["to_do"] for finding in found.values() if finding["status"] == "ok")
    assert list(settings.data_dir.iterdir()) == [], "nothing is left behind"


def test_the_table_says_what_to_do(settings: Settings, capsys: pytest.CaptureFixture[str]) -> None:
    (settings.page_dir / "index.html").unlink()
    assert main(["doctor", "--port", "0"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert any(line.split()[:2] == ["fail", "page"] for line in lines)
    assert any(line.startswith("page: `make setup` builds it") for line in lines)


def test_a_port_that_another_has(settings: Settings, capsys: pytest.CaptureFixture[str]) -> None:
    with answering(b"hello") as port:
        status, found = told(capsys, "--port", str(port))
    assert status == 1
    assert found["port"]["status"] == "fail"
    assert f"port {port} is in use" in found["port"]["detail"]
    [silent] = listen("127.0.0.1", 0)
    assert network.running_version("127.0.0.1", silent.getsockname()[1]) is None
    silent.close()


def test_a_port_that_reina_has(settings: Settings, capsys: pytest.CaptureFixture[str]) -> None:
    with answering(json.dumps({"version": "9.8.7", "streams": ["reina.v1"]}).encode()) as port:
        status, found = told(capsys, "--port", str(port))
    assert status == 0
    assert "Reina 9.8.7 answers" in found["port"]["detail"]


def test_addresses_that_others_reach_and_that_are_none() -> None:
    open_to_all = by_name(network.network_checks("0.0.0.0", 0))
    assert open_to_all["addresses"].status == "warn"
    assert "proxy" in open_to_all["addresses"].to_do
    assert by_name(network.network_checks("192.0.2.1", 0))["port"].status == "fail"
    assert by_name(network.network_checks("127.0.0.1", 70000))["port"].status == "fail"


def test_a_data_directory_that_cannot_be_written(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("")
    for folder in (file, file / "below", Path("/proc/reina")):
        [finding] = data.data_checks(folder)
        assert (finding.what, finding.status) == ("data directory", "fail")
        assert "--data-dir" in finding.to_do


def test_a_data_directory_that_is_not_made_yet(tmp_path: Path) -> None:
    found = by_name(data.data_checks(tmp_path / "a" / "b"))
    assert found["data directory"].detail.endswith("will be made")
    assert list(tmp_path.iterdir()) == []


def test_a_data_directory_that_others_may_read(settings: Settings) -> None:
    settings.data_dir.chmod(0o755)
    owner = by_name(data.data_checks(settings.data_dir))["owner"]
    assert owner.status == "warn"
    assert stat.S_IMODE(settings.data_dir.stat().st_mode) == 0o755


@pytest.mark.parametrize(("free", "status"), [(10**6, "fail"), (10**9, "warn"), (10**11, "ok")])
def test_room(settings: Settings, monkeypatch: pytest.MonkeyPatch, free: int, status: str) -> None:
    usage = Usage(free, 0, free)
    monkeypatch.setattr(shutil, "disk_usage", Mock(return_value=usage))
    assert by_name(data.data_checks(settings.data_dir))["room"].status == status


@pytest.mark.skipif(os.name != "posix", reason="no such locks elsewhere")
def test_a_directory_that_a_server_works_in(settings: Settings) -> None:
    import fcntl

    lock = settings.data_dir / "lock"
    with lock.open("w+") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        file.write("4711\n")
        file.flush()
        assert "the process 4711" in by_name(data.data_checks(settings.data_dir))["lock"].detail
    assert "no server" in by_name(data.data_checks(settings.data_dir))["lock"].detail


def make_database(settings: Settings, revision: str | None) -> Path:
    path = settings.data_dir / DATABASE
    with contextlib.closing(sqlite3.connect(path)) as made, made:
        made.execute("CREATE TABLE filler (text TEXT)")
        made.executemany("INSERT INTO filler VALUES (?)", [("x" * 500,)] * 100)
        if revision is not None:
            made.execute("CREATE TABLE alembic_version (version_num VARCHAR(32) NOT NULL)")
            made.execute("INSERT INTO alembic_version VALUES (?)", (revision,))
    return path


@pytest.mark.parametrize(
    ("revision", "status", "detail"),
    [
        ("0002", "ok", "is whole, at revision 0002"),
        ("0001", "warn", "at revision 0001, before 0002"),
        ("9999", "fail", "newer version"),
        (None, "warn", "no tables yet"),
    ],
)
def test_the_revision_of_a_database(
    settings: Settings, monkeypatch: pytest.MonkeyPatch, revision: str | None, status: str, detail: str
) -> None:
    monkeypatch.setattr(database, "known_revisions", lambda: (frozenset({"0001", "0002"}), "0002"))
    before = make_database(settings, revision).read_bytes()
    found = database.database_finding(settings.data_dir, "")
    assert found.status == status
    assert detail in found.detail
    assert (settings.data_dir / DATABASE).read_bytes() == before


def test_a_damaged_database_and_one_that_is_none(settings: Settings) -> None:
    path = make_database(settings, "0001")
    whole = path.read_bytes()
    for damaged in (b"no database" * 1000, whole[:4096] + bytes(len(whole) - 4096)):
        path.write_bytes(damaged)
        found = database.database_finding(settings.data_dir, "")
        assert found.status == "fail"
        assert "reina restore" in found.to_do


def test_a_database_server_that_is_away_or_none(settings: Settings) -> None:
    [free] = listen("127.0.0.1", 0)
    port = free.getsockname()[1]
    free.close()
    away = database.database_finding(settings.data_dir, f"postgresql://reina:hidden@127.0.0.1:{port}/reina")
    assert away.status == "fail"
    assert "hidden" not in away.detail
    for address in ("nonsense", "nosuch://x/y"):
        assert database.database_finding(settings.data_dir, address).status == "fail"


def test_what_connects_servers(settings: Settings, tmp_path: Path) -> None:
    alone = replace(settings, bus="redis://127.0.0.1:1")
    assert "one database" in redis_bus.bus_finding(alone).detail
    shared = replace(alone, database="postgresql://reina@127.0.0.1/reina")
    assert "REINA_FILES" in redis_bus.bus_finding(shared).detail
    shared = replace(shared, files=str(tmp_path))
    away = redis_bus.bus_finding(shared)
    assert away.status == "fail"
    assert "does not answer" in away.detail
    assert "cannot be read" in redis_bus.bus_finding(replace(shared, bus="nonsense")).detail
    with redis_server() as redis:
        assert redis_bus.bus_finding(replace(shared, bus=redis.url)).status == "ok"


def test_what_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    found = parts.packages_finding(["numpy>=2", "not-there-at-all>=1", 'onnxruntime>=1; extra == "x"'])
    assert (found.status, found.detail) == ("fail", "not-there-at-all missing")
    monkeypatch.setattr(sys, "version_info", (3, 10, 1))
    assert parts.python_finding().status == "fail"


def test_parts_that_are_missing(settings: Settings, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (settings.page_dir / "index.html").unlink()
    monkeypatch.setenv("REINA_RIGS", str(tmp_path / "none"))
    monkeypatch.setenv("REINA_SOUNDFONT", str(tmp_path / "none.sf2"))
    monkeypatch.setenv("REINA_BROWSER", str(tmp_path / "no-browser"))
    found = by_name(parts.parts_checks(Settings()))
    assert {what for what, one in found.items() if one.status == "fail"} == {"page", "rigs", "soundfont"}
    assert found["browser"].status == "warn"
    assert all(one.to_do for one in found.values() if one.status != "ok")


def test_a_browser_without_what_drives_it(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> None:
    version = importlib.metadata.version

    def without(name: str) -> str:
        if name == "playwright":
            raise importlib.metadata.PackageNotFoundError(name)
        return version(name)

    monkeypatch.setattr(importlib.metadata, "version", without)
    assert "nothing to drive it" in by_name(parts.parts_checks(settings))["browser"].detail


@pytest.mark.parametrize(("most", "status"), [(100, "fail"), (1024, "warn"), (65536, "ok"), (None, "ok")])
def test_open_files(most: int | None, status: str) -> None:
    assert machine.files_finding(most).status == status


@pytest.mark.parametrize(
    ("total", "status"), [(10**8, "fail"), (10**9, "warn"), (10**10, "ok"), (None, "ok")]
)
def test_memory(total: int | None, status: str) -> None:
    assert machine.memory_finding(total).status == status


@pytest.mark.parametrize(
    ("threads", "status", "told"),
    [
        (None, "warn", "no Dask scheduler answers at tcp://gpu:8786"),
        (0, "warn", "tcp://gpu:8786 answers and has no workers"),
        (4, "ok", "tcp://gpu:8786 answers; 4 pieces of work at a time"),
    ],
)
def test_a_scheduler(
    settings: Settings, monkeypatch: pytest.MonkeyPatch, threads: int | None, status: str, told: str
) -> None:
    @contextlib.contextmanager
    def cluster_at(address: str) -> Generator[object]:
        if threads is None:
            raise ClusterError(f"no Dask scheduler answers at {address}")
        yield None

    monkeypatch.setattr(scheduler, "cluster_at", cluster_at)
    monkeypatch.setattr(scheduler, "threads_of", Mock(return_value=threads))
    found = scheduler.scheduler_finding(replace(settings, scheduler="tcp://gpu:8786"))
    assert (found.status, found.detail) == (status, told)
    assert bool(found.to_do) == (status == "warn")


def test_a_scheduler_that_is_none_or_cannot_be_spoken_to(
    settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = scheduler.scheduler_finding(replace(settings, scheduler="gpu:8786"))
    assert (found.status, "tcp://host:8786" in found.detail) == ("fail", True)
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.setattr("reina.api.settings.find_spec", Mock(return_value=None))
    found = scheduler.scheduler_finding(replace(settings, scheduler="tcp://gpu:8786"))
    assert (found.status, "reina[cluster]" in found.detail) == ("fail", True)
