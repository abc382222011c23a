"""Reads MakeHuman's base mesh, its shape targets, and a standard rig with its weights.

Lengths are decimetres here, as in the source; `body.figure` turns them into metres.
"""

from __future__ import annotations

import gzip
import itertools
import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Face = tuple[list[int], list[int]]  # vertex indices and texture-coordinate indices of one polygon

BODY_VERTEX_COUNT = 13380  # what follows in base.obj are helper surfaces


@dataclass
class Bone:
    """A source bone: its parent's name, and its ends in decimetres, shape (3,)."""

    parent: str | None
    head: Array
    tail: Array


class BaseMesh:
    """The hm08 mesh: `vertices` (V, 3) in dm, `uv` (T, 2), polygons by group; targets move the vertices."""

    def __init__(self, data: Path) -> None:
        self.data = data / "mpfb2"
        self.face_units = data / "faceunits01" / "targets" / "faceunits"
        vertices: list[list[float]] = []
        uv: list[list[float]] = []
        self.groups: dict[str, list[Face]] = {}
        group = ""
        for line in (self.data / "3dobjs" / "base.obj").read_text().splitlines():
            words = line.split()
            if not words:
                continue
            if words[0] == "v":
                vertices.append([float(word) for word in words[1:4]])
            elif words[0] == "vt":
                uv.append([float(word) for word in words[1:3]])
            elif words[0] == "g":
                group = words[1]
            elif words[0] == "f":
                corners = [[int(part) - 1 for part in word.split("/")[:2]] for word in words[1:]]
                self.groups.setdefault(group, []).append(([c[0] for c in corners], [c[1] for c in corners]))
        self.vertices: Array = np.array(vertices)
        self.uv: Array = np.array(uv)

    def vertex_set(self, group: str) -> list[int]:
        """The sorted vertex indices that a group of polygons uses."""
        return sorted({index for corners, _ in self.groups[group] for index in corners})

    def triangles(self, groups: Iterable[str]) -> Indices:
        """The groups' polygons as triangles (F, 3), each quad split along its first diagonal."""
        rows: list[list[int]] = []
        for group in groups:
            for corners, _ in self.groups[group]:
                rows.extend([corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1))
        return np.array(rows, dtype=np.int64)

    def has_target(self, name: str) -> bool:
        """Whether a shape target of this name is in the data."""
        return (self.data / "targets" / f"{name}.target.gz").exists()

    def apply(self, name: str, weight: float) -> None:
        """Add `weight` times the named shape target."""
        if abs(weight) < 1e-6:
            return
        indices, offsets = read_target(self.data / "targets" / f"{name}.target.gz")
        self.vertices[indices] += weight * offsets

    def apply_macro(self, sex: str, races: Mapping[str, float], shape: Mapping[str, float]) -> None:
        """Apply a young person's macro targets.

        `shape` holds muscle, weight, height, proportions, and of a woman cup and firmness, in 0…1.
        """
        muscle = _thirds(shape["muscle"], "minmuscle", "averagemuscle", "maxmuscle")
        weight = _thirds(shape["weight"], "minweight", "averageweight", "maxweight")
        height = _thirds(shape["height"], "minheight", "", "maxheight")
        proportions = _thirds(shape["proportions"], "uncommonproportions", "", "idealproportions")
        cup = _thirds(shape.get("cup", 0.5), "mincup", "averagecup", "maxcup")
        firmness = _thirds(shape.get("firmness", 0.5), "minfirmness", "averagefirmness", "maxfirmness")
        for race, share in races.items():
            self.apply(f"macrodetails/{race}-{sex}-young", share)
        for (m, m_share), (w, w_share) in itertools.product(muscle.items(), weight.items()):
            build, share = f"{sex}-young-{m}-{w}", m_share * w_share
            self.apply(f"macrodetails/universal-{build}", share)
            for name, part in height.items():
                if name:
                    self.apply(f"macrodetails/height/{build}-{name}", share * part)
            for name, part in proportions.items():
                if name:
                    self.apply(f"macrodetails/proportions/{build}-{name}", share * part)
            for (c, c_share), (f, f_share) in itertools.product(cup.items(), firmness.items()):
                if self.has_target(f"breast/{build}-{c}-{f}"):
                    self.apply(f"breast/{build}-{c}-{f}", share * c_share * f_share)

    def face_unit(self, names: Iterable[str]) -> Array:
        """The summed offsets (V, 3) in dm of the face targets with these ARKit names."""
        total = np.zeros_like(self.vertices)
        for name in names:
            indices, offsets = read_target(self.face_units / f"{name}.target")
            total[indices] += offsets
        return total

    def bones(self, rig: str = "game_engine") -> dict[str, Bone]:
        """The standard rig's bones, fitted to the mesh as it now stands."""
        content = json.loads((self.data / "rigs" / "standard" / f"rig.{rig}.json").read_text())
        entries = content.get("bones", content)
        return {
            name: Bone(entry.get("parent") or None, self._place(entry["head"]), self._place(entry["tail"]))
            for name, entry in entries.items()
        }

    def weights(self, rig: str = "game_engine") -> dict[str, list[tuple[int, float]]]:
        """For each bone of the rig, its (vertex, weight) pairs."""
        content = json.loads((self.data / "rigs" / "standard" / f"weights.{rig}.json").read_text())
        weights: dict[str, list[tuple[int, float]]] = content["weights"]
        return weights

    def _place(self, entry: dict[str, Any]) -> Array:
        strategy = entry["strategy"]
        if strategy == "CUBE":
            place: Array = self.vertices[self.vertex_set(entry["cube_name"])].mean(axis=0)
        elif strategy == "MEAN":
            place = self.vertices[entry["vertex_indices"]].mean(axis=0)
        elif strategy == "VERTEX":
            place = self.vertices[entry["vertex_index"]].copy()
        elif strategy == "XYZ":
            place = np.array(
                [self.vertices[index][axis] for axis, index in enumerate(entry["vertex_indices"])]
            )
        else:
            raise ValueError(f"unknown joint strategy {strategy!r}; known are CUBE, MEAN, VERTEX, XYZ")
        return place


def read_target(path: Path) -> tuple[Indices, Array]:
    """Read one `.target` or `.target.gz`: vertex indices (N,) and their offsets (N, 3) in dm."""
    text = gzip.decompress(path.read_bytes()).decode() if path.suffix == ".gz" else path.read_text()
    rows = [line.split() for line in text.splitlines() if line.strip() and not line.startswith("#")]
    indices = np.array([int(row[0]) for row in rows], dtype=np.int64)
    return indices, np.array([[float(word) for word in row[1:4]] for row in rows]).reshape(-1, 3)


def _thirds(value: float, low: str, middle: str, high: str) -> dict[str, float]:
    """Split 0…1 into the shares of MakeHuman's three-way sliders that are not zero."""
    shares = {low: max(0.0, 1 - 2 * value), middle: 1 - abs(2 * value - 1), high: max(0.0, 2 * value - 1)}
    return {name: share for name, share in shares.items() if share > 0}
