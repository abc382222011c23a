"""A visible part of a model, before it is written: geometry, surface and morphs."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from common.meshes import Mesh

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Surface:
    """A material: `colour` in sRGB 0…1 or an `image` (bytes, MIME type); `extensions` as glTF has them.

    `shade` is what is left of its colour (linear RGB) where no light comes in; None: all of it.
    """

    name: str
    roughness: float
    metallic: float = 0.0
    colour: tuple[float, float, float] | None = None
    image: tuple[bytes, str] | None = None
    both_sides: bool = False
    extensions: dict[str, Any] = field(default_factory=dict[str, Any], hash=False)
    shade: tuple[float, float, float] | None = (0.36, 0.36, 0.42)


@dataclass
class Part:
    """`normals` (V, 3) where they are not the mesh's own; `morphs` name → offsets (V, 3).

    `colours` (V, 3) by which the surface's colour is multiplied, linear.
    """

    name: str
    mesh: Mesh
    surface: Surface
    normals: Array | None = None
    morphs: dict[str, Array] | None = None
    colours: Array | None = None
