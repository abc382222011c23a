import numpy as np
import pytest

from reina import rotations as r
from reina.kinematics import FingerChains, excess_over_limits
from reina.performance.slide_finger import SlideFinger
from reina.skeleton import Hold, Rig, forward_kinematics


@pytest.fixture
def finger(player_rig: Rig, trumpet_rig: Rig, hold: Hold) -> SlideFinger:
    held = hold.rotations(player_rig)
    _, world = forward_kinematics(player_rig.skeleton, held)
    hand = r.multiply(r.conjugate(hold.instrument_rotation), world[player_rig.skeleton.index("leftHand")])
    travel = next(part.travel for part in trumpet_rig.parts if part.parameter == "trumpet/slide/3")
    assert travel is not None
    return SlideFinger(player_rig, "leftRing", travel, hand, held)


def test_with_the_slide_in_the_finger_is_as_it_holds(finger: SlideFinger) -> None:
    np.testing.assert_array_equal(finger.solve(np.zeros(60)), np.broadcast_to(finger.held, (60, 3, 4)))
    barely = finger.solve(np.full(2, 1e-9))
    assert r.angle_between(barely, finger.held).max() < 1e-6


def test_it_goes_along_smoothly_and_within_its_limits(finger: SlideFinger, player_rig: Rig) -> None:
    way = np.linspace(0.0, 1.0, 400)
    rotations = finger.solve(way)
    chains = FingerChains(player_rig, ["leftRing"])
    tips = chains.tips(rotations[:, None])[:, 0]
    assert np.linalg.norm(tips[-1] - tips[0]) > 0.002
    steps = r.angle_between(rotations[1:], rotations[:-1])
    assert steps.max() < 0.02
    for place, joint in enumerate(finger.joints.tolist()):
        rest = player_rig.skeleton.rest_rotations[joint]
        assert excess_over_limits(rotations[:, place], rest, player_rig.limits[joint]).max() < 1e-9
    assert 0.0 < finger.reach <= 1.0
