"""Solve how a player holds the trumpet, and write rigs/<player>/holds/trumpet.json.

Slow, and not part of a normal build: its result is committed as data. Run it after a change of either rig.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from common.rig_file import write_json
from hold import left_hand, right_hand
from hold.collision import Obstacles
from hold.grip import DEG, MM, Grip
from hold.left_hand import LeftHand
from hold.report import report
from hold.rig import Pose, Rig, turn
from hold.right_hand import RightHand
from hold.stance import Stance, stand

if TYPE_CHECKING:
    from collections.abc import Callable

Array = NDArray[np.float64]

RIGS = Path(__file__).resolve().parents[1]
PITCH_DOWN_DEG = 8.0
STARTS = 6
"""Searches from scattered starts; the best counts."""


def place_trumpet(player: Rig, trumpet: Rig, stance: Stance) -> tuple[Array, Array]:
    """The trumpet's world rotation (3, 3) and position (3,).

    Rim on the lips, bell a little below horizontal.
    """
    joint, offset = player.contact("lips")
    head, place = player.world(stance.pose, stance.hips)[joint]
    rotation = turn("x", np.radians(PITCH_DOWN_DEG))
    return rotation, place + head @ offset - rotation @ trumpet.contact("mouthpiece")[1]


def search(residuals: Callable[[Array], Array], start: Array, label: str, starts: int) -> Array:
    """The best of several least-squares searches from scattered starts; the same every run."""
    rng = np.random.default_rng(3)
    best = None
    for attempt in range(starts):
        spread = np.r_[np.full(3, 0.006), np.full(3, 0.12), 0.2, 0.02, 0.02, np.full(len(start) - 9, 0.12)]
        guess = start + (rng.normal(0, 1, len(start)) * spread if attempt else 0)
        found = least_squares(residuals, guess, method="trf", x_scale=np.maximum(spread, 0.02), max_nfev=120)
        print(f"{label} start {attempt}: cost {found.cost:.3f}")
        if best is None or found.cost < best.cost:
            best = found
    assert best is not None
    return np.asarray(best.x)


def solve_right(grip: Grip, trumpet: Rig, starts: int) -> Pose:
    """The right arm and hand."""
    buttons = np.array([b["position"] for b in trumpet.content["buttons"]])
    hand = RightHand(grip, buttons, trumpet.contact("thumb_right")[1], trumpet.contact("hook")[1])
    x = search(hand.residuals, right_hand.START, "right", starts)
    rotation, position, arm = grip.reach(x)
    angles, lacking = hand.fingers(rotation, position)
    print("right hand", np.round(x, 4).tolist())
    print(
        "  wrist twist, flexion, deviation",
        np.round(arm.wrist * DEG, 1),
        "elbow",
        np.round(arm.elbow - grip.shoulder, 3),
    )
    for finger, rows, gaps in zip(grip.fingers, angles, lacking, strict=True):
        print(
            f"  {finger.name}", np.round(rows * DEG, 1).tolist(), "lacks mm", np.round(gaps * MM, 3).tolist()
        )
    return grip.pose(arm, [rows[0] for rows in angles], x[9:14])


def solve_left(grip: Grip, trumpet: Rig, starts: int) -> Pose:
    """The left arm and hand."""
    ring, saddle = trumpet.contact("ring")[1], trumpet.contact("saddle")[1]
    third = trumpet.content["buttons"][2]["position"]
    casing = trumpet.contact("grip_left")[1][0]
    hand = LeftHand(grip, ring, saddle, np.array([-0.004, -0.034, 0.040]), third[2], casing)
    x = search(hand.residuals, left_hand.START, "left", starts)
    arm = grip.reach(x)[2]
    print("left hand", np.round(x, 4).tolist())
    print(
        "  wrist twist, flexion, deviation",
        np.round(arm.wrist * DEG, 1),
        "elbow",
        np.round(arm.elbow - grip.shoulder, 3),
    )
    for finger, row in zip(grip.fingers, hand.angles(x), strict=True):
        print(f"  {finger.name}", np.round(row * DEG, 1).tolist())
    return grip.pose(arm, hand.angles(x), x[9:14])


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rigs", type=Path, default=RIGS, help="the folder of rigs")
    parser.add_argument("--player", default="trumpeter", help="the player's rig")
    parser.add_argument("--starts", type=int, default=STARTS, help="how many searches for each hand")
    arguments = parser.parse_args()
    folder: Path = arguments.rigs
    holds = folder / arguments.player / "holds"
    player, trumpet = Rig.read(holds.parent / "rig.json"), Rig.read(folder / "trumpet" / "rig.json")
    stance = stand(player)
    instrument = place_trumpet(player, trumpet, stance)
    obstacles = Obstacles(trumpet.content["capsules"])
    pose = dict(stance.pose)
    pose.update(solve_right(Grip(player, "right", stance, instrument, obstacles), trumpet, arguments.starts))
    pose.update(solve_left(Grip(player, "left", stance, instrument, obstacles), trumpet, arguments.starts))
    quaternions = whole_pose(player, pose)
    hold = {
        "instrument": "trumpet",
        "player": arguments.player,
        "pose": quaternions,
        "instrument_pose": {
            "position": instrument[1].tolist(),
            "rotation": Rotation.from_matrix(instrument[0]).as_quat().tolist(),
        },
        "hips": stance.hips.tolist(),
    }
    holds.mkdir(exist_ok=True)
    write_json(holds / "trumpet.json", hold)
    report(player, trumpet, hold)


def whole_pose(player: Rig, pose: Pose) -> dict[str, list[float]]:
    """Every joint's whole local quaternion, nearest to its rest's sign, twist helpers included."""
    result: dict[str, list[float]] = {}
    for name, rest in player.rests.items():
        quaternion = Rotation.from_matrix(pose.get(name, rest)).as_quat()
        rest_quaternion = np.array(next(j["rotation"] for j in player.content["joints"] if j["name"] == name))
        result[name] = (quaternion if quaternion @ rest_quaternion >= 0 else -quaternion).tolist()
    for twist in player.content["twists"]:
        source = Rotation.from_matrix(
            player.rests[twist["source"]].T @ pose.get(twist["source"], player.rests[twist["source"]])
        )
        x, _, _, w = source.as_quat()
        angle = 2 * np.arctan2(x, w)
        angle = (angle + np.pi) % (2 * np.pi) - np.pi
        half = angle * twist["fraction"] / 2
        helper = Rotation.from_matrix(player.rests[twist["joint"]]) * Rotation.from_quat(
            [np.sin(half), 0, 0, np.cos(half)]
        )
        result[twist["joint"]] = helper.as_quat().tolist()
    return result


if __name__ == "__main__":
    main()
