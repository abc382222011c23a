"""How horns are held: lips at the rim, pads on buttons over the whole stroke, both hands at the metal."""

from __future__ import annotations

import itertools
import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from reina.instruments import INSTRUMENTS

Array = NDArray[np.float64]

RIGS = Path(__file__).resolve().parents[3] / "rigs"
MARGIN_RAD = np.radians(3.0)


def matrix(quaternion: Any) -> Array:
    """A rotation matrix from x, y, z, w."""
    x, y, z, w = np.asarray(quaternion) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def item(items: list[dict[str, Any]], name: str) -> dict[str, Any]:
    return next(entry for entry in items if entry["name"] == name)


@dataclass
class Held:
    player: dict[str, Any]
    instrument: dict[str, Any]
    hold: dict[str, Any]
    world: dict[str, tuple[Array, Array]]

    def in_instrument(self, joint: str, offset: Any) -> Array:
        rotation, place = self.world[joint]
        pose = self.hold["instrument_pose"]
        point: Array = matrix(pose["rotation"]).T @ (place + rotation @ np.asarray(offset) - pose["position"])
        return point


def is_blown(instrument: str) -> bool:
    """Whether an instrument is held to the mouth."""
    rig = json.loads((RIGS / instrument / "rig.json").read_text(encoding="utf-8"))
    return any(contact["name"] == "mouthpiece" for contact in rig["contacts"])


HOLDS = tuple(
    sorted((path.parents[1].name, path.stem) for path in RIGS.glob("*/holds/*.json") if is_blown(path.stem))
)


def test_every_player_holds_every_instrument() -> None:
    players = {player for player, _ in HOLDS}
    assert len(players) >= 2
    horns = [name for name, one in INSTRUMENTS.items() if one.rig and is_blown(one.rig)]
    assert set(HOLDS) == {(player, instrument) for player in players for instrument in horns}


@cache
def held_by(name: str, horn: str) -> Held:
    player = json.loads((RIGS / name / "rig.json").read_text(encoding="utf-8"))
    instrument = json.loads((RIGS / horn / "rig.json").read_text(encoding="utf-8"))
    hold = json.loads((RIGS / name / "holds" / f"{horn}.json").read_text(encoding="utf-8"))
    world: dict[str, tuple[Array, Array]] = {}
    for joint in player["joints"]:
        local = matrix(hold["pose"][joint["name"]])
        if joint["parent"] is None:
            world[joint["name"]] = local, np.array(hold["hips"])
        else:
            rotation, place = world[joint["parent"]]
            world[joint["name"]] = rotation @ local, place + rotation @ np.array(joint["translation"])
    return Held(player, instrument, hold, world)


@pytest.fixture(params=HOLDS, ids="-".join)
def held(request: pytest.FixtureRequest) -> Held:
    """Every player with every instrument."""
    return held_by(*request.param)


def test_pose_names_every_joint_with_a_unit_quaternion_on_the_rest_poses_side(held: Held) -> None:
    h = held
    assert set(h.hold["pose"]) == {joint["name"] for joint in h.player["joints"]}
    for joint in h.player["joints"]:
        quaternion = np.array(h.hold["pose"][joint["name"]])
        assert np.linalg.norm(quaternion) == pytest.approx(1, abs=1e-8)
        assert quaternion @ joint["rotation"] >= 0


def test_mouthpiece_is_at_the_lips(held: Held) -> None:
    h = held
    lips = item(h.player["contacts"], "lips")
    rim = item(h.instrument["contacts"], "mouthpiece")["offset"]
    assert np.linalg.norm(h.in_instrument(lips["joint"], lips["offset"]) - rim) < 0.0002


@pytest.mark.parametrize("side", ["left", "right"])
def test_feet_stand_flat_on_the_floor(held: Held, side: str) -> None:
    h = held
    sole = item(h.player["contacts"], f"{side}Sole")
    rotation, place = h.world[sole["joint"]]
    assert (place + rotation @ np.array(sole["offset"]))[1] == pytest.approx(0, abs=0.001)
    assert rotation[1, 1] == pytest.approx(1, abs=1e-6)


def test_bell_points_forward_and_a_little_down(held: Held) -> None:
    bell = matrix(held.hold["instrument_pose"]["rotation"])[:, 2]
    assert 4 < np.degrees(np.arcsin(-bell[1])) < 9
    assert bell[2] > 0.98


@pytest.mark.parametrize("valve", [1, 2, 3])
def test_pads_lie_on_their_buttons(held: Held, valve: int) -> None:
    h = held
    button = h.instrument["buttons"][valve - 1]
    effector = item(h.player["effectors"], button["effector"])
    assert (
        np.linalg.norm(h.in_instrument(effector["joint"], effector["offset"]) - button["position"]) < 0.0005
    )


@pytest.mark.parametrize("valve", [1, 2, 3])
@pytest.mark.parametrize("stroke", [-0.25, 0.0, 0.25, 0.5, 0.75, 1.0])
def test_fingers_reach_their_buttons_within_limits_over_the_whole_stroke(
    held: Held, valve: int, stroke: float
) -> None:
    """`stroke` is the valve's value; −0.25 is about 4 mm above the cap."""
    h = held
    button = h.instrument["buttons"][valve - 1]
    name = button["effector"].removesuffix("Tip")
    joints = {joint["name"]: joint for joint in h.player["joints"]}
    chain = item(h.player["chains"], name)
    parts = [joints[joint] for joint in chain["joints"]]
    target = np.array(button["position"]) + stroke * np.array(button["travel"])
    instrument = h.hold["instrument_pose"]
    world = matrix(instrument["rotation"]) @ target + instrument["position"]
    hand_rotation, hand_place = h.world["rightHand"]
    knuckle = hand_place + hand_rotation @ np.array(parts[0]["translation"])
    local = (hand_rotation @ matrix(parts[0]["rotation"])).T @ (world - knuckle)
    lengths = [
        parts[1]["translation"][0],
        parts[2]["translation"][0],
        item(h.player["effectors"], f"{name}Tip")["offset"][0],
    ]
    theta2 = coupled_angle(lengths, chain["kappa"], float(np.linalg.norm(local)))
    outer = theta2 * (1 + chain["kappa"])
    bend = np.arctan2(
        lengths[1] * np.sin(theta2) + lengths[2] * np.sin(outer),
        lengths[0] + lengths[1] * np.cos(theta2) + lengths[2] * np.cos(outer),
    )
    from_rest = {
        (0, "y"): np.arctan2(-local[2], local[0]),
        (0, "z"): np.arctan2(local[1], np.hypot(local[0], local[2])) - bend,
        (1, "z"): theta2 - rest_turn(parts[1]),
        (2, "z"): theta2 * chain["kappa"] - rest_turn(parts[2]),
    }
    assert abs(from_rest[0, "y"]) < np.radians(13)
    for (k, axis), angle in from_rest.items():
        low, high = parts[k]["limits"][axis]
        assert low + MARGIN_RAD <= angle <= high - MARGIN_RAD, (parts[k]["name"], axis, np.degrees(angle))


def rest_turn(joint: dict[str, Any]) -> float:
    return float(2 * np.arctan2(joint["rotation"][2], joint["rotation"][3]))


def coupled_angle(lengths: list[float], kappa: float, distance: float) -> float:
    """θ2 for which knuckle and pad are `distance` apart, by halving; fails when the pad cannot reach."""
    l1, l2, l3 = lengths

    def reach(theta2: float) -> float:
        outer = theta2 * (1 + kappa)
        return float(
            np.hypot(l1 + l2 * np.cos(theta2) + l3 * np.cos(outer), l2 * np.sin(theta2) + l3 * np.sin(outer))
        )

    low, high = np.radians(-135.0), 0.0
    assert reach(low) < distance < reach(high)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if reach(middle) < distance else (low, middle)
    return float((low + high) / 2)


def test_every_joint_is_within_its_limits(held: Held) -> None:
    h = held
    for joint in h.player["joints"]:
        limits = joint.get("limits")
        if limits:
            turn = Rotation.from_quat(joint["rotation"]).inv() * Rotation.from_quat(
                h.hold["pose"][joint["name"]]
            )
            for axis, angle in zip(limits["order"], turn.as_euler(limits["order"].upper()), strict=True):
                low, high = limits[axis]
                assert low - 1e-6 <= angle <= high + 1e-6, (joint["name"], axis, np.degrees(angle))


def clearance(instrument: dict[str, Any], point: Array) -> float:
    """Distance from the nearest of the instrument's capsules, negative inside."""
    best = np.inf
    for capsule in instrument["capsules"]:
        start, bone = np.array(capsule["from"]), np.subtract(capsule["to"], capsule["from"])
        t = np.clip((point - start) @ bone / max(bone @ bone, 1e-12), 0, 1)
        best = min(best, float(np.linalg.norm(point - start - t * bone)) - capsule["radius"])
    return best


@pytest.mark.parametrize(
    "pad",
    ["leftThumbTip", "leftIndexTip", "leftMiddleTip", "leftLittleTip", "rightThumbTip", "rightLittleTip"],
)
def test_gripping_pads_touch_the_metal(held: Held, pad: str) -> None:
    h = held
    effector = item(h.player["effectors"], pad)
    assert abs(clearance(h.instrument, h.in_instrument(effector["joint"], effector["offset"]))) < 0.002


def test_left_thumb_lies_in_the_saddle_and_the_ring_finger_in_the_ring(held: Held) -> None:
    h = held
    thumb = item(h.player["effectors"], "leftThumbTip")
    saddle = np.array(item(h.instrument["contacts"], "saddle")["offset"])
    assert np.linalg.norm(h.in_instrument(thumb["joint"], thumb["offset"]) - saddle) < 0.003
    ring = np.array(item(h.instrument["contacts"], "ring")["offset"])
    tip = item(h.player["effectors"], "leftRingTip")
    chain = [h.in_instrument(f"leftRing{part}", np.zeros(3)) for part in ("Intermediate", "Distal")]
    chain.append(h.in_instrument(tip["joint"], tip["offset"]))
    gaps: list[float] = []
    for a, b in itertools.pairwise(chain):
        t = np.clip((ring - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        gaps.append(float(np.linalg.norm(a + t * (b - a) - ring)))
    assert min(gaps) < 0.004


@pytest.mark.parametrize("finger", ["leftIndex", "leftMiddle", "leftLittle"])
def test_left_fingers_wrap_the_third_casing(held: Held, finger: str) -> None:
    """Round its front to its right side, every joint bent, the tip turned back toward the palm."""
    h = held
    tip = item(h.player["effectors"], f"{finger}Tip")
    pad = h.in_instrument(tip["joint"], tip["offset"])
    outer = h.in_instrument(f"{finger}Distal", np.zeros(3))
    assert h.in_instrument(f"{finger}Proximal", np.zeros(3))[0] > 0.02
    assert pad[0] < 0
    assert (pad - outer)[2] < -0.004
    for part, low, high in (("Intermediate", -88, -40), ("Distal", -45, -12)):
        quaternion = h.hold["pose"][f"{finger}{part}"]
        assert low < np.degrees(2 * np.arctan2(quaternion[2], quaternion[3])) < high


@pytest.mark.parametrize("finger", ["rightIndex", "rightMiddle"])
def test_pressing_fingers_are_curved(held: Held, finger: str) -> None:
    quaternion = held.hold["pose"][f"{finger}Intermediate"]
    assert -70 <= np.degrees(2 * np.arctan2(quaternion[2], quaternion[3])) <= -40


@pytest.mark.parametrize("side", ["left", "right"])
def test_wrists_are_nearly_straight(held: Held, side: str) -> None:
    h = held
    rest = next(joint["rotation"] for joint in h.player["joints"] if joint["name"] == f"{side}Hand")
    turn = Rotation.from_quat(rest).inv() * Rotation.from_quat(h.hold["pose"][f"{side}Hand"])
    _, flexion, deviation = turn.as_euler("XZY", degrees=True)
    assert abs(flexion) < 15
    assert abs(deviation) <= 12


@pytest.mark.parametrize("joint", ["leftHand", "rightHand"])
def test_palms_stay_out_of_the_metal(held: Held, joint: str) -> None:
    h = held
    for capsule in h.player["capsules"]:
        if capsule["joint"] == joint:
            for t in np.linspace(0, 1, 7):
                along = (1 - t) * np.array(capsule["from"]) + t * np.array(capsule["to"])
                assert clearance(h.instrument, h.in_instrument(joint, along)) > capsule["radius"] - 0.003
