"""A rig from its folder: ``rig.json`` as docs/conventions.md describes it, and its motion clips."""

from __future__ import annotations

import itertools
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import ORDERS
from reina.skeleton.document import Node, read_document
from reina.skeleton.errors import BvhError, RigError
from reina.skeleton.read_bvh import read_bvh
from reina.skeleton.rig import (
    SOLVERS,
    Button,
    Capsule,
    Chain,
    Cylinder,
    Limits,
    Morph,
    MovingPart,
    Point,
    Rig,
    Twist,
    Zone,
)
from reina.skeleton.skeleton import Skeleton

if TYPE_CHECKING:
    from pathlib import Path

    from reina.rotations.arrays import FloatArray
    from reina.skeleton.motion_clip import MotionClip

_UNIT_TOLERANCE = 1e-3
_CHAIN_LENGTHS = {"planar_three_bone": 3, "coupled_three_bone": 3, "two_bone": 3}


def load_rig(folder: Path) -> Rig:
    """The rig in a folder.

    Raises:
        RigError: The document lacks something or contradicts itself, ``where`` is the path in ``rig.json``;
            or a clip is no BVH file.
    """
    rig = read_rig(read_document(folder / "rig.json"))
    return replace(rig, clips={path.stem: _read_clip(path) for path in sorted(folder.glob("clips/*.bvh"))})


def _read_clip(path: Path) -> MotionClip:
    try:
        return read_bvh(path.read_bytes())
    except BvhError as error:
        raise RigError(f"this clip is no motion: {error}", location=f"clips/{path.name}") from error


def read_rig(document: Node) -> Rig:
    """The rig that a document describes; raises as `load_rig` does."""
    skeleton, nodes = _read_skeleton(document)
    effectors = _read_points(document, "effectors", skeleton)
    return Rig(
        name=document["name"].text(),
        skeleton=skeleton,
        nodes=nodes,
        effectors=effectors,
        contacts=_read_points(document, "contacts", skeleton),
        chains=_read_chains(document, skeleton, effectors),
        limits=_read_limits(document),
        twists=tuple(
            Twist(
                _joint(entry["joint"], skeleton),
                _joint(entry["source"], skeleton),
                entry["fraction"].number(),
            )
            for entry in document.items("twists")
        ),
        morphs=tuple(
            Morph(entry["parameter"].text(), entry["target"].text()) for entry in document.items("morphs")
        ),
        capsules=tuple(Capsule(*_read_solid(entry, skeleton)) for entry in document.items("capsules")),
        parts=tuple(_read_part(entry) for entry in document.items("parts")),
        buttons=tuple(_read_button(entry) for entry in document.items("buttons")),
        cylinders=tuple(Cylinder(*_read_solid(entry, skeleton)) for entry in document.items("cylinders")),
        zones=_read_zones(document, skeleton),
    )


def _read_skeleton(document: Node) -> tuple[Skeleton, tuple[str, ...]]:
    document["joints"]  # a rig without joints is none
    names: list[str] = []
    parents: list[int] = []
    translations: list[list[float]] = []
    rotations: list[list[float]] = []
    nodes: list[str] = []
    for entry in document.items("joints"):
        name = entry["name"].text()
        parent = entry.get("parent")
        if parent is not None and parent.text() not in names:
            raise parent.fail(f"{name!r} has the parent {parent.text()!r}, which does not stand before it")
        parents.append(-1 if parent is None else names.index(parent.text()))
        names.append(name)
        translations.append(entry["translation"].numbers(3).tolist())
        rotations.append(entry["rotation"].quaternion().tolist())
        node = entry.get("node")
        nodes.append(name if node is None else node.text())
    skeleton = Skeleton(
        tuple(names),
        np.array(parents, dtype=np.intp),
        np.array(translations).reshape(-1, 3),
        np.array(rotations).reshape(-1, 4),
    )
    return skeleton, tuple(nodes)


def _read_limits(document: Node) -> dict[int, Limits]:
    limits: dict[int, Limits] = {}
    for index, entry in enumerate(document.items("joints")):
        node = entry.get("limits")
        if node is None:
            continue
        order = node["order"].text()
        if order not in ORDERS:
            raise node["order"].fail(
                f"Euler order {order!r} is not known; the orders are {', '.join(ORDERS)}"
            )
        ranges = [_range(node[axis]) for axis in "xyz"]
        low_x, low_y, low_z = (low for low, _ in ranges)
        high_x, high_y, high_z = (high for _, high in ranges)
        limits[index] = Limits(order, (low_x, low_y, low_z), (high_x, high_y, high_z))
    return limits


def _range(node: Node) -> tuple[float, float]:
    low, high = node.numbers(2).tolist()
    if low > high:
        raise node.fail(f"the least angle, {low:g}, is greater than the greatest, {high:g}")
    return low, high


def _read_points(document: Node, key: str, skeleton: Skeleton) -> dict[str, Point]:
    points: dict[str, Point] = {}
    for entry in document.items(key):
        name = entry["name"].text()
        if name in points:
            raise entry["name"].fail(f"{name!r} stands here twice")
        points[name] = Point(name, _joint(entry["joint"], skeleton), entry["offset"].numbers(3))
    return points


def _read_chains(document: Node, skeleton: Skeleton, effectors: dict[str, Point]) -> dict[str, Chain]:
    chains: dict[str, Chain] = {}
    for entry in document.items("chains"):
        name = entry["name"].text()
        solver = entry["solver"].text()
        if solver not in SOLVERS:
            raise entry["solver"].fail(
                f"solver {solver!r} is not known; there are {', '.join(sorted(SOLVERS))}"
            )
        joints = tuple(_joint(joint, skeleton) for joint in entry.items("joints"))
        length = _CHAIN_LENGTHS.get(solver, len(joints))
        if len(joints) != length or not joints:
            raise entry["joints"].fail(f"{solver} needs {length or 'some'} joints, not {len(joints)}")
        for upper, lower in itertools.pairwise(joints):
            if skeleton.parents[lower] != upper:
                raise entry["joints"].fail(
                    f"{skeleton.names[lower]!r} is no child of {skeleton.names[upper]!r}; chains have no gaps"
                )
        effector = entry.get("effector")
        if effector is not None and effector.text() not in effectors:
            raise effector.fail(f"there is no effector {effector.text()!r}; there are {', '.join(effectors)}")
        if effector is not None and effectors[effector.text()].joint != joints[-1]:
            raise effector.fail(f"{effector.text()!r} does not sit on the chain's last joint")
        numbers = {
            key: node.number()
            for key, node in entry.members()
            if key not in ("name", "solver", "joints", "effector") and isinstance(node.value, (int, float))
        }
        chains[name] = Chain(
            name=name,
            joints=joints,
            solver=solver,
            effector=None if effector is None else effector.text(),
            kappa=numbers.get("kappa"),
            phi_rad=numbers.get("phi_rad"),
            settings=numbers,
        )
        if solver == "coupled_three_bone" and "kappa" not in numbers:
            raise entry.fail("coupled_three_bone needs 'kappa', θ3 / θ2")
        if solver == "planar_three_bone" and "phi_rad" not in numbers:
            raise entry.fail("planar_three_bone needs 'phi_rad', the last bone's direction")
    return chains


def _read_part(entry: Node) -> MovingPart:
    travel, axis, angle = entry.get("travel"), entry.get("axis"), entry.get("angle")
    shown_from = entry.get("shown_from")
    if travel is None and (axis is None or angle is None) and shown_from is None:
        raise entry.fail("a part needs 'travel', or 'axis' and 'angle', or 'shown_from'")
    return MovingPart(
        node=entry["node"].text(),
        parameter=entry["parameter"].text(),
        travel=None if travel is None else travel.numbers(3),
        axis=None if axis is None else axis.numbers(3),
        angle_rad=None if angle is None else angle.number(),
        shown_from=None if shown_from is None else shown_from.number(),
    )


def _read_button(entry: Node) -> Button:
    valve = entry["valve"].number()
    if valve != int(valve) or valve < 1:
        raise entry["valve"].fail(f"valves are numbered from 1, not {valve:g}")
    return Button(
        int(valve), entry["effector"].text(), entry["position"].numbers(3), entry["travel"].numbers(3)
    )


def _read_solid(entry: Node, skeleton: Skeleton) -> tuple[int, FloatArray, FloatArray, float, str | None]:
    """What capsules and cylinders have: joint, both ends, radius and the piece that it belongs to."""
    piece = entry.get("piece")
    return (
        _joint(entry["joint"], skeleton),
        entry["from"].numbers(3),
        entry["to"].numbers(3),
        entry["radius"].number(),
        None if piece is None else piece.text(),
    )


def _read_zones(document: Node, skeleton: Skeleton) -> dict[tuple[str, str], Zone]:
    zones: dict[tuple[str, str], Zone] = {}
    for entry in document.items("zones"):
        piece, name = entry["piece"].text(), entry["zone"].text()
        if (piece, name) in zones:
            raise entry["zone"].fail(f"{piece!r} has the zone {name!r} twice")
        normal = entry["normal"].numbers(3)
        length = float(np.linalg.norm(normal))
        if abs(length - 1.0) > _UNIT_TOLERANCE:
            raise entry["normal"].fail(f"a normal has length 1, not {length:.6g}")
        radius = entry["radius"].number()
        if radius < 0:
            raise entry["radius"].fail(f"a zone's radius is at least 0, not {radius:g}")
        joint, position = _joint(entry["joint"], skeleton), entry["position"].numbers(3)
        zones[piece, name] = Zone(piece, name, joint, position, normal / length, radius)
    return zones


def _joint(node: Node, skeleton: Skeleton) -> int:
    name = node.text()
    if name not in skeleton:
        raise RigError(f"there is no joint {name!r}", location=node.path)
    return skeleton.index(name)
