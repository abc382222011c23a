"""A short bob on the head joint: a cap on the scalp, sheets that hang from it, and locks laid over both."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from common.meshes import Mesh, joined, normals
from common.shapes import grid_faces, tube

if TYPE_CHECKING:
    from body.figure import Figure
    from dress.tailor import Tailor

Array = NDArray[np.float64]

SEED = 7
STRANDS_V = 0.96  # below it the hair's picture is dark
TEMPLE_RAD = 0.86  # where the hair that hangs begins, from the front
PARTING_RAD = 0.36  # on her left
FRINGE = ((9, 0.0140, 1.0, 1.15), (6, 0.0178, 0.985, 0.95))  # locks, lift, length and width of its two layers
HAIRLINE = (
    (0, 0.060),
    (0.6, 0.055),
    (1.0, 0.030),
    (1.35, 0.010),
    (1.75, -0.010),
    (2.3, -0.06),
    (3.2, -0.075),
)
STRAY_RAD = (-0.70, -0.33, 0.02, 0.66)  # a few fine strands over the fringe


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
    """One lock: azimuth (0 is the front), polar angles from the crown, then a free fall of `drop_m`.

    It turns by `swing` on its way, `bow` later than evenly, and narrows to its tip from `taper` on.
    """

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
    bow: float = 1.0
    taper: float = 0.62
    tip: float = 0.6

    def path(self, scalp: Scalp, steps: int) -> tuple[Array, Array]:
        """The lock's middle (steps, 3) and the directions away from the head (steps, 3)."""
        hanging = 0.62 if self.drop_m > 0 else 1.0
        outward = np.array([np.sin(self.azimuth), 0, np.cos(self.azimuth)])
        aside = np.array([np.cos(self.azimuth), 0, -np.sin(self.azimuth)])
        path: list[Array] = []
        for t in np.linspace(0, 1, steps):
            lying = min(float(t), hanging)
            polar = self.start + (self.end - self.start) * lying / hanging
            azimuth = self.azimuth + self.swing * lying**self.bow
            d = np.array([np.sin(polar) * np.sin(azimuth), np.cos(polar), np.sin(polar) * np.cos(azimuth)])
            lift = self.lift_m * (0.35 + 0.65 * np.sin(min(1.0, lying * 1.5) * np.pi / 2))
            point = scalp.centre + d * (scalp.radius(d) + lift)
            if t > hanging:
                k = (t - hanging) / (1 - hanging)
                point = point + [0, -self.drop_m * k, 0] + aside * (self.swing * 0.05 * k)
                point = point + outward * (self.out_m * np.sin(k * np.pi * 0.9) - self.curl_m * k * k)
            path.append(point)
        middle = np.array(path)
        up = middle - scalp.centre
        return middle, up / np.linalg.norm(up, axis=1, keepdims=True)

    def mesh(self, scalp: Scalp, steps: int, sides: int) -> tuple[Array, NDArray[np.int64], Array]:
        """The lock as a tube: vertices, faces, texture coordinates."""
        path, up = self.path(scalp, steps)
        t = np.linspace(0, 1, steps)
        narrowing = np.clip((1 - t) / (1 - self.taper), 0, 1)
        radius = self.width_m * np.clip(0.55 + 0.9 * t, 0, 1) * narrowing**self.tip + 0.0004
        vertices, faces, uv = tube(path, radius, up, sides, self.flat)
        return vertices, faces, uv * [1.0, STRANDS_V]


def _side_and_back(azimuth: float, length: float, lift_m: float) -> Lock:
    """How hair hangs at an azimuth behind the temples: over the ears and in to the neck."""
    behind = 0.5 - 0.5 * np.cos(azimuth)
    drop = (0.098 + 0.014 * behind) * length
    return Lock(azimuth, 0.22, 1.62, lift_m, 0.0, drop, 0.020 + 0.010 * behind, 0.0, 0.006)


def _curtain(tailor: Tailor, scalp: Scalp, steps: int, columns: int) -> Mesh:
    """The body of the bob: one closed sheet from temple to temple, on which the locks lie."""
    azimuths = np.linspace(TEMPLE_RAD, 2 * np.pi - TEMPLE_RAD, columns)
    lines: list[Array] = []
    for azimuth in azimuths:
        length = 0.965 + 0.012 * np.sin(azimuth * 9.0) + 0.006 * np.sin(azimuth * 23.0 + 1.0)
        lines.append(_side_and_back(float(azimuth), float(length), 0.0125).path(scalp, steps)[0])
    vertices = np.stack(lines, axis=1).reshape(-1, 3)
    v, u = np.meshgrid(np.linspace(0, STRANDS_V, steps), azimuths * 1.6, indexing="ij")
    weights = tailor.rigid(len(vertices), head=1)
    return Mesh(vertices, weights, grid_faces(steps, columns, flip=True), np.c_[u.ravel(), v.ravel()])


def _lining(curtain: Mesh, scalp: Scalp, steps: int, columns: int) -> Mesh:
    """The curtain's dark inside, seen past the jaw: every second column, a little nearer the head."""
    every = np.arange(0, columns, 2)
    low = np.arange(steps // 2, steps)
    index = (low[:, None] * columns + every).ravel()
    vertices = scalp.centre + (curtain.vertices[index] - scalp.centre) * [0.965, 1.0, 0.965]
    uv = np.c_[curtain.uv[index, 0] if curtain.uv is not None else 0 * index, np.full(len(index), 0.995)]
    return Mesh(vertices, curtain.weights[index], grid_faces(len(low), len(every)), uv)


def _locks_over_curtain(rng: np.random.Generator, share: float) -> list[Lock]:
    """Broad locks with soft tips, in two layers of uneven length and width."""
    locks: list[Lock] = []
    for lift, count, length, width in ((0.0165, 21, 1.0, 0.0165), (0.0205, 15, 0.92, 0.0150)):
        number = max(8, round(count * share))
        for i in range(number):
            azimuth = TEMPLE_RAD + 0.06 + (2 * np.pi - 2 * TEMPLE_RAD - 0.12) * (i + 0.5) / number
            azimuth += rng.uniform(-0.07, 0.07)
            lock = _side_and_back(azimuth, length * rng.uniform(0.975, 1.01), lift)
            lock.start = rng.uniform(0.10, 0.32)
            lock.width_m = width * rng.uniform(0.85, 1.2) / share**0.8
            lock.swing, lock.flat = rng.uniform(-0.09, 0.09), 0.36
            lock.taper, lock.tip = rng.uniform(0.78, 0.88), 0.5
            locks.append(lock)
    return locks


def _swept(tip: float, length: float, lift_m: float) -> Lock:
    """How the fringe lies: combed from the parting to a tip's azimuth, longer toward the temples."""
    from_parting = tip - PARTING_RAD
    root = PARTING_RAD + 0.30 * from_parting
    end = (1.475 + 0.125 * min(1.0, abs(from_parting)) ** 1.5) * length
    return Lock(root, 0.16, end, lift_m, 0.0, swing=tip - root, flat=0.26, bow=1.25)


def _fringe_sheet(tailor: Tailor, scalp: Scalp, steps: int, columns: int) -> Mesh:
    """The body of the fringe: one sheet with a softly waved edge, over which the tips of its locks reach."""
    tips = np.linspace(-1.10, 1.08, columns)
    edge = 0.985 + 0.006 * np.sin(tips * 8.0 + 0.6) + 0.003 * np.sin(tips * 19.0)
    lines = [
        _swept(float(a), float(length), 0.0125).path(scalp, steps)[0]
        for a, length in zip(tips, edge, strict=True)
    ]
    vertices = np.stack(lines, axis=1).reshape(-1, 3)
    v, u = np.meshgrid(np.linspace(0, STRANDS_V, steps), tips * 1.6, indexing="ij")
    weights = tailor.rigid(len(vertices), head=1)
    return Mesh(vertices, weights, grid_faces(steps, columns, flip=True), np.c_[u.ravel(), v.ravel()])


def _fringe(rng: np.random.Generator, share: float) -> list[Lock]:
    """Broad overlapping locks in two layers, swept to one side, their tips apart; and a few fine strands."""
    locks: list[Lock] = []
    for most, lift, length, width in FRINGE:
        number = max(5, round(most * share**0.5))
        spacing = 2.0 / (number - 1)
        for i in range(number):
            tip = -1.0 + spacing * (i + rng.uniform(-0.22, 0.22)) + (0.0 if length == 1.0 else 0.06)
            lock = _swept(tip, length * rng.uniform(0.985, 1.012), lift)
            lock.start += rng.uniform(-0.04, 0.04)
            lock.width_m = spacing * 0.083 * width * rng.uniform(0.85, 1.1)
            lock.taper, lock.tip = rng.uniform(0.74, 0.82), rng.uniform(0.50, 0.58)
            lock.flat = 0.24
            locks.append(lock)
    for tip in STRAY_RAD if share > 0.8 else ():
        lock = _swept(tip, 1.0, 0.0185)
        lock.width_m, lock.taper, lock.tip = 0.0036, 0.4, 0.8
        locks.append(lock)
    return locks


def _temple_locks() -> list[Lock]:
    """Longer locks that frame the face and hide the fringe's ends."""
    locks: list[Lock] = []
    for sign in (1, -1):
        locks.append(
            Lock(sign * 0.90, 0.3, 1.50, 0.0125, 0.0062, 0.058, 0.006, -sign * 0.10, taper=0.35, tip=0.9)
        )
        locks.append(
            Lock(sign * 0.98, 0.3, 1.50, 0.0135, 0.0120, 0.086, -0.003, -sign * 0.06, taper=0.42, tip=0.85)
        )
        locks.append(
            Lock(sign * 1.13, 0.3, 1.55, 0.0165, 0.0150, 0.102, 0.010, -sign * 0.05, taper=0.6, tip=0.6)
        )
    return locks


def scalp_cap(
    tailor: Tailor, scalp: Scalp, hairline: tuple[tuple[float, float], ...], thickness_m: float
) -> Mesh:
    """The scalp under the locks, cut at the hairline and clear of the ears.

    `hairline`: turns from the front and the edge's heights over the eyes, metres.
    """
    figure: Figure = tailor.figure
    faces = figure.mesh.triangles(["body"])
    on_head = tailor.weights[:, tailor.column("head")] > 0.5
    mesh = Mesh(figure.vertices, tailor.weights, faces).where(on_head)
    v = mesh.vertices
    azimuth = np.arctan2(v[:, 0], v[:, 2] - scalp.centre[2])
    line = scalp.eye_y + np.interp(np.abs(azimuth), [a for a, _ in hairline], [h for _, h in hairline])
    head_x = np.abs(figure.body[on_head[: len(figure.body)], 0])
    ear = (np.abs(azimuth) > 1.2) & (np.abs(azimuth) < 2.0) & (np.abs(v[:, 0]) > np.percentile(head_x, 96))
    mesh.vertices = v + normals(v, mesh.faces) * thickness_m
    mesh = mesh.clipped(np.where(ear, -1, mesh.vertices[:, 1] - line))
    mesh.uv = np.c_[
        np.arctan2(mesh.vertices[:, 0], mesh.vertices[:, 2]) * 0.8, np.full(len(mesh.vertices), 0.3)
    ]
    mesh.weights = tailor.rigid(len(mesh.vertices), head=1)
    return mesh


def bob(tailor: Tailor, steps: int, sides: int, share: float) -> tuple[Mesh, Array]:
    """The whole head of hair and its normals (V, 3).

    `share` is the part of the locks that a lower tier keeps (they grow wider).
    """
    rng = np.random.default_rng(SEED)
    scalp = Scalp.of(tailor)
    locks = _locks_over_curtain(rng, share) + _fringe(rng, share) + _temple_locks()
    columns = 2 * round(48 * share) + 1
    curtain = _curtain(tailor, scalp, steps, columns)
    meshes = [
        scalp_cap(tailor, scalp, HAIRLINE, 0.006),
        curtain,
        _fringe_sheet(tailor, scalp, steps, round(56 * share)),
    ]
    for lock in locks:
        vertices, faces, uv = lock.mesh(scalp, steps, sides)
        meshes.append(Mesh(vertices, tailor.rigid(len(vertices), head=1), faces, uv))
    hair = facing_outward(joined(meshes), scalp)
    lining = _lining(curtain, scalp, steps, columns)
    both = joined([hair, lining])
    return both, np.vstack([soft_normals(hair, scalp), normals(lining.vertices, lining.faces)])


def facing_outward(hair: Mesh, scalp: Scalp) -> Mesh:
    """Drop the faces that look at the head: locks hide them, and they would be lit wrongly."""
    a, b, c = (hair.vertices[hair.faces[:, k]] for k in range(3))
    facing = np.cross(b - a, c - a)
    outward = (a + b + c) / 3 - scalp.centre
    outward[:, 1] *= 0.6
    product = (facing * outward).sum(axis=1)
    lengths = np.linalg.norm(facing, axis=1) * np.linalg.norm(outward, axis=1)
    return replace(hair, faces=hair.faces[product > -0.3 * lengths]).compact()


def soft_normals(hair: Mesh, scalp: Scalp) -> Array:
    """Each strand's own normals leaned toward the head's roundness, so that the hair is lit as one body."""
    outward = hair.vertices - scalp.centre
    outward[:, 1] *= 0.6  # below the ears the hair hangs like a curtain
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    own = normals(hair.vertices, hair.faces)
    blended = 0.55 * own + 0.6 * outward
    unit: Array = blended / np.linalg.norm(blended, axis=1, keepdims=True)
    return unit
