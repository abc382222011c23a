"""The command, the page and the rigs; sessions outlive the server."""

from __future__ import annotations

import asyncio
import json
import os
import socket
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import httpx
from tests.integration.scores import duet, scale, show, song
from tests.integration.server import serve, upload
from tests.integration.watching import watch

if TYPE_CHECKING:
    import pytest
    from tests.integration.server import Owned, Running

PAGE = Path(__file__).parents[2] / "web" / "dist"


def test_sessions_outlive_the_server(tmp_path: Path) -> None:
    sound = song()
    with serve(tmp_path) as running, httpx.Client(base_url=running.address, timeout=30) as client:
        session = upload(
            client,
            duet(),
            "Duet.mid",
            song=("s.wav", sound),
            show=("show.json", show()),
            title="Two",
            in_time="true",
        )
        session.change("PATCH", json={"part": 0, "transposition": -12, "public": True}).raise_for_status()
        session.change(
            "POST", "/show/tracks/camera/fov/keyframes", json={"time": 1.0, "value": 0.5}
        ).raise_for_status()
        session.control("seek", song_time_s=1.5)
        before = {name: client.get(f"{session.path}{name}").json() for name in ("", "/show", "/score")}
        frames = client.get(f"{session.path}/frames", params={"end_s": 1.0}).content
        assert running.stop() == 0
    with serve(tmp_path) as running, httpx.Client(base_url=running.address, timeout=30) as client:
        after = {name: client.get(f"{session.path}{name}").json() for name in ("", "/show", "/score")}
        assert after == before
        assert client.get(f"{session.path}/song").content == sound
        assert client.get(f"{session.path}/frames", params={"end_s": 1.0}).content == frames
        transport = client.get(f"{session.path}/transport").json()
        assert (transport["playing"], transport["song_time_s"]) == (False, 1.5)
        assert [listed["id"] for listed in client.get("/api/v1/sessions").json()["sessions"]] == [session.id]
        again = client.post(f"{session.path}/transport", json={"action": "play"}, headers=session.headers)
        assert again.status_code == 200
        assert client.delete(session.path, headers=session.headers).status_code == 204
    assert not [path for path in (tmp_path / "files").rglob("*") if path.is_file()]


def test_sigterm_ends_it_within_seconds_with_streams_open(tmp_path: Path) -> None:
    async def scenario(running: Running, session: Owned) -> tuple[int, int | None, float]:
        async with watch(running, session.id) as watcher:
            await asyncio.to_thread(session.control, "play")
            await watcher.frame(10, epoch=1)
            begun = time.monotonic()
            status = await asyncio.to_thread(running.stop)
            took_s = time.monotonic() - begun
            await asyncio.wait_for(watcher.socket.wait_closed(), 5)
            return status, watcher.socket.close_code, took_s

    with serve(tmp_path) as running, httpx.Client(base_url=running.address, timeout=30) as client:
        session = upload(client, scale(), song=("s.wav", song()))
        # One that never reads, too: it must not be waited for.
        host, port = running.address.removeprefix("http://").split(":")
        silent = socket.create_connection((host, int(port)))
        status, code, took_s = asyncio.run(scenario(running, session))
        silent.close()
    assert status == 0
    assert code in (1012, 1006)
    assert took_s < 6


def test_the_environment_configures_it(tmp_path: Path) -> None:
    environment = {
        **os.environ,
        "REINA_PORT": "0",
        "REINA_DATA_DIR": str(tmp_path),
        "REINA_HOST": "127.0.0.1",
    }
    command = [sys.executable, "-c", "import sys; from reina.cli import main; sys.exit(main())", "serve"]
    process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    address = process.stdout.readline().strip()
    assert httpx.get(f"{address}/api/v1/health", timeout=30).json()["status"] == "ok"
    process.terminate()
    assert process.wait(30) == 0
    process.stdout.close()
    assert (tmp_path / "reina.db").is_file()


def test_a_port_that_is_taken_is_told(tmp_path: Path, server: Running) -> None:
    port = server.address.rsplit(":", 1)[1]
    command = [sys.executable, "-c", "import sys; from reina.cli import main; sys.exit(main())", "serve"]
    ended = subprocess.run(
        [*command, "--port", port, "--data-dir", str(tmp_path)], capture_output=True, text=True, timeout=30
    )
    assert ended.returncode == 1
    [line] = ended.stderr.splitlines()
    assert f"port {port} is in use" in line
    assert ended.stdout == ""


def test_health_says_what_it_speaks(client: httpx.Client) -> None:
    health = client.get("/api/v1/health").json()
    assert health["ready"] is True
    assert health["streams"] == ["reina.v1"]


def test_a_drum_kits_description_says_where_it_is_struck(client: httpx.Client) -> None:
    kit = client.get("/api/v1/rigs/drumkit").json()
    joints = {joint["name"] for joint in kit["joints"]}
    assert {zone["piece"] for zone in kit["zones"]} >= {"snare", "kick", "hi_hat", "ride", "cowbell"}
    assert {zone["joint"] for zone in kit["zones"]} | {solid["joint"] for solid in kit["cylinders"]} <= joints
    for side in ("left", "right"):
        effectors = client.get(f"/api/v1/rigs/{side}_stick").json()["effectors"]
        assert [effector["name"] for effector in effectors] == [f"{side}StickTip"]


def test_a_rigs_description_links_its_models(client: httpx.Client) -> None:
    rigs = client.get("/api/v1/rigs").json()["rigs"]
    assert {"trumpet", "trumpeter"} <= {rig["name"] for rig in rigs}
    for name in ("trumpet", "trumpeter"):
        rig = client.get(f"/api/v1/rigs/{name}").json()
        assert rig["name"] == name
        assert rig["models"].keys() == {"full", "medium", "low"}
        for href in rig["models"].values():
            model = client.get(href)
            assert model.content[:4] == b"glTF"
            assert model.headers["content-type"] == "model/gltf-binary"
            unchanged = client.get(href, headers={"If-None-Match": model.headers["etag"]})
            assert unchanged.status_code == 304
    trumpet = client.get("/api/v1/rigs/trumpet").json()
    assert {button["valve"] for button in trumpet["buttons"]} == {1, 2, 3}


def test_json_is_compressed_and_frames_are_not(client: httpx.Client, owned: Owned) -> None:
    accepts = {"Accept-Encoding": "gzip"}
    assert client.get("/api/v1/parameters", headers=accepts).headers["content-encoding"] == "gzip"
    frames = client.get(f"{owned.path}/frames", params={"end_s": 0.5}, headers=accepts)
    assert "content-encoding" not in frames.headers
    sound = client.get(f"{owned.path}/song", headers=accepts)
    assert "content-encoding" not in sound.headers


def test_the_page_stands_at_the_root_and_at_each_session(client: httpx.Client) -> None:
    home = client.get("/")
    assert home.status_code == 200
    assert home.text == client.get("/s/anything").text
    assert home.headers["cache-control"] == "no-cache"
    asset = next((PAGE / "assets").iterdir())
    answer = client.get(f"/assets/{asset.name}")
    assert answer.content == asset.read_bytes()
    assert "immutable" in answer.headers["cache-control"]
    assert client.head("/").status_code == 200
    assert client.get("/assets/..%2F..%2Fpackage.json").status_code == 404


def test_without_the_page_the_api_answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_PAGE", str(tmp_path / "nowhere"))
    with serve(tmp_path / "data", "--no-page") as running:
        assert httpx.get(f"{running.api}/health", timeout=30).json()["ready"] is True
        home = httpx.get(running.address, timeout=30)
    assert home.status_code == 503
    assert "make setup" in home.json()["detail"]


def test_the_interface_describes_itself(client: httpx.Client) -> None:
    document = client.get("/openapi.json").json()
    committed = (Path(__file__).parents[2] / "docs" / "openapi.json").read_text()
    assert document["paths"].keys() <= json.loads(committed)["paths"].keys()
    post = document["paths"]["/api/v1/sessions"]["post"]
    assert "multipart/form-data" in post["requestBody"]["content"]
    assert "application/problem+json" in post["responses"]["4XX"]["content"]
