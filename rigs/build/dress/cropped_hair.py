"""Short hair, parted at the side: a cap on the scalp, locks that lie close, and a quiff combed over."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from common.meshes import Mesh, joined
from dress.hair import Lock, Scalp, facing_outward, scalp_cap, soft_normals

if TYPE_CHECKING:
    from dress.tailor import Tailor

Array = NDArray[np.float64]

SEED = 19
PARTING_RAD = 0.62  # on his left
HAIRLINE = (
    (0.0, 0.069), (0.5, 0.067), (0.8, 0.058), (0.98, 0.040), (1.15, 0.006),
    (1.45, -0.012), (1.9, -0.012), (2.4, -0.050), (3.2, -0.062),
)  # fmt: skip
"""Turn from the front, and the hair's edge over the eyes, metres."""


def _sides(rng: np.random.Generator, share: float) -> list[Lock]:
    """Locks combed down and back over sides and nape, in three rows like tiles."""
    locks: list[Lock] = []
    for start, end, count, lift, width in (
        (0.95, 1.60, 30, 0.0055, 0.0105), (0.62, 1.34, 27, 0.0080, 0.0120), (0.28, 1.02, 22, 0.0105, 0.0130),
    ):  # fmt: skip
        number = max(8, round(count * share))
        for i in range(number):
            azimuth = 0.85 + (2 * np.pi - 1.70) * (i + rng.uniform(0.2, 0.8)) / number
            front = abs((azimuth + np.pi) % (2 * np.pi) - np.pi)
            back = np.clip((front - 1.0) / 2.0, 0, 1)
            swing = 0.30 * np.sign(np.sin(azimuth)) * (1 - back)
            lock = Lock(
                azimuth, start, end + 0.16 * back * (end > 1.3), lift, width / share**0.7, swing=swing
            )
            lock.start += rng.uniform(-0.05, 0.05)
            lock.end += rng.uniform(-0.05, 0.04)
            lock.flat, lock.taper, lock.tip = 0.34, rng.uniform(0.45, 0.6), 0.75
            locks.append(lock)
    return locks


def _quiff(rng: np.random.Generator, share: float) -> list[Lock]:
    """Longer hair combed from the parting over the top, rising a little over the forehead."""
    locks: list[Lock] = []
    for row, (lift, count) in enumerate(((0.013, 13), (0.019, 11), (0.024, 8))):
        number = max(5, round(count * share))
        for i in range(number):
            t = (i + rng.uniform(0.25, 0.75)) / number
            tip = 0.60 - 1.75 * t
            root = PARTING_RAD + 0.20 * (tip - PARTING_RAD)
            end = 1.13 - 0.05 * row - 0.10 * t * t + rng.uniform(-0.03, 0.03)
            lock = Lock(root, 0.10 + 0.05 * row, end, lift, 0.0135 / share**0.6, swing=tip - root)
            lock.flat, lock.bow = 0.40, 1.2
            lock.taper, lock.tip = rng.uniform(0.5, 0.65), 0.7
            locks.append(lock)
    return locks


def _front(rng: np.random.Generator, share: float) -> list[Lock]:
    """Short hair that grows up and back from the forehead, so that its edge is no line."""
    locks: list[Lock] = []
    for lift, number in ((0.0035, 24), (0.0065, 18)):
        number = max(7, round(number * share))
        for i in range(number):
            azimuth = -0.92 + 1.78 * (i + rng.uniform(0.2, 0.8)) / number
            corner = 0.035 * np.exp(-(((abs(azimuth) - 0.55) / 0.2) ** 2))
            lock = Lock(azimuth, 1.085 - corner + rng.uniform(-0.03, 0.035), 0.66, lift, 0.0075 / share**0.7)
            lock.swing, lock.flat = -0.16 + rng.uniform(-0.07, 0.07), 0.30
            lock.taper, lock.tip = 0.55, 0.8
            locks.append(lock)
    return locks


def cropped(tailor: Tailor, steps: int, sides: int, share: float) -> tuple[Mesh, Array]:
    """The whole head of hair and its normals (V, 3).

    `share` is the part of the locks that a lower tier keeps.
    """
    rng = np.random.default_rng(SEED)
    scalp = Scalp.of(tailor)
    meshes = [scalp_cap(tailor, scalp, HAIRLINE, 0.0045)]
    for lock in _sides(rng, share) + _quiff(rng, share) + _front(rng, share):
        vertices, faces, uv = lock.mesh(scalp, max(5, steps // 2), sides)
        meshes.append(Mesh(vertices, tailor.rigid(len(vertices), head=1), faces, uv))
    hair = facing_outward(joined(meshes), scalp)
    return hair, soft_normals(hair, scalp)
