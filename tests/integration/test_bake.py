"""`reina bake`: what it makes is what a server gives, whoever is killed on the way."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from tests.integration.scores import duet, scale
from tests.integration.server import PATIENCE_S, rendered, upload

from reina.cli.bake.library import BY_REVISION, MANIFEST, STAGING
from reina.cli.bake.work import SHOW

if TYPE_CHECKING:
    from collections.abc import Generator

    import httpx

SCORES = 8
BAKE = (sys.executable, "-m", "reina", "bake")
POISONED = (sys.executable, "-m", "tests.integration.poisoned_bake")
QUICK = ("--only", "show,blocks,bvh")
PATIENT_S = 60.0


@pytest.fixture(scope="module")
def scores(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A library of short scores, in folders."""
    folder = tmp_path_factory.mktemp("scores")
    for number in range(SCORES):
        path = folder / f"book {number % 3}" / f"{number}.mid"
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(scale(6 + number))
    return folder


@pytest.fixture(scope="module")
def baked(scores: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same baked, with nobody disturbed."""
    output = tmp_path_factory.mktemp("baked")
    done = bake(scores, "--out", output, *QUICK, workers=2)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1].startswith(f"{SCORES} made, 0 there already, 0 failed")
    return output


def bake(
    folder: Path, *arguments: object, program: tuple[str, ...] = BAKE, workers: int = 1
) -> subprocess.CompletedProcess[str]:
    command = [*program, str(folder), "--workers", str(workers), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=PATIENT_S, check=False)


@dataclass(frozen=True)
class Baking:
    """A bake under way."""

    process: subprocess.Popen[str]

    def wait_for(self, scores: int) -> None:
        """Wait until so many are done."""
        assert self.process.stdout is not None
        for line in self.process.stdout:
            if line.startswith(f"{scores} of "):
                return
        raise AssertionError("it ended before")

    def workers(self) -> list[int]:
        """The processes that work: those of its children that stay and are no helpers of Python's."""
        tasks = Path(f"/proc/{self.process.pid}/task").glob("*/children")
        children = [int(child) for task in tasks for child in task.read_text().split()]
        return [one for one in children if "spawn_main" in Path(f"/proc/{one}/cmdline").read_text()]

    def end(self) -> tuple[int, str]:
        """Its status, and what it complained of."""
        _, complaint = self.process.communicate(timeout=PATIENT_S)
        return self.process.returncode, complaint


@contextmanager
def baking(folder: Path, *arguments: object, workers: int = 1) -> Generator[Baking]:
    command = [*BAKE, str(folder), "--workers", str(workers), *map(str, arguments)]
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    try:
        yield Baking(process)
    finally:
        process.kill()
        process.communicate()


def files_of(output: Path) -> dict[str, bytes]:
    """All that is baked, but for what is kept beside it."""
    return {
        path.relative_to(output).as_posix(): path.read_bytes()
        for path in output.rglob("*")
        if path.is_file() and path.name != "lock"
    }


def until_gone(processes: list[int]) -> None:
    """Wait until processes have ended."""
    deadline = time.monotonic() + PATIENCE_S
    for one in processes:
        with suppress(ProcessLookupError, FileNotFoundError):
            while Path(f"/proc/{one}/stat").read_text().rpartition(")")[2].split()[0] != "Z":
                os.kill(one, 0)
                assert time.monotonic() < deadline, f"process {one} goes on"
                time.sleep(0.02)


def manifest(output: Path, name: str) -> dict[str, Any]:
    document: dict[str, Any] = json.loads((output / name / MANIFEST).read_bytes())
    return document


def test_what_is_baked_is_what_the_server_gives(tmp_path: Path, client: httpx.Client) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "duet.mid").write_bytes(duet())
    (tmp_path / "in" / "broken.mid").write_bytes(b"MThd and nothing else")
    (tmp_path / "in" / "other.json").write_text('{"colour": "red"}')
    done = bake(tmp_path / "in", "--json")
    output = tmp_path / "in-baked"
    told = json.loads(done.stdout)
    assert done.returncode == 1
    assert told["made"] == ["duet.mid"]
    assert list(told["failed"]) == ["broken.mid"]
    assert f"reina bake: broken.mid: {told['failed']['broken.mid']}" in done.stderr
    assert not (output / "broken.mid").exists()

    made, document = output / "duet.mid", manifest(output, "duet.mid")
    session = upload(client, duet(), name="duet.mid")
    shown = client.get(session.path).json()
    hello = client.get(f"{session.path}/manifest").json()
    assert document["duration_s"] == shown["duration_s"]
    assert [player["part"] for player in document["players"]] == [
        one["part"] for one in shown["cast"]["castings"]
    ]
    blocks = document["parts"]["blocks"]
    assert blocks["revision"] == hello["blocks"]["revision"]
    assert (
        blocks["count"] == len(blocks["files"]) == len(list((made / "blocks" / blocks["revision"]).iterdir()))
    )
    for number in range(blocks["count"]):
        served = client.get(f"{session.path}/blocks/{blocks['revision']}/{number}").raise_for_status()
        for folder in (made / "blocks", output / BY_REVISION):
            assert (folder / blocks["revision"] / str(number)).read_bytes() == served.content
    beyond = client.get(f"{session.path}/blocks/{blocks['revision']}/{blocks['count']}")
    assert beyond.status_code == 404
    assert (made / SHOW).read_bytes() == client.get(f"{session.path}/show").content
    for number, player in enumerate(document["players"]):
        served = client.get(f"{session.path}/export.bvh", params={"player": number}).raise_for_status()
        assert (made / player["motion"]).read_bytes() == served.content
    assert (made / "song.flac").read_bytes() == rendered(client, shown["song"]["href"]).content
    assert document["parts"].keys() == {"show", "blocks", "bvh", "sound"}
    session.change("DELETE")


def test_a_score_that_is_there_is_passed_over_and_one_that_changed_is_not(
    scores: Path, baked: Path, tmp_path: Path
) -> None:
    subprocess.run(["cp", "-a", f"{scores}/.", tmp_path / "in"], check=True)
    subprocess.run(["cp", "-a", f"{baked}/.", tmp_path / "out"], check=True)
    changed, lost, same = (f"book {number}/{number}.mid" for number in range(3))
    (tmp_path / "in" / changed).write_bytes(scale(5))
    (tmp_path / "out" / lost / SHOW).unlink()
    before = (tmp_path / "out" / same).stat()
    done = bake(tmp_path / "in", "--out", tmp_path / "out", *QUICK, "--json")
    told = json.loads(done.stdout)
    assert sorted(told["made"]) == [changed, lost]
    assert len(told["there"]) == SCORES - 2
    assert (tmp_path / "out" / same).stat() == before
    assert files_of(tmp_path / "out")[f"{lost}/{SHOW}"] == files_of(baked)[f"{lost}/{SHOW}"]
    revisions = {
        manifest(tmp_path / "out", path.relative_to(tmp_path / "in").as_posix())["parts"]["blocks"][
            "revision"
        ]
        for path in (tmp_path / "in").rglob("*.mid")
    }
    assert {link.name for link in (tmp_path / "out" / BY_REVISION).iterdir()} == revisions


def test_a_worker_that_is_killed_costs_nothing_but_its_piece(
    scores: Path, baked: Path, tmp_path: Path
) -> None:
    with baking(scores, "--out", tmp_path, *QUICK, workers=2) as under_way:
        under_way.wait_for(1)
        workers = under_way.workers()
        assert len(workers) == 2
        os.kill(workers[0], signal.SIGKILL)
        status, complaint = under_way.end()
    assert (status, complaint) == (0, "")
    assert files_of(tmp_path) == files_of(baked)


def test_a_score_that_kills_whoever_works_at_it_is_told_and_the_others_are_made(
    tmp_path: Path,
) -> None:
    (tmp_path / "in").mkdir()
    for name in ("one.mid", "poison.mid", "two.mid"):
        (tmp_path / "in" / name).write_bytes(scale(3))
    done = bake(tmp_path / "in", "--out", tmp_path / "out", *QUICK, program=POISONED)
    assert done.returncode == 1
    told = "every process that worked at it ended: it takes too much memory, or crashes"
    assert done.stderr == f"reina bake: poison.mid: {told}\n"
    assert "2 made, 0 there already, 1 failed" in done.stdout
    assert {path.parent.name for path in (tmp_path / "out").rglob(MANIFEST)} == {"one.mid", "two.mid"}


def test_a_bake_that_is_killed_leaves_nothing_half_and_goes_on(
    scores: Path, baked: Path, tmp_path: Path
) -> None:
    whole = files_of(baked)
    with baking(scores, "--out", tmp_path, *QUICK) as under_way:
        under_way.wait_for(2)
        workers = under_way.workers()
        under_way.process.kill()
        under_way.process.wait(PATIENCE_S)
        until_gone(workers)
    there = {path.parent for path in tmp_path.rglob(MANIFEST) if STAGING not in path.parts}
    assert 2 <= len(there) < SCORES
    for name, data in whole.items():
        piece = tmp_path / Path(*Path(name).parts[:2])
        assert not piece.exists() or (tmp_path / name).read_bytes() == data
    done = bake(scores, "--out", tmp_path, *QUICK, "--json")
    assert len(json.loads(done.stdout)["there"]) == len(there)
    assert files_of(tmp_path) == whole


def test_one_bakes_to_a_place_until_ctrl_c_which_ends_the_workers_and_says_how_to_go_on(
    scores: Path, tmp_path: Path
) -> None:
    with baking(scores, "--out", tmp_path, *QUICK) as under_way:
        under_way.wait_for(1)
        # It stands still while another is tried: it may be done by the time that that has started.
        under_way.process.send_signal(signal.SIGSTOP)
        try:
            other = bake(scores, "--out", tmp_path, *QUICK)
        finally:
            under_way.process.send_signal(signal.SIGCONT)
        assert (other.returncode, other.stderr) == (
            1,
            f"reina bake: something else is baked into {tmp_path}; name another with --out\n",
        )
        workers = under_way.workers()
        os.killpg(under_way.process.pid, signal.SIGINT)
        status, complaint = under_way.end()
        until_gone(workers)
    assert status == 130
    assert "scores are there; the same command goes on from here" in complaint
    assert complaint.count("\n") == 1
    assert not (tmp_path / STAGING).exists()
