"""The measures that all clothes are cut from, and cloth laid over the body."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from body.joint_names import SIDES
from common.meshes import Flags, Mesh, normals, on_border, smoothed, welded

if TYPE_CHECKING:
    from body.figure import Figure
    from body.skeleton import Skeleton

Array = NDArray[np.float64]

LEG_PARTS = ("UpperLeg", "LowerLeg", "Foot", "Toes")


@dataclass
class Tailor:
    """The figure, its skeleton and skin weights.

    And the helper surface `tights` that lies close over the body.
    """

    figure: Figure
    skeleton: Skeleton
    weights: Array
    tights: Mesh

    @classmethod
    def measure(cls, figure: Figure, skeleton: Skeleton, weights: Array) -> Tailor:
        """Lay the tights over the figure."""
        faces = figure.mesh.triangles(["helper-tights"])
        return cls(figure, skeleton, weights, welded(Mesh(figure.vertices, weights, faces).compact()))

    def at(self, joint: str) -> Array:
        """A joint's rest position (3,) in metres."""
        return self.skeleton.positions[joint]

    @property
    def neck_y(self) -> float:
        """Height of the neck joint, metres."""
        return float(self.at("neck")[1])

    def column(self, joint: str) -> int:
        """The joint's column in weights."""
        return self.skeleton.names.index(joint)

    def weight_of(self, weights: Array, *joints: str) -> Array:
        """The summed weight (V,) that rows of `weights` give to these joints."""
        total: Array = weights[:, [self.column(joint) for joint in joints]].sum(axis=1)
        return total

    def leg_weight(self, weights: Array) -> Array:
        """The summed weight (V,) of both legs."""
        return self.weight_of(weights, *(f"{side}{part}" for side, _ in SIDES for part in LEG_PARTS))

    def forearm(self, vertices: Array, weights: Array, side: str) -> tuple[Flags, Array]:
        """Which vertices belong to a forearm, and how far along it (0 elbow … 1 wrist) each lies."""
        elbow, wrist = self.at(f"{side}LowerArm"), self.at(f"{side}Hand")
        along = (vertices - elbow) @ (wrist - elbow) / ((wrist - elbow) @ (wrist - elbow))
        hand = [name for name in self.skeleton.names if name.startswith(side) and _is_hand(name[len(side) :])]
        arm = self.weight_of(weights, f"{side}LowerArm", f"{side}LowerArmTwist1", *hand)
        return arm > 0.5, along

    def cloth(self, keep: Flags, offset_m: float, drape: int, subdivisions: int = 1) -> Mesh:
        """The tights where `keep`, held `offset_m` off the body, smoothed `drape` rounds, never sunk in."""
        mesh = self.tights.where(keep)
        for _ in range(subdivisions):
            mesh = mesh.subdivided()
        border = on_border(len(mesh.vertices), mesh.faces)
        body = smoothed(mesh.vertices, mesh.faces, 3, border)
        out = normals(body, mesh.faces)
        cloth = body + out * offset_m
        if drape:
            cloth = smoothed(cloth, mesh.faces, drape, border)
            sunk = np.maximum(0, offset_m - ((cloth - body) * out).sum(axis=1))
            cloth = smoothed(cloth + out * sunk[:, None], mesh.faces, 2, border)
        mesh.vertices = cloth
        return mesh

    def rigid(self, count: int, **shares: float) -> Array:
        """Weights (count, J) that are the same for every vertex: `rigid(n, neck=0.4, upperChest=0.6)`."""
        weights = np.zeros((count, len(self.skeleton.names)))
        for joint, share in shares.items():
            weights[:, self.column(joint)] = share
        return weights


def borrowed_weights(points: Array, cloth: Mesh) -> Array:
    """Weights (N, J) for points that lie on a cloth: of its four nearest vertices, by nearness."""
    distance, index = cKDTree(cloth.vertices).query(points, k=4)
    near = 1 / (distance + 1e-4)
    near /= near.sum(axis=1, keepdims=True)
    weights: Array = (cloth.weights[index] * near[..., None]).sum(axis=1)
    return weights


def _is_hand(part: str) -> bool:
    return part.startswith(("Hand", "Thumb", "Index", "Middle", "Ring", "Little"))
