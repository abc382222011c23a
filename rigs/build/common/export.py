"""Writes a skinned model: parts on a skeleton, as glTF."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from body.skinning import strongest
from common.glb import GlbWriter, linear
from common.meshes import even_normals

if TYPE_CHECKING:
    from pathlib import Path

    from body.skeleton import Skeleton
    from common.parts import Part, Surface


def add_surface(writer: GlbWriter, surface: Surface, known: dict[str, int]) -> int:
    """The material's index; a surface of the same name is written once."""
    if surface.name not in known:
        rest: dict[str, object] = {"doubleSided": True} if surface.both_sides else {}
        if surface.extensions:
            rest["extensions"] = surface.extensions
        if surface.image is not None:
            rest["texture"] = writer.texture(*surface.image, surface.name)
        if surface.colour is not None:
            rest["colour"] = linear(surface.colour)
        known[surface.name] = writer.material(
            surface.name, metallic=surface.metallic, roughness=surface.roughness, **rest
        )
    return known[surface.name]


def write_skinned(path: Path, name: str, skeleton: Skeleton, parts: list[Part]) -> None:
    """One node for each joint, rest transforms as in rig.json.

    Each part a skinned mesh at the scene's root.
    """
    writer = GlbWriter()
    nodes: dict[str, int] = {}
    for joint in skeleton.names:
        translation, rotation = skeleton.local(joint)
        place = {"translation": [float(x) for x in translation], "rotation": [float(x) for x in rotation]}
        nodes[joint] = writer.node(joint, **place)
    for joint, parent in skeleton.parents.items():
        if parent is not None:
            writer.content["nodes"][nodes[parent]].setdefault("children", []).append(nodes[joint])
    binds = np.tile(np.eye(4), (len(nodes), 1, 1))
    for k, joint in enumerate(skeleton.names):
        binds[k, :3, :3] = skeleton.axes[joint].T
        binds[k, :3, 3] = -skeleton.axes[joint].T @ skeleton.positions[joint]
    skin = writer.skin(name, list(nodes.values()), binds)
    roots = [nodes[skeleton.names[0]]]
    materials: dict[str, int] = {}
    for part in parts:
        mesh = part.mesh
        joints, weights = strongest(mesh.weights)
        primitive = writer.primitive(
            mesh.vertices,
            even_normals(mesh.vertices, mesh.faces) if part.normals is None else part.normals,
            mesh.faces,
            add_surface(writer, part.surface, materials),
            uv=mesh.uv if part.surface.image is not None else None,
            joints=joints,
            weights=weights,
            colours=part.colours,
            targets=list(part.morphs.values()) if part.morphs else None,
        )
        index = writer.mesh(part.name, [primitive], list(part.morphs) if part.morphs else None)
        roots.append(writer.node(part.name, mesh=index, skin=skin))
    writer.save(path, roots)
