"""What is sewn on the uniform: buttons and ribbon bow, with the collars of their own module."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from common.meshes import Mesh, joined
from common.parts import Part, Surface
from common.shapes import grid_faces, tube
from dress.buttons import coat_buttons
from dress.collars import Drape, blazer_collar, lapels, shirt_collar
from dress.details import crest, piping, placket, pockets, sleeve_bands
from dress.uniform import shirt_surface

if TYPE_CHECKING:
    from collections.abc import Mapping

    from body.figure_file import Colour
    from dress.tailor import Tailor

    Colours = Mapping[str, Colour]

Array = NDArray[np.float64]

BOW_Z_M = 0.103  # depth of the bow's knot


def bow(tailor: Tailor, *, tails: bool) -> Mesh:
    """A bow at the collar: two loops, a knot, and of a ribbon two tails."""
    knot = np.array([0.0, tailor.neck_y - 0.036, BOW_Z_M])
    t = np.linspace(0, 1, 9)
    pieces: list[Mesh] = []
    for sign in (1, -1):
        swell = np.sin(t * np.pi)
        loop = np.c_[sign * 0.048 * t, 0.004 * swell, 0.006 * swell - 0.012 * t * t]
        loop_width = 0.005 + 0.016 * np.sin(np.minimum(t * 1.15, 1) * np.pi / 2)
        tail = np.c_[sign * (0.006 + 0.020 * t), -0.075 * t, 0.002 - 0.004 * t]
        strips = [(loop, loop_width, [0, 1, 0]), (tail, 0.005 + 0.009 * t, [1, 0.25 * sign, 0])]
        for path, width, across in strips if tails else strips[:1]:
            rows = [
                knot + path + np.outer(width * k, across) + [0, 0, 0.004 * (1 - abs(k))] for k in (-1, 0, 1)
            ]
            points = np.stack(rows, axis=1).reshape(-1, 3)
            faces = grid_faces(9, 3, flip=path is tail or sign > 0)
            pieces.append(Mesh(points, tailor.rigid(len(points), upperChest=1), faces))
    path = knot + np.array([[0, 0.009, 0.002], [0, 0.005, 0.006], [0, -0.005, 0.006], [0, -0.009, 0.002]])
    points, faces, _ = tube(path, np.array([0.004, 0.008, 0.008, 0.004]), np.array([0.0, 0.0, 1.0]), 10)
    pieces.append(Mesh(points, tailor.rigid(len(points), upperChest=1), faces))
    return joined(pieces)


def trimming_parts(
    tailor: Tailor,
    cloth: Mesh,
    outer: Mesh,
    shirt: Mesh,
    detail: float,
    colours: Colours,
    *,
    formal: bool,
) -> list[Part]:
    """All trimmings, made for the coat `outer`, which is cut from `cloth`, and `shirt`.

    `detail` is the part of their rows that a lower tier keeps; `formal` has a bow tie for a ribbon and
    covered buttons for brass ones.
    """
    thick = 1 + 1.1 * (1 - detail)  # a coarser coat comes nearer to them
    turned, edges = lapels(tailor, cloth, round(40 * detail), thick)
    collar, collar_edge = blazer_collar(tailor, cloth, round(60 * detail) + 1)
    turned_over = [turned, collar]
    linen = [shirt_collar(tailor, round(72 * detail))]
    drape = Drape(outer)
    metal = [coat_buttons(tailor, drape)]
    sewn: list[Part] = []
    if not formal:
        linen.append(placket(tailor, shirt, max(round(20 * detail), 6)))
        metal.append(crest(tailor, drape))
        cords = piping([*edges, collar_edge], cloth)
        bands = sleeve_bands(tailor, outer, max(round(32 * detail), 12))
        flaps = pockets(tailor, drape, max(round(9 * detail), 4))
        sewn.append(Part("Pockets", flaps, Surface("blazer", 0.82, colour=colours["coat"], both_sides=True)))
        sewn.append(
            Part(
                "Piping",
                joined([cords, bands]),
                Surface("piping", 0.7, colour=colours["piping"], both_sides=True),
            )
        )
    button = Surface("button", 0.3, 0.0 if formal else 1.0, colour=colours["button"])
    lapel = Surface("lapel", 0.42 if formal else 0.75, colour=colours["lapel"], both_sides=True)
    name = "tie" if formal else "ribbon"
    return [
        Part("Lapels", joined(turned_over), lapel),
        *sewn,
        Part("Buttons", joined(metal), button),
        Part("Collar", joined(linen), shirt_surface(colours)),
        Part(
            name.capitalize(),
            bow(tailor, tails=not formal),
            Surface(name, 0.6, colour=colours["bow"], both_sides=True),
        ),
    ]
