"""Two, three and four players on one stage, from frames alone: room, light, cameras and glances."""

from __future__ import annotations

from itertools import combinations, pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tests.integration.scores import scale, song, trumpets
from tests.integration.server import upload
from tests.integration.stranger import take
from tests.integration.test_audit import excess
from tests.integration.test_framing import CUT, furthest_out

if TYPE_CHECKING:
    import httpx
    from numpy.typing import NDArray
    from tests.integration.server import Owned
    from tests.integration.stranger import Take

SONG: dict[str, Any] = {"song": ("s.wav", song())}
APART_M = 0.25
"""Nobody, arm and bell included, comes nearer to anybody else."""
CAMERA_M = 0.35
SPOT_SIDES = {1: -1, 2: 1, 3: 0}


def prefixes(frames: Take) -> list[str]:
    """What the paths of each player begin with, in the cast's order."""
    return [name.removesuffix("player") for name in frames.poses if name.endswith("player")]


def capsules(
    frames: Take, prefix: str
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """A player's and the instrument's: from and to (F, K, 3), radius (K,)."""
    ends: tuple[list[Any], list[Any]] = ([], [])
    radii: list[float] = []
    for name, pose in frames.poses.items():
        if name.rpartition("/")[0] == prefix.rstrip("/"):
            for capsule in pose.rig["capsules"]:
                ends[0].append(pose.point(capsule["joint"], capsule["from"]))
                ends[1].append(pose.point(capsule["joint"], capsule["to"]))
                radii.append(capsule["radius"])
    return np.stack(ends[0], axis=1), np.stack(ends[1], axis=1), np.array(radii)


def along(start: NDArray[np.float64], end: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """(..., count, 3): points from start to end."""
    return start[..., None, :] + (end - start)[..., None, :] * np.linspace(0.0, 1.0, count)[:, None]


def distance(
    points: NDArray[np.float64], solid: tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]
) -> NDArray[np.float64]:
    """(F, P): of points (F, P, 3) to the nearest surface of capsules."""
    start, end, radius = solid
    way = (end - start)[:, None]
    from_start = points[:, :, None] - start[:, None]
    length = np.maximum(np.einsum("fpki,fpki->fpk", way, way), 1e-12)
    share = np.clip(
        np.einsum("fpki,fpki->fpk", from_start, np.broadcast_to(way, from_start.shape)) / length, 0, 1
    )
    return (np.linalg.norm(from_start - share[..., None] * way, axis=-1) - radius).min(axis=-1)


@pytest.fixture(scope="module", params=[2, 3, 4])
def cast(request: pytest.FixtureRequest, client: httpx.Client) -> Any:
    made = upload(client, trumpets(request.param), **SONG)
    assert len(made.body["cast"]["castings"]) == request.param
    yield made
    made.change("DELETE")


@pytest.fixture(scope="module")
def frames(cast: Owned) -> Take:
    return take(cast.client, cast.id, 0.0, cast.body["duration_s"], fps=4)


def test_nobody_stands_in_anybody_and_no_bell_pokes_into_a_neighbour(frames: Take) -> None:
    solid = [capsules(frames, prefix) for prefix in prefixes(frames)]
    for one, other in combinations(solid, 2):
        start, end, radius = one
        points = along(start, end, 4)
        gap = distance(points.reshape(len(points), -1, 3), other).reshape(points.shape[:3]) - radius[:, None]
        assert gap.min() > APART_M


def test_from_where_the_audience_sits_nobody_hides_anybodys_head_or_hands(frames: Take) -> None:
    solid = [capsules(frames, prefix) for prefix in prefixes(frames)]
    for x_m in (-1.5, 0.0, 1.5):
        for number, prefix in enumerate(prefixes(frames)):
            player = frames.poses[f"{prefix}player"]
            for seen in (player.positions["head"], player.named("effectors", "rightIndexTip")):
                sight = along(np.broadcast_to([x_m, 1.5, 6.0], seen.shape), seen, 40)
                for other, hiding in enumerate(solid):
                    assert other == number or distance(sight, hiding).min() > 0.02


def test_the_first_show_has_everybody_in_its_first_picture_and_no_camera_stands_in_anybody(
    frames: Take,
) -> None:
    everybody = [
        frames.poses[f"{prefix}player"].positions[joint]
        for prefix in prefixes(frames)
        for joint in ("head", "leftHand", "rightHand", "hips")
    ]
    out = furthest_out(frames, np.stack(everybody, axis=1))
    cuts = np.flatnonzero(frames.raw[:, 2] & CUT)
    assert out[: cuts[0] if len(cuts) else None].max() < 0.95
    camera = frames.parameters["camera/position"][:, None]
    for prefix in prefixes(frames):
        assert distance(camera, capsules(frames, prefix)).min() > CAMERA_M


def test_the_first_show_lights_every_player(frames: Take) -> None:
    for prefix in prefixes(frames):
        chest = frames.poses[f"{prefix}player"].positions["upperChest"]
        lit = np.zeros(len(chest), bool)
        for spot in SPOT_SIDES:
            path = f"lights/spots/{spot}"
            hangs = frames.parameters[f"{path}/position"]
            to_target, to_chest = frames.parameters[f"{path}/target"] - hangs, chest - hangs
            cosine = np.einsum("fi,fi->f", to_target, to_chest) / (
                np.linalg.norm(to_target, axis=1) * np.linalg.norm(to_chest, axis=1)
            )
            inside = np.arccos(np.minimum(cosine, 1.0)) < 0.8 * frames.parameters[f"{path}/angle"][:, 0]
            lit |= inside & (frames.parameters[f"{path}/intensity"][:, 0] > 1.0)
        assert lit.all()


def test_the_light_and_the_camera_go_to_who_has_the_tune(cast: Owned, frames: Take) -> None:
    tune = cast.client.get(f"{cast.path}/cast").raise_for_status().json()["tune"]
    assert tune[0]["start_s"] == 0.0
    assert all(one["end_s"] == other["start_s"] for one, other in pairwise(tune))
    # The first trumpet, the highest, has it from the first note on.
    assert tune[0]["player"] == 0
    x_m = float(frames.poses["player"].positions["hips"][0, 0])
    side = 0 if abs(x_m) < 0.2 else int(np.sign(x_m))
    own = next(spot for spot, place in SPOT_SIDES.items() if place == side)
    levels = {spot: frames.parameters[f"lights/spots/{spot}/intensity"][8, 0] for spot in SPOT_SIDES}
    assert max(levels, key=levels.__getitem__) == own


def test_players_look_at_each_other_as_somebody_enters(client: httpx.Client) -> None:
    made = upload(client, trumpets(2), **SONG)

    def heads(amount: float) -> Take:
        tracks = [
            {"parameter": f"{prefix}player/glance", "keyframes": [{"time": 0, "value": amount}]}
            for prefix in ("", "players/2/")
        ]
        made.change("PUT", "/show", json={"version": 1, "tracks": tracks}).raise_for_status()
        return take(client, made.id, 0.0, 16.0, fps=20)

    still, looking = heads(0.0), heads(1.0)
    # The second enters at 1.5 s while the first plays: the first looks to the left, above all with the eyes.
    at = 28
    for prefix, before_s in (("", at), ("players/2/", 18)):
        moved = Rotation.from_quat(still.local[f"{prefix}player"][before_s]).inv() * Rotation.from_quat(
            looking.local[f"{prefix}player"][before_s]
        )
        joints = looking.poses[f"{prefix}player"].rig["joints"]
        angles = np.linalg.norm(moved.as_rotvec(), axis=-1).tolist()
        turned = {joint["name"]: angle for joint, angle in zip(joints, angles, strict=True)}
        assert turned["leftEye"] > 0.2, prefix
        assert turned["head"] > 0.02, prefix
    # Between entries each keeps to the part.
    for name, one in still.local.items():
        moved = np.abs(one - looking.local[name]).max(axis=(1, 2)) > 1e-6
        assert 0.02 < moved.mean() < 0.5, name
    made.change("DELETE")


def test_no_glance_breaks_a_contact_or_a_limit(client: httpx.Client) -> None:
    """Glances at their largest, over the largest turns that a show may key."""
    made = upload(client, trumpets(3), **SONG)
    tracks = [
        {"parameter": f"{prefix}player/{path}", "keyframes": [{"time": 0, "value": value}]}
        for prefix, sign in (("", 1), ("players/2/", -1), ("players/3/", 1))
        for path, value in (
            ("glance", 1.5),
            ("pose/head", [0.1, 0.19 * sign, 0.05]),
            ("pose/torso", [0.1, 0.25 * sign, 0.05]),
            ("pose/gaze_left", 0.5 * sign),
        )
    ]
    made.change("PUT", "/show", json={"version": 1, "tracks": tracks}).raise_for_status()
    frames = take(client, made.id, 0.0, made.body["duration_s"], fps=20)
    notes = client.get(f"{made.path}/score").json()["notes"]
    for number, prefix in enumerate(prefixes(frames)):
        player, trumpet = frames.poses[f"{prefix}player"], frames.poses[f"{prefix}trumpet"]
        own = [note for note in notes if note["player"] == number]
        sounding = np.any(
            [
                (frames.song_time_s >= n["onset_s"]) & (frames.song_time_s < n["onset_s"] + n["duration_s"])
                for n in own
            ],
            axis=0,
        )
        mouth = player.named("contacts", "lips") - trumpet.named("contacts", "mouthpiece")
        assert np.linalg.norm(mouth, axis=1)[sounding].max() <= 0.001
        for sole in ("leftSole", "rightSole"):
            place = player.named("contacts", sole)
            assert np.abs(place - place[0]).max() <= 0.001
        for index, joint in enumerate(player.rig["joints"]):
            if "limits" in joint and joint["parent"] is not None:
                turned = Rotation.from_quat(frames.local[f"{prefix}player"][:, index])
                assert excess(joint, turned) <= 3e-5, joint["name"]
    made.change("DELETE")


def test_one_player_alone_has_nobody_to_look_at(client: httpx.Client) -> None:
    made = upload(client, scale(4), **SONG)
    listed = client.get(f"{made.path}/parameters").json()["parameters"]
    assert not any("glance" in entry["path"] or entry["path"].startswith("players/") for entry in listed)
    made.change("DELETE")
