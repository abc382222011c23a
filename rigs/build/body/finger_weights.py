"""Skin weights of the hands, laid anew because the knuckles were moved to where a person has them.

Along a finger, weight passes from bone to bone across each joint by a smooth step; across the palm, the
skin between knuckles is shared by how near each metacarpal line is. The thumb keeps the source's weights.
"""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.joint_names import FINGERS, PHALANGES
from common.meshes import smoothed, smoothstep

if TYPE_CHECKING:
    from body.figure import Figure
    from body.skeleton import Skeleton

Array = NDArray[np.float64]

# Half widths in metres over which weight passes from one bone to the next.
BLEND_M = {"Proximal": 0.0120, "Intermediate": 0.0060, "Distal": 0.0050}
NEARNESS_POWER = 6.0


def lay_finger_weights(figure: Figure, skeleton: Skeleton, weights: Array, side: str) -> None:
    """Replace one hand's finger weights in place; `weights` is (V, J)."""
    index = {name: k for k, name in enumerate(skeleton.names)}
    hand = index[f"{side}Hand"]
    columns = {f: [index[f"{side}{f}{p}"] for p in PHALANGES] for f in FINGERS}
    all_columns = [hand] + [c for f in FINGERS for c in columns[f]]
    movable = weights[:, all_columns].sum(axis=1)
    rows = np.flatnonzero(movable > 1e-6)
    points = figure.vertices[rows]
    owned = np.column_stack([weights[np.ix_(rows, np.array(columns[f]))].sum(axis=1) for f in FINGERS])
    in_palm = np.maximum(1 - owned.sum(axis=1) / movable[rows], 0)[:, None]
    distance = np.column_stack([_distance_to_finger(skeleton, side, f, points) for f in FINGERS])
    near = (distance / distance.min(axis=1, keepdims=True)) ** -NEARNESS_POWER
    membership = near / near.sum(axis=1, keepdims=True) * in_palm + owned / movable[rows, None]
    membership /= membership.sum(axis=1, keepdims=True)
    laid = np.zeros((len(rows), len(index)))
    for k, finger in enumerate(FINGERS):
        steps = [_passed(skeleton, side, finger, p, points) for p in PHALANGES] + [np.zeros(len(rows))]
        laid[:, hand] += membership[:, k] * (1 - steps[0])
        for p, column in enumerate(columns[finger]):
            laid[:, column] += membership[:, k] * steps[p] * (1 - steps[p + 1])
    weights[np.ix_(rows, np.array(all_columns))] = laid[:, all_columns] * movable[rows, None]
    _smooth_hand(figure, weights, rows)


def _passed(skeleton: Skeleton, side: str, finger: str, phalanx: str, points: Array) -> Array:
    """How far (0…1) each point lies beyond a joint, across the plane that halves the joint's rest angle."""
    joint = f"{side}{finger}{phalanx}"
    outward = skeleton.axes[joint][:, 0]
    if phalanx == "Proximal":
        inward = skeleton.axes[f"{side}Hand"][:, 0]
    else:
        inward = skeleton.axes[skeleton.parents[joint] or ""][:, 0]
    normal = (outward + inward) / np.linalg.norm(outward + inward)
    half = BLEND_M[phalanx]
    step: Array = smoothstep(((points - skeleton.positions[joint]) @ normal + half) / (2 * half))
    return step


def _distance_to_finger(skeleton: Skeleton, side: str, finger: str, points: Array) -> Array:
    """Distance (N,) from each point to the line wrist – knuckle – middle joint – outer joint – pad."""
    chain = [skeleton.positions[f"{side}{finger}{p}"] for p in PHALANGES]
    start = 0.35 * skeleton.positions[f"{side}Hand"] + 0.65 * chain[0]
    path = [start, *chain, skeleton.effectors[f"{side}{finger}Tip"][1]]
    best = np.full(len(points), np.inf)
    for a, b in itertools.pairwise(path):
        t = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)[:, None]
        best = np.minimum(best, np.linalg.norm(points - a - t * (b - a), axis=1))
    return np.maximum(best, 1e-4)


def _smooth_hand(figure: Figure, weights: Array, rows: NDArray[np.int64]) -> None:
    """Two gentle rounds of smoothing over the hand's skin, so that neighbouring vertices agree."""
    faces = figure.mesh.triangles(["body"])
    inside = np.zeros(len(weights), dtype=bool)
    inside[rows] = True
    local = np.full(len(weights), -1, dtype=np.int64)
    used = np.unique(faces[inside[faces].any(axis=1)])
    local[used] = np.arange(len(used))
    part = local[faces[inside[faces].any(axis=1)]]
    fixed = ~inside[used]
    weights[used] = smoothed(weights[used], part, 2, fixed)
