"""A short bob: a cap over the scalp and locks of hair laid over it, on the head joint."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from common.meshes import Mesh, joined, normals
from common.shapes import tube

if TYPE_CHECKING:
    from body.figure import Figure
    from dress.tailor import Tailor

Array = NDArray[np.float64]

SEED = 7


@dataclass
class Scalp:
    """The head as radii from a centre (3,), by direction; `eye_y` is the eyes' height."""

    centre: Array
    eye_y: float
    directions: cKDTree
    radii: Array

    @classmethod
    def of(cls, tailor: Tailor) -> Scalp:
        """Measure the head."""
        figure = tailor.figure
        head = figure.body[tailor.weights[: len(figure.body), tailor.column("head")] > 0.5]
        eye_y = float(figure.centre("helper-l-eye")[1])
        centre = np.array([0.0, eye_y + 0.020, (head[:, 2].max() + head[:, 2].min()) / 2 - 0.012])
        offsets = head - centre
        radii = np.linalg.norm(offsets, axis=1)
        return cls(centre, eye_y, cKDTree(offsets / radii[:, None]), radii)

    def radius(self, direction: Array) -> float:
        """The head's radius in a direction (3,), metres."""
        distance, index = self.directions.query(direction / np.linalg.norm(direction), k=8)
        near = 1 / (distance + 0.02) ** 2
        return float((self.radii[index] * near).sum() / near.sum())


@dataclass
class Lock:
    """One lock: azimuth (0 is the front), polar angles from the crown, then a free fall of `drop_m`."""

    azimuth: float
    start: float
    end: float
    lift_m: float
    width_m: float
    drop_m: float = 0.0
    curl_m: float = 0.0
    swing: float = 0.0
    out_m: float = 0.0
    flat: float = 0.42
    blunt: float = 0.6

    def mesh(self, scalp: Scalp, steps: int, sides: int) -> tuple[Array, NDArray[np.int64], Array]:
        """The lock as a tube: vertices, faces, texture coordinates."""
        hanging = 0.62
        path: list[Array] = []
        up: list[Array] = []
        for t in np.linspace(0, 1, steps):
            polar = self.start + (self.end - self.start) * (min(1.0, t / hanging) if self.drop_m > 0 else t)
            azimuth = self.azimuth + self.swing * t
            d = np.array([np.sin(polar) * np.sin(azimuth), np.cos(polar), np.sin(polar) * np.cos(azimuth)])
            lift = self.lift_m * (0.35 + 0.65 * np.sin(min(1.0, t * 1.5) * np.pi / 2))
            point = scalp.centre + d * (scalp.radius(d) + lift)
            if self.drop_m > 0 and t > hanging:
                k = (t - hanging) / (1 - hanging)
                outward = np.array([np.sin(self.azimuth), 0, np.cos(self.azimuth)])
                aside = np.array([np.cos(self.azimuth), 0, -np.sin(self.azimuth)])
                fall = outward * (self.out_m * np.sin(k * np.pi * 0.9) - self.curl_m * k * k)
                point = (
                    path[int(hanging * (steps - 1))]
                    + [0, -self.drop_m * k, 0]
                    + fall
                    + aside * self.swing * 0.05 * k
                )
            path.append(point)
            up.append((point - scalp.centre) / np.linalg.norm(point - scalp.centre))
        t_all = np.linspace(0, 1, steps)
        radius = (
            self.width_m * np.clip(0.55 + 0.9 * t_all, 0, 1) * np.clip((1 - t_all) * 2.6, 0, 1) ** self.blunt
            + 0.0004
        )
        return tube(np.array(path), radius, np.array(up), sides, self.flat)


def _side_and_back_locks(rng: np.random.Generator, share: float) -> list[Lock]:
    locks: list[Lock] = []
    for lift, count, length in ((0.010, 30, 1.0), (0.016, 26, 0.95), (0.021, 20, 0.86)):
        number = max(8, round(count * share))
        for i in range(number):
            azimuth = 0.85 + (2 * np.pi - 1.7) * (i + 0.5) / number + rng.uniform(-0.06, 0.06)
            drop = (0.105 if np.cos(azimuth) > -0.2 else 0.115) * length * rng.uniform(0.94, 1.06)
            start, end, width = (
                rng.uniform(0.10, 0.35),
                1.62 + rng.uniform(-0.05, 0.05),
                rng.uniform(0.013, 0.017),
            )
            curl, swing, out = rng.uniform(0.020, 0.034), rng.uniform(-0.10, 0.10), rng.uniform(0.003, 0.008)
            locks.append(Lock(azimuth, start, end, lift, width / share**0.8, drop, curl, swing, out))
    return locks


def _fringe(rng: np.random.Generator, share: float) -> list[Lock]:
    """Layers of fine strands of uneven length down to the brows.

    Swept apart at a parting, longer at the temples.
    """
    locks: list[Lock] = []
    parting = 0.22
    for lift, count, extra in ((0.0125, 30, 0.03), (0.0155, 26, 0.0), (0.0180, 20, -0.04)):
        number = max(9, round(count * share))
        for i in range(number):
            a = -1.06 + 2.08 * (i + 0.5) / number + rng.uniform(-0.035, 0.035)
            length = 1.475 + 0.13 * a * a + extra + rng.uniform(-0.055, 0.045)
            sweep = (
                0.16 * a
                + 0.05 * np.sign(a - parting) * np.exp(-(((a - parting) / 0.22) ** 2))
                + rng.uniform(-0.03, 0.03)
            )
            width = rng.uniform(0.0066, 0.0098) / share**0.9
            start = 0.20 + rng.uniform(-0.05, 0.05)
            locks.append(Lock(a * 0.86, start, length, lift, width, swing=sweep, flat=0.30, blunt=1.0))
    return locks


def _temple_locks() -> list[Lock]:
    locks: list[Lock] = []
    for sign in (1, -1):
        locks.append(Lock(sign * 1.02, 0.3, 1.50, 0.014, 0.0125, 0.10, 0.004, -sign * 0.06))
        locks.append(Lock(sign * 1.18, 0.3, 1.55, 0.017, 0.0125, 0.105, 0.012, -sign * 0.05))
    return locks


def _cap(tailor: Tailor, scalp: Scalp) -> Mesh:
    """The scalp under the locks, cut at the hairline and clear of the ears."""
    figure: Figure = tailor.figure
    faces = figure.mesh.triangles(["body"])
    on_head = tailor.weights[:, tailor.column("head")] > 0.5
    mesh = Mesh(figure.vertices, tailor.weights, faces).where(on_head)
    v = mesh.vertices
    azimuth = np.arctan2(v[:, 0], v[:, 2] - scalp.centre[2])
    turn = [0, 0.6, 1.0, 1.35, 1.75, 2.3, 3.2]
    line = scalp.eye_y + np.interp(np.abs(azimuth), turn, [0.060, 0.055, 0.030, 0.010, -0.010, -0.06, -0.075])
    head_x = np.abs(figure.body[on_head[: len(figure.body)], 0])
    ear = (np.abs(azimuth) > 1.2) & (np.abs(azimuth) < 2.0) & (np.abs(v[:, 0]) > np.percentile(head_x, 96))
    mesh.vertices = v + normals(v, mesh.faces) * 0.006
    mesh = mesh.clipped(np.where(ear, -1, mesh.vertices[:, 1] - line))
    mesh.uv = np.c_[np.arctan2(mesh.vertices[:, 0], mesh.vertices[:, 2]) * 0.8, mesh.vertices[:, 1] * 3]
    mesh.weights = tailor.rigid(len(mesh.vertices), head=1)
    return mesh


def bob(tailor: Tailor, steps: int, sides: int, share: float) -> tuple[Mesh, Array]:
    """The whole head of hair and its normals (V, 3).

    `share` is the part of the locks that a lower tier keeps (they grow wider).
    """
    rng = np.random.default_rng(SEED)
    scalp = Scalp.of(tailor)
    locks = _side_and_back_locks(rng, share) + _fringe(rng, share) + _temple_locks()
    meshes = [_cap(tailor, scalp)]
    for lock in locks:
        vertices, faces, uv = lock.mesh(scalp, steps, sides)
        meshes.append(Mesh(vertices, tailor.rigid(len(vertices), head=1), faces, uv))
    hair = _outside(joined(meshes), scalp)
    return hair, _soft_normals(hair, scalp)


def _outside(hair: Mesh, scalp: Scalp) -> Mesh:
    """Drop the faces that look at the head: locks hide them, and they would be lit wrongly."""
    a, b, c = (hair.vertices[hair.faces[:, k]] for k in range(3))
    facing = np.cross(b - a, c - a)
    outward = (a + b + c) / 3 - scalp.centre
    outward[:, 1] *= 0.6
    product = (facing * outward).sum(axis=1)
    lengths = np.linalg.norm(facing, axis=1) * np.linalg.norm(outward, axis=1)
    return replace(hair, faces=hair.faces[product > -0.3 * lengths]).compact()


def _soft_normals(hair: Mesh, scalp: Scalp) -> Array:
    """Each strand's own normals leaned toward the head's roundness, so that the hair is lit as one body."""
    outward = hair.vertices - scalp.centre
    outward[:, 1] *= 0.6  # below the ears the hair hangs like a curtain
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    own = normals(hair.vertices, hair.faces)
    blended = 0.55 * own + 0.6 * outward
    unit: Array = blended / np.linalg.norm(blended, axis=1, keepdims=True)
    return unit
