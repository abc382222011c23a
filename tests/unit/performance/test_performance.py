from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tests.unit.skeleton.figures import POSES, figure

from reina import rotations as r
from reina.curves import ParameterRegistry
from reina.instruments.brass.fingering import brass_fingering
from reina.instruments.player.pose_keys import POSE_PARAMETERS
from reina.performance import BLOCK_FRAMES, FrameBlock, Performance
from reina.show import Show, TimeMap
from reina.skeleton import Hold, Point, Rig, forward_kinematics, human_pose

NoteBeats = tuple[float, float, int]
Perform = Callable[..., Performance]
BLOCKS = 22


def column(performance: Performance, path: str) -> int:
    offset = 0
    for parameter in performance.layout.parameters:
        if parameter.path == path:
            return offset
        offset += parameter.length
    raise AssertionError(path)


class Frames:
    """Frames of a performance as a reader of the stream has them, with the world positions that they mean."""

    def __init__(self, performance: Performance, player: Rig, trumpet: Rig, blocks: int = BLOCKS) -> None:
        parts = [performance.evaluate(block) for block in range(blocks)]
        rotations = np.concatenate([part.rotations for part in parts]).astype(np.float64)
        roots = np.concatenate([part.root_positions for part in parts]).astype(np.float64)
        self.parameters = np.concatenate([part.parameters for part in parts]).astype(np.float64)
        self.time_s = np.concatenate([part.song_time_s for part in parts])
        self.performance, self.player, self.trumpet = performance, player, trumpet
        self.local = rotations[:, : len(player.skeleton)]
        self.instrument = rotations[:, len(player.skeleton)]
        self.place = roots[:, 1]
        self.positions, self.world = forward_kinematics(player.skeleton, self.local, roots[:, 0])

    def point(self, point: Point) -> np.ndarray:
        return self.positions[:, point.joint] + r.rotate(self.world[:, point.joint], point.offset)

    def in_instrument(self, offset: np.ndarray) -> np.ndarray:
        return self.place + r.rotate(self.instrument, offset)

    def value(self, path: str) -> np.ndarray:
        return self.parameters[:, column(self.performance, path)]


@pytest.fixture(scope="module")
def played(perform: Perform, tune: list[NoteBeats], player_rig: Rig, trumpet_rig: Rig) -> Frames:
    return Frames(perform(tune), player_rig, trumpet_rig)


@pytest.fixture(scope="module")
def most(
    perform: Perform, tune: list[NoteBeats], registry: ParameterRegistry, player_rig: Rig, trumpet_rig: Rig
) -> Frames:
    """Every amount at its greatest."""
    values = greatest_amounts(registry)
    assert len(values) == 14
    return Frames(perform(tune, values=values), player_rig, trumpet_rig)


def greatest_amounts(registry: ParameterRegistry) -> dict[str, float]:
    amounts = [p for p in registry if p.path.startswith("player/") and p.type == "number"]
    return {p.path: p.maximum or 0.0 for p in amounts if not p.path.startswith("player/pose/")}


@pytest.fixture(scope="module")
def posed(
    perform: Perform, tune: list[NoteBeats], registry: ParameterRegistry, player_rig: Rig, trumpet_rig: Rig
) -> Frames:
    """Head, torso and eyes keyed from one corner of what they may turn to another, on top of all that."""
    tracks = pose_corners()
    return Frames(perform(tune, values=greatest_amounts(registry), tracks=tracks), player_rig, trumpet_rig)


@pytest.fixture(scope="module", params=POSES)
def stood(
    request: pytest.FixtureRequest,
    perform: Perform,
    tune: list[NoteBeats],
    registry: ParameterRegistry,
    player_rig: Rig,
    trumpet_rig: Rig,
) -> Frames:
    """The same, in a stance from a motion file."""
    pose = human_pose(figure(request.param), 0.1)
    values = {**greatest_amounts(registry), "player/stance": "own"}
    performance = perform(tune, values=values, tracks=pose_corners(), stances={"own": pose})
    return Frames(performance, player_rig, trumpet_rig, blocks=12)


def pose_corners() -> list[dict[str, Any]]:
    rng = np.random.default_rng(11)
    tracks: list[dict[str, Any]] = []
    for parameter in POSE_PARAMETERS:
        corners = rng.choice([-1.0, 1.0], size=(BLOCKS // 2 + 1, parameter.length)) * (
            parameter.maximum or 0.0
        )
        keyframes = [
            {
                "time": 2.0 * place,
                "value": corner.tolist() if parameter.length > 1 else corner[0],
                "interpolation": "sine_in_out",
            }
            for place, corner in enumerate(corners)
        ]
        tracks.append({"parameter": parameter.path, "time": "seconds", "keyframes": keyframes})
    return tracks


@pytest.fixture(params=["played", "most", "posed"])
def frames(request: pytest.FixtureRequest, played: Frames, most: Frames, posed: Frames) -> Frames:
    return {"played": played, "most": most, "posed": posed}[request.param]


def test_in_a_stance_from_a_motion_file_nothing_comes_apart(stood: Frames, hold: Hold) -> None:
    test_rotations_are_unit_and_on_the_side_of_rest(stood)
    assert pressed_buttons(stood) > 100
    test_the_mouth_stays_on_the_mouthpiece_while_the_horn_is_up(stood)
    test_feet_stay_planted_and_hands_on_the_horn(stood, hold)
    test_no_joint_leaves_its_limits(stood)
    test_nothing_jumps(stood)


def test_the_layout_names_everything_in_a_frame(
    perform: Perform, tune: list[NoteBeats], registry: ParameterRegistry, player: str
) -> None:
    performance = perform(tune)
    layout = performance.layout
    assert [(s.name, s.rig, len(s.joints)) for s in layout.skeletons] == [
        ("player", player, 58),
        ("trumpet", "trumpet", 1),
    ]
    paths = [parameter.path for parameter in layout.parameters]
    assert paths[: len(registry)] == [parameter.path for parameter in registry]
    given = paths[len(registry) :]
    assert given[:4] == ["trumpet/valve/1", "trumpet/valve/2", "trumpet/valve/3", "trumpet/slide/3"]
    assert "face/cheek_puff" in given
    block = performance.evaluate(2)
    assert block.first_frame == 120
    assert block.rotations.shape == (BLOCK_FRAMES, 59, 4)
    assert block.root_positions.shape == (BLOCK_FRAMES, 2, 3)
    assert block.parameters.shape == (BLOCK_FRAMES, sum(p.length for p in layout.parameters))
    assert block.cuts.shape == (BLOCK_FRAMES,)
    assert {block.rotations.dtype, block.root_positions.dtype, block.parameters.dtype} == {
        np.dtype(np.float32)
    }
    np.testing.assert_array_equal(block.song_time_s, np.arange(120, 180) / 60)


def whole(block: FrameBlock) -> bytes:
    return b"".join(
        array.tobytes()
        for array in (block.rotations, block.root_positions, block.parameters, block.song_time_s, block.cuts)
    )


def test_a_block_has_the_same_bytes_whenever_it_is_asked_for(perform: Perform, tune: list[NoteBeats]) -> None:
    first, second = perform(tune), perform(tune)
    forward = [whole(first.evaluate(block)) for block in range(8)]
    backward = [whole(second.evaluate(block)) for block in reversed(range(8))][::-1]
    assert forward == backward
    assert whole(first.evaluate(5)) == forward[5]
    assert len(set(forward)) == 8


def test_seeds_differ_in_what_no_score_says_and_agree_in_the_valves(
    perform: Perform, tune: list[NoteBeats]
) -> None:
    one, other = perform(tune).evaluate(3), perform(tune, seed=5).evaluate(3)
    assert one.rotations.tobytes() != other.rotations.tobytes()
    valve = column(perform(tune), "trumpet/valve/1")
    np.testing.assert_array_equal(
        one.parameters[:, valve : valve + 3], other.parameters[:, valve : valve + 3]
    )


def test_rotations_are_unit_and_on_the_side_of_rest(frames: Frames) -> None:
    np.testing.assert_allclose(np.linalg.norm(frames.local, axis=-1), 1.0, atol=3e-7)
    assert np.all(r.dot(frames.local, frames.player.skeleton.rest_rotations) >= 0.0)
    assert np.all(frames.instrument[:, 3] >= 0.0)


def test_pads_stay_on_their_buttons(frames: Frames) -> None:
    assert pressed_buttons(frames) > 300


def pressed_buttons(frames: Frames) -> int:
    """How often valves are down; pads are on their buttons whenever they are."""
    pressed = 0
    for button in frames.trumpet.buttons:
        down = frames.value(f"trumpet/valve/{button.valve}")
        target = frames.in_instrument(button.position + down[:, None] * button.travel)
        gap = np.linalg.norm(frames.point(frames.player.effector(button.effector)) - target, axis=-1)
        assert gap[down > 0.0].max() < 0.0005
        assert gap.max() < 0.008
        pressed += int(np.sum(down == 1.0))
    return pressed


def test_valves_follow_the_fingering(played: Frames) -> None:
    performance, part = played.performance, played.performance.performers[0].played
    valve = column(performance, "trumpet/valve/1")
    checked = 0
    for note in range(len(part.line)):
        onset, end = float(part.line.onset_s[note]), float(part.line.end_s[note])
        following = float(part.line.onset_s[note + 1]) if note + 1 < len(part.line) else np.inf
        end = min(end, following - min(0.040, 0.4 * (following - onset)))
        inside = (played.time_s >= onset) & (played.time_s < end - 1e-9)
        wanted = brass_fingering(part).valves[note].astype(np.float64)
        found = played.parameters[inside, valve : valve + 3]
        np.testing.assert_array_equal(found, np.broadcast_to(wanted, found.shape))
        checked += int(inside.sum())
    assert checked > 400


def test_the_mouth_stays_on_the_mouthpiece_while_the_horn_is_up(frames: Frames) -> None:
    gap = np.linalg.norm(
        frames.point(frames.player.contact("lips"))
        - frames.in_instrument(frames.trumpet.contact("mouthpiece").offset),
        axis=-1,
    )
    sounding = np.any([frames.value(f"trumpet/valve/{v}") > 0 for v in (1, 2, 3)], axis=0)
    assert gap[sounding].max() < 0.001
    # In the long rest it is taken down, and it is back in time.
    assert gap.max() > 0.05


def test_feet_stay_planted_and_hands_on_the_horn(frames: Frames, hold: Hold) -> None:
    for sole in ("leftSole", "rightSole"):
        place = frames.point(frames.player.contact(sole))
        assert np.abs(place - place[0]).max() < 0.001
    start, _ = forward_kinematics(frames.player.skeleton, hold.rotations(frames.player), hold.hips_position)
    for hand in ("leftHand", "rightHand"):
        joint = frames.player.skeleton.index(hand)
        in_hold = r.rotate(r.conjugate(hold.instrument_rotation), start[joint] - hold.instrument_position)
        now = r.rotate(r.conjugate(frames.instrument), frames.positions[:, joint] - frames.place)
        # The right hand rocks by under two millimetres in vibrato.
        assert np.abs(now - in_hold).max() < 0.002


def test_no_joint_leaves_its_limits(frames: Frames) -> None:
    skeleton = frames.player.skeleton
    for joint, limits in frames.player.limits.items():
        from_rest = r.multiply(r.conjugate(skeleton.rest_rotations[joint]), frames.local[:, joint])
        euler = r.to_euler(from_rest, limits.order)
        # The same rotation has two sets of angles; the joint is where the one that fits says.
        other = np.stack([euler[:, 0] + np.pi, np.pi - euler[:, 1], euler[:, 2] + np.pi], axis=1)
        axes = ["xyz".index(letter) for letter in limits.order]
        low, high = np.array(limits.minimum)[axes], np.array(limits.maximum)[axes]
        beyond = [
            np.maximum(low - angles, angles - high).max(axis=1)
            for angles in (euler, (other + np.pi) % (2.0 * np.pi) - np.pi)
        ]
        assert np.minimum(*beyond).max() < 2e-5, skeleton.names[joint]


def test_nothing_jumps(frames: Frames) -> None:
    speed = r.angle_between(frames.local[1:], frames.local[:-1]) * 60.0
    assert speed.max() < 25.0
    assert (np.linalg.norm(np.diff(frames.positions, axis=0), axis=-1) * 60.0).max() < 1.2
    assert (np.linalg.norm(np.diff(frames.place, axis=0), axis=-1) * 60.0).max() < 1.2


def test_the_body_is_alive(played: Frames) -> None:
    skeleton = played.player.skeleton
    for name, least in (
        ("head", 0.01),
        ("chest", 0.01),
        ("rightUpperArm", 0.01),
        ("leftEye", 0.05),
        ("rightIndexProximal", 0.1),
    ):
        turned = r.angle_between(played.local[:, skeleton.index(name)], played.local[0, skeleton.index(name)])
        assert turned.max() > least, name
    for path in ("face/blink_left", "face/cheek_puff", "face/mouth_press", "face/jaw_open"):
        weights = played.value(path)
        assert weights.max() > 0.05, path
        assert weights.min() >= 0.0
        assert weights.max() <= 1.0
    # The cheeks fill a little while a note sounds and are empty in the long rest.
    cheeks = played.value("face/cheek_puff")
    assert 0.04 < cheeks[int(1.2 * 60)] < 0.15
    assert cheeks[int(13.0 * 60)] == 0.0


def test_amounts_of_zero_give_the_bare_hold(
    perform: Perform, registry: ParameterRegistry, hold: Hold, player_rig: Rig
) -> None:
    values = {p.path: 0.0 for p in registry if p.path.startswith("player/") and p.type == "number"}
    performance = perform([(8.0, 1.0, 70)], values=values)
    block = performance.evaluate(1)
    assert np.ptp(block.rotations, axis=0).max() == 0.0
    held = hold.rotations(player_rig)
    fingers = [
        player_rig.skeleton.index(f"right{name}{bone}")
        for name in ("Index", "Middle", "Ring")
        for bone in ("Proximal", "Intermediate", "Distal")
    ]
    others = np.setdiff1d(np.arange(len(held)), fingers)
    assert r.angle_between(block.rotations[0, others], held[others]).max() < 1e-4


def test_before_the_start_and_after_the_end(perform: Perform, tune: list[NoteBeats]) -> None:
    performance = perform(tune)
    late = performance.evaluate(100)
    later = performance.evaluate(5000)
    np.testing.assert_array_equal(np.ptp(late.rotations, axis=0), 0.0)
    np.testing.assert_array_equal(late.rotations, later.rotations)
    np.testing.assert_array_equal(late.root_positions, later.root_positions)
    assert later.song_time_s[0] == 5000.0
    with pytest.raises(ValueError, match="blocks are counted from 0, not -1"):
        performance.evaluate(-1)


def test_a_new_show_shares_everything_else(
    perform: Perform, tune: list[NoteBeats], registry: ParameterRegistry
) -> None:
    performance = perform(tune)
    track = {"parameter": "player/sway", "keyframes": [{"time": 0, "value": 0.0}]}
    show = Show.from_document({"version": 1, "tracks": [track]}, registry)
    other = performance.with_show(show.plan(registry, TimeMap.steady()))
    sway = column(performance, "player/sway")
    assert performance.evaluate(0).parameters[0, sway] == 1.0
    assert other.evaluate(0).parameters[0, sway] == 0.0
    assert other.layout is performance.layout
    assert np.ptp(other.evaluate(0).root_positions[:, 0, 0]) < np.ptp(
        performance.evaluate(0).root_positions[:, 0, 0]
    )


def test_a_part_with_nothing_to_play_stands_with_the_horn_down(
    perform: Perform, player_rig: Rig, trumpet_rig: Rig
) -> None:
    frames = Frames(perform([(0.0, 1.0, 20), (2.0, 4.0, 21)]), player_rig, trumpet_rig, blocks=3)
    for valve in (1, 2, 3):
        np.testing.assert_array_equal(frames.value(f"trumpet/valve/{valve}"), 0.0)
    bell = frames.in_instrument(trumpet_rig.contact("bell").offset)
    mouthpiece = frames.in_instrument(trumpet_rig.contact("mouthpiece").offset)
    assert np.all(bell[:, 1] < mouthpiece[:, 1] - 0.1)
