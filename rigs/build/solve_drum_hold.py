"""Solve how a player sits at the drum kit with sticks in hand, and write rigs/<player>/holds/drumkit.json.

Not part of a normal build: its result is committed as data. Run it after a change of either rig.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from common.rig_file import write_json
from hold.arm import Arm, ArmPose
from hold.rig import Rig
from hold.seated import HEEL_UP_DEG, Footing, sit
from hold.stick_grip import StickGrip, lacking
from hold.stick_grips import HandGrips
from solve_hold import RIGS, whole_pose

if TYPE_CHECKING:
    from hold.rig import Pose
    from hold.stance import Stance

Array = NDArray[np.float64]

TOES_OUT_DEG = {"left": 24.0, "right": 10.0}
OVER_SNARE_M = 0.05
"""How far over the snare the tips are held."""
APART_M = 0.05
"""How far each tip is from the snare's middle."""
STICKS_DOWN_DEG = 12.0
"""How far the sticks point down."""
STICKS_IN_DEG = (36.0, 12.0)
"""How far they point to one another, at best, and how much more or less costs as much as a bent wrist."""
SWIVEL_RAD = (0.35, 0.3)
"""How far the elbows are out from hanging straight down, likewise."""
BENT_DEG = np.array([25.0, 10.0])
"""How much flexion and deviation of the wrist cost as much."""


def footings(kit: Rig) -> dict[str, Footing]:
    """The balls of the feet on the boards of the pedals, as they are unpressed."""
    world = kit.world({})
    result: dict[str, Footing] = {}
    for side, out in TOES_OUT_DEG.items():
        joint, offset = kit.contact(f"{side}Pedal")
        turn, place = world[joint]
        result[side] = Footing(place + turn @ offset, np.radians(out), np.radians(HEEL_UP_DEG))
    return result


def hold_stick(rig: Rig, kit: Rig, stick: Rig, side: str, stance: Stance) -> tuple[Pose, dict[str, Any]]:
    """Local rotations of arm and hand with the stick over the snare, and the stick's place in the hand."""
    outward = 1.0 if side == "left" else -1.0
    grip = StickGrip.solve(rig, side)
    print(*lacking(rig, side, grip), sep="\n")
    back = np.array([0.0, 1.0, 0.0]) - grip.direction * grip.direction[1]
    held = np.column_stack([np.cross(back / np.linalg.norm(back), grip.direction), back, grip.direction])
    zone = next(z for z in kit.content["zones"] if (z["piece"], z["zone"]) == ("snare", "centre"))
    turn, place = kit.world({})[zone["joint"]]
    tip = place + turn @ (np.array(zone["position"]) + OVER_SNARE_M * np.array(zone["normal"]))
    tip[0] += outward * APART_M
    arm = Arm(rig, side, rig.world(stance.pose, stance.hips)["upperChest"])

    def reach(x: Array) -> ArmPose:
        aside, down = float(np.radians(x[0])), float(np.radians(STICKS_DOWN_DEG))
        ahead = np.array(
            [-outward * np.sin(aside) * np.cos(down), -np.sin(down), np.cos(aside) * np.cos(down)]
        )
        up = np.array([0.0, 1.0, 0.0]) - ahead * ahead[1]
        up /= np.linalg.norm(up)
        pointing: Array = np.stack([np.cross(up, ahead), up, ahead], axis=1).astype(np.float64)
        hand = np.asarray(np.matmul(pointing, held.T), dtype=np.float64)
        fulcrum = tip - pointing @ stick.effector(f"{side}StickTip")[1]
        return arm.reach(fulcrum - hand @ grip.fulcrum, hand, float(x[1]), np.zeros(2))

    def cost(x: Array) -> Array:
        best, width = np.array([STICKS_IN_DEG, SWIVEL_RAD]).T
        return np.r_[np.degrees(reach(x).wrist[1:]) / BENT_DEG, (x - best) / width, reach(x).lacking * 1000.0]

    found = least_squares(cost, [STICKS_IN_DEG[0], SWIVEL_RAD[0]], x_scale=[10.0, 0.3])
    reached = reach(found.x)
    print(f"{side} stick {found.x[0]:.0f} degrees inward, elbow {found.x[1]:.2f} out")
    print(
        f"{side} wrist twist, flexion, deviation",
        np.degrees(reached.wrist).round(1),
        f"lacks {1000 * reached.lacking:.1f} mm",
    )
    attachment = {
        "joint": f"{side}Hand",
        "position": grip.fulcrum.tolist(),
        "rotation": Rotation.from_matrix(held).as_quat().tolist(),
    }
    return {**reached.local, **grip.pose}, attachment


def both_hands(player: Rig) -> dict[str, list[dict[str, Any]]]:
    """What hands do with sticks beside holding them as in the pose: keys of each grip, both hands together.

    A joint that a key leaves out is as in the key before.
    """
    hands = {side: HandGrips(player, side).all() for side in ("left", "right")}
    result: dict[str, list[dict[str, Any]]] = {}
    for name, keys in hands["left"].items():
        result[name] = []
        before: dict[str, list[float]] = {}
        for pair in zip(keys, hands["right"][name], strict=True):
            by_side = dict(zip(("left", "right"), pair, strict=True))
            local = {joint: turn for key in pair for joint, turn in key.pose.items()}
            pose = {joint: Rotation.from_matrix(turn).as_quat().tolist() for joint, turn in local.items()}
            entry: dict[str, Any] = {
                "share": pair[0].share,
                "pose": {joint: turn for joint, turn in pose.items() if before.get(joint) != turn},
                "attachments": {f"{side}_stick": key.attachment(side) for side, key in by_side.items()},
                "points": {f"{side}_stick": key.point.tolist() for side, key in by_side.items()},
            }
            faces = {f"{side}_stick": key.faces for side, key in by_side.items()}
            if pair[0].faces is not None:
                entry["faces"] = {
                    side: {"along": both[0].tolist(), "out": both[1].tolist()}
                    for side, both in faces.items()
                    if both is not None
                }
            result[name].append(entry)
            before = pose
    return result


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rigs", type=Path, default=RIGS, help="the folder of rigs")
    parser.add_argument("--player", default="soloist", help="the player's rig")
    arguments = parser.parse_args()
    folder: Path = arguments.rigs
    player, kit = (Rig.read(folder / name / "rig.json") for name in (arguments.player, "drumkit"))
    stance = sit(player, float(kit.contact("seat")[1][1]), footings(kit))
    pose, attachments = dict(stance.pose), {}
    for side in ("left", "right"):
        stick = Rig.read(folder / f"{side}_stick" / "rig.json")
        arm, attachments[f"{side}_stick"] = hold_stick(player, kit, stick, side, stance)
        pose.update(arm)
    holds = folder / arguments.player / "holds"
    holds.mkdir(exist_ok=True)
    hold = {
        "instrument": "drumkit",
        "player": arguments.player,
        "pose": whole_pose(player, pose),
        "instrument_pose": {"position": [0.0, 0.0, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0]},
        "attachments": attachments,
        "hips": stance.hips.tolist(),
        "grips": both_hands(player),
    }
    write_json(holds / "drumkit.json", hold)


if __name__ == "__main__":
    main()
