"""Fingers on valves and lips on the mouthpiece, from frames alone, on every example."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.integration.stranger import button, take

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx
    from tests.integration.stranger import Take

EXAMPLES = sorted(
    path
    for path in (Path(__file__).parents[2] / "examples" / "scores").iterdir()
    if path.suffix in {".mid", ".json"}
)
DOWN = 0.999
"""A valve at this value or more is down."""


@pytest.fixture(scope="module", params=EXAMPLES, ids=lambda path: path.stem)
def played(request: pytest.FixtureRequest, client: httpx.Client) -> Iterator[Take]:
    """All frames of an example, played by a new session."""
    path: Path = request.param
    session = client.post("/api/v1/sessions", files={"score": (path.name, path.read_bytes())})
    assert session.status_code == 201, session.text
    body = session.json()
    yield take(client, body["id"], 0.0, body["duration_s"] + 1.0)
    client.delete(
        f"/api/v1/sessions/{body['id']}", headers={"Authorization": f"Bearer {body['control_token']}"}
    ).raise_for_status()


@pytest.mark.parametrize("valve", [1, 2, 3])
def test_the_pad_is_on_the_button_whenever_its_valve_is_down(played: Take, valve: int) -> None:
    player, trumpet = played.skeleton("trumpeter"), played.skeleton("trumpet")
    effector = next(entry["effector"] for entry in trumpet.rig["buttons"] if entry["valve"] == valve)
    apart_m = np.linalg.norm(player.named("effectors", effector) - button(trumpet, played, valve), axis=1)
    down = played.parameters[f"trumpet/valve/{valve}"][:, 0] >= DOWN
    assert apart_m[down].max(initial=0.0) <= 0.001
    # Between notes the finger rests on the cap or a few millimetres above it.
    assert apart_m.max() <= 0.008


def test_the_lips_are_on_the_mouthpiece_while_a_note_sounds(played: Take) -> None:
    player, trumpet = played.skeleton("trumpeter"), played.skeleton("trumpet")
    apart_m = np.linalg.norm(
        player.named("contacts", "lips") - trumpet.named("contacts", "mouthpiece"), axis=1
    )
    assert played.sounding.any()
    assert apart_m[played.sounding].max() <= 0.001


def test_quaternions_are_unit_and_the_feet_stay(played: Take) -> None:
    for quaternions in played.local.values():
        assert np.abs(np.linalg.norm(quaternions, axis=-1) - 1.0).max() < 1e-6
    player = played.skeleton("trumpeter")
    for sole in ("leftSole", "rightSole"):
        points = player.named("contacts", sole)
        assert np.linalg.norm(points - points[0], axis=1).max() <= 0.001


def test_no_joint_leaves_its_limits(played: Take) -> None:
    from scipy.spatial.transform import Rotation

    player = played.skeleton("trumpeter")
    quaternions = played.local[next(name for name, pose in played.poses.items() if pose is player)]
    for index, joint in enumerate(player.rig["joints"]):
        limits = joint.get("limits")
        if limits is None:
            continue
        delta = Rotation.from_quat(joint["rotation"]).inv() * Rotation.from_quat(quaternions[:, index])
        # Intrinsic axes in the limits' order; scipy writes those in capitals.
        angles = delta.as_euler(limits["order"].upper())
        for axis, angle in zip(limits["order"], angles.T, strict=True):
            low, high = limits[axis]
            assert angle.min() >= low - 1e-4, (joint["name"], axis)
            assert angle.max() <= high + 1e-4, (joint["name"], axis)
