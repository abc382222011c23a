"""The drummer audited from frames alone: tips on their pieces, nothing in anything, limits, speeds."""

from __future__ import annotations

import io
import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import mido
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tests.integration.scores import song
from tests.integration.stranger import take
from tests.integration.test_audit import excess

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx
    from numpy.typing import NDArray
    from tests.integration.stranger import Pose, Take

    Points = NDArray[np.float64]

Hits = Sequence[tuple[float, int, int] | tuple[float, int, int, float]]
"""Onset in beats, key, velocity, and length in beats where that says something."""

SCORES: dict[str, tuple[float, Hits]] = {
    "thirty-second notes": (120, [(2 + i / 8, 38, 80 + 20 * (i % 8 == 0)) for i in range(128)]),
    "blast beat": (
        200,
        [
            *((2 + i / 4, 42, 90) for i in range(96)),
            *((2 + i / 2, 38, 100) for i in range(48)),
            *((2.25 + i / 2, 36, 100) for i in range(48)),
        ],
    ),
    "four toms at 200": (
        200,
        [(2 + i / 4, (38, 38, 50, 50, 47, 47, 43, 43)[i // 2 % 8], 100) for i in range(96)],
    ),
    "flams": (120, [hit for i in range(24) for hit in ((1.94 + i, 38, 50), (2.0 + i, 38, 110))]),
    "the whole kit at once": (
        120,
        [
            (2 + 0.5 * i, key, 100)
            for i, key in enumerate(
                [38, 42, 50, 47, 43, 49, 57, 51, 53, 52, 55, 56, 46, 49, 43, 57, 52, 49] * 2
            )
        ],
    ),
    "two crashes and the bass drum": (
        120,
        [(2 + 0.5 * i, key, 110) for i in range(24) for key in (49, 57, 36)],
    ),
    "softer and softer": (120, [(2 + 0.5 * i, 38, max(1, 120 - 5 * i)) for i in range(24)]),
    "a long rest": (120, [(1, 38, 100), (2, 49, 100), (42, 38, 100), (43, 43, 90)]),
    "hi-hat and floor tom in turn": (140, [(4 + 0.5 * i, (42, 43)[i % 2], 100) for i in range(32)]),
    "bell, snare, china": (130, [(2 + 0.5 * i, (53, 38, 52)[i % 3], 100) for i in range(36)]),
    "the farthest pieces": (140, [(4 + 0.5 * i, (42, 52, 49, 43, 46, 51)[i % 6], 110) for i in range(36)]),
    "cross-sticks and rim shots under the hi-hat's arm": (
        120,
        [
            *((2 + 0.5 * i, 42, 80) for i in range(56)),
            *((3 + 2 * i, 37, 90) for i in range(6)),
            *((15 + i, (37, 38, 40, 37)[i % 4], 110) for i in range(14)),
        ],
    ),
    "chokes": (
        110,
        [
            *((2 + 4 * i, 49, 110, 2.5) for i in range(8)),
            *((4 + 4 * i, 57, 110, 2.5) for i in range(8)),
            *((6 + 8 * i, 49, 115, 0.35) for i in range(4)),
            *((8 + 8 * i, 57, 115, 0.35) for i in range(4)),
        ],
    ),
    "anything anywhere": (
        120,
        [
            (2 + 0.8 * i, int(key), int(velocity))
            for i, (key, velocity) in enumerate(
                zip(
                    np.random.default_rng(11).choice(
                        [38, 42, 46, 50, 47, 43, 49, 57, 51, 53, 52, 55, 56], size=60
                    ),
                    np.random.default_rng(12).integers(30, 125, size=60),
                    strict=True,
                )
            )
        ],
    ),
}
EXAMPLES = ("when-the-saints.mid",)
LEFT_HANDED = "when the saints, left-handed"
"""The same example; who plays it leads with the left hand, on the mirror image of the kit."""
SCORES_FOLDER = Path(__file__).parents[2] / "examples" / "scores"

TOUCH_M = 0.002
INSIDE_M = 0.003
PEDAL_M = 0.002
HAND_SPEED, STICK_SPEED = 15.0, 30.0
LIMIT_DEG = 1.5
HELD_M, TURNING_M = 0.003, 0.010
"""A stick goes through where the hand of its hold has it, or some part of the hand is at it: within the first
where it strikes, within the second where it is twirled or turned end for end."""
SHAFT_M = 0.0072
RIGS = Path(__file__).parents[2] / "rigs"
FINE_FPS = 240
EARLY_S = 1 / 60


def midi(bpm: float, hits: Hits) -> bytes:
    track = mido.MidiTrack([mido.MetaMessage("set_tempo", tempo=mido.bpm2tempo(bpm))])
    events = [(round(at * 480), 1, key, velocity) for at, key, velocity, *_ in hits]
    events += [(round((at + sum(length or (0.05,))) * 480), 0, key, 0) for at, key, _, *length in hits]
    last = 0
    for tick, kind, key, velocity in sorted(events):
        name = "note_on" if kind else "note_off"
        track.append(mido.Message(name, channel=9, note=key, velocity=velocity, time=tick - last))
        last = tick
    data = io.BytesIO()
    mido.MidiFile(ticks_per_beat=480, tracks=[track]).save(file=data)
    return data.getvalue()


class Drummed:
    """A score in a session, and what the drummer of it does."""

    def __init__(self, client: httpx.Client, session: dict[str, Any], name: str) -> None:
        self.name = name
        self.client, self.id = client, session["id"]
        self.end_s = float(session["duration_s"]) + 1.0
        cast = client.get(f"/api/v1/sessions/{self.id}/cast").raise_for_status().json()["castings"]
        self.number = next(i for i, casting in enumerate(cast) if casting["instrument"] == "drums")
        self.player = cast[self.number]["player"]
        self.prefix = f"players/{self.number + 1}/" if self.number else ""
        self.frames = self.take(0.0, self.end_s)
        notes = client.get(f"/api/v1/sessions/{self.id}/score").raise_for_status().json()["notes"]
        self.notes = [note for note in notes if note["player"] == self.number]

    def take(self, start_s: float, end_s: float, fps: int = 60) -> Take:
        return take(self.client, self.id, start_s, end_s, fps)

    def pose(self, frames: Take, name: str) -> Pose:
        return frames.poses[f"{self.prefix}{name}"]

    def tip(self, frames: Take, side: str) -> Points:
        return self.pose(frames, f"{side}_stick").named("effectors", f"{side}StickTip")

    def carried(self, frames: Take, joint: str) -> Points:
        """How far a parameter has moved what a joint of the kit carries, in the world, (F, 3)."""
        kit = self.pose(frames, "drums")
        moved = np.zeros((len(frames.song_time_s), 3))
        for part in kit.rig["parts"]:
            if part["node"] == joint and "travel" in part:
                values = frames.parameters[f"{self.prefix}{part['parameter']}"]
                moved += Rotation.from_quat(kit.rotations[kit.rig["joints"][0]["name"]].as_quat()).apply(
                    values * np.array(part["travel"])
                )
        return moved


@pytest.fixture(
    scope="module", params=[*SCORES, *EXAMPLES, LEFT_HANDED], ids=lambda name: name.replace(" ", "-")
)
def drummed(request: pytest.FixtureRequest, client: httpx.Client) -> Iterator[Drummed]:
    """A score with drums, as it is cast by itself."""
    name = request.param
    example = EXAMPLES[0] if name == LEFT_HANDED else name
    data = (SCORES_FOLDER / example).read_bytes() if example in EXAMPLES else midi(*SCORES[name])
    # The song is longer than any of the scores: what comes after its end is not played.
    files = {"score": ("drums.mid", data), "song": ("song.wav", song(70.0))}
    # In time as it is: no search for the score in the recording moves the music meanwhile.
    made = client.post("/api/v1/sessions", files=files, data={"in_time": "true"}).raise_for_status().json()
    headers = {"Authorization": f"Bearer {made['control_token']}"}
    if name == LEFT_HANDED:
        lead_with_the_left(client, f"/api/v1/sessions/{made['id']}/cast", headers)
    yield Drummed(client, made, name)
    client.delete(f"/api/v1/sessions/{made['id']}", headers=headers).raise_for_status()


def lead_with_the_left(client: httpx.Client, path: str, headers: dict[str, str]) -> None:
    """Let the drummer of a cast lead with the left hand."""
    castings = client.get(path).raise_for_status().json()["castings"]
    fields = [
        {name: casting[name] for name in ("part", "instrument", "player")}
        | {"handedness": "left" if casting["instrument"] == "drums" else "right"}
        for casting in castings
    ]
    client.put(path, json={"castings": fields}, headers=headers).raise_for_status()


def struck(note: dict[str, Any]) -> dict[str, Any]:
    return note["fingering"]


def on_surface(drummed: Drummed, frames: Take, tip: Points, piece: str, zone: str) -> Points:
    """How far a tip is from where a piece is struck, metres: out of its surface, and beside its zone."""
    kit = drummed.pose(frames, "drums")
    # A cross-stick lies on the head while its shaft strikes the rim.
    names = (zone, "centre", "edge") if zone == "rim" else (zone,)
    apart: list[Points] = []
    for entry in kit.rig["zones"]:
        if entry["piece"] != piece or entry["zone"] not in names:
            continue
        joint = entry["joint"]
        place = kit.point(joint, entry["position"]) + drummed.carried(frames, joint)
        normal = kit.rotations[joint].apply(np.array(entry["normal"]))
        offset = tip - place
        out = np.einsum("fi,fi->f", offset, normal)
        beside = np.linalg.norm(offset - out[:, None] * normal, axis=1) - entry["radius"]
        if zone == "rim" and entry["zone"] != "rim":
            beside = beside - 0.12  # anywhere on the head
        apart.append(np.hypot(out, np.maximum(beside, 0.0)))
    return np.min(apart, axis=0)


def test_every_hit_lands_on_its_piece_by_its_onset(drummed: Drummed) -> None:
    """At 240 frames a second: within a frame of 60 before each onset the tip is on the piece, never late."""
    hits = [note for note in drummed.notes if note["fingering"] and struck(note)["hand"]]
    assert hits
    for start in np.arange(0.0, drummed.end_s, 8.0):
        frames = drummed.take(start, start + 8.0 + EARLY_S, FINE_FPS)
        tips = {side: drummed.tip(frames, side) for side in ("left", "right")}
        for note in hits:
            onset = note["onset_s"]
            if not start + EARLY_S <= onset < start + 8.0:
                continue
            fingering = struck(note)
            near = on_surface(drummed, frames, tips[fingering["hand"]], fingering["piece"], fingering["zone"])
            before = (frames.song_time_s <= onset + 1e-6) & (frames.song_time_s > onset - EARLY_S)
            assert near[before].min() <= TOUCH_M, (
                f"{onset:.3f} s: {fingering}, {1000 * near[before].min():.1f} mm"
            )


def test_joints_are_within_their_limits(drummed: Drummed) -> None:
    pose = drummed.pose(drummed.frames, "player")
    local = drummed.frames.local[f"{drummed.prefix}player"]
    for index, joint in enumerate(pose.rig["joints"]):
        if "limits" in joint:
            beyond = np.degrees(excess(joint, Rotation.from_quat(local[:, index])))
            assert beyond <= LIMIT_DEG, f"{joint['name']}: {beyond:.1f} degrees"


def test_hands_and_sticks_are_no_faster_than_they_can_be(drummed: Drummed) -> None:
    pose = drummed.pose(drummed.frames, "player")
    for side in ("left", "right"):
        hand, tip = pose.positions[f"{side}Hand"], drummed.tip(drummed.frames, side)
        assert 60 * np.linalg.norm(np.diff(hand, axis=0), axis=1).max() < HAND_SPEED
        assert 60 * np.linalg.norm(np.diff(tip, axis=0), axis=1).max() < STICK_SPEED


def test_the_balls_of_the_feet_stay_on_the_pedals(drummed: Drummed) -> None:
    pose, kit = drummed.pose(drummed.frames, "player"), drummed.pose(drummed.frames, "drums")
    joints = {joint["name"]: joint for joint in pose.rig["joints"]}
    rest: dict[str, tuple[Points, Rotation]] = {}
    for name, joint in joints.items():
        turned = Rotation.from_quat(joint["rotation"])
        if joint["parent"] is None:
            rest[name] = np.array(joint["translation"]), turned
        else:
            place, rotation = rest[joint["parent"]]
            rest[name] = place + rotation.apply(joint["translation"]), rotation * turned
    for side in ("left", "right"):
        foot, toes = rest[f"{side}Foot"], rest[f"{side}Toes"]
        ball = foot[1].inv().apply(toes[0] * [1.0, 0.0, 1.0] - foot[0])
        apart = pose.point(f"{side}Foot", ball.tolist()) - kit.named("contacts", f"{side}Pedal")
        assert np.linalg.norm(apart, axis=1).max() <= PEDAL_M


def solids(drummed: Drummed, frames: Take) -> Iterator[tuple[str, Points, Points, Points, float]]:
    """The kit's flat-ended solids: piece, and in the world middle, unit axis, half the length, radius."""
    kit = drummed.pose(frames, "drums")
    for solid in kit.rig["cylinders"]:
        moved = drummed.carried(frames, solid["joint"])
        ends = [kit.point(solid["joint"], solid[end]) + moved for end in ("from", "to")]
        along = ends[1] - ends[0]
        length = np.linalg.norm(along, axis=1)
        yield (
            solid["piece"],
            0.5 * (ends[0] + ends[1]),
            along / length[:, None],
            0.5 * length,
            solid["radius"],
        )


def samples(drummed: Drummed, frames: Take) -> dict[str, list[tuple[str, Points, float]]]:
    """Spheres along sticks, hands and arms of each side: what, (F, 3) centres, radius."""
    pose = drummed.pose(frames, "player")
    result: dict[str, list[tuple[str, Points, float]]] = {}
    for side in ("left", "right"):
        own: list[tuple[str, Points, float]] = []
        stick = drummed.pose(frames, f"{side}_stick")
        for capsule in stick.rig["capsules"]:
            for share in np.linspace(0.0, 1.0, 12):
                at = np.array(capsule["from"]) * (1 - share) + np.array(capsule["to"]) * share
                own.append(("stick", stick.point(capsule["joint"], at.tolist()), capsule["radius"]))
        for upper, lower, radius in (("LowerArm", "Hand", 0.03), ("Hand", "MiddleProximal", 0.02)):
            ends = pose.positions[f"{side}{upper}"], pose.positions[f"{side}{lower}"]
            own += [
                (lower, ends[0] * (1 - share) + ends[1] * share, radius) for share in np.linspace(0, 1, 6)
            ]
        result[side] = own
    return result


def test_no_stick_hand_or_arm_is_inside_the_kit_or_the_other(drummed: Drummed) -> None:
    frames = drummed.frames
    spheres = samples(drummed, frames)
    for piece, middle, axis, half, radius in solids(drummed, frames):
        for side, own in spheres.items():
            for what, centre, thick in own:
                offset = centre - middle
                along = np.einsum("fi,fi->f", offset, axis)
                out = np.linalg.norm(offset - along[:, None] * axis, axis=1) - radius
                over = np.abs(along) - half
                outside: Points = np.hypot(np.maximum(out, 0), np.maximum(over, 0))
                deep: Points = thick - outside - np.minimum(np.maximum(out, over), 0.0)
                worst = int(deep.argmax())
                assert deep[worst] <= INSIDE_M, (
                    f"{frames.song_time_s[worst]:.3f} s: the {side} {what} is {1000 * deep[worst]:.1f} mm"
                    f" inside the {piece}"
                )
    for what, left, thick in spheres["left"]:
        for other, right, broad in spheres["right"]:
            deep = thick + broad - np.linalg.norm(left - right, axis=1)
            worst = int(deep.argmax())
            assert deep[worst] <= INSIDE_M, (
                f"{frames.song_time_s[worst]:.3f} s: left {what}, right {other}: {1000 * deep[worst]:.1f} mm"
            )


def off_fulcrum(drummed: Drummed, frames: Take, side: str) -> Points:
    """How far a stick's middle line is from where the hand holds it to play, metres (F,)."""
    hold = json.loads((RIGS / drummed.player / "holds" / "drumkit.json").read_text())
    attached = hold["attachments"][f"{side}_stick"]
    fulcrum = drummed.pose(frames, "player").point(attached["joint"], attached["position"])
    return off_shaft(drummed.pose(frames, f"{side}_stick"), side, fulcrum)


def off_shaft(stick: Pose, side: str, points: Points) -> Points:
    ends = [stick.point(f"{side}Stick", [0.0, 0.0, along]) for along in (-0.135, 0.25)]
    line = ends[1] - ends[0]
    length = np.linalg.norm(line, axis=1)
    line = line / length[:, None]
    along = np.clip(np.einsum("fi,fi->f", points - ends[0], line), 0.0, length)
    return np.linalg.norm(points - ends[0] - along[:, None] * line, axis=1)


def off_hand(drummed: Drummed, frames: Take, side: str) -> Points:
    """How far a stick's surface is from the nearest part of the hand, metres (F,)."""
    player, stick = drummed.pose(frames, "player"), drummed.pose(frames, f"{side}_stick")
    nearest = np.full(len(frames.song_time_s), np.inf)
    parts = tuple(f"{side}{part}" for part in ("Hand", "Thumb", "Index", "Middle", "Ring", "Little"))
    for capsule in player.rig["capsules"]:
        if not capsule["joint"].startswith(parts):
            continue
        for share in np.linspace(0.0, 1.0, 8):
            at = np.array(capsule["from"]) * (1 - share) + np.array(capsule["to"]) * share
            apart = off_shaft(stick, side, player.point(capsule["joint"], at.tolist()))
            nearest = np.minimum(nearest, apart - capsule["radius"] - SHAFT_M)
    return nearest


@pytest.mark.parametrize("side", ["left", "right"])
def test_each_stick_lies_in_its_hand(drummed: Drummed, side: str) -> None:
    frames = drummed.frames
    held, near = off_fulcrum(drummed, frames, side), off_hand(drummed, frames, side)
    apart = np.where(held <= HELD_M, 0.0, near)
    assert apart.max() <= TURNING_M, (
        f"{frames.song_time_s[apart.argmax()]:.3f} s: {1000 * apart.max():.1f} mm"
    )
    for note in drummed.notes:
        if not note["fingering"] or struck(note)["hand"] != side:
            continue
        last = np.flatnonzero(frames.song_time_s <= note["onset_s"] + 1e-6)[-1]
        # A cross-stick is held otherwise, its shaft at the fingers.
        off = held[last] if struck(note)["zone"] != "rim" else min(held[last], near[last])
        assert off <= HELD_M, f"{note['onset_s']:.3f} s: {struck(note)}, {1000 * off:.1f} mm"


def test_a_frame_is_the_same_by_seek_and_by_play(drummed: Drummed) -> None:
    middle = np.floor(drummed.end_s / 2)
    one = drummed.take(middle, middle + 1.0)
    first = round(middle * 60)
    whole = drummed.frames.raw[first : first + len(one.raw), 24:]
    np.testing.assert_array_equal(one.raw[:, 24:], whole)


def test_a_left_handed_player_leads_with_the_left_on_a_mirrored_kit(drummed: Drummed) -> None:
    kit, is_left = drummed.pose(drummed.frames, "drums"), drummed.name == LEFT_HANDED
    assert kit.rig["name"] == ("drumkit_left_handed" if is_left else "drumkit")
    assert (kit.positions["hi_hat_top"][:, 0].max() < -0.3) == is_left
    if drummed.name not in (*EXAMPLES, LEFT_HANDED):
        return
    leading = [struck(note) for note in drummed.notes if struck(note) and struck(note)["piece"] != "snare"]
    side = "left" if is_left else "right"
    hats = [one["hand"] for one in leading if one["piece"] == "hi_hat" and one["hand"]]
    assert hats.count(side) > 0.8 * len(hats) > 0
    kicks = [one["foot"] for one in leading if one["piece"] == "kick"]
    assert kicks.count(side) > 0.8 * len(kicks) > 0
