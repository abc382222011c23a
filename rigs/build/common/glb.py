"""Writes binary glTF: node trees, skinned meshes with morph targets, embedded JPEG and PNG images."""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from pathlib import Path

Array = NDArray[Any]

FLOAT, UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5121, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
LINEAR, LINEAR_MIPMAP_LINEAR, REPEAT = 9729, 9987, 10497


class GlbWriter:
    """Collects buffers, materials, meshes and nodes; `save` writes them with a fixed order of bytes."""

    def __init__(self) -> None:
        self.buffer = bytearray()
        self.content: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "reina rigs"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "materials": [],
            "accessors": [],
            "bufferViews": [],
        }

    def _view(self, data: bytes, target: int | None = None) -> int:
        self.buffer.extend(b"\0" * (-len(self.buffer) % 4))
        view: dict[str, Any] = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data)}
        if target is not None:
            view["target"] = target
        self.buffer.extend(data)
        return self._append("bufferViews", view)

    def _append(self, kind: str, item: dict[str, Any]) -> int:
        self.content.setdefault(kind, []).append(item)
        return len(self.content[kind]) - 1

    def accessor(self, values: Array, kind: str, target: int | None = None, *, bounds: bool = False) -> int:
        """Store an array (N, …) as an accessor of glTF type `kind`."""
        values = np.ascontiguousarray(values)
        component = {"f4": FLOAT, "u1": UNSIGNED_BYTE, "u2": UNSIGNED_SHORT, "u4": UNSIGNED_INT}[
            values.dtype.str[1:]
        ]
        view = self._view(values.tobytes(), target)
        item: dict[str, Any] = {
            "bufferView": view,
            "componentType": component,
            "count": len(values),
            "type": kind,
        }
        if bounds:
            item["min"] = [float(x) for x in values.min(axis=0)]
            item["max"] = [float(x) for x in values.max(axis=0)]
        return self._append("accessors", item)

    def texture(self, data: bytes, mime: str, name: str) -> int:
        """Embed an image and return its texture's index."""
        if not self.content.get("samplers"):
            sampler = {
                "magFilter": LINEAR,
                "minFilter": LINEAR_MIPMAP_LINEAR,
                "wrapS": REPEAT,
                "wrapT": REPEAT,
            }
            self._append("samplers", sampler)
        image = self._append("images", {"bufferView": self._view(data), "mimeType": mime, "name": name})
        return self._append("textures", {"source": image, "sampler": 0})

    def material(self, name: str, *, metallic: float, roughness: float, **rest: Any) -> int:
        """Add a metallic-roughness material.

        `colour` (linear RGB) or `texture` give its base, the rest is glTF's own.
        """
        surface: dict[str, Any] = {"metallicFactor": metallic, "roughnessFactor": roughness}
        if "colour" in rest:
            surface["baseColorFactor"] = [*(float(c) for c in rest.pop("colour")), 1.0]
        if "texture" in rest:
            surface["baseColorTexture"] = {"index": rest.pop("texture")}
        for name_used in rest.get("extensions", {}):
            used = self.content.setdefault("extensionsUsed", [])
            if name_used not in used:
                used.append(name_used)
        return self._append("materials", {"name": name, "pbrMetallicRoughness": surface, **rest})

    def primitive(
        self,
        positions: Array,
        normals: Array,
        faces: Array,
        material: int,
        *,
        uv: Array | None = None,
        joints: Array | None = None,
        weights: Array | None = None,
        targets: list[Array] | None = None,
        colours: Array | None = None,
        tangents: Array | None = None,
    ) -> dict[str, Any]:
        """One drawable part; joints, weights are (V, 4), targets a list of offsets (V, 3), colours (V, 3).

        `tangents` (V, 4) are along u, with the sense of v, as glTF has them.
        """
        attributes = {
            "POSITION": self.accessor(positions.astype("<f4"), "VEC3", ARRAY_BUFFER, bounds=True),
            "NORMAL": self.accessor(normals.astype("<f4"), "VEC3", ARRAY_BUFFER),
        }
        if tangents is not None:
            attributes["TANGENT"] = self.accessor(tangents.astype("<f4"), "VEC4", ARRAY_BUFFER)
        if uv is not None:
            attributes["TEXCOORD_0"] = self.accessor(uv.astype("<f4"), "VEC2", ARRAY_BUFFER)
        if colours is not None:
            attributes["COLOR_0"] = self.accessor(colours.astype("<f4"), "VEC3", ARRAY_BUFFER)
        if joints is not None and weights is not None:
            attributes["JOINTS_0"] = self.accessor(joints.astype("u1"), "VEC4", ARRAY_BUFFER)
            attributes["WEIGHTS_0"] = self.accessor(weights.astype("<f4"), "VEC4", ARRAY_BUFFER)
        kind = "<u2" if len(positions) < 65536 else "<u4"
        indices = self.accessor(faces.reshape(-1).astype(kind), "SCALAR", ELEMENT_ARRAY_BUFFER)
        part: dict[str, Any] = {"attributes": attributes, "indices": indices, "material": material, "mode": 4}
        if targets:
            part["targets"] = [
                {"POSITION": self.accessor(t.astype("<f4"), "VEC3", ARRAY_BUFFER, bounds=True)}
                for t in targets
            ]
        return part

    def mesh(self, name: str, primitives: list[dict[str, Any]], morphs: list[str] | None = None) -> int:
        """Add a mesh and return its index."""
        item: dict[str, Any] = {"name": name, "primitives": primitives}
        if morphs:
            item["weights"] = [0.0] * len(morphs)
            item["extras"] = {"targetNames": morphs}
        return self._append("meshes", item)

    def node(self, name: str, **rest: Any) -> int:
        """Add a node and return its index."""
        return self._append("nodes", {"name": name, **rest})

    def skin(self, name: str, joints: list[int], inverse_binds: Array) -> int:
        """`inverse_binds` is (J, 4, 4), row-major as NumPy writes matrices."""
        columns = np.swapaxes(inverse_binds, 1, 2).reshape(len(joints), 16).astype("<f4")
        return self._append(
            "skins", {"name": name, "joints": joints, "inverseBindMatrices": self.accessor(columns, "MAT4")}
        )

    def save(self, path: Path, roots: list[int]) -> None:
        """Write the file with these nodes as the scene's roots."""
        self.content["scenes"][0]["nodes"] = roots
        self.buffer.extend(b"\0" * (-len(self.buffer) % 4))
        self.content["buffers"] = [{"byteLength": len(self.buffer)}]
        text = json.dumps(self.content, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        total = 12 + 8 + len(text) + 8 + len(self.buffer)
        with path.open("wb") as file:
            file.write(struct.pack("<III", 0x46546C67, 2, total))
            file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
            file.write(struct.pack("<II", len(self.buffer), 0x004E4942) + bytes(self.buffer))


def linear(srgb: tuple[float, float, float]) -> list[float]:
    """SRGB components 0…1 to linear ones."""
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in srgb]
