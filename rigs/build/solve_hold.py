"""Solve how a player holds an instrument, and write rigs/<player>/holds/<instrument>.json.

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
from hold.grip import DEG, MM, VALVES_FROM_LIPS_M, Grip
from hold.left_hand import LeftHand
from hold.report import report
from hold.rig import Pose, Rig, turn
from hold.right_hand import RightHand
from hold.stance import Stance, stand

if TYPE_CHECKING:
    from collections.abc import Sequence

Array = NDArray[np.float64]

RIGS = Path(__file__).resolve().parents[1]
PITCH_DOWN_DEG = 8.0
STEP_M = 0.015
"""How much nearer a short horn comes between one search and the next."""
WRIST_DEG = 16.0
"""A wrist that is bent by more is wrung."""
FOREARM_M = 0.0
"""How deep a forearm may lie in the instrument."""
STARTS = 6
"""Searches from scattered starts; the best counts."""


def place_instrument(player: Rig, instrument: Rig, stance: Stance) -> tuple[Array, Array]:
    """The instrument's world rotation (3, 3) and position (3,).

    Rim on the lips, bell a little below horizontal.
    """
    joint, offset = player.contact("lips")
    head, place = player.world(stance.pose, stance.hips)[joint]
    rotation = turn("x", np.radians(PITCH_DOWN_DEG))
    return rotation, place + head @ offset - rotation @ instrument.contact("mouthpiece")[1]


def search(hands: Sequence[RightHand] | Sequence[LeftHand], start: Array, label: str, starts: int) -> Array:
    """The best of several least-squares searches from scattered starts; the same every run.

    Each is for the first hand, and followed from each hand to the next. One that ends with a wrung wrist or
    the forearm in the instrument only counts where no other does better.
    """
    rng = np.random.default_rng(3)
    best = None
    for attempt in range(starts):
        spread = np.r_[np.full(3, 0.006), np.full(3, 0.12), 0.2, 0.02, 0.02, np.full(len(start) - 9, 0.12)]
        x = start + (rng.normal(0, 1, len(start)) * spread if attempt else 0)
        cost = np.inf
        for hand in hands:
            scale = np.maximum(spread, 0.02)
            found = least_squares(hand.residuals, x, method="trf", x_scale=scale, max_nfev=120)
            x, cost = np.asarray(found.x), float(found.cost)
        grip = hands[-1].grip
        _, flexion, deviation = np.abs(grip.reach(x)[2].wrist * DEG)
        depth = grip.forearm_depth(x)
        unnatural = bool(max(flexion, deviation) > WRIST_DEG or depth > FOREARM_M)
        print(
            f"{label} start {attempt}: cost {cost:.3f}, wrist {flexion:.1f} and {deviation:.1f} degrees,",
            f"forearm {1000 * depth:.1f} mm in metal",
        )
        if best is None or (unnatural, cost) < best[:2]:
            best = unnatural, cost, x
    assert best is not None
    return best[2]


def solve_right(grips: Sequence[Grip], instrument: Rig, starts: int) -> Pose:
    """The right arm and hand, with the last grip."""
    buttons = np.array([b["position"] for b in instrument.content["buttons"]])
    thumb, hook = instrument.contact("thumb_right")[1], instrument.contact("hook")[1]
    hands = [RightHand(grip, buttons, thumb, hook) for grip in grips]
    x = search(hands, right_hand.START, "right", starts)
    hand, grip = hands[-1], grips[-1]
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


def solve_left(grips: Sequence[Grip], instrument: Rig, starts: int) -> Pose:
    """The left arm and hand, with the last grip."""
    ring, saddle = instrument.contact("ring")[1], instrument.contact("saddle")[1]
    third = instrument.content["buttons"][2]["position"]
    casing = instrument.contact("grip_left")[1][0]
    slide = np.array([-0.004, -0.034, 0.040])
    hands = [LeftHand(grip, ring, saddle, slide, third[2], casing) for grip in grips]
    x = search(hands, left_hand.START, "left", starts)
    hand, grip = hands[-1], grips[-1]
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


def grips_of(
    player: Rig, side: str, stance: Stance, place: tuple[Array, Array], instrument: Rig
) -> list[Grip]:
    """Grips on the instrument: as far from the lips as a trumpet first, then in small steps at its place.

    A short horn is near the body, and a search that begins there ends with an arm wrung round itself.
    """
    rotation, position = place
    away = -float(instrument.contact("mouthpiece")[1][2])
    farther = max(VALVES_FROM_LIPS_M - away, 0.0)
    obstacles = Obstacles(instrument.content["capsules"])
    steps = np.linspace(farther, 0.0, int(np.ceil(farther / STEP_M - 1e-6)) + 1)
    return [
        Grip(player, side, stance, (rotation, position + rotation[:, 2] * ahead), obstacles, away + ahead)
        for ahead in steps.tolist()
    ]


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rigs", type=Path, default=RIGS, help="the folder of rigs")
    parser.add_argument("--player", default="trumpeter", help="the player's rig")
    parser.add_argument("--instrument", default="trumpet", help="the instrument's rig")
    parser.add_argument("--starts", type=int, default=STARTS, help="how many searches for each hand")
    arguments = parser.parse_args()
    folder: Path = arguments.rigs
    holds = folder / arguments.player / "holds"
    player = Rig.read(holds.parent / "rig.json")
    instrument = Rig.read(folder / arguments.instrument / "rig.json")
    stance = stand(player)
    place = place_instrument(player, instrument, stance)
    pose = dict(stance.pose)
    for side, solve in (("right", solve_right), ("left", solve_left)):
        grips = grips_of(player, side, stance, place, instrument)
        pose.update(solve(grips, instrument, arguments.starts))
    quaternions = whole_pose(player, pose)
    hold = {
        "instrument": arguments.instrument,
        "player": arguments.player,
        "pose": quaternions,
        "instrument_pose": {
            "position": place[1].tolist(),
            "rotation": Rotation.from_matrix(place[0]).as_quat().tolist(),
        },
        "hips": stance.hips.tolist(),
    }
    holds.mkdir(exist_ok=True)
    write_json(holds / f"{arguments.instrument}.json", hold)
    report(player, instrument, hold)


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
