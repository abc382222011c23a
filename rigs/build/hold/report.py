"""Says in numbers how well a hold fits: pads, lips, soles, and what passes through the metal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from hold.collision import Obstacles, along_bones

if TYPE_CHECKING:
    from hold.rig import Rig

Array = NDArray[np.float64]


def report(player: Rig, instrument: Rig, hold: dict[str, Any]) -> None:
    """Print the fit of a hold as it would be written."""
    pose = {name: Rotation.from_quat(q).as_matrix() for name, q in hold["pose"].items()}
    world = player.world(pose, np.array(hold["hips"]))
    turn = Rotation.from_quat(hold["instrument_pose"]["rotation"]).as_matrix()
    place = np.array(hold["instrument_pose"]["position"])

    def in_instrument(joint: str, offset: Any) -> Array:
        rotation, position = world[joint]
        point: Array = turn.T @ (position + rotation @ np.asarray(offset) - place)
        return point

    lips = in_instrument(*player.contact("lips"))
    print(
        "lips to rim, mm:", round(1000 * float(np.linalg.norm(lips - instrument.contact("mouthpiece")[1])), 4)
    )
    for button in instrument.content["buttons"]:
        gap = np.linalg.norm(in_instrument(*player.effector(button["effector"])) - button["position"])
        print(button["effector"], "to button, mm:", round(1000 * float(gap), 4))
    for side in ("left", "right"):
        joint, offset = player.contact(f"{side}Sole")
        print(
            side,
            "sole's height, mm:",
            round(1000 * float((world[joint][1] + world[joint][0] @ offset)[1]), 3),
        )
    obstacles = Obstacles(instrument.content["capsules"])
    for side in ("left", "right"):
        for digit in ("Thumb", "Index", "Middle", "Ring", "Little"):
            pad = in_instrument(*player.effector(f"{side}{digit}Tip"))
            print(
                side,
                digit,
                "pad at mm",
                np.round(pad * 1000, 1).tolist(),
                "from metal",
                round(1000 * float(obstacles.clearance(pad[None])[0]), 2),
            )
    for capsule in player.content["capsules"]:
        if not capsule["joint"].startswith(("left", "right")) or "Leg" in capsule["joint"]:
            continue
        ends = np.array([in_instrument(capsule["joint"], capsule[end]) for end in ("from", "to")])
        points, radii = along_bones(ends, np.array([capsule["radius"]]), 6)
        depth = float((radii - obstacles.clearance(points)).max())
        if depth > 0.001:
            print("inside metal:", capsule["joint"], round(depth * 1000, 2), "mm")
