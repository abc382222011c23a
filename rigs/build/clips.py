"""Make the players' motion clips: three ways of standing, as BVH files that loop.

`python rigs/build/clips.py` writes rigs/<player>/clips; the same input gives the same bytes. A clip begins
and ends in the same neutral stance, so that what it does beside its first frame can be laid under playing.
Trunk and arms are written here, as waves of the time; legs are solved, so that the feet stay where they are.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import TwoBoneLimbs, minimum_jerk
from reina.rotations import conjugate, exp, multiply, rotate
from reina.skeleton import MotionClip, Rig, clip_of_motion, forward_kinematics, load_rig, write_bvh

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.rotations.arrays import FloatArray

RIGS = Path(__file__).resolve().parents[1]
FPS = 24
DECIMALS = 5
LEGS = ("leftLeg", "rightLeg")
LEFT_OUT = ("Eye", "Twist", "Thumb", "Index", "Middle", "Ring", "Little")
"""Joints with one of these in their names do not move in a stance and are not in its file."""

STANDING_M = (0.0, -0.014, 0.0)
"""How far below rest the hips stand, so that the knees are soft and the legs have something to give."""

HANGING: dict[str, tuple[float, float, float]] = {
    "leftUpperArm": (0.10, -0.06, -0.48),
    "rightUpperArm": (0.10, 0.06, 0.48),
    "leftFoot": (0.0, 0.10, 0.0),
    "rightFoot": (0.0, -0.10, 0.0),
}
"""Turns from rest that are the same all the time: arms hang at the sides, toes point out a little."""

BENT_RAD = {"leftLowerArm": -0.28, "rightLowerArm": 0.28}
"""Elbows are hinges about their own y and hang a little bent."""


@dataclass(frozen=True)
class Wave:
    """What one cause does to the body: turns and a shift of the hips, at 1.

    Turns are rotation vectors, radians, about the world's axes at rest: +x the player's left, +y up, +z
    ahead.
    """

    turns: dict[str, tuple[float, float, float]]
    hips_m: tuple[float, float, float] = (0.0, 0.0, 0.0)


BREATH = Wave(
    {
        "spine": (-0.006, 0.0, 0.0),
        "chest": (-0.018, 0.0, 0.0),
        "upperChest": (-0.014, 0.0, 0.0),
        "neck": (0.020, 0.0, 0.0),
        "head": (0.012, 0.0, 0.0),
        "leftShoulder": (0.0, -0.008, 0.030),
        "rightShoulder": (0.0, 0.008, -0.030),
        "leftUpperArm": (0.0, 0.0, 0.012),
        "rightUpperArm": (0.0, 0.0, -0.012),
    }
)
"""The chest full: it rises and opens, the head stays level, the arms are carried out a little."""

SIDE = Wave(
    {
        "hips": (0.0, 0.0, 0.006),
        "spine": (0.0, 0.0, -0.018),
        "chest": (0.0, 0.0, -0.014),
        "upperChest": (0.0, 0.0, -0.006),
        "neck": (0.0, 0.0, 0.014),
        "head": (0.0, 0.0, 0.010),
        "leftUpperArm": (0.0, 0.0, 0.018),
        "rightUpperArm": (0.0, 0.0, 0.018),
    },
    (0.016, -0.001, 0.0),
)
"""Swayed to the left: hips first, the trunk leaning after them, the head nearly upright."""

FORE = Wave(
    {
        "hips": (0.005, 0.0, 0.0),
        "spine": (0.004, 0.0, 0.0),
        "chest": (0.004, 0.0, 0.0),
        "neck": (-0.008, 0.0, 0.0),
        "leftUpperArm": (-0.014, 0.0, 0.0),
        "rightUpperArm": (-0.014, 0.0, 0.0),
    },
    (0.0, -0.001, 0.007),
)
"""Swayed forward over the balls of the feet."""

ABOUT = Wave(
    {
        "hips": (0.0, 0.010, 0.0),
        "spine": (0.0, 0.010, 0.0),
        "chest": (0.0, 0.012, 0.0),
        "upperChest": (0.0, 0.006, 0.0),
        "neck": (0.0, -0.010, 0.0),
        "head": (0.0, -0.012, 0.0),
    }
)
"""Turned to the left, the eyes kept ahead."""

WEIGHT = Wave(
    {
        "hips": (0.0, 0.020, 0.030),
        "spine": (0.0, -0.006, -0.034),
        "chest": (0.0, -0.008, -0.022),
        "upperChest": (0.0, -0.006, 0.004),
        "neck": (0.0, 0.0, 0.012),
        "head": (0.0, 0.0, 0.006),
        "leftShoulder": (0.0, 0.0, -0.012),
        "rightShoulder": (0.0, 0.0, -0.012),
    },
    (0.026, -0.006, -0.003),
)
"""The weight on the left leg: the hips over it and higher on its side, the trunk curved back above them."""


def turning(period_s: float, phase: float = 0.0) -> Callable[[FloatArray], FloatArray]:
    """A sine of a period."""
    return lambda times_s: np.sin(2.0 * np.pi * (times_s / period_s + phase))


def breathing(
    period_s: float, depths: tuple[float, ...], begin_s: float = 0.0
) -> Callable[[FloatArray], FloatArray]:
    """Breaths one after another: in over two fifths of the period, out over half, then a pause."""

    def value(times_s: FloatArray) -> FloatArray:
        count = np.floor((times_s - begin_s) / period_s)
        share = (times_s - begin_s) / period_s - count
        depth = np.array(depths)[count.astype(np.int64) % len(depths)]
        return depth * (minimum_jerk(share / 0.4) - minimum_jerk((share - 0.4) / 0.5))

    return value


def going(*moves: tuple[float, float, float]) -> Callable[[FloatArray], FloatArray]:
    """From rest to rest: begin and end of each move, seconds, and the value that it goes to; 0 before."""

    def value(times_s: FloatArray) -> FloatArray:
        found, last = np.zeros(len(times_s)), 0.0
        for begin_s, end_s, to in moves:
            found += (to - last) * minimum_jerk((times_s - begin_s) / (end_s - begin_s))
            last = to
        return found

    return value


@dataclass(frozen=True)
class Stance:
    """A clip to make: its length, and what moves it."""

    length_s: float
    waves: tuple[tuple[Wave, float, Callable[[FloatArray], FloatArray]], ...]
    """Wave, amount, value over time."""


STANCES: dict[str, Stance] = {
    "breathing": Stance(
        13.5,
        (
            (BREATH, 1.0, breathing(4.5, (1.0, 0.82, 1.12))),
            (FORE, 0.35, turning(6.75)),
            (SIDE, 0.25, turning(13.5)),
            (ABOUT, 0.25, turning(13.5, 0.5)),
        ),
    ),
    "swaying": Stance(
        14.4,
        (
            (SIDE, 1.0, turning(7.2)),
            (SIDE, 0.35, turning(14.4)),
            (ABOUT, 0.9, turning(14.4, 0.5)),
            (FORE, 0.7, turning(4.8)),
            (BREATH, 0.7, breathing(4.8, (1.0, 0.85, 1.05))),
        ),
    ),
    "shifting": Stance(
        21.6,
        (
            (WEIGHT, 0.8, going((0.6, 2.4, 0.85), (8.2, 10.6, -0.9), (13.0, 13.9, -0.75), (19.0, 21.2, 0.0))),
            (ABOUT, 0.6, going((1.4, 3.4, -1.0), (8.8, 11.2, 0.9), (18.2, 20.8, 0.0))),
            (FORE, 0.6, turning(7.2)),
            (SIDE, 0.2, turning(5.4)),
            (BREATH, 0.7, breathing(4.32, (1.0, 0.85, 1.05, 0.9, 1.1))),
        ),
    ),
}
"""By the file's name."""


def make(rig: Rig, stance: Stance) -> MotionClip:
    """The clip of a stance; its last frame is its first."""
    skeleton = rig.skeleton
    frames = round(stance.length_s * FPS)
    times_s = np.arange(frames + 1) / FPS
    times_s[-1] = 0.0
    _, rest = forward_kinematics(skeleton, skeleton.rest_rotations)
    turns = np.zeros((len(times_s), len(skeleton), 3))
    hips = np.tile(skeleton.rest_translations[0] + STANDING_M, (len(times_s), 1))
    for wave, amount, value in stance.waves:
        signal = amount * (value(times_s) - value(np.zeros(1)))
        for name, turn in wave.turns.items():
            turns[:, skeleton.index(name)] += signal[:, None] * turn
        hips += signal[:, None] * np.array(wave.hips_m)
    local = multiply(skeleton.rest_rotations, exp(rotate(conjugate(rest), turns)))
    for name, turn in HANGING.items():
        joint = skeleton.index(name)
        hanging = exp(rotate(conjugate(rest[joint]), np.array(turn)))
        local[:, joint] = multiply(
            multiply(skeleton.rest_rotations[joint], hanging),
            exp(rotate(conjugate(rest[joint]), turns[:, joint])),
        )
    for name, angle in BENT_RAD.items():
        joint = skeleton.index(name)
        local[:, joint] = multiply(skeleton.rest_rotations[joint], exp([0.0, angle, 0.0]))
    stand(rig, local, hips)
    clip = clip_of_motion(skeleton, local, hips, 1.0 / FPS)
    return without(clip, LEFT_OUT)


def stand(rig: Rig, local: FloatArray, hips: FloatArray) -> None:
    """Turn the legs so that the feet stay flat where they stand at rest."""
    skeleton = rig.skeleton
    standing = skeleton.rest_rotations.copy()
    for name in ("leftFoot", "rightFoot"):
        standing[skeleton.index(name)] = local[0, skeleton.index(name)]
    places, flat = forward_kinematics(skeleton, standing)
    begun, world = forward_kinematics(skeleton, local, hips)
    limbs = TwoBoneLimbs(rig, LEGS)
    upper, lower, foot = limbs.joints.T
    targets = np.broadcast_to(places[foot], (len(hips), len(LEGS), 3))
    ahead = np.broadcast_to(rotate(flat[upper], limbs.hinge), targets.shape)
    pose = limbs.solve(begun[:, upper], targets, ahead)
    if pose.status.any():
        raise ValueError("the legs do not reach the floor; let the hips stand lower")
    local[:, upper] = multiply(conjugate(world[:, skeleton.parents[upper]]), pose.upper)
    local[:, lower] = pose.lower_local
    local[:, foot] = multiply(conjugate(multiply(pose.upper, pose.lower_local)), flat[foot])


def without(clip: MotionClip, parts: tuple[str, ...]) -> MotionClip:
    """The clip without the joints that have one of these in their names; what is left are whole branches."""
    kept = [joint for joint, name in enumerate(clip.names) if not any(part in name for part in parts)]
    place = {joint: index for index, joint in enumerate(kept)}
    begins = np.cumsum([0, *(len(channels) for channels in clip.channels)]).tolist()
    columns = [column for joint in kept for column in range(begins[joint], begins[joint + 1])]
    return MotionClip(
        names=tuple(clip.names[joint] for joint in kept),
        parents=np.array([place.get(int(clip.parents[joint]), -1) for joint in kept], dtype=np.intp),
        offsets=clip.offsets[kept],
        end_sites=tuple(tuple(_ends(clip, joint, set(kept))) for joint in kept),
        channels=tuple(clip.channels[joint] for joint in kept),
        values=clip.values[:, columns],
        frame_time_s=clip.frame_time_s,
    )


def _ends(clip: MotionClip, joint: int, kept: set[int]) -> list[tuple[float, float, float]]:
    """Where a joint's bone ends: at the middle finger's root in a hand, else a little further on."""
    children = np.flatnonzero(clip.parents == joint).tolist()
    if any(child in kept for child in children):
        return []
    middle = [child for child in children if "MiddleProximal" in clip.names[child]]
    x, y, z = (clip.offsets[middle[0]] if middle else 0.5 * clip.offsets[joint]).tolist()
    return [(x, y, z)]


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rigs", type=Path, default=RIGS, help="where the rigs are")
    parser.add_argument("--player", default="trumpeter", help="the player's rig")
    arguments = parser.parse_args()
    folder: Path = arguments.rigs / arguments.player
    rig = load_rig(folder)
    (folder / "clips").mkdir(exist_ok=True)
    for name, stance in STANCES.items():
        clip = make(rig, stance)
        path = folder / "clips" / f"{name}.bvh"
        path.write_text(write_bvh(clip, decimals=DECIMALS), encoding="utf-8", newline="\n")
        print(f"{arguments.player}/clips/{path.name}: {len(clip)} frames, {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
