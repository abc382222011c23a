import itertools
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from reina import rotations as r
from reina.instruments.brass.slide_finger import YIELDING_M, SlideFinger
from reina.kinematics import FingerChains, excess_over_limits
from reina.skeleton import Hold, Rig, forward_kinematics

Array = NDArray[np.float64]

RING_M = 0.0095
"""Half the ring's width inside its wire."""


@dataclass(frozen=True)
class Ringed:
    finger: SlideFinger
    ring: Array
    """Its middle in the hand's frame, metres."""
    travel: Array


@pytest.fixture
def ringed(player_rig: Rig, trumpet_rig: Rig, hold: Hold) -> Ringed:
    held = hold.rotations(player_rig)
    positions, world = forward_kinematics(player_rig.skeleton, held, hold.hips_position)
    index = player_rig.skeleton.index("leftHand")
    to_hand = r.multiply(r.conjugate(world[index]), hold.instrument_rotation)
    travel = next(part.travel for part in trumpet_rig.parts if part.parameter == "trumpet/slide/3")
    assert travel is not None
    place = hold.instrument_position + r.rotate(hold.instrument_rotation, trumpet_rig.contact("ring").offset)
    ring = r.rotate(r.conjugate(world[index]), place - positions[index])
    way, yielding = r.rotate(to_hand, travel), r.rotate(to_hand, YIELDING_M)
    return Ringed(SlideFinger(player_rig, "leftRing", ring, way, yielding, held), ring, way)


@pytest.fixture
def finger(ringed: Ringed) -> SlideFinger:
    return ringed.finger


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


def test_its_axis_stays_within_the_ring_as_far_as_it_reaches(ringed: Ringed, player_rig: Rig) -> None:
    finger = ringed.finger
    assert finger.reach > 0.5
    ways = np.linspace(0.0, finger.reach, 40)
    # What it is told is held back near its reach: ask for so much that it goes all the way.
    asked = finger.reach * np.arctanh(np.minimum(ways / finger.reach, 0.98))
    ways = finger.reach * np.tanh(asked / finger.reach)
    rotations = finger.solve(asked)
    skeleton = player_rig.skeleton
    place = np.broadcast_to(skeleton.rest_translations[finger.joints[0]], (40, 3))
    turn: Array = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (40, 4))
    points: list[Array] = []
    tip = player_rig.effector("leftRingTip").offset
    for joint, link in enumerate([*skeleton.rest_translations[finger.joints[1:]], tip]):
        turn = r.multiply(turn, rotations[:, joint])
        points.append(place)
        place = place + r.rotate(turn, link)
    points.append(place)
    ring = ringed.ring + ways[:, None] * ringed.travel
    gaps = [
        np.linalg.norm(a + part * (b - a) - ring, axis=1)
        for a, b in itertools.pairwise(points)
        for part in np.linspace(0.0, 1.0, 30)
    ]
    assert np.min(gaps, axis=0).max() < RING_M


def test_the_way_is_worked_out_once_for_a_hold(
    ringed: Ringed, player_rig: Rig, hold: Hold, monkeypatch: pytest.MonkeyPatch
) -> None:
    solved: list[Array] = []

    def solve(chain: object, targets: Array, held: Array, **_: object) -> None:
        solved.append(targets)
        raise NotImplementedError

    monkeypatch.setattr("reina.instruments.brass.slide_finger.solve_damped_least_squares", solve)
    yielding, held = np.zeros(3), hold.rotations(player_rig)

    def another(travel: Array, bends: Array) -> SlideFinger:
        return SlideFinger(player_rig, "leftRing", ringed.ring, travel, bends, held)

    with pytest.raises(NotImplementedError):
        another(ringed.travel, yielding)
    assert len(solved) == 1
    monkeypatch.undo()
    first = another(ringed.travel, yielding)
    monkeypatch.setattr("reina.instruments.brass.slide_finger.solve_damped_least_squares", solve)
    again = another(ringed.travel.copy(), yielding.copy())
    assert len(solved) == 1
    way = np.linspace(0.0, 1.0, 60)
    np.testing.assert_array_equal(again.solve(way), first.solve(way))
