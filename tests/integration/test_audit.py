"""Every example and extreme scores audited from frames alone: touch, timing, limits, speed, feet, bytes."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import mido
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tests.integration.scores import song
from tests.integration.server import serve
from tests.integration.stranger import button, take

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray
    from tests.integration.stranger import Pose, Take

Notes = list[tuple[float, float, int]]
"""Onset and duration in beats at 120 to the minute, sounding pitch."""

HOUR_BEATS = 7200.0

SCORES: dict[str, Notes] = {
    "fast trill": [(2 + i * 0.08, 0.08, 64 + 2 * (i % 2)) for i in range(200)],
    "faster than strokes": [(2 + i * 0.05, 0.05, 52 + i % 38) for i in range(240)],
    "two-octave leaps": [(1 + i * 0.5, 0.5, 58 + 24 * (i % 2)) for i in range(40)],
    "two-octave leaps in semiquavers": [(1 + i * 0.25, 0.25, (55, 79, 61, 85)[i % 4]) for i in range(64)],
    "repeated notes": [(i * 0.125, 0.06, 61) for i in range(160)],
    "whole range, out of it too": [(i * 0.5, 0.5, 48 + i) for i in range(46)],
    "staccato with breaths": [(i * 1.0, 0.2, 60 + i % 7) for i in range(24)],
    "a long note and a rest": [(0.0, 8.0, 70), (24.0, 4.0, 75), (44.0, 0.5, 60)],
    "an hour of rest": [(1.0, 1.0, 60), (HOUR_BEATS, 2.0, 70)],
}

EXAMPLES = {
    path.name: path
    for path in sorted((Path(__file__).parents[2] / "examples" / "scores").iterdir())
    if path.suffix in {".mid", ".json"}
}

PAD_M = 0.0005
LIFTED_M = 0.008
MOUTH_M = 0.001
FEET_M = 0.001
LONGEST_STROKE_S = 0.040
LARGEST_SHARE = 0.4
GREATEST_SPEED = 25.0
ROUNDING_RAD = 3e-5
"""What float32 quaternions leave of an angle."""


def midi(notes: Notes) -> bytes:
    track = mido.MidiTrack([mido.Message("program_change", program=56)])
    events = [(round(on * 480), 1, pitch) for on, _, pitch in notes]
    events += [(round((on + length) * 480), 0, pitch) for on, length, pitch in notes]
    last = 0
    for tick, kind, pitch in sorted(events):
        track.append(
            mido.Message("note_on" if kind else "note_off", note=pitch, velocity=100 * kind, time=tick - last)
        )
        last = tick
    data = io.BytesIO()
    mido.MidiFile(ticks_per_beat=480, tracks=[track]).save(file=data)
    return data.getvalue()


SOLOISTS = ("faster than strokes", "two-octave leaps", "a long note and a rest", "chromatic-scale.mid")
"""What the second player plays too: the same motion on another skeleton."""

LONGEST_S = 600.0
"""Longer scores are audited at their beginning, middle and end."""


class Played:
    """A score in a session, and frames of it."""

    def __init__(
        self, client: httpx.Client, session: str, player: str, spans: list[tuple[float, float]]
    ) -> None:
        self.client, self.session, self.player = client, session, player
        self.takes = [take(client, session, start, end) for start, end in spans]
        score: dict[str, Any] = client.get(f"/api/v1/sessions/{session}/score").raise_for_status().json()
        self.notes = [note for note in score["notes"] if note["part"] == score["part"]]


def upload(client: httpx.Client, name: str, player: str = "trumpeter") -> dict[str, Any]:
    """A new session of an example or of an extreme score."""
    score = (name, EXAMPLES[name].read_bytes()) if name in EXAMPLES else ("extreme.mid", midi(SCORES[name]))
    # With a song of their own, so that nothing is rendered meanwhile.
    files = {"score": score, "song": ("song.wav", song())}
    made: dict[str, Any] = (
        client.post("/api/v1/sessions", files=files, data={"player": player}).raise_for_status().json()
    )
    return made


@pytest.fixture(
    scope="module",
    params=[(name, "trumpeter") for name in (*SCORES, *EXAMPLES)] + [(name, "soloist") for name in SOLOISTS],
    ids=lambda both: "-".join(both).replace(" ", "-"),
)
def played(request: pytest.FixtureRequest, client: httpx.Client) -> Iterator[Played]:
    """All frames of a score, or its beginning, middle and end."""
    name, player = request.param
    made = upload(client, name, player)
    end = float(made["duration_s"]) + 2.0
    spans = [(0.0, end)] if end < LONGEST_S else [(0.0, 12.0), (end / 2, end / 2 + 8.0), (end - 12.0, end)]
    yield Played(client, made["id"], player, spans)
    client.delete(
        f"/api/v1/sessions/{made['id']}", headers={"Authorization": f"Bearer {made['control_token']}"}
    ).raise_for_status()


def valve(one: Take, number: int) -> NDArray[np.float64]:
    return one.parameters[f"trumpet/valve/{number}"][:, 0]


@pytest.mark.parametrize("number", [1, 2, 3])
def test_pads_are_on_their_buttons_and_idle_fingers_near_them(played: Played, number: int) -> None:
    for one in played.takes:
        player, trumpet = one.skeleton(played.player), one.skeleton("trumpet")
        effector = next(entry["effector"] for entry in trumpet.rig["buttons"] if entry["valve"] == number)
        apart = np.linalg.norm(player.named("effectors", effector) - button(trumpet, one, number), axis=1)
        assert apart[valve(one, number) > 0.0].max(initial=0.0) <= PAD_M
        assert apart.max() <= LIFTED_M


def test_every_note_has_its_fingering_from_onset_to_end(played: Played) -> None:
    """Micro-F1 of valve states against the fingering, over all frames outside of strokes, is 1."""
    hits = misses = false_alarms = frames = 0
    for one in played.takes:
        found = np.stack([valve(one, number) for number in (1, 2, 3)], axis=1)
        for index, note in enumerate(played.notes):
            onset, end = note["onset_s"], note["onset_s"] + note["duration_s"]
            if index + 1 < len(played.notes):
                following = played.notes[index + 1]["onset_s"]
                stroke = min(LONGEST_STROKE_S, LARGEST_SHARE * (following - onset))
                end = min(end, following - stroke)
            inside = (one.song_time_s >= onset) & (one.song_time_s < end - 1e-6)
            wanted = np.array([number in (note["valves"] or []) for number in (1, 2, 3)])
            state = found[inside]
            assert np.all((state == 0.0) | (state == 1.0))  # none is still on its way
            hits += int(np.sum((state == 1.0) & wanted))
            misses += int(np.sum((state == 0.0) & wanted))
            false_alarms += int(np.sum((state == 1.0) & ~wanted))
            frames += len(state)
    assert frames > 0
    assert (misses, false_alarms) == (0, 0)
    assert hits == 0 or 2 * hits / (2 * hits + misses + false_alarms) == 1.0


def test_no_valve_is_late_on_a_finer_grid(played: Played) -> None:
    """At 240 frames a second: whatever a note needs is all the way there at its onset and before the next."""
    onsets = [note["onset_s"] for note in played.notes if note["valves"] is not None]
    start = max(onsets[len(onsets) // 2] - 1.0, 0.0)
    one = take(played.client, played.session, start, start + 3.0, fps=240)
    found = np.stack([valve(one, number) for number in (1, 2, 3)], axis=1)
    checked = 0
    for note, following in zip(played.notes, [*played.notes[1:], None], strict=True):
        end = note["onset_s"] + note["duration_s"]
        if following is not None:
            interval = following["onset_s"] - note["onset_s"]
            end = min(end, following["onset_s"] - min(LONGEST_STROKE_S, LARGEST_SHARE * interval))
        inside = (one.song_time_s >= note["onset_s"]) & (one.song_time_s < end - 1e-6)
        wanted = [float(number in (note["valves"] or [])) for number in (1, 2, 3)]
        np.testing.assert_array_equal(found[inside], np.broadcast_to(wanted, found[inside].shape))
        checked += int(inside.sum())
    assert checked > 0


def test_the_mouth_is_on_the_mouthpiece_and_the_feet_do_not_slide(played: Played) -> None:
    for one in played.takes:
        player, trumpet = one.skeleton(played.player), one.skeleton("trumpet")
        lips, mouthpiece = player.named("contacts", "lips"), trumpet.named("contacts", "mouthpiece")
        apart = np.linalg.norm(lips - mouthpiece, axis=1)
        assert apart[one.sounding].max(initial=0.0) <= MOUTH_M
        for sole in ("leftSole", "rightSole"):
            place = player.named("contacts", sole)
            assert np.abs(place - place[0]).max() <= FEET_M


def excess(joint: dict[str, Any], turned: Rotation) -> float:
    """By how much a joint is beyond its limits, radians; of two sets of angles the one that fits better."""
    limits = joint["limits"]
    order: str = limits["order"]
    angles = (Rotation.from_quat(joint["rotation"]).inv() * turned).as_euler(order.upper())
    other = np.stack([angles[:, 0] + np.pi, np.pi - angles[:, 1], angles[:, 2] + np.pi], axis=1)
    low = np.array([limits[letter][0] for letter in order])
    high = np.array([limits[letter][1] for letter in order])
    first, second = (
        np.maximum(np.maximum(low - one, one - high), 0.0).max(axis=1)
        for one in (angles, (other + np.pi) % (2 * np.pi) - np.pi)
    )
    return float(np.minimum(first, second).max())


def test_no_joint_is_beyond_its_limits(played: Played) -> None:
    for one in played.takes:
        joints = one.skeleton(played.player).rig["joints"]
        local = one.local["player"]
        for index, joint in enumerate(joints):
            if "limits" in joint:
                assert excess(joint, Rotation.from_quat(local[:, index])) <= ROUNDING_RAD, joint["name"]


def test_nothing_jumps(played: Played) -> None:
    for one in played.takes:
        names = [joint["name"] for joint in one.skeleton(played.player).rig["joints"]]
        pressing = np.zeros(len(names), dtype=bool)
        quaternions = one.local["player"]
        cosine = np.abs(np.sum(quaternions[1:] * quaternions[:-1], axis=-1)).clip(max=1.0)
        speed = 2.0 * np.arccos(cosine) * 60.0
        for number, finger in ((1, "rightIndex"), (2, "rightMiddle"), (3, "rightRing")):
            # A finger is excused by the strokes of its own valve alone.
            own = np.array([name.startswith(finger) for name in names])
            assert own.sum() == 3
            still = np.diff(valve(one, number)) == 0.0
            assert speed[np.ix_(still, own)].max(initial=0.0) <= GREATEST_SPEED, finger
            pressing |= own
        assert speed[:, ~pressing].max() <= GREATEST_SPEED
        for pose in one.poses.values():
            assert greatest_step(pose) * 60.0 <= 1.5


def greatest_step(pose: Pose) -> float:
    """The furthest that any joint goes from frame to frame, metres."""
    return max(
        float(np.linalg.norm(np.diff(place, axis=0), axis=1).max()) for place in pose.positions.values()
    )


def test_asking_for_a_part_gives_the_same_bytes(played: Played) -> None:
    """Sought last to first and in between, from any frame of a block, as a person who scrubs would."""
    for one in played.takes:
        for share in (0.93, 0.07, 0.61, 0.34):
            first = int(share * (len(one.song_time_s) - 30))
            start = float(one.song_time_s[first])
            again = take(played.client, played.session, start, start + 0.4)
            begin = int(np.flatnonzero(one.song_time_s == again.song_time_s[0])[0])
            assert len(again.raw) >= 20
            np.testing.assert_array_equal(again.raw[:, 24:], one.raw[begin : begin + len(again.raw), 24:])


def test_another_process_gives_the_same_bytes(
    client: httpx.Client, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Scores with strokes, leaps, the third slide and a lowered horn among them."""
    with (
        serve(tmp_path_factory.mktemp("other")) as running,
        httpx.Client(base_url=running.address, timeout=30.0) as other,
    ):
        for name, end in {
            "faster than strokes": 14.0,
            "two-octave leaps in semiquavers": 9.0,
            "a long note and a rest": 25.0,
            "chromatic-scale.mid": 12.0,
        }.items():
            first, second = (take(one, upload(one, name)["id"], 0.0, end) for one in (client, other))
            np.testing.assert_array_equal(first.raw[:, 24:], second.raw[:, 24:], err_msg=name)


def test_every_gesture_has_an_amount_that_frames_obey(client: httpx.Client) -> None:
    """Every ``player/`` parameter is listed, and what a show sets it to is seen in the frames."""
    made = upload(client, "a long note and a rest")
    listed = client.get(f"/api/v1/sessions/{made['id']}/parameters").raise_for_status().json()["parameters"]
    player = {entry["path"]: entry for entry in listed if entry["path"].startswith("player/")}
    assert len(player) >= 15
    headers = {"Authorization": f"Bearer {made['control_token']}"}

    def frames(*tracks: dict[str, Any]) -> dict[str, NDArray[np.float64]]:
        url = f"/api/v1/sessions/{made['id']}/show"
        client.put(url, headers=headers, json={"version": 1, "tracks": tracks}).raise_for_status()
        one = take(client, made["id"], 0.0, 14.0, fps=24)
        seen = {
            path: value
            for path, value in one.parameters.items()
            if path.startswith("face/") or path == "trumpet/mute"
        }
        return seen | {"joints": one.local["player"].reshape(len(one.raw), -1)}

    shown = frames()
    for path, entry in player.items():
        least = entry["minimum"]
        values = entry["choices"] or [[least] * 3 if entry["type"] == "vector" else least]
        others = [value for value in values if value != entry["default"]]
        assert others, path
        assert entry["documentation"], path
        for value in others:
            if value == "open":
                continue  # as this score has it
            found = frames({"parameter": path, "keyframes": [{"time": 0, "value": value}]})
            assert max(np.abs(found[name] - shown[name]).max() for name in shown) > 5e-4, (path, value)
    client.delete(f"/api/v1/sessions/{made['id']}", headers=headers).raise_for_status()
