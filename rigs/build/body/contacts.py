"""Where the player touches things, and capsules that stand for the body.

Contacts are lips, soles and palms; capsules serve collision tests.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from body.joint_names import FINGERS, PHALANGES, SIDES
from common.raycast import ray_distances

if TYPE_CHECKING:
    from body.figure import Figure
    from body.skeleton import Skeleton

Array = NDArray[np.float64]

RIM_RADIUS_M = 0.0118
PLAYING_MOUTH = {"mouthPucker": 0.36, "mouthPress": 0.45}  # morphs while a note sounds
RIM_PRESS_M = 0.0012  # how far the rim sinks into the lips' softness
THICKEST_DIGIT_M = 0.0120
PITCH_DOWN_RAD = float(np.radians(10.0))  # of the mouthpiece from the head, as it is held


def lips_contact(figure: Figure, lip_centre: Array) -> Array:
    """Where the middle of a mouthpiece's rim rests (3,), world.

    A circle laid against the mouth, pressed in a little.
    """
    faces = figure.mesh.triangles(["body"])
    playing = figure.vertices + sum(weight * figure.morphs[name] for name, weight in PLAYING_MOUTH.items())
    forward = np.array([0.0, -np.sin(PITCH_DOWN_RAD), np.cos(PITCH_DOWN_RAD)])
    up = np.cross(forward, [1.0, 0.0, 0.0])
    start = lip_centre + 0.05 * forward
    depths: list[float] = []
    for angle in np.linspace(0, 2 * np.pi, 24, endpoint=False):
        point = start + RIM_RADIUS_M * (np.cos(angle) * np.array([1.0, 0, 0]) + np.sin(angle) * up)
        depths.append(0.05 - ray_distances(point, -forward, playing, faces)[0])
    rest = float(np.percentile(depths, 70)) - RIM_PRESS_M
    return np.array([0.0, lip_centre[1], lip_centre[2]]) + rest * forward


def sole_contact(skeleton: Skeleton, side: str) -> Array:
    """A point under the ball of the foot and the arch, on the floor."""
    ankle, toes = skeleton.positions[f"{side}Foot"], skeleton.positions[f"{side}Toes"]
    middle = 0.45 * ankle + 0.55 * toes
    return np.array([middle[0], 0.0, middle[2]])


def palm_contact(skeleton: Skeleton, side: str) -> Array:
    """The hollow of the palm."""
    hand = skeleton.axes[f"{side}Hand"]
    middle = 0.4 * skeleton.positions[f"{side}Hand"] + 0.6 * skeleton.positions[f"{side}MiddleProximal"]
    palm: Array = middle - 0.014 * hand[:, 1]
    return palm


def contacts(figure: Figure, skeleton: Skeleton, lip_centre: Array) -> list[dict[str, Any]]:
    """The player's contacts, each with its joint and its offset in that joint's frame."""
    places = {"lips": ("head", lips_contact(figure, lip_centre))}
    for side, _ in SIDES:
        places[f"{side}Sole"] = (f"{side}Foot", sole_contact(skeleton, side))
        places[f"{side}Palm"] = (f"{side}Hand", palm_contact(skeleton, side))
    return [
        {"name": name, "joint": joint, "offset": skeleton.to_local(joint, point).tolist()}
        for name, (joint, point) in places.items()
    ]


def capsules(figure: Figure, skeleton: Skeleton, weights: Array) -> list[dict[str, Any]]:
    """Fingers and thumbs from the mesh's own thickness; palms, arms, head and torso by measure."""
    result: list[dict[str, Any]] = []
    body = weights[: len(figure.body)]

    def add(joint: str, start: Array, end: Array, radius: float) -> None:
        ends = (skeleton.to_local(joint, p).tolist() for p in (start, end))
        first, second = ends
        result.append({"joint": joint, "from": first, "to": second, "radius": float(radius)})

    def thickness(joint: str, start: Array, end: Array, share: float) -> float:
        rows = body[:, skeleton.names.index(joint)] > 0.6
        points, bone = figure.body[rows], end - start
        t = np.clip((points - start) @ bone / (bone @ bone), 0, 1)[:, None]
        return float(np.percentile(np.linalg.norm(points - start - t * bone, axis=1), share))

    p = skeleton.positions
    for side, _ in SIDES:
        for digit in (*FINGERS, "Thumb"):
            parts = PHALANGES if digit != "Thumb" else ("Metacarpal", "Proximal", "Distal")
            joints = [f"{side}{digit}{part}" for part in parts]
            tip = skeleton.effectors[f"{side}{digit}Tip"][1]
            for joint, following in zip(joints, [*joints[1:], None], strict=True):
                radius = thickness(joint, p[joint], tip if following is None else p[following], 50)
                radius = min(radius, THICKEST_DIGIT_M)  # the ball of the thumb is flesh and gives way
                end = p[following] if following else tip + skeleton.axes[joint][:, 1] * radius * 0.95
                add(joint, p[joint], end, radius)
        hand, up = f"{side}Hand", skeleton.axes[f"{side}Hand"][:, 1]
        for finger, radius in (("Index", 0.0125), ("Middle", 0.0125), ("Ring", 0.012), ("Little", 0.0115)):
            root = 0.75 * p[hand] + 0.25 * p[f"{side}{finger}Proximal"]
            add(hand, root - 0.003 * up, p[f"{side}{finger}Proximal"] - 0.004 * up, radius)
        add(f"{side}LowerArm", p[f"{side}LowerArm"], p[hand], 0.036)
        add(f"{side}UpperArm", p[f"{side}UpperArm"], p[f"{side}LowerArm"], 0.050)
        add(f"{side}UpperLeg", p[f"{side}UpperLeg"], p[f"{side}LowerLeg"], 0.070)
        add(f"{side}LowerLeg", p[f"{side}LowerLeg"], p[f"{side}Foot"], 0.050)
    head = p["head"]
    add("head", head + np.array([0, 0.045, 0.005]), head + np.array([0, 0.105, 0.005]), 0.080)
    add("neck", p["neck"], head, 0.052)
    add("upperChest", p["upperChest"] + [-0.05, 0.06, 0], p["upperChest"] + [0.05, 0.06, 0], 0.105)
    add("chest", p["chest"] + [-0.03, 0, 0.01], p["chest"] + [0.03, 0, 0.01], 0.100)
    add("hips", p["hips"] + [-0.05, 0, 0], p["hips"] + [0.05, 0, 0], 0.115)
    return result
