"""Poses of motion files as stances of a session."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import httpx
import numpy as np
import pytest
from tests.integration.scores import scale
from tests.integration.server import serve, upload
from tests.integration.stranger import take
from tests.unit.skeleton.figures import figure

from reina.skeleton import write_bvh

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tests.integration.server import Owned

BVH = write_bvh(figure("crouch", "Mixamo"))
ASKED: dict[str, Any] = {"name": "low one", "time_s": 0.1, "filename": "crouch.bvh"}
TRACK = {"keyframes": [{"time": 0, "value": "low one"}]}


@pytest.fixture
def piece(client: httpx.Client) -> Iterator[Owned]:
    made = upload(client, scale())
    yield made
    made.change("DELETE")


def choices(piece: Owned) -> list[str]:
    told = piece.client.get(f"{piece.path}/parameters").json()["parameters"]
    return next(one["choices"] for one in told if one["path"] == "player/stance")


def hips(piece: Owned) -> float:
    return float(np.mean(take(piece.client, piece.id, 0.0, 0.5).poses["player"].positions["hips"][:, 1]))


def test_a_stance_is_made_chosen_taken_away_and_made_again(piece: Owned) -> None:
    stood = hips(piece)
    built_in = choices(piece)
    answer = piece.change("POST", "/stances", params=ASKED, content=BVH)
    assert answer.status_code == 201
    assert answer.json() == {
        "name": "low one",
        "file": "crouch.bvh",
        "time_s": 0.1,
        "href": f"{piece.path}/stances/low%20one",
    }
    assert choices(piece) == [*built_in, "low one"]
    piece.change("PUT", "/show/tracks/player/stance", json=TRACK).raise_for_status()
    assert stood - hips(piece) > 0.08

    assert piece.change("DELETE", "/stances/low%20one").status_code == 204
    assert piece.client.get(f"{piece.path}/stances").json() == {"stances": []}
    # Its track is kept without effect, and says so; it is heard of again with the stance.
    assert abs(stood - hips(piece)) < 0.02
    told = [one for one in piece.client.get(piece.path).json()["warnings"] if one["kind"].startswith("show")]
    assert [(one["kind"], one["place"]) for one in told] == [("show-unknown-choice", "player/stance")]
    assert "low one" in told[0]["message"]
    tracks = piece.client.get(f"{piece.path}/show").json()["tracks"]
    assert (
        next(one for one in tracks if one["parameter"] == "player/stance")["keyframes"][0]["value"]
        == "low one"
    )
    piece.change("POST", "/stances", params=ASKED, content=BVH).raise_for_status()
    assert stood - hips(piece) > 0.08


def test_what_cannot_be_used_is_refused_with_what_and_where(piece: Owned) -> None:
    def refused(content: str = BVH, **changes: Any) -> tuple[int, str, str]:
        answer = piece.change("POST", "/stances", params={**ASKED, **changes}, content=content)
        problem = answer.json()
        return answer.status_code, problem["type"].rpartition(":")[2], problem["detail"]

    status, kind, detail = refused(time_s=9)
    assert (status, kind) == (422, "pose-unusable")
    assert detail == "9 s: there is no frame; the file has them from 0 to 0.10 s"
    status, kind, detail = refused(BVH.replace("LeftFoot", "Thing"))
    assert (status, kind) == (422, "pose-unusable")
    assert detail.startswith("the file has no joint for leftFoot; its joints are mixamorig:Hips")
    assert refused("no motion")[:2] == (422, "clip-unreadable")
    assert refused(name="swaying")[:2] == (409, "stance-name-taken")
    for name in ("", "a/b", " a", "a\n", "x" * 41):
        assert refused(name=name)[:2] == (422, "request-invalid"), name
    watching = httpx.post(f"{piece.client.base_url}{piece.path}/stances", params=ASKED, content=BVH)
    assert watching.status_code == 401
    gone = piece.change("DELETE", "/stances/none")
    assert (gone.status_code, gone.json()["type"]) == (404, "urn:reina:problem:unknown-stance")
    for number in range(16):
        named = {**ASKED, "name": f"s{number}"}
        piece.change("POST", "/stances", params=named, content=BVH).raise_for_status()
    assert refused()[:2] == (409, "too-many-stances")
    # One that is there is replaced.
    piece.change("POST", "/stances", params={**ASKED, "name": "s3"}, content=BVH).raise_for_status()


def test_stances_outlive_the_server(tmp_path: Path) -> None:
    with serve(tmp_path) as running, httpx.Client(base_url=running.address, timeout=30.0) as client:
        piece = upload(client, scale())
        piece.change("POST", "/stances", params=ASKED, content=BVH).raise_for_status()
        piece.change("PUT", "/show/tracks/player/stance", json=TRACK).raise_for_status()
        low, session = hips(piece), piece.id
    with serve(tmp_path) as running, httpx.Client(base_url=running.address, timeout=30.0) as client:
        again = client.get(f"/api/v1/sessions/{session}/stances").raise_for_status().json()
        assert [one["name"] for one in again["stances"]] == ["low one"]
        frames = take(client, session, 0.0, 0.5)
        assert abs(float(np.mean(frames.poses["player"].positions["hips"][:, 1])) - low) < 1e-6
