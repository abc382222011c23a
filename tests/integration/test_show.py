"""Programming the show while it runs."""

from __future__ import annotations

import asyncio
import json
import time
from typing import TYPE_CHECKING

import httpx
import numpy as np
import pytest
from tests.integration.scores import show
from tests.integration.watching import watch

from reina.protocol import FrameFlag, Manifest, decode

if TYPE_CHECKING:
    from tests.integration.server import Owned, Running

    from reina.protocol import Frames

LIGHT = "lights/key/intensity"
KEYS = f"/show/tracks/{LIGHT}/keyframes"


def value(manifest: Manifest, frames: Frames, path: str) -> list[float]:
    """A parameter's first float in each frame."""
    parameter = next(parameter for parameter in manifest.parameters if parameter.path == path)
    first = min(parameter.offset for parameter in manifest.parameters)
    column = (parameter.offset - first) // 4
    return [float(number) for number in frames["parameters"][:, column]]


def test_keyframes_are_added_changed_and_removed(owned: Owned) -> None:
    owned.change("PUT", "/show", json={"version": 1, "tracks": []}).raise_for_status()
    assert owned.client.get(f"{owned.path}{KEYS}").json() == {"keyframes": []}
    first = owned.change("POST", KEYS, json={"time": 0.0, "value": 1.0, "interpolation": "linear"})
    assert first.status_code == 201
    assert first.json() == {"key": "k1", "time": 0.0, "value": 1.0, "interpolation": "linear"}
    second = owned.change("POST", KEYS, json={"time": 2.0, "value": 3.0, "interpolation": "linear"}).json()
    assert second["key"] == "k2"
    taken = owned.change("POST", KEYS, json={"key": "k2", "time": 5.0, "value": 3.0})
    assert taken.status_code == 409
    changed = owned.change("PATCH", f"{KEYS}/k2", json={"value": 5.0})
    assert changed.json() == {**second, "value": 5.0}
    assert owned.client.get(f"{owned.path}{KEYS}/k2").json()["value"] == 5.0
    assert [key["key"] for key in owned.client.get(f"{owned.path}{KEYS}").json()["keyframes"]] == ["k1", "k2"]
    tracks = owned.client.get(f"{owned.path}/show").json()["tracks"]
    assert [track["parameter"] for track in tracks] == [LIGHT]
    assert owned.change("DELETE", f"{KEYS}/k1").status_code == 204
    assert owned.change("DELETE", f"{KEYS}/k1").status_code == 404
    assert owned.change("DELETE", f"{KEYS}/k2").status_code == 204
    assert owned.client.get(f"{owned.path}/show").json()["tracks"] == []


@pytest.mark.parametrize(
    ("method", "below", "body", "status", "told"),
    [
        ("POST", KEYS, {"time": 0, "value": "bright"}, 422, "bright"),
        ("POST", KEYS, {"time": 0, "value": 1e9}, 422, "out of range"),
        ("POST", KEYS, {"time": 0, "value": 1, "interpolation": "magic"}, 422, "magic"),
        ("POST", KEYS, {"value": 1}, 422, "time"),
        ("POST", KEYS, [1], 422, "body"),
        ("POST", "/show/tracks/lights/nowhere/keyframes", {"time": 0, "value": 1}, 404, "lights/nowhere"),
        ("PATCH", f"{KEYS}/k99", {"value": 1}, 404, "k99"),
        ("PATCH", f"{KEYS}/k1", {"key": "k2"}, 422, "key"),
        ("PUT", "/show", {"version": 2}, 422, "version"),
        ("PUT", "/show", {"version": 1, "tracks": 7}, 422, "list"),
    ],
)
def test_edits_that_cannot_be_are_refused_and_change_nothing(
    owned: Owned, method: str, below: str, body: object, status: int, told: str
) -> None:
    before = owned.client.get(f"{owned.path}/show").json()
    answer = owned.change(method, below, json=body)
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert told in answer.json()["detail"]
    assert owned.client.get(f"{owned.path}/show").json() == before


def test_an_edit_is_in_every_viewers_next_frames(server: Running, owned: Owned) -> None:
    async def scenario() -> None:
        async with watch(server, owned.id) as one, watch(server, owned.id) as two:
            played = await asyncio.to_thread(owned.control, "play")
            for watcher in (one, two):
                await watcher.frame(10, epoch=played["epoch"])
            before = time.monotonic()
            await asyncio.to_thread(
                lambda: owned.change("PUT", "/show", json=json.loads(show(7.25))).raise_for_status()
            )
            answered = time.monotonic()
            epoch = played["epoch"] + 1
            for watcher in (one, two):
                await watcher.until(lambda watcher=watcher: watcher.of_type("show_changed"))
                assert watcher.of_type("show_changed")[0]["path"] is None
                await watcher.frame(0, epoch=epoch)
                frames = watcher.frames
                edited = frames[frames["epoch"] == epoch % 256]
                assert set(value(watcher.manifest, edited, LIGHT)) == {7.25}
                assert edited["flags"][0] & FrameFlag.FIRST
                # The first edited frame is the one on screen when the edit was made.
                assert before - 2 / 60 <= edited["due_time_s"][0] <= answered
            await asyncio.to_thread(owned.control, "pause")

    asyncio.run(scenario())


def test_while_paused_an_edit_sends_one_frame(server: Running, owned: Owned) -> None:
    async def scenario() -> None:
        async with watch(server, owned.id) as watcher:
            await watcher.until(lambda: watcher.messages)
            for time_s in (100.0, 101.0, 102.0):
                added = {"time": time_s, "value": 2.0}
                answer = await asyncio.to_thread(owned.change, "POST", KEYS, json=added)
                answer.raise_for_status()
            await watcher.until(lambda: len(watcher.of_type("show_changed")) == 3)
            await watcher.until(lambda: len(watcher.messages) == 4)
            assert [told["path"] for told in watcher.of_type("show_changed")] == [LIGHT] * 3
            assert [told["revision"] for told in watcher.of_type("show_changed")] == [1, 2, 3]

    asyncio.run(scenario())


def test_edits_at_the_same_time_are_all_kept(server: Running, owned: Owned) -> None:
    owned.change("PUT", "/show", json={"version": 1, "tracks": []}).raise_for_status()

    async def scenario() -> list[int]:
        async with httpx.AsyncClient(base_url=server.address, timeout=30) as client:
            answers = await asyncio.gather(
                *(
                    client.post(
                        f"{owned.path}{KEYS}", json={"time": float(n), "value": 1.0}, headers=owned.headers
                    )
                    for n in range(12)
                )
            )
        return [answer.status_code for answer in answers]

    assert asyncio.run(scenario()) == [201] * 12
    keyframes = owned.client.get(f"{owned.path}{KEYS}").json()["keyframes"]
    assert sorted(key["time"] for key in keyframes) == [float(n) for n in range(12)]
    assert len({key["key"] for key in keyframes}) == 12


def test_frames_over_http_follow_the_show(owned: Owned) -> None:
    manifest = owned.client.get(f"{owned.path}/manifest").json()
    reader = Manifest.model_validate({name: manifest[name] for name in Manifest.model_fields})
    track = {
        "parameter": LIGHT,
        "keyframes": [
            {"key": "k1", "time": 0.0, "value": 0.0, "interpolation": "step"},
            {"key": "k2", "time": 1.0, "value": 2.0, "interpolation": "linear"},
        ],
    }
    document = {"version": 1, "time": "seconds", "tracks": [track]}
    owned.change("PUT", "/show", json=document).raise_for_status()
    for fps in (30, 60, 24):
        query = {"start_s": 0, "end_s": 1, "fps": fps}
        frames = decode(reader, owned.client.get(f"{owned.path}/frames", params=query).content)
        assert len(frames) == fps
        assert frames["song_time_s"] == pytest.approx(np.arange(fps) / fps)
        assert value(reader, frames, LIGHT) == pytest.approx(list(2 * np.arange(fps) / fps), abs=1e-6)


def test_every_parameter_is_described(owned: Owned) -> None:
    described = owned.client.get(f"{owned.path}/parameters").json()
    manifest = owned.client.get(f"{owned.path}/manifest").json()
    streamed = [parameter["path"] for parameter in manifest["parameters"]]
    assert streamed[: len(described["parameters"])] == [p["path"] for p in described["parameters"]]
    assert streamed[len(described["parameters"]) :] == [p["path"] for p in described["streamed"]]
    intensity = next(p for p in described["parameters"] if p["path"] == LIGHT)
    assert intensity["type"] == "number"
    assert intensity["documentation"]
    assert {"step", "linear", "quad_in"} <= set(intensity["interpolations"])
    assert {"step", "linear", "quad_in"} <= {i["name"] for i in described["interpolations"]}


def test_every_parameter_says_what_it_is_and_how_far_it_goes(owned: Owned) -> None:
    described = owned.client.get(f"{owned.path}/parameters").json()
    groups = {parameter["path"].partition("/")[0] for parameter in described["parameters"]}
    assert groups >= {"camera", "lights", "stage", "blocks", "player", "look"}
    for parameter in described["parameters"]:
        path = parameter["path"]
        assert parameter["documentation"].endswith("."), path
        assert bool(parameter["choices"]) == (parameter["type"] == "choice"), path
        if parameter["type"] in ("number", "vector"):
            values = np.atleast_1d(parameter["default"])
            assert np.all(parameter["minimum"] <= values), path
            assert np.all(values <= parameter["maximum"]), path
        # What is told as the default can be keyed as it stands, with any of the interpolations told.
        keyframes = [
            {"time": n, "value": parameter["default"], "interpolation": name}
            for n, name in enumerate(parameter["interpolations"])
        ]
        answer = owned.change("PUT", f"/show/tracks/{path}", json={"keyframes": keyframes})
        assert answer.status_code == 200, answer.text
    for interpolation in described["interpolations"]:
        assert interpolation["documentation"].endswith("."), interpolation["name"]
        assert all(option["documentation"] for option in interpolation["options"])
