"""How a drummer sits: the balls of the feet on the pedals, sticks in the hands, joints within limits."""

from pathlib import Path

import numpy as np
import pytest

from reina.instruments.player import HeldPose
from reina.kinematics import excess_over_limits
from reina.rotations import conjugate, multiply, rotate
from reina.skeleton import Hold, Rig, forward_kinematics, load_hold, load_rig

RIGS = Path(__file__).resolve().parents[3] / "rigs"
PLAYERS = sorted(path.parents[1].name for path in RIGS.glob("*/holds/drumkit.json"))
KIT = load_rig(RIGS / "drumkit")
STICK_RADIUS_M = 0.0072


@pytest.fixture(params=PLAYERS)
def seated(request: pytest.FixtureRequest) -> tuple[Rig, Hold, HeldPose]:
    """A player at the kit."""
    folder = RIGS / request.param
    rig, hold = load_rig(folder), load_hold(folder, "drumkit")
    return rig, hold, HeldPose(rig, hold)


def test_somebody_sits_at_the_kit() -> None:
    assert "soloist" in PLAYERS


def test_every_joint_is_within_its_limits(seated: tuple[Rig, Hold, HeldPose]) -> None:
    rig, _, held = seated
    for joint, limits in rig.limits.items():
        excess = excess_over_limits(held.rotations[joint], rig.skeleton.rest_rotations[joint], limits)
        assert np.degrees(excess) < 0.01, f"{rig.skeleton.names[joint]}: {np.degrees(excess):.1f} degrees"


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_ball_of_the_foot_is_on_its_pedal(seated: tuple[Rig, Hold, HeldPose], side: str) -> None:
    rig, _, held = seated
    places, turns = forward_kinematics(KIT.skeleton, KIT.skeleton.rest_rotations)
    pedal = KIT.contact(f"{side}Pedal")
    board = places[pedal.joint] + rotate(turns[pedal.joint], pedal.offset)
    foot, toes = (rig.skeleton.index(f"{side}{part}") for part in ("Foot", "Toes"))
    # Under the toes' joint, where the sole is at rest.
    rest, rest_turns = forward_kinematics(rig.skeleton, rig.skeleton.rest_rotations)
    ball = rotate(conjugate(rest_turns[foot]), rest[toes] * [1.0, 0.0, 1.0] - rest[foot])
    assert np.linalg.norm(held.positions[foot] + rotate(held.world[foot], ball) - board) < 0.001
    knee, hip = (held.positions[rig.skeleton.index(f"{side}{part}")] for part in ("LowerLeg", "UpperLeg"))
    shin, thigh = held.positions[foot] - knee, hip - knee
    angle = np.degrees(np.arccos(shin @ thigh / np.linalg.norm(shin) / np.linalg.norm(thigh)))
    assert 80.0 < angle < 130.0


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_fingers_are_round_the_stick(seated: tuple[Rig, Hold, HeldPose], side: str) -> None:
    rig, hold, held = seated
    attached = hold.attachments[f"{side}_stick"]
    hand = rig.skeleton.index(attached.joint)
    grip = held.positions[hand] + rotate(held.world[hand], attached.position)
    along = rotate(multiply(held.world[hand], attached.rotation), np.array([0.0, 0.0, 1.0]))
    for finger in ("Thumb", "Index", "Middle", "Ring", "Little"):
        pad = rig.effector(f"{side}{finger}Tip")
        place = held.positions[pad.joint] + rotate(held.world[pad.joint], pad.offset)
        apart = place - grip
        from_axis = np.linalg.norm(apart - along * (apart @ along))
        assert abs(from_axis - STICK_RADIUS_M) < 0.004, f"{finger}: {1000 * from_axis:.1f} mm from the axis"
