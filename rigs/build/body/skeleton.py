"""The player's skeleton at rest: where each joint lies and how its axes stand."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from body.fingers import finger_joints, hand_axes, knuckles, thumb_joints
from body.joint_names import FINGERS, PHALANGES, SIDES, source_bones

if TYPE_CHECKING:
    from body.figure import Figure

Array = NDArray[np.float64]


@dataclass
class Skeleton:
    """Joints in order, parents first: world positions (3,) in m and world axes (3, 3), columns X Y Z."""

    parents: dict[str, str | None] = field(default_factory=dict[str, "str | None"])
    positions: dict[str, Array] = field(default_factory=dict[str, Array])
    axes: dict[str, Array] = field(default_factory=dict[str, Array])
    effectors: dict[str, tuple[str, Array]] = field(
        default_factory=dict[str, "tuple[str, Array]"]
    )  # name: (joint, world position)

    @property
    def names(self) -> list[str]:
        """The joints' names, parents first."""
        return list(self.parents)

    def add(self, name: str, parent: str | None, position: Array, axes: Array | None = None) -> None:
        """Append a joint; its parent must be there already."""
        if parent is not None and parent not in self.parents:
            raise ValueError(f"joint {name!r} comes before its parent {parent!r}")
        self.parents[name] = parent
        self.positions[name] = np.asarray(position, dtype=np.float64)
        self.axes[name] = np.eye(3) if axes is None else axes

    def local(self, name: str) -> tuple[Array, Array]:
        """The joint's rest translation (3,) and quaternion (4,) x y z w in its parent's frame."""
        parent = self.parents[name]
        if parent is None:
            return self.positions[name], _quaternion(self.axes[name])
        turn = self.axes[parent].T
        return turn @ (self.positions[name] - self.positions[parent]), _quaternion(turn @ self.axes[name])

    def to_local(self, joint: str, point: Array) -> Array:
        """A world point (3,) at rest in the joint's own frame."""
        offset: Array = self.axes[joint].T @ (point - self.positions[joint])
        return offset


def build_skeleton(figure: Figure) -> Skeleton:
    """Lay the VRM joints into the figure; see rigs/README.md for the axes."""
    skeleton = Skeleton()
    places = {name: figure.bone_heads[bone] for name, (_, bone) in source_bones().items()}
    axes: dict[str, Array] = {}
    faces = figure.mesh.triangles(["body"])
    for side, letter in SIDES:
        mcp = knuckles(figure, letter, faces)
        axes[f"{side}Hand"] = hand_axes(places[f"{side}Hand"], mcp, side)
        for finger in FINGERS:
            joints = finger_joints(figure, letter, finger, mcp[finger], axes[f"{side}Hand"], faces)
            for part, place in zip(PHALANGES, joints.places, strict=True):
                places[f"{side}{finger}{part}"] = place
            axes.update({f"{side}{finger}{p}": a for p, a in zip(PHALANGES, joints.axes, strict=True)})
            skeleton.effectors[f"{side}{finger}Tip"] = (f"{side}{finger}Distal", joints.pad)
        thumb = thumb_joints(figure, letter, places[f"{side}LittleProximal"], faces)
        for part, place, turn in zip(
            ("ThumbMetacarpal", "ThumbProximal", "ThumbDistal"), thumb.places, thumb.axes, strict=True
        ):
            places[f"{side}{part}"], axes[f"{side}{part}"] = place, turn
        skeleton.effectors[f"{side}ThumbTip"] = (f"{side}ThumbDistal", thumb.pad)
        axes.update(_arm_axes(side, places))
    for name, (parent, _) in source_bones().items():
        skeleton.add(name, parent, places[name], axes.get(name))
        if name == "head":
            for side, letter in SIDES:
                skeleton.add(f"{side}Eye", "head", figure.centre(f"helper-{letter}-eye"))
        if name.endswith(("UpperArm", "LowerArm")):
            child = name.replace("Upper", "Lower") if "Upper" in name else name.replace("LowerArm", "Hand")
            middle = (places[name] + places[child]) / 2
            skeleton.add(f"{name}Twist1", name, middle, axes[name])
    return skeleton


def _arm_axes(side: str, places: dict[str, Array]) -> dict[str, Array]:
    """Upper and lower arm: X along the bone, Y (up) the elbow's hinge, shared: the elbow is a pure Y turn."""
    shoulder, elbow, wrist = (places[f"{side}{part}"] for part in ("UpperArm", "LowerArm", "Hand"))
    hinge = np.cross(wrist - elbow, elbow - shoulder)
    hinge = hinge * (np.sign(hinge[1]) / float(np.linalg.norm(hinge)))
    result: dict[str, Array] = {}
    for name, bone in ((f"{side}UpperArm", elbow - shoulder), (f"{side}LowerArm", wrist - elbow)):
        x: Array = bone / float(np.linalg.norm(bone))
        result[name] = np.column_stack([x, hinge, np.cross(x, hinge)]).astype(np.float64)
    return result


def _quaternion(matrix: Array) -> Array:
    """X y z w with w ≥ 0."""
    quaternion: Array = Rotation.from_matrix(matrix).as_quat()
    return -quaternion if quaternion[3] < 0 else quaternion
