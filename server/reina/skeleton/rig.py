"""A rig: a skeleton and what a player or an instrument has on it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeVar

from reina.skeleton.errors import RigError

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray
    from reina.skeleton.motion_clip import MotionClip
    from reina.skeleton.skeleton import Skeleton


T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Point:
    """A named place that moves with a joint: an effector (a fingertip's pad) or a contact (lips, a sole).

    Attributes:
        name: Its name, ``rightIndexTip``.
        joint: Index of the joint that carries it.
        offset: In the joint's frame, metres, ``(3,)``.
    """

    name: str
    joint: int
    offset: FloatArray


@dataclass(frozen=True)
class Limits:
    """How far a joint may turn from rest: Euler angles of rest⁻¹·q.

    Attributes:
        order: Euler order as `reina.rotations.from_euler` reads it.
        minimum: Radians about x, y and z.
        maximum: Radians about x, y and z.
    """

    order: str
    minimum: tuple[float, float, float]
    maximum: tuple[float, float, float]


@dataclass(frozen=True)
class Chain:
    """Joints that a solver may move, and how.

    Attributes:
        name: ``rightIndex``, ``leftArm``.
        joints: Indices, parents first.
        solver: One of `SOLVERS`.
        effector: Name of the effector that is to reach the target; None where the last joint itself is.
        kappa: θ3 / θ2 of a coupled finger, or None.
        phi_rad: The last bone's direction in the paper's planar finger, radians, or None.
        settings: Every number that the document gives besides.
    """

    name: str
    joints: tuple[int, ...]
    solver: str
    effector: str | None = None
    kappa: float | None = None
    phi_rad: float | None = None
    settings: dict[str, float] = field(default_factory=dict[str, float])


@dataclass(frozen=True)
class Twist:
    """A helper joint that takes a part of another's turn about the bone.

    Attributes:
        joint: Index of the helper; it turns about its own x.
        source: Index of the joint whose rest⁻¹·q is read about x.
        fraction: How much of that angle the helper turns by.
    """

    joint: int
    source: int
    fraction: float


@dataclass(frozen=True)
class Morph:
    """A morph target of the model and the parameter that drives it."""

    parameter: str
    target: str


@dataclass(frozen=True, eq=False)
class Capsule:
    """A solid part for collisions: a segment in a joint's frame with a radius, metres, and round ends.

    Attributes:
        piece: What of an instrument it belongs to, `Zone.piece` where that is struck; None if none.
    """

    joint: int
    start: FloatArray
    end: FloatArray
    radius: float
    piece: str | None = None


@dataclass(frozen=True, eq=False)
class Cylinder:
    """A solid part with flat ends, as drums and cymbals are; otherwise as `Capsule`."""

    joint: int
    start: FloatArray
    end: FloatArray
    radius: float
    piece: str | None = None


@dataclass(frozen=True, eq=False)
class Zone:
    """Where a piece of a kit is struck, in a joint's frame, metres.

    Where a part moves the joint's node, the zone goes with it, by the part's travel times its parameter.

    Attributes:
        piece: ``snare``, ``ride``.
        name: Which of the piece's zones: ``centre``, ``edge``, ``rim``; ``bow``, ``bell``, ``edge``.
        joint: Index of the joint that carries it.
        position: On the surface, ``(3,)``.
        normal: Out of the surface, unit, ``(3,)``.
        radius: How far from there along the surface a tip may land and still be in it.
    """

    piece: str
    name: str
    joint: int
    position: FloatArray
    normal: FloatArray
    radius: float


@dataclass(frozen=True, eq=False)
class MovingPart:
    """A node of an instrument's model that a parameter moves, or shows.

    Attributes:
        node: The node's name in the model.
        parameter: ``trumpet/valve/1``.
        travel: Metres from 0 to 1 in the instrument's frame ``(3,)``; None for other parts.
        axis: Unit axis that it turns about ``(3,)``, or None.
        angle_rad: Angle from 0 to 1, or None.
        shown_from: The value from which on the part is there at all, or None.
    """

    node: str
    parameter: str
    travel: FloatArray | None = None
    axis: FloatArray | None = None
    angle_rad: float | None = None
    shown_from: float | None = None


@dataclass(frozen=True, eq=False)
class Button:
    """What a finger presses, in the instrument's frame, metres.

    Attributes:
        valve: 1-based number of the valve that it moves.
        effector: The player's effector that presses it.
        position: When up, ``(3,)``.
        travel: From up to down, ``(3,)``.
    """

    valve: int
    effector: str
    position: FloatArray
    travel: FloatArray


SOLVERS: frozenset[str] = frozenset(
    {"planar_three_bone", "coupled_three_bone", "two_bone", "ccd", "fabrik", "damped_least_squares"}
)
"""Solvers that a chain may name."""


@dataclass(frozen=True, eq=False)
class Rig:
    """A skeleton with everything that solvers, performances and pages need to know about it.

    Attributes:
        name: The rig's folder.
        skeleton: Its joints.
        nodes: The models' node of each joint, J names.
        effectors: By name.
        contacts: By name.
        chains: By name.
        limits: By joint index; joints that are not in it turn freely.
        twists: Helpers, in the document's order.
        morphs: In the document's order.
        capsules: In the document's order.
        parts: What an instrument's parameters move.
        buttons: What the player's fingers press.
        cylinders: Solid parts with flat ends, in the document's order.
        zones: Where the pieces of a kit are struck, by piece and the zone's name.
        clips: Motion of its own, ``clips/<name>.bvh`` in its folder, by name.
    """

    name: str
    skeleton: Skeleton
    nodes: tuple[str, ...]
    effectors: dict[str, Point]
    contacts: dict[str, Point]
    chains: dict[str, Chain]
    limits: dict[int, Limits]
    twists: tuple[Twist, ...]
    morphs: tuple[Morph, ...]
    capsules: tuple[Capsule, ...]
    parts: tuple[MovingPart, ...]
    buttons: tuple[Button, ...]
    clips: dict[str, MotionClip] = field(default_factory=dict[str, "MotionClip"])
    cylinders: tuple[Cylinder, ...] = ()
    zones: dict[tuple[str, str], Zone] = field(default_factory=dict[tuple[str, str], Zone])

    def effector(self, name: str) -> Point:
        """An effector by name; RigError lists them where there is none of that name."""
        return _find(self.effectors, name, "effector")

    def contact(self, name: str) -> Point:
        """A contact by name; RigError lists them where there is none of that name."""
        return _find(self.contacts, name, "contact")

    def chain(self, name: str) -> Chain:
        """A chain by name; RigError lists them where there is none of that name."""
        return _find(self.chains, name, "chain")

    def zone(self, piece: str, name: str) -> Zone:
        """A zone of a piece; RigError lists the zones where there is none of that name."""
        zone = self.zones.get((piece, name))
        if zone is None:
            known = ", ".join(" ".join(key) for key in self.zones) or "none"
            raise RigError(f"there is no zone {name!r} of {piece!r}; there are: {known}", location="zones")
        return zone

    def chain_of_effector(self, effector: str) -> Chain:
        """The chain that brings an effector to its target.

        Raises:
            RigError: No chain does.
        """
        for chain in self.chains.values():
            if chain.effector == effector:
                return chain
        raise RigError(f"rig {self.name!r} has no chain for the effector {effector!r}", location="chains")


def _find(table: dict[str, T], name: str, kind: str) -> T:
    try:
        return table[name]
    except KeyError:
        known = ", ".join(table) or "none"
        raise RigError(f"there is no {kind} {name!r}; there are: {known}", location=f"{kind}s") from None
