"""Skin weights (V, J).

The source's, moved to the skeleton's joints, with twist helpers and re-laid fingers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.finger_weights import lay_finger_weights
from body.joint_names import SIDES, source_bones
from common.meshes import smoothstep

if TYPE_CHECKING:
    from body.figure import Figure
    from body.skeleton import Skeleton

Array = NDArray[np.float64]

INFLUENCES = 4
MIN_WEIGHT = 0.01


def skin_weights(figure: Figure, skeleton: Skeleton) -> Array:
    """Weights of all source vertices, helper surfaces included; each row sums to one."""
    column = {name: k for k, name in enumerate(skeleton.names)}
    weights = np.zeros((len(figure.vertices), len(column)))
    source = figure.mesh.weights()
    for name, (_, bone) in source_bones().items():
        for vertex, weight in source.get(bone, []):
            weights[vertex, column[name]] += weight
    for vertex, weight in source.get("Root", []):
        weights[vertex, column["hips"]] += weight
    weights[weights.sum(axis=1) < 1e-6, column["hips"]] = 1
    weights /= weights.sum(axis=1, keepdims=True)
    for side, _ in SIDES:
        _split_twist(figure, skeleton, weights, f"{side}UpperArm", f"{side}LowerArm", helper_is_near=True)
        _split_twist(figure, skeleton, weights, f"{side}LowerArm", f"{side}Hand", helper_is_near=False)
        lay_finger_weights(figure, skeleton, weights, side)
    return weights


def _split_twist(
    figure: Figure, skeleton: Skeleton, weights: Array, bone: str, child: str, *, helper_is_near: bool
) -> None:
    """Share a bone's weight with its twist helper.

    The upper arm's near the shoulder, the lower arm's near the wrist.
    """
    column, helper = skeleton.names.index(bone), skeleton.names.index(f"{bone}Twist1")
    along = skeleton.positions[child] - skeleton.positions[bone]
    share = (figure.vertices - skeleton.positions[bone]) @ along / (along @ along)
    toward_child = (
        smoothstep((share - 0.12) / 0.62) if not helper_is_near else smoothstep((share - 0.30) / 0.55)
    )
    part = 1 - toward_child if helper_is_near else toward_child
    weights[:, helper] = weights[:, column] * part
    weights[:, column] *= 1 - part


def strongest(weights: Array) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
    """The four strongest joints of each vertex (V, 4) and their weights (V, 4), normalised.

    Unused ones are zero.
    """
    joints = np.argsort(-weights, axis=1, kind="stable")[:, :INFLUENCES]
    values = np.take_along_axis(weights, joints, axis=1)
    values[values < MIN_WEIGHT] = 0
    values /= np.maximum(values.sum(axis=1, keepdims=True), 1e-9)
    joints[values == 0] = 0
    return joints.astype(np.uint8), values.astype(np.float32)
