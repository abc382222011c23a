"""A real Dask scheduler with a worker: what a server, and `reina bake`, have done there."""

from __future__ import annotations

import asyncio
import json
import os
import subprocess
import sys
import time
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from tests.integration.scores import duet, scale
from tests.integration.server import PATIENCE_S, rendered, serve, upload

from reina.cli.bake import work
from reina.cli.bake.library import MANIFEST
from reina.errors import InputError
from reina.system.cluster import AwayError, LostError
from reina.system.elsewhere import Elsewhere

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator, Mapping

ROOT = Path(__file__).parents[2]
WORK = "tests.integration.elsewhere_work"
TIMEOUT_S = 60.0


@dataclass(frozen=True)
class Cluster:
    """A scheduler and a worker."""

    address: str
    processes: Mapping[str, subprocess.Popen[Any]]

    def end(self, name: str) -> None:
        self.processes[name].kill()
        self.processes[name].wait(PATIENCE_S)


@contextmanager
def running_cluster(folder: Path) -> Generator[Cluster]:
    file = folder / "scheduler.json"
    environment = os.environ | {"PYTHONPATH": f"{ROOT / 'server'}{os.pathsep}{ROOT}"}
    quiet: dict[str, Any] = {"env": environment, "stderr": subprocess.DEVNULL, "cwd": folder}
    program = (sys.executable, "-m")
    shared = ("--dashboard-address", "127.0.0.1:0", "--scheduler-file", str(file))
    processes = {
        "scheduler": subprocess.Popen(
            [*program, "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", *shared],
            **quiet,
        ),
        "worker": subprocess.Popen(
            [*program, "distributed.cli.dask_worker", "--nthreads", "1", *shared],
            **quiet,
        ),
    }
    try:
        deadline = time.monotonic() + PATIENCE_S
        while not file.exists():
            assert time.monotonic() < deadline, "the scheduler does not start"
            time.sleep(0.05)
        yield Cluster(json.loads(file.read_text())["address"], processes)
    finally:
        for process in processes.values():
            process.terminate()
        for process in processes.values():
            process.wait(PATIENCE_S)


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    """One for all tests, until the last ends it."""
    with running_cluster(tmp_path_factory.mktemp("cluster")) as one:
        until_it_works(one)
        yield one


def until_it_works(cluster: Cluster) -> None:
    """Wait until the worker has come."""

    async def works() -> bool:
        elsewhere = Elsewhere(cluster.address)
        try:
            return await asked(elsewhere, "doubled", 2) == 4
        except AwayError:
            return False
        finally:
            await elsewhere.aclose()

    deadline = time.monotonic() + PATIENCE_S
    while not asyncio.run(works()):
        assert time.monotonic() < deadline, "no worker comes"
        time.sleep(0.1)


async def asked(
    elsewhere: Elsewhere, function: str, *arguments: object, heard: list[float] | None = None
) -> Any:
    tell = (heard if heard is not None else list[float]()).append
    return await elsewhere.run(f"{WORK}:{function}", *arguments, tell=tell, timeout_s=TIMEOUT_S)


def test_work_is_done_told_refused_and_called_off(cluster: Cluster, tmp_path: Path) -> None:
    async def all_of_it() -> None:
        elsewhere = Elsewhere(cluster.address)
        heard: list[float] = []
        assert await asked(elsewhere, "doubled", 21, heard=heard) == 42
        assert heard == [0.5]
        with pytest.raises(InputError, match="7 is no number"):
            await asked(elsewhere, "refused", 7)
        note = tmp_path / "called off"
        heard.clear()
        endless = asyncio.create_task(asked(elsewhere, "endless", str(note), heard=heard))
        async with asyncio.timeout(TIMEOUT_S):
            while not heard:  # noqa: ASYNC110 - a list that a callback fills
                await asyncio.sleep(0.01)
            assert set(heard) == {0.25}
            endless.cancel()
            with pytest.raises(asyncio.CancelledError):
                await endless
            while not note.exists():  # noqa: ASYNC110 - another process writes it
                await asyncio.sleep(0.01)
        # The worker is free again.
        assert await asked(elsewhere, "doubled", 1) == 2
        with pytest.raises(LostError):
            await asked(elsewhere, "deadly")
        await elsewhere.aclose()

    asyncio.run(all_of_it())


def test_a_library_is_baked_there(cluster: Cluster, tmp_path: Path) -> None:
    scores, output = tmp_path / "in", tmp_path / "out"
    scores.mkdir()
    for number in range(3):
        (scores / f"{number}.mid").write_bytes(scale(4 + number))
    command = [sys.executable, "-m", "reina", "bake", str(scores), "--only", "show,blocks"]
    done = subprocess.run(
        [*command, "--out", str(output), "--scheduler", cluster.address],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    for path in scores.iterdir():
        order = work.ScoreOrder(path.read_bytes(), path.name, None, work.maker())
        _, files = work.begin(order, frozenset({"show", "blocks"}))
        made = output / path.name
        found = {p.relative_to(made).as_posix(): p.read_bytes() for p in made.rglob("*") if p.is_file()}
        del found[MANIFEST]
        assert found == files


def test_songs_are_made_there_and_here_when_the_scheduler_is_gone(
    tmp_path: Path, cluster: Cluster, client: httpx.Client
) -> None:
    """The last one: it ends the cluster."""
    own = upload(client, duet(), name="duet.mid")
    expected = rendered(client, client.get(own.path).json()["song"]["href"]).content
    own.change("DELETE")
    log = tmp_path / "log"
    with (
        serve(tmp_path / "data", "--no-page", "--scheduler", cluster.address, log=log) as server,
        httpx.Client(base_url=server.address, timeout=TIMEOUT_S) as there,
    ):
        assert song_of(there, duet()) == expected
        recorded = upload(there, duet(), song=("song.flac", expected))
        assert alignment(there, recorded.path)["status"] == "found"
        songs = list((tmp_path / "data" / "songs").glob("*/song.flac"))
        assert [len(list(song.parent.glob("*.opus"))) > 0 for song in songs] == [True]
        assert "does not work" not in log.read_text()
        cluster.end("worker")
        cluster.end("scheduler")
        assert song_of(there, scale(4)).startswith(b"fLaC")
        assert song_of(there, scale(5)).startswith(b"fLaC")
    told = [line for line in log.read_text().splitlines() if "does not work, this server does" in line]
    assert len(told) == 1


def song_of(client: httpx.Client, score: bytes) -> bytes:
    """What a new session of a score is heard with."""
    session = upload(client, score, name="duet.mid")
    return rendered(client, client.get(session.path).json()["song"]["href"]).content


def alignment(client: httpx.Client, path: str) -> dict[str, Any]:
    """Where a score is heard, once that is known."""
    deadline = time.monotonic() + TIMEOUT_S
    while (state := client.get(path).json()["alignment"])["status"] == "searching":
        assert time.monotonic() < deadline
        time.sleep(0.05)
    return state
