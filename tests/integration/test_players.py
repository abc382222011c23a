"""Who plays is a session's choice: the other player moves as exactly, and everybody who watches sees it."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

import httpx
import numpy as np
from scipy.spatial.transform import Rotation
from tests.integration.scores import scale, song
from tests.integration.server import serve, upload
from tests.integration.stranger import button, take
from tests.integration.test_audit import excess
from tests.integration.watching import watch

if TYPE_CHECKING:
    from pathlib import Path

    from tests.integration.server import Running

SONG: dict[str, Any] = {"song": ("s.wav", song())}


def test_another_player_is_chosen_at_upload_and_later(client: httpx.Client) -> None:
    made = upload(client, scale(8), **SONG)
    assert made.body["player"] == "trumpeter"
    assert set(made.body["players"]) >= {"trumpeter", "soloist"}
    changed = made.change("PATCH", json={"player": "soloist"}).raise_for_status().json()
    assert changed["player"] == "soloist"
    manifest = client.get(f"{made.path}/manifest").raise_for_status().json()
    assert [skeleton["rig"] for skeleton in manifest["skeletons"]] == ["soloist", "trumpet"]
    assert manifest["links"]["rigs"].keys() == {"soloist", "trumpet"}


def test_nobody_else_can_be_chosen(client: httpx.Client) -> None:
    made = upload(client, scale(8), **SONG)
    refused = made.change("PATCH", json={"player": "drummer"})
    assert refused.status_code == 422
    assert "there is no player 'drummer'; there are trumpeter, soloist" in refused.json()["detail"]
    assert client.get(made.path).json()["player"] == "trumpeter"
    files = {"score": ("s.mid", scale(8))}
    assert client.post("/api/v1/sessions", files=files, data={"player": "../x"}).status_code == 422


def test_the_soloist_plays_as_exactly_as_the_trumpeter(client: httpx.Client) -> None:
    made = upload(client, scale(32), **SONG)
    made.change("PATCH", json={"player": "soloist"}).raise_for_status()
    one = take(client, made.id, 0.0, made.body["duration_s"])
    player, trumpet = one.skeleton("soloist"), one.skeleton("trumpet")
    for entry in trumpet.rig["buttons"]:
        valve = one.parameters[f"trumpet/valve/{entry['valve']}"][:, 0]
        pad = player.named("effectors", entry["effector"])
        apart = np.linalg.norm(pad - button(trumpet, one, entry["valve"]), axis=1)
        assert (valve == 1.0).any()
        assert apart[valve > 0].max() <= 0.0005
        assert apart.max() <= 0.008
    apart = np.linalg.norm(player.named("contacts", "lips") - trumpet.named("contacts", "mouthpiece"), axis=1)
    assert apart[one.sounding].max() <= 0.001
    for sole in ("leftSole", "rightSole"):
        place = player.named("contacts", sole)
        assert np.abs(place - place[0]).max() <= 0.001
    for index, joint in enumerate(player.rig["joints"]):
        if "limits" in joint:
            assert excess(joint, Rotation.from_quat(one.local["player"][:, index])) <= 3e-5, joint["name"]


def test_who_watches_is_told_what_the_frames_now_hold(server: Running, client: httpx.Client) -> None:
    made = upload(client, scale(8), **SONG)

    async def told() -> tuple[dict[str, Any], dict[str, Any]]:
        async with watch(server, made.id) as viewer:
            change = asyncio.to_thread(made.change, "PATCH", json={"player": "soloist"})
            (await change).raise_for_status()
            await viewer.until(lambda: viewer.of_type("hello"))
            return viewer.hello, viewer.of_type("hello")[0]

    first, second = asyncio.run(told())
    assert [hello["skeletons"][0]["rig"] for hello in (first, second)] == ["trumpeter", "soloist"]
    assert second["frame_size"] == first["frame_size"]


def test_the_choice_outlives_the_server(tmp_path: Path) -> None:
    with serve(tmp_path) as before, httpx.Client(base_url=before.address, timeout=30) as client:
        made = upload(client, scale(8), **SONG)
        made.change("PATCH", json={"player": "soloist"}).raise_for_status()
    with serve(tmp_path) as after, httpx.Client(base_url=after.address, timeout=30) as client:
        assert client.get(made.path).json()["player"] == "soloist"
