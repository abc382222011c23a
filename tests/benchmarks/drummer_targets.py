"""What a drummer's arms are asked for, recorded from performances, and such an arm as a chain of hinges."""

from __future__ import annotations

from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from unittest import mock

import numpy as np
from machine import ROOT
from tests.integration.test_drum_audit import SCORES, midi

from reina.instruments import Cast, Casting
from reina.instruments.drums import body as drums_body
from reina.instruments.player.body import PlayerBody
from reina.instruments.player.held_pose import HeldPose
from reina.instruments.player.trunk_reach import LIMITS
from reina.kinematics import JointChain
from reina.kinematics.tool_arms import ToolArms
from reina.music import read_score
from reina.rotations import conjugate, multiply, rotate
from reina.sessions.production import Production
from reina.sessions.stage import Stage
from reina.skeleton import Limits, load_hold, load_rig

if TYPE_CHECKING:
    from collections.abc import Generator

    from reina.performance import Performance
    from reina.rotations.arrays import FloatArray

RIGS = ROOT / "rigs"
PLAYER, KIT = "soloist", "drumkit"
SIDES = ("left", "right")
SAINTS = "when-the-saints.mid"
FRAMES = 60


@dataclass(frozen=True)
class Call:
    """A call that was made: of which object, with what."""

    subject: Any
    arguments: tuple[Any, ...]
    named: dict[str, Any]


@dataclass(frozen=True)
class Recorded:
    """What was asked for in a performance, block by block."""

    arms: list[Call]
    """Of `ToolArms.solve`: shoulders, tips, directions, poles, ``(60, 2, 3)`` each."""
    stands: list[Call]
    """Of `PlayerBody.stand`."""
    trunk: Call
    """Of `reach_out`: body, wrists ``(N, 2, 3)``, pivot, signals."""


def drummer(stage: Stage, data: bytes) -> tuple[Performance, int]:
    """A performance by a drummer alone, and how many blocks it has."""
    score = read_score(data, filename="drums.mid")
    cast = Cast((Casting(part=None, instrument="drums", player=PLAYER),), None)
    return Production.plan(stage, score, cast=cast).performance, int(score.duration_s) + 1


def scores() -> dict[str, bytes]:
    """The example, and scores made to break a drummer (tests/integration/test_drum_audit.py)."""
    saints = (ROOT / "examples" / "scores" / SAINTS).read_bytes()
    return {SAINTS: saints, **{name: midi(*score) for name, score in SCORES.items()}}


def load_stage() -> Stage:
    """Every rig that there is."""
    return Stage.load(RIGS)


def record(stage: Stage, data: bytes) -> Recorded:
    """Play a score, and keep what arms and trunk were asked for."""
    with _kept(drums_body, "reach_out") as trunk:
        performance, blocks = drummer(stage, data)
    with ExitStack() as stack:
        arms = stack.enter_context(_kept(ToolArms, "solve"))
        stands = stack.enter_context(_kept(PlayerBody, "stand"))
        for block in range(blocks):
            performance.evaluate(block)
    return Recorded(arms, stands, trunk[0])


@contextmanager
def _kept(owner: Any, name: str) -> Generator[list[Call]]:
    """All calls of a function while this lasts."""
    calls: list[Call] = []
    real = getattr(owner, name)

    def keep(*arguments: Any, **named: Any) -> Any:
        own = isinstance(owner, type)
        calls.append(Call(arguments[0] if own else None, arguments[own:], named))
        return real(*arguments, **named)

    with mock.patch.object(owner, name, keep):
        yield calls


def tips_in_hands() -> FloatArray:
    """Where the sticks' tips are in the hands' frames, left and right, metres, ``(2, 3)``."""
    hold = load_hold(RIGS / PLAYER, KIT)
    tips: list[FloatArray] = []
    for side in SIDES:
        attached = hold.attachments[f"{side}_stick"]
        tip = load_rig(RIGS / f"{side}_stick").effector(f"{side}StickTip").offset
        tips.append(attached.position + rotate(attached.rotation, tip))
    return np.stack(tips)


def arm_chain(side: int) -> tuple[JointChain, FloatArray]:
    """Trunk, collarbone, shoulder, elbow, wrist and stick as one chain, and its angles in the hold.

    The trunk turns and bows and tips about the foot of the spine, the collarbone brings the shoulder forward,
    both as far as `reach_out` lets them; the arm has the rig's limits.

    Returns:
        The chain, in the world, and the angles of its hinges, ``(M,)``, radians.
    """
    rig, hold = load_rig(RIGS / PLAYER), load_hold(RIGS / PLAYER, KIT)
    held = HeldPose(rig, hold)
    names = [f"{SIDES[side]}{bone}" for bone in ("UpperArm", "LowerArm", "Hand")]
    spine, collarbone, *arm = (
        rig.skeleton.index(name) for name in ("spine", f"{SIDES[side]}Shoulder", *names)
    )
    parents = rig.skeleton.parents
    low, high = LIMITS.tolist()  # bow about x, turn about y, tip about z, then each collarbone about ±y
    forward = (low[3], high[3]) if side else (-high[3], -low[3])
    places, rest = held.positions, rig.skeleton.rest_rotations
    still = np.array([0.0, 0.0, 0.0, 1.0])
    # Up to the shoulder the joints' frames are the world's in the hold.
    chain = JointChain(
        np.stack(
            [
                places[spine],
                places[collarbone] - places[spine],
                places[arm[0]] - places[collarbone],
                *rig.skeleton.rest_translations[arm[1:]],
                tips_in_hands()[side],
            ]
        ),
        np.stack([still, still, multiply(held.world[parents[arm[0]]], rest[arm[0]]), *rest[arm[1:]]]),
        (
            Limits("yxz", (low[0], low[1], low[2]), (high[0], high[1], high[2])),
            Limits("yxz", (0.0, forward[0], 0.0), (0.0, forward[1], 0.0)),
            *(rig.limits.get(joint) for joint in arm),
        ),
    )
    local = np.stack(
        [still, still, held.world[arm[0]]]
        + [multiply(conjugate(held.world[parents[joint]]), held.world[joint]) for joint in arm[1:]]
    )
    angles = chain.angles(local[None])[0]
    return chain, np.array([angles[joint, place] for joint, place in chain.hinges])
