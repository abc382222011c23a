"""The drummer's hands from frames alone: rim shots, cross-sticks, chokes, fingers that follow the stick."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import mido
import numpy as np
import pytest
from tests.integration.scores import song
from tests.integration.test_drum_audit import EARLY_S, FINE_FPS, TOUCH_M, Drummed

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx
    from numpy.typing import NDArray
    from tests.integration.stranger import Pose, Take

    Points = NDArray[np.float64]

BPM = 120.0
RIM_SHOTS = (3.0, 5.0, 6.0, 7.0)
CROSS_STICKS = (12.0, 14.0, 16.0, 16.5)
CHOKED = ((32.0, 55), (36.0, 52))
"""Beats at which a crash is struck that ends soon, and its key."""
LENGTH = 0.5
HITS = [
    (2.0, 22, 80, 0.1),
    *((2.0 + 0.5 * k, 42, 80, 0.1) for k in range(30)),
    *((at, 40, 112, 0.1) for at in RIM_SHOTS),
    *((9.0 + 0.25 * k, 38, 50, 0.1) for k in range(3)),
    *((at, 37, 90, 0.1) for at in CROSS_STICKS),
    *((20.0 + 0.25 * k, 38, 40 if k % 4 else 120, 0.1) for k in range(16)),
    (26.0, 55, 110, 3.0),
    (29.0, 52, 110, 3.0),
    *((at, key, 115, LENGTH) for at, key in CHOKED),
    (42.0, 38, 90, 0.1),
]
"""Onset and length in beats, key and velocity, as an electronic kit sends them."""

SHAFT_M = 0.0072
PAD_M = 0.003
STAYS_M = 0.015
BRONZE_M = 0.0014
FINGERS = ("Thumb", "Index", "Middle", "Ring", "Little")


def electronic() -> bytes:
    track = mido.MidiTrack([mido.MetaMessage("set_tempo", tempo=mido.bpm2tempo(BPM))])
    events = [(round(at * 480), 1, key, velocity) for at, key, velocity, _ in HITS]
    events += [(round((at + length) * 480), 0, key, 0) for at, key, _, length in HITS]
    last = 0
    for tick, kind, key, velocity in sorted(events):
        name = "note_on" if kind else "note_off"
        track.append(mido.Message(name, channel=9, note=key, velocity=velocity, time=tick - last))
        last = tick
    data = io.BytesIO()
    mido.MidiFile(ticks_per_beat=480, tracks=[track]).save(file=data)
    return data.getvalue()


@pytest.fixture(scope="module")
def drummed(client: httpx.Client) -> Iterator[Drummed]:
    files = {"score": ("drums.mid", electronic()), "song": ("song.wav", song())}
    made = client.post("/api/v1/sessions", files=files, data={"in_time": "true"}).raise_for_status().json()
    yield Drummed(client, made, "hands")
    headers = {"Authorization": f"Bearer {made['control_token']}"}
    client.delete(f"/api/v1/sessions/{made['id']}", headers=headers).raise_for_status()


def struck(drummed: Drummed, beats: tuple[float, ...]) -> list[tuple[float, str]]:
    """Onsets and hands of hits on the snare's rim."""
    found: list[tuple[float, str]] = []
    for beat in beats:
        at = beat * 60.0 / BPM
        note = next(
            note
            for note in drummed.notes
            if abs(note["onset_s"] - at) < 1e-3
            and note["fingering"] is not None
            and note["fingering"]["piece"] == "snare"
        )
        assert note["fingering"]["zone"] == "rim"
        found.append((note["onset_s"], note["fingering"]["hand"]))
    return found


def before(frames: Take, onset_s: float) -> NDArray[np.intp]:
    """The frames of a 60th up to an onset."""
    return np.flatnonzero((frames.song_time_s <= onset_s + 1e-6) & (frames.song_time_s > onset_s - EARLY_S))


def head(drummed: Drummed, frames: Take) -> tuple[Points, Points, float, float]:
    """The snare's middle and normal, its hoop's radius, and how far the hoop's top is over the head."""
    kit = drummed.pose(frames, "drums")
    zones = {zone["zone"]: zone for zone in kit.rig["zones"] if zone["piece"] == "snare"}
    normal = np.array(zones["centre"]["normal"])
    offset = np.array(zones["rim"]["position"]) - np.array(zones["centre"]["position"])
    over = float(offset @ normal)
    middle = kit.point("kit", zones["centre"]["position"])
    return middle, kit.rotations["kit"].apply(normal), float(np.linalg.norm(offset - over * normal)), over


def off_head(drummed: Drummed, frames: Take, side: str) -> Points:
    """How far a tip is from the snare's head, metres."""
    middle, normal, *_ = head(drummed, frames)
    return np.abs(np.einsum("fi,fi->f", drummed.tip(frames, side) - middle, normal))


def off_hoop(drummed: Drummed, frames: Take, side: str) -> Points:
    """How far a stick's shaft is from the top of the snare's hoop, metres; negative inside."""
    middle, normal, radius, over = head(drummed, frames)
    stick = drummed.pose(frames, f"{side}_stick")
    nearest = np.full(len(frames.song_time_s), np.inf)
    for along in np.arange(-0.13, 0.16, 0.0005):
        offset = stick.point(f"{side}Stick", [0.0, 0.0, along]) - middle
        height = np.einsum("fi,fi->f", offset, normal)
        out = np.linalg.norm(offset - height[:, None] * normal, axis=1)
        nearest = np.minimum(nearest, np.hypot(out - radius, height - over))
    return nearest - SHAFT_M


def test_a_rim_shot_is_on_the_head_and_on_the_hoop_at_once(drummed: Drummed) -> None:
    for onset, side in struck(drummed, RIM_SHOTS):
        frames = drummed.take(onset - 0.05, onset + 0.05, FINE_FPS)
        both = np.maximum(off_head(drummed, frames, side), np.abs(off_hoop(drummed, frames, side)))
        assert both[before(frames, onset)].max() <= TOUCH_M, f"{onset} s: {1000 * both.min():.1f} mm"


def test_a_cross_stick_clicks_on_the_hoop_while_tip_and_hand_stay(drummed: Drummed) -> None:
    hits = struck(drummed, CROSS_STICKS)
    sides = {side for _, side in hits}
    assert len(sides) == 1
    side = sides.pop()
    frames = drummed.take(hits[0][0] - EARLY_S, hits[-1][0] + 0.005, FINE_FPS)
    assert off_head(drummed, frames, side).max() <= TOUCH_M
    hoop = off_hoop(drummed, frames, side)
    assert hoop.min() >= -TOUCH_M
    for onset, _ in hits:
        assert np.abs(hoop[before(frames, onset)]).max() <= TOUCH_M
    assert hoop.max() > 0.02, "the shaft is lifted between clicks"
    wrist = drummed.pose(frames, "player").positions[f"{side}Hand"]
    assert np.linalg.norm(wrist - wrist[0], axis=1).max() <= STAYS_M
    # The hand is over the drum, and the butt is beyond the hoop.
    middle, normal, radius, _ = head(drummed, frames)
    for point, is_over in (
        (wrist, True),
        (drummed.pose(frames, f"{side}_stick").point(f"{side}Stick", [0.0, 0.0, -0.135]), False),
    ):
        offset = point - middle
        level = offset - np.einsum("fi,fi->f", offset, normal)[:, None] * normal
        assert ((np.linalg.norm(level, axis=1) < radius) == is_over).all()


def spheres(pose: Pose, joint: str) -> tuple[list[Points], float]:
    """Spheres along a bone: their middles (F, 3), and the radius."""
    capsule = next(one for one in pose.rig["capsules"] if one["joint"] == joint)
    ends = np.array(capsule["from"]), np.array(capsule["to"])
    shares = np.linspace(0.0, 1.0, 8)
    return [pose.point(joint, (ends[0] * (1 - s) + ends[1] * s).tolist()) for s in shares], capsule["radius"]


def over_bronze(kit: Pose, piece: str, points: Points) -> tuple[Points, Points]:
    """How far points are over a cymbal's upper side near its edge, and how far in over the edge, metres."""
    edge = next(zone for zone in kit.rig["zones"] if (zone["piece"], zone["zone"]) == (piece, "edge"))
    place, normal = np.array(edge["position"]), np.array(edge["normal"])
    fall = np.hypot(normal[0], normal[2]) / normal[1]
    radius = np.hypot(place[0], place[2])
    local = kit.rotations[piece].inv().apply(points - kit.positions[piece])
    out = np.hypot(local[:, 0], local[:, 2])
    height = local[:, 1] - (place[1] - fall * (out - radius))
    return height * normal[1], radius + 0.006 - out


def test_a_choke_takes_the_cymbals_edge_between_thumb_and_fingers(drummed: Drummed) -> None:
    for beat, key in CHOKED:
        piece = {55: "crash_left", 52: "crash_right"}[key]
        note = next(note for note in drummed.notes if abs(note["onset_s"] - beat * 60 / BPM) < 1e-3)
        at = (beat + LENGTH) * 60 / BPM
        side = "left" if note["fingering"]["hand"] == "right" else "right"
        frames = drummed.take(at, at + 0.05)
        kit, player = drummed.pose(frames, "drums"), drummed.pose(frames, "player")
        gaps: dict[str, float] = {}
        for finger in FINGERS:
            gap = np.inf
            for part in ("Proximal", "Intermediate", "Distal"):
                joint = f"{side}{finger}{part}"
                if joint not in player.rotations:
                    continue
                middles, thick = spheres(player, joint)
                for middle in middles:
                    height, within = over_bronze(kit, piece, middle)
                    apart = np.maximum(height, -height - BRONZE_M)
                    apart = np.where(within > 0.0, apart, np.hypot(apart, within)) - thick
                    gap = min(gap, float(apart.min()))
                    if finger == "Thumb" and part == "Distal":
                        assert height.max() < 0.0, "the thumb is below"
            gaps[finger] = 1000 * gap
        assert min(gaps.values()) >= -1000 * PAD_M, (piece, gaps)
        assert max(gaps["Thumb"], gaps["Index"], gaps["Middle"]) <= 1000 * PAD_M, (piece, gaps)


@pytest.mark.parametrize("side", ["left", "right"])
def test_fingers_stay_with_the_stick_as_it_turns_in_the_hand(drummed: Drummed, side: str) -> None:
    frames = drummed.take(9.7, 12.3)
    player, stick = drummed.pose(frames, "player"), drummed.pose(frames, f"{side}_stick")
    ends = [stick.point(f"{side}Stick", [0.0, 0.0, along]) for along in (-0.135, 0.25)]
    line = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0], axis=1)[:, None]
    turned = np.degrees(
        np.arccos(np.einsum("fi,fi->f", line, player.rotations[f"{side}Hand"].apply([0.0, 1.0, 0.0])))
    )
    assert np.ptp(turned) > 5.0, "the stick turns in the hand"
    for finger in FINGERS:
        middles, thick = spheres(player, f"{side}{finger}Distal")
        gaps = np.min(
            [
                np.linalg.norm(np.cross(middle - ends[0], line), axis=1) - thick - SHAFT_M
                for middle in middles
            ],
            axis=0,
        )
        assert gaps.min() >= -PAD_M, f"{finger}: {1000 * gaps.min():.1f} mm"
        assert gaps.max() <= PAD_M, f"{finger}: {1000 * gaps.max():.1f} mm"


def test_a_frame_of_any_grip_is_the_same_by_seek_and_by_play(drummed: Drummed) -> None:
    whole = drummed.frames
    for second in range(0, int(drummed.end_s), 3):
        one = drummed.take(second + 0.5, second + 0.8)
        first = round((second + 0.5) * 60)
        np.testing.assert_array_equal(one.raw[:, 24:], whole.raw[first : first + len(one.raw), 24:])
