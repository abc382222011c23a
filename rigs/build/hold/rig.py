"""Reads rig.json and computes forward kinematics for a pose of local quaternions."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

if TYPE_CHECKING:
    from pathlib import Path

Array = NDArray[np.float64]
Pose = dict[str, Array]  # joint → local rotation matrix (3, 3), rest included


@dataclass
class Rig:
    """A rig's rest pose: parents.

    Local translations (3,) and local rotations (3, 3) by joint, parents first.
    """

    content: dict[str, Any]
    parents: dict[str, str | None]
    translations: dict[str, Array]
    rests: dict[str, Array]

    @classmethod
    def read(cls, path: Path) -> Rig:
        """Read a rig.json."""
        content = json.loads(path.read_text(encoding="utf-8"))
        joints = content["joints"]
        return cls(
            content,
            {j["name"]: j["parent"] for j in joints},
            {j["name"]: np.array(j["translation"]) for j in joints},
            {j["name"]: Rotation.from_quat(j["rotation"]).as_matrix() for j in joints},
        )

    def contact(self, name: str) -> tuple[str, Array]:
        """A contact's joint and its offset (3,)."""
        found = next(c for c in self.content["contacts"] if c["name"] == name)
        return found["joint"], np.array(found["offset"])

    def effector(self, name: str) -> tuple[str, Array]:
        """An effector's joint and its offset (3,)."""
        found = next(e for e in self.content["effectors"] if e["name"] == name)
        return found["joint"], np.array(found["offset"])

    def world(self, pose: Pose, root: Array | None = None) -> dict[str, tuple[Array, Array]]:
        """World rotation (3, 3) and position (3,) of each joint; joints not in `pose` rest."""
        result: dict[str, tuple[Array, Array]] = {}
        for name, parent in self.parents.items():
            local = pose.get(name, self.rests[name])
            if parent is None:
                result[name] = local, self.translations[name] if root is None else root
            else:
                turn, place = result[parent]
                result[name] = turn @ local, place + turn @ self.translations[name]
        return result


def turn(order: str, *angles_rad: float) -> Array:
    """A rotation matrix R_a(α)·R_b(β)…; `order` names the carried axes, as "yzx"."""
    matrix: Array = Rotation.from_euler(order.upper(), angles_rad).as_matrix()
    return matrix
