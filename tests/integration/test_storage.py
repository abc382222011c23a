"""What a server keeps, with each of the databases: over restarts and kills, damaged, locked, taken over."""

from __future__ import annotations

import json
import random
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from tests.integration.killed import (
    check_acknowledged,
    client_of,
    kill_in_the_middle,
    light,
    move_light,
    options,
    with_client,
)
from tests.integration.scores import scale, show, song
from tests.integration.server import PATIENCE_S, Owned, Running, serve, upload
from tests.kept import kept, sql

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx

OLD = Path(__file__).parent / "version_0_1"
"""A data directory as version 0.1 left it; `expected.json` has what that version said of its sessions."""
COMMAND = [sys.executable, "-c", "import sys; from reina.cli import main; sys.exit(main())"]


def test_undo_works_after_a_restart(tmp_path: Path, database: str) -> None:
    with serve(tmp_path, *options(database)) as server, client_of(server) as client:
        session = upload(client, scale(), song=("s.wav", song()), show=("s.json", show(0.5)))
        for value in (1.0, 1.5, 2.0):
            assert move_light(session, value).status_code == 200
        assert session.change("POST", "/show/undo").json()["undo"] == 2
        assert server.stop() == 0
    with serve(tmp_path, *options(database)) as server, client_of(server) as client:
        session = with_client(session, client)
        assert light(session) == 1.5
        again = session.change("POST", "/show/redo")
        assert (again.status_code, again.json()["undo"], again.json()["redo"]) == (200, 3, 0)
        assert light(session) == 2.0
        for value in (1.5, 1.0, 0.5):
            assert session.change("POST", "/show/undo").status_code == 200
            assert light(session) == value
        assert session.change("POST", "/show/undo").status_code == 409
        listed = client.get("/api/v1/sessions").json()["sessions"]
        assert listed == []
        assert session.change("DELETE").status_code == 204
        assert client.get(session.path).status_code == 404


def test_what_is_killed_loses_nothing_that_it_acknowledged(tmp_path: Path, database: str) -> None:
    chance = random.Random(7)
    writers = [kill_in_the_middle(tmp_path, options(database), chance) for _ in range(2)]
    with serve(tmp_path, *options(database)) as server, client_of(server) as client:
        for writer in writers:
            check_acknowledged(client, writer)
    assert list((tmp_path / "staging").iterdir()) == [], "what was under way is removed"


@pytest.fixture
def running(tmp_path: Path) -> Iterator[tuple[Running, httpx.Client, Path]]:
    data_dir, log = tmp_path / "data", tmp_path / "log"
    with serve(data_dir, "--no-page", log=log) as server, client_of(server) as client:
        yield server, client, data_dir
    assert "Traceback" not in log.read_text()


def damage(data_dir: Path, what: str, damaged: str, whole: str) -> None:
    """Damage a session that is not loaded."""
    match what:
        case "record":
            sql(data_dir, "UPDATE sessions SET record = '{}' WHERE id = ?", damaged)
        case "copy":
            copied = "(SELECT record FROM sessions WHERE id = ?)"
            sql(data_dir, f"UPDATE sessions SET record = {copied} WHERE id = ?", whole, damaged)
        case "show":
            sql(data_dir, "DELETE FROM show_objects WHERE session_id = ?", damaged)
        case _:
            asked = "SELECT digest FROM session_files WHERE session_id = ? AND name = 'score'"
            (row,) = sql(data_dir, asked, damaged)
            next(path for path in data_dir.rglob(f"*{row[0][-60:]}*") if path.is_file()).unlink()


def test_a_damaged_session_is_one_problem_and_can_be_ended(tmp_path: Path) -> None:
    data_dir, log = tmp_path / "data", tmp_path / "log"
    ways = ["record", "copy", "show", "score"]
    with serve(data_dir, "--no-page") as server, client_of(server) as client:
        whole = upload(client, scale(3), song=("s.wav", song()), public="true", title="Whole")
        damaged = [
            upload(client, scale(4 + at), song=("s.wav", song()), public="true", title=way)
            for at, way in enumerate(ways)
        ]
        server.stop()
    for way, session in zip(ways, damaged, strict=True):
        damage(data_dir, way, session.id, whole.id)
    with serve(data_dir, "--no-page", log=log) as server, client_of(server) as client:
        whole = with_client(whole, client)
        listed = client.get("/api/v1/sessions").json()["sessions"]
        assert {session["title"] for session in listed} == {"Whole", *ways}
        for session in (with_client(each, client) for each in damaged):
            for path in ("", "/song", "/score", "/show", "/transport"):
                answer = client.get(f"{session.path}{path}")
                problem = answer.status_code, answer.json()["type"]
                assert problem == (409, "urn:reina:problem:session-damaged")
                assert session.id in answer.json()["detail"]
            assert session.change("PATCH", json={"title": "x"}).status_code == 409
            assert client.delete(session.path).status_code == 401
            assert client.delete(session.path, headers=whole.headers).status_code == 403
            assert session.change("DELETE").status_code == 204
            assert client.get(session.path).status_code == 404
        assert client.get(whole.path).json()["title"] == "Whole"
        assert whole.change("DELETE").status_code == 204
        assert server.stop() == 0
    assert "Traceback" not in log.read_text()
    assert kept(data_dir) == []


def test_a_file_that_is_lost_while_the_session_is_loaded_is_the_same_problem(
    running: tuple[Running, httpx.Client, Path],
) -> None:
    _, client, data_dir = running
    session = upload(client, scale(4), song=("s.wav", song()))
    for path in (data_dir / "files").rglob("*"):
        if path.is_file():
            path.unlink()
    for path in ("/song", "/score/file"):
        answer = client.get(f"{session.path}{path}")
        assert (answer.status_code, answer.json()["type"]) == (409, "urn:reina:problem:session-damaged")
    assert session.change("DELETE").status_code == 204


def test_a_second_server_is_told_who_holds_the_directory(running: tuple[Running, httpx.Client, Path]) -> None:
    server, _, data_dir = running
    for command in (["serve", "--port", "0", "--no-page"], ["migrate"]):
        second = subprocess.run(
            [*COMMAND, *command, "--data-dir", str(data_dir)],
            capture_output=True,
            text=True,
            check=False,
            timeout=PATIENCE_S,
        )
        assert second.returncode == 1
        assert f"another server works in the data directory {data_dir}" in second.stderr
        assert f"the process {server.process.pid};" in second.stderr
        assert "Traceback" not in second.stderr


@pytest.mark.parametrize(
    ("url", "said"),
    [
        ("postgresql+psycopg://someone:secret@127.0.0.1:1/reina", "does not answer"),
        ("mysql://host/name", "is no database that sessions are kept in"),
    ],
)
def test_a_database_that_cannot_be_used_is_told_in_a_line(tmp_path: Path, url: str, said: str) -> None:
    ended = subprocess.run(
        [*COMMAND, "serve", "--port", "0", "--no-page", "--data-dir", str(tmp_path), "--database", url],
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE_S,
    )
    assert ended.returncode == 1
    assert said in ended.stderr
    assert len(ended.stderr.splitlines()) == 1
    assert "secret" not in ended.stderr


def test_a_database_that_is_away_is_503_until_it_is_back(tmp_path: Path) -> None:
    from tests.servers.postgresql import postgresql

    log = tmp_path / "log"
    with postgresql() as database:
        url = database.database()
        with serve(tmp_path / "data", *options(url), log=log) as server, client_of(server) as client:
            session = upload(client, scale(4), song=("s.wav", song()), show=("s.json", show(0.5)))
            database.stop()
            answers = [
                client.get("/api/v1/sessions"),
                client.get("/api/v1/sessions/q3Zt0bXJ5V2mC9yLk7wH1A"),
                client.post("/api/v1/sessions", files={"score": ("s.mid", scale(4))}),
                move_light(session, 2.0),
                session.change("DELETE"),
            ]
            for answer in answers:
                assert (answer.status_code, answer.json()["type"]) == (503, "urn:reina:problem:database-away")
                assert int(answer.headers["Retry-After"]) > 0
            assert light(session) == 0.5, "what is refused is seen by nobody"
            database.start()
            assert move_light(session, 2.0).status_code == 200
            assert light(session) == 2.0
            assert server.stop() == 0
        assert "Traceback" not in log.read_text()


# Version 0.1


@pytest.fixture
def old(tmp_path: Path) -> Path:
    """A data directory of version 0.1, to work in."""
    shutil.copytree(OLD, tmp_path / "data")
    return tmp_path / "data"


def check_old(client: httpx.Client, expected: dict[str, Any]) -> None:
    """See that a session is as version 0.1 told it."""
    session = Owned(client, {"id": expected["id"], "control_token": expected["token"]})
    found = client.get(session.path).json()
    for name in ("id", "title", "public", "created_at", "duration_s", "notes", "cast"):
        assert found[name] == expected["session"][name], name
    assert client.get(f"{session.path}/show").json() == expected["show"]
    assert client.get(f"{session.path}/show").headers["ETag"] == expected["show_etag"]
    folder = OLD / "sessions" / expected["id"]
    assert client.get(f"{session.path}/score/file").content == (folder / "score").read_bytes()
    if (folder / "song.wav").exists():
        assert client.get(f"{session.path}/song").content == (folder / "song.wav").read_bytes()
        assert client.get(f"{session.path}/song/peaks?points=20").json() == expected["peaks"]
    if (folder / "alignment.json").exists():
        aligned = client.get(f"{session.path}/alignment").json()
        assert aligned == expected["alignment"]
    assert move_light(session, 1.25).status_code == 200
    assert session.change("POST", "/show/undo").status_code == 200
    assert client.get(f"{session.path}/show").json() == expected["show"]


def test_a_directory_of_version_0_1_is_taken_over_at_the_start(old: Path, database: str) -> None:
    expected = json.loads((old / "expected.json").read_text())
    with serve(old, *options(database)) as server, client_of(server) as client:
        for each in expected:
            check_old(client, each)
    assert not (old / "sessions").exists()
    assert not (old / "sessions.json").exists()


def test_what_is_taken_over_by_the_command_is_whole_however_often_it_is_killed(old: Path) -> None:
    expected = json.loads((old / "expected.json").read_text())
    damaged = old / "sessions" / "damaged-0123456789abcd"
    damaged.mkdir()
    (damaged / "session.json").write_text("{")
    (old / "sessions" / expected[0]["id"] / ".show.json.0123abcd").write_text("half a sho")
    command = [*COMMAND, "migrate", "--data-dir", str(old)]
    chance = random.Random(3)
    for _ in range(4):
        process = subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        time.sleep(chance.uniform(0.5, 2.0))
        process.kill()
        process.wait()
    for _ in range(2):
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=PATIENCE_S)
        assert done.returncode == 1
        assert f"the session in {damaged} stays there: its record does not fit" in done.stderr
    assert [path.name for path in (old / "sessions").iterdir()] == [damaged.name]
    with serve(old, "--no-page") as server, client_of(server) as client:
        for each in expected:
            check_old(client, each)
        assert client.get(f"/api/v1/sessions/{damaged.name}").status_code == 404
    shutil.rmtree(damaged)
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=PATIENCE_S)
    assert (done.returncode, done.stdout) == (0, "0 sessions taken over, 0 left\n")
