from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from tests.unit.skeleton.figures import POSES, figure

from reina.curves import ParameterRegistry
from reina.instruments.player.held_pose import HeldPose
from reina.instruments.player.posed_stance import retarget_pose
from reina.instruments.player.stance_choice import PASSAGE_S, StanceChoice
from reina.instruments.player.stances import STANCES, Stances
from reina.performance import Performance
from reina.rotations import angle_between, exp, multiply, rotate
from reina.show import Show, TimeMap
from reina.skeleton import Hold, Rig, clip_of_motion, human_pose, read_bvh, write_bvh

NoteBeats = tuple[float, float, int]
Perform = Callable[..., Performance]


def only(choice: str, frames: int) -> np.ndarray:
    weights = np.zeros((frames, len(STANCES)))
    weights[:, STANCES.index(choice)] = 1.0
    return weights


@pytest.fixture(scope="module")
def stances(player_rig: Rig) -> Stances:
    return Stances(player_rig)


def test_the_rig_has_a_clip_for_every_choice(player_rig: Rig) -> None:
    assert set(player_rig.clips) == set(STANCES) - {"none"}


@pytest.mark.parametrize("choice", STANCES[1:])
def test_a_stance_goes_round_and_round_without_a_jump(stances: Stances, player_rig: Rig, choice: str) -> None:
    clip = player_rig.clips[choice]
    length_s = (len(clip) - 1) * clip.frame_time_s
    times = np.arange(round(3.0 * length_s * 240.0)) / 240.0
    moved = stances.evaluate(times, only(choice, len(times)))
    assert moved is not None
    assert moved.shape == (len(times), len(stances.joints) + 1, 3)
    again = stances.evaluate(times + length_s, only(choice, len(times)))
    assert again is not None
    np.testing.assert_allclose(moved, again, atol=1e-9)
    # Neither the way nor the speed jumps, at the seam no more than elsewhere.
    speed = np.diff(moved, axis=0) * 240.0
    assert np.abs(speed).max() < 0.15
    assert np.abs(np.diff(speed, axis=0)).max() * 240.0 < 1.2
    assert np.ptp(moved, axis=0).max() > 0.01


def test_it_begins_with_nothing_and_passes_through_its_frames(stances: Stances, player_rig: Rig) -> None:
    clip = player_rig.clips["swaying"]
    times: np.ndarray = np.arange(len(clip)) * clip.frame_time_s
    moved = stances.evaluate(times, only("swaying", len(clip)))
    assert moved is not None
    assert np.abs(moved[[0, -1]]).max() < 1e-9
    roots = clip.values[:, :3] - clip.values[0, :3]
    np.testing.assert_allclose(moved[:, -1], roots, atol=1e-7)


def test_no_stance_adds_nothing(stances: Stances) -> None:
    assert stances.evaluate(np.arange(4.0), only("none", 4)) is None
    assert stances.evaluate(np.arange(4.0), np.zeros((4, len(STANCES)))) is None


def test_a_clip_that_is_no_loop_is_refused(player_rig: Rig) -> None:
    clip = player_rig.clips["shifting"]
    short = replace(clip, values=clip.values[:100])
    with pytest.raises(ValueError, match="'shifting' does not end where it begins"):
        Stances(replace(player_rig, clips={"shifting": short}))


def test_a_rig_without_clips_stands_still(player_rig: Rig) -> None:
    assert Stances(replace(player_rig, clips={})).evaluate(np.arange(4.0), only("swaying", 4)) is None


def chosen(registry: ParameterRegistry, *keyframes: tuple[float, str]) -> StanceChoice:
    track = {
        "parameter": "player/stance",
        "keyframes": [{"time": time, "value": value} for time, value in keyframes],
    }
    show = Show.from_document({"version": 1, "tracks": [track] if keyframes else []}, registry)
    return StanceChoice(show.plan(registry, TimeMap.steady()))


def test_weights_pass_smoothly_from_one_choice_to_the_next(registry: ParameterRegistry) -> None:
    choice = chosen(registry, (0.0, "none"), (4.0, "swaying"), (10.0, "breathing"))
    times = np.arange(0, 900) / 60
    weights = choice.weights(times)
    np.testing.assert_allclose(weights.sum(axis=1), 1.0)
    np.testing.assert_array_equal(weights[:239], only("none", 239))
    np.testing.assert_allclose(weights[times > 4.0 + PASSAGE_S][:200], only("swaying", 200), atol=1e-12)
    np.testing.assert_allclose(weights[-100:], only("breathing", 100), atol=1e-12)
    assert np.abs(np.diff(weights, axis=0)).max() < 1.0 / (PASSAGE_S * 60.0) * 2.0
    # Whatever is asked for together, a time has its weights.
    scattered = np.array([0.5, 4.7, 4000.0, 10.3])
    for row, time in zip(choice.weights(scattered), scattered, strict=True):
        np.testing.assert_allclose(row, choice.weights(np.array([time]))[0], atol=1e-12)


def test_without_a_track_the_default_stands_from_the_beginning(registry: ParameterRegistry) -> None:
    default = registry["player/stance"].default
    np.testing.assert_array_equal(chosen(registry).weights(np.arange(3.0)), only(str(default), 3))


def test_a_change_of_stance_is_no_jump_in_the_frames(
    perform: Perform, tune: list[NoteBeats], registry: ParameterRegistry
) -> None:
    performance = perform(tune)
    track = {
        "parameter": "player/stance",
        "keyframes": [{"time": 0, "value": "swaying"}, {"time": 4.0, "value": "shifting"}],
    }
    show = Show.from_document({"version": 1, "tracks": [track]}, registry)
    changing = performance.with_show(show.plan(registry, TimeMap.steady()))
    roots = np.concatenate([changing.evaluate(block).root_positions[:, 0] for block in range(2, 8)])
    other = np.concatenate([performance.evaluate(block).root_positions[:, 0] for block in range(2, 8)])
    assert np.abs(roots - other)[:100].max() > 0.005
    np.testing.assert_array_equal(roots[-100:], other[-100:])
    assert np.linalg.norm(np.diff(roots, axis=0), axis=1).max() * 60.0 < 0.1


def test_an_exported_pose_put_back_is_that_pose(
    perform: Perform, tune: list[NoteBeats], player_rig: Rig, hold: Hold
) -> None:
    """Trunk and legs, in a frame of a performance written as BVH and read again."""
    skeleton, held = player_rig.skeleton, HeldPose(player_rig, hold)
    values = {"player/stance": "none", "player/sway": 0.0}
    block = perform(tune, values=values).evaluate(2)
    rotations = block.rotations[:1, : len(skeleton)].astype(np.float64)
    clip = clip_of_motion(skeleton, rotations, block.root_positions[:1, 0], 1.0 / 60.0)
    stance = retarget_pose(human_pose(read_bvh(write_bvh(clip)), 0.0), player_rig, held)
    trunk = [skeleton.index(name) for name in ("hips", "spine", "chest", "upperChest")]
    shown = multiply(held.rotations[trunk], exp(stance.turns[: len(trunk)]))
    assert np.degrees(angle_between(shown, rotations[0, trunk])).max() < 1.0
    assert np.degrees(np.linalg.norm(stance.feet_turns, axis=1)).max() < 1.0
    assert np.abs(stance.feet).max() < 0.015
    assert np.abs(stance.hips - (block.root_positions[0, 0] - held.root)).max() < 0.015


@pytest.mark.parametrize("pose", POSES)
def test_both_feet_of_a_pose_stand_on_the_floor(player_rig: Rig, hold: Hold, pose: str) -> None:
    held = HeldPose(player_rig, hold)
    stance = retarget_pose(human_pose(figure(pose), 0.1), player_rig, held)
    for side, ankle, turn, place in zip(
        ("left", "right"), held.positions[feet(player_rig)], stance.feet_turns, stance.feet, strict=True
    ):
        joint = player_rig.skeleton.index(f"{side}Foot")
        sole = player_rig.contact(f"{side}Sole").offset
        world = multiply(exp(turn), held.world[joint])
        height = float((ankle + place + rotate(world, sole))[1])
        # The sole's point is its middle: a heel that is lifted lifts it too.
        assert -0.005 < height < 0.09, side


def test_poses_blend_as_clips_do(player_rig: Rig, hold: Hold) -> None:
    pose = human_pose(figure("crouch"), 0.1)
    stances = Stances(player_rig, [pose], HeldPose(player_rig, hold))
    assert stances.count == len(STANCES) + 1
    weights = np.zeros((3, stances.count))
    weights[:, STANCES.index("none")] = [1.0, 0.5, 0.0]
    weights[:, -1] = [0.0, 0.5, 1.5]
    moved = stances.evaluate(np.zeros(3), weights)
    assert moved is not None
    np.testing.assert_allclose(moved[1], 0.5 * moved[2])
    np.testing.assert_array_equal(moved[0], 0.0)
    assert moved[2, len(stances.joints), 1] < -0.1


def feet(rig: Rig) -> list[int]:
    return [rig.skeleton.index(f"{side}Foot") for side in ("left", "right")]
