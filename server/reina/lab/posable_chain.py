"""A chain of a rig with everything that is needed to pose it by hand."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import JointChain
from reina.lab.solver_settings import SOLVERS, ChainKind, SolverName
from reina.rotations import conjugate, rotate
from reina.skeleton import Limits, forward_kinematics

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray
    from reina.skeleton import Chain, Rig

_KINDS: dict[str, ChainKind] = {
    "planar_three_bone": "finger",
    "coupled_three_bone": "finger",
    "two_bone": "limb",
}
"""What a chain is, by the solver that its rig names."""


@dataclass(frozen=True)
class Hinge:
    """One angle of a chain.

    Attributes:
        joint: Which of the chain's joints turns.
        place: Which letter of the joint's Euler order it is.
        axis: ``x``, ``y`` or ``z`` of the joint.
        minimum_rad: The rig's limit, from rest.
        maximum_rad: The rig's limit, from rest.
    """

    joint: int
    place: int
    axis: str
    minimum_rad: float
    maximum_rad: float


@dataclass(frozen=True, eq=False)
class PosableChain:
    """A chain, in the frame of the joint that carries it (the hand, the shoulder, the hips).

    Attributes:
        rig: Its rig.
        chain: The rig's own description of it.
        kind: What it is.
    """

    rig: Rig
    chain: Chain
    kind: ChainKind

    @property
    def name(self) -> str:
        """The chain's name in its rig."""
        return self.chain.name

    @property
    def solvers(self) -> tuple[SolverName, ...]:
        """What it can be solved with."""
        return SOLVERS[self.kind]

    @cached_property
    def limited(self) -> JointChain:
        """The chain with the rig's limits."""
        return JointChain.from_rig(self.rig, self.name)

    @cached_property
    def unlimited(self) -> JointChain:
        """The chain with the same hinges, each of which turns all the way."""
        return JointChain.from_rig(self.unlimited_rig, self.name)

    def joint_chain(self, *, limits: bool) -> JointChain:
        """The chain with or without limits."""
        return self.limited if limits else self.unlimited

    @cached_property
    def unlimited_rig(self) -> Rig:
        """The rig with this chain's hinges free; what was no hinge before is none now."""
        freed = {joint: _freed(self.rig.limits[joint]) for joint in self.joints if joint in self.rig.limits}
        return replace(self.rig, limits={**self.rig.limits, **freed})

    @cached_property
    def joints(self) -> tuple[int, ...]:
        """Indices of the joints that turn, from the base on."""
        return self.chain.joints if self.chain.effector is not None else self.chain.joints[:-1]

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Their names."""
        return tuple(self.rig.skeleton.names[joint] for joint in self.joints)

    @property
    def end_name(self) -> str:
        """What is brought to the target: an effector, or the last joint."""
        return self.chain.effector or self.rig.skeleton.names[self.chain.joints[-1]]

    @property
    def carrier(self) -> int:
        """The joint that carries the chain."""
        return int(self.rig.skeleton.parents[self.joints[0]])

    @cached_property
    def hinges(self) -> tuple[Hinge, ...]:
        """Its angles, from the base on."""
        chain = self.limited
        return tuple(
            Hinge(
                joint,
                place,
                chain.limits[joint].order[place],
                float(chain.low[joint, place]),
                float(chain.high[joint, place]),
            )
            for joint, place in chain.hinges
        )

    @cached_property
    def bone_lengths(self) -> FloatArray:
        """Metres, ``(N,)``."""
        return np.sqrt(np.sum(self.limited.links[1:] ** 2, axis=-1))

    @cached_property
    def planar_bends(self) -> FloatArray:
        """What the rest pose adds to a finger's hinge angles to make the paper's θ: radians, ``(N,)``.

        The first joint's θ is counted from its own rest axes, the others' from the bone before.
        """
        rest = self.limited.rest
        bends = 2.0 * np.arctan2(rest[:, 2], rest[:, 3])
        bends[0] = 0.0
        return bends

    @cached_property
    def rest_segments(self) -> FloatArray:
        """The rig's other bones at rest around the chain, ``(S, 2, 3)``, metres, in the carrier's frame.

        Around a finger that is the hand, around a limb the whole figure.
        """
        skeleton = self.rig.skeleton
        positions, rotations = forward_kinematics(skeleton, skeleton.rest_rotations)
        moved = set(self.joints)
        for joint in range(len(skeleton)):
            if int(skeleton.parents[joint]) in moved:
                moved.add(joint)
        helpers = {twist.joint for twist in self.rig.twists}
        shown = [
            joint
            for joint in range(1, len(skeleton))
            if joint not in moved
            and joint not in helpers
            and (self.kind == "limb" or self.carrier in {joint, *skeleton.ancestors(joint)})
        ]
        segments = np.array([[positions[skeleton.parents[joint]], positions[joint]] for joint in shown])
        inverse = conjugate(rotations[self.carrier])
        return rotate(inverse, segments - positions[self.carrier])


def posable_chains(rig: Rig) -> tuple[PosableChain, ...]:
    """The rig's fingers and limbs, in its own order; chains of other kinds are left out."""
    return tuple(
        PosableChain(rig, chain, _KINDS[chain.solver])
        for chain in rig.chains.values()
        if chain.solver in _KINDS
    )


def _freed(limits: Limits) -> Limits:
    low = tuple(-np.inf if a < b else a for a, b in zip(limits.minimum, limits.maximum, strict=True))
    high = tuple(np.inf if a < b else b for a, b in zip(limits.minimum, limits.maximum, strict=True))
    return Limits(limits.order, (low[0], low[1], low[2]), (high[0], high[1], high[2]))
