"""Arms with a stick in hand: tips at their places, wrists in their range, poses of their target alone."""

from pathlib import Path

import numpy as np
import pytest

from reina.kinematics import TwoBoneLimbs
from reina.kinematics.tool_arms import Tool, ToolArms, ToolPose, WristRange
from reina.rotations import conjugate, rotate
from reina.skeleton import load_rig

RIG = load_rig(Path(__file__).parents[3] / "rigs" / "soloist")
ARMS = TwoBoneLimbs(RIG, ["leftArm", "rightArm"])
ACROSS = np.radians(48.0)
FLEXION = (np.radians(-50.0), np.radians(45.0))
DEVIATION = np.radians([[-26.0, 16.0], [-16.0, 26.0]])
FRAMES = 500


def stick(side: float) -> Tool:
    direction = np.array([np.cos(ACROSS), 0.0, side * np.sin(ACROSS)])
    tip = 0.265 * direction - [0.0, 0.0048, 0.0]
    return Tool(np.array([0.092, -0.0275, 0.02 * side]), direction, tip)


TOOLS = (stick(1.0), stick(-1.0))
SOLVER = ToolArms(ARMS, TOOLS, [[0.2, 1.0, 0.0], [-0.2, 1.0, 0.0]], WristRange(FLEXION, DEVIATION))
SHOULDERS = np.broadcast_to([[0.2, 1.02, 0.0], [-0.2, 1.02, 0.0]], (FRAMES, 2, 3))
POLES = np.broadcast_to([[0.4, -1.0, -0.4], [-0.4, -1.0, -0.4]], (FRAMES, 2, 3))


def asked(seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Tips before the player, and directions that point ahead and inward."""
    rng = np.random.default_rng(seed)
    tips = rng.uniform([-0.2, 0.6, 0.35], [0.35, 1.0, 0.6], size=(FRAMES, 2, 3)) * [[[1, 1, 1], [-1, 1, 1]]]
    aside = np.radians(rng.uniform(-10.0, 45.0, size=(FRAMES, 2))) * [-1.0, 1.0]
    down = np.radians(rng.uniform(-20.0, 30.0, size=(FRAMES, 2)))
    directions = np.stack(
        [np.sin(aside) * np.cos(down), -np.sin(down), np.cos(aside) * np.cos(down)], axis=-1
    )
    return tips, directions


def ends(pose: ToolPose) -> np.ndarray:
    """Where the tips come to be, from wrists and hands alone."""
    offsets = np.stack([tool.fulcrum + tool.tip for tool in TOOLS])
    return pose.wrists + rotate(pose.hands, offsets)


def bends(pose: ToolPose) -> tuple[np.ndarray, np.ndarray]:
    """Flexion and deviation of the wrists, radians, from the solved arms."""
    limbs = ARMS.solve(SHOULDERS, pose.wrists, pose.hinges)
    elbows = SHOULDERS + rotate(limbs.upper, RIG.skeleton.rest_translations[ARMS.joints[:, 1]])
    forearms = pose.wrists - elbows
    forearms /= np.linalg.norm(forearms, axis=-1, keepdims=True)
    in_hand = rotate(conjugate(pose.hands), forearms)
    return (
        np.arctan2(in_hand[..., 1], in_hand[..., 0]),
        np.arctan2(in_hand[..., 2], np.hypot(in_hand[..., 0], in_hand[..., 1])),
    )


def test_tips_are_exactly_where_they_are_asked_to_be() -> None:
    tips, directions = asked()
    pose = SOLVER.solve(SHOULDERS, tips, directions, POLES)
    assert np.abs(ends(pose) - tips).max() < 1e-12
    reached = pose.lacking == 0.0
    assert reached.mean() > 0.9
    limbs = ARMS.solve(SHOULDERS, pose.wrists, pose.hinges)
    apart = np.linalg.norm(limbs.ends - pose.wrists, axis=-1)
    assert apart[reached].max() < 1e-9
    assert np.allclose(np.linalg.norm(pose.directions, axis=-1), 1.0)


def test_a_stick_lies_as_asked_where_the_wrist_lets_it() -> None:
    tips, directions = asked()
    pose = SOLVER.solve(SHOULDERS, tips, directions, POLES)
    flexion, deviation = bends(pose)
    inside = (
        (flexion > FLEXION[0] + 0.05)
        & (flexion < FLEXION[1] - 0.05)
        & (deviation > DEVIATION[:, 0] + 0.05)
        & (deviation < DEVIATION[:, 1] - 0.05)
        & (np.linalg.norm(pose.wrists - SHOULDERS, axis=-1) < 0.9 * ARMS.reach)
    )
    assert inside.mean() > 0.2
    gave = np.arccos(np.clip(np.sum(pose.directions * directions, axis=-1), -1.0, 1.0))
    unmoved = gave < 1e-6
    assert (unmoved & inside).sum() > 0.1 * inside.sum()
    # What was asked within the range is never turned.
    first = SOLVER.solve(SHOULDERS, tips, pose.directions, POLES)
    again = np.arccos(np.clip(np.sum(first.directions * pose.directions, axis=-1), -1.0, 1.0))
    assert np.degrees(again[inside]).max() < 2.0


def test_wrists_are_brought_toward_their_range() -> None:
    tips, directions = asked()
    free = ToolArms(
        ARMS, TOOLS, [[0.2, 1.0, 0.0], [-0.2, 1.0, 0.0]], WristRange((-4.0, 4.0), np.array([[-4.0, 4.0]] * 2))
    )

    def beyond(pose: ToolPose) -> np.ndarray:
        flexion, deviation = bends(pose)
        return np.maximum.reduce(
            [
                FLEXION[0] - flexion,
                flexion - FLEXION[1],
                DEVIATION[:, 0] - deviation,
                deviation - DEVIATION[:, 1],
                np.zeros_like(flexion),
            ]
        )

    loose = beyond(free.solve(SHOULDERS, tips, directions, POLES))
    kept = beyond(SOLVER.solve(SHOULDERS, tips, directions, POLES))
    assert np.degrees(np.percentile(kept, 90)) < 8.0 < np.degrees(np.percentile(loose, 90))


@pytest.mark.parametrize("place", [0, 3, FRAMES - 1])
def test_a_pose_depends_on_its_own_target_alone(place: int) -> None:
    tips, directions = asked()
    whole = SOLVER.solve(SHOULDERS, tips, directions, POLES)
    one = slice(place, place + 1)
    alone = SOLVER.solve(SHOULDERS[one], tips[one], directions[one], POLES[one])
    assert np.abs(alone.wrists[0] - whole.wrists[place]).max() < 1e-12
    assert np.abs(alone.hands[0] - whole.hands[place]).max() < 1e-12
