"""Buttons: domed discs that lie on a cloth, on the coat's front and sleeves and on the shirt."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.joint_names import SIDES
from common.meshes import Mesh, joined
from common.raycast import ray_distances
from dress.tailor import borrowed_weights
from dress.uniform import top_button_y

if TYPE_CHECKING:
    from dress.collars import Drape
    from dress.tailor import Tailor

Array = NDArray[np.float64]

COAT = ((0.0092, 0.0), (0.0082, 0.0034), (0.0, 0.0044))  # radius, height over the cloth: rim, edge, middle
SLEEVE = ((0.0040, 0.0), (0.0035, 0.0024), (0.0, 0.0030))
SHIRT = ((0.0052, 0.0014), (0.0044, 0.0036), (0.0, 0.0031))
FRONT_M = ((0.004, -0.025), (0.004, -0.100))  # from the middle, and over the opening's lowest point
SLEEVE_AT = (0.803, 0.837)  # places along the forearm
TO_BACK = 0.55  # of the hand, the rest toward the little finger


def button(drape: Drape, place: Array, profile: tuple[tuple[float, float], ...], sides: int) -> Mesh:
    """A disc on the cloth nearest to a place (3,)."""
    on, out = (rows[0] for rows in drape.surface(place[None]))
    first = np.cross([0.0, 1.0, 0.0], out)
    first /= np.linalg.norm(first)
    second = np.cross(out, first)
    angle = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    spokes = np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * second
    *rings, (_, middle) = profile
    points = np.vstack(
        [*(on + radius * spokes + height * out for radius, height in rings), on + middle * out]
    )
    i = np.arange(sides)
    j = (i + 1) % sides
    faces = np.vstack(
        [
            np.c_[i, j, sides + i],
            np.c_[j, sides + j, sides + i],
            np.c_[sides + i, sides + j, 0 * i + 2 * sides],
        ]
    )
    return Mesh(points, borrowed_weights(points, drape.cloth), faces)


def coat_buttons(tailor: Tailor, drape: Drape, sides: int = 16) -> Mesh:
    """Two on the front below the opening, and two at the back of each cuff."""
    discs = [button(drape, drape.front(x, top_button_y(tailor) + below), COAT, sides) for x, below in FRONT_M]
    vertices, faces = drape.cloth.vertices, drape.cloth.faces
    for side, _ in SIDES:
        elbow, wrist = tailor.at(f"{side}LowerArm"), tailor.at(f"{side}Hand")
        axes = tailor.skeleton.axes[f"{side}LowerArm"]
        to_little_finger = axes[:, 2] if side == "right" else -axes[:, 2]
        spoke = TO_BACK * axes[:, 1] + (1 - TO_BACK) * to_little_finger
        spoke /= np.linalg.norm(spoke)
        near_cuff = np.linalg.norm(vertices - 0.2 * elbow - 0.8 * wrist, axis=1) < 0.1
        local = faces[near_cuff[faces].all(axis=1)]
        for share in SLEEVE_AT:
            centre = elbow + share * (wrist - elbow)
            reach = float(ray_distances(centre, spoke, vertices, local)[0])
            discs.append(button(drape, centre + reach * spoke, SLEEVE, sides))
    return joined(discs)
