"""Several players at once: who plays what is chosen, carried whole, and each moves exactly."""

from __future__ import annotations

import io
import json
from typing import TYPE_CHECKING, Any

import httpx
import mido
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tests.integration.scores import collection, duet, relay, scale, song, trumpets
from tests.integration.server import serve, upload
from tests.integration.stranger import take
from tests.integration.test_audit import excess

if TYPE_CHECKING:
    from pathlib import Path

    from tests.integration.server import Owned

SONG: dict[str, Any] = {"song": ("s.wav", song())}
FLUTE_TOO: dict[str, Any] = {
    "castings": [{"part": 1}, {"part": 0, "player": "soloist", "transposition": -12}],
}


@pytest.fixture
def pair(client: httpx.Client) -> Any:
    """A trumpet and, an octave lower, the flute's part on another."""
    made = upload(client, duet(), **SONG, cast=json.dumps(FLUTE_TOO))
    yield made
    made.change("DELETE")


def test_a_cast_comes_with_the_upload_and_tells_who_plays_what(pair: Owned) -> None:
    cast = pair.client.get(f"{pair.path}/cast").raise_for_status().json()
    told = [(one["part"], one["part_name"], one["player"], one["seat"]) for one in cast["castings"]]
    assert told == [(1, "Trumpet", "trumpeter", "right"), (0, "Flute", "soloist", "left")]
    assert [one["seat_chosen"] for one in cast["castings"]] == [False, False]
    assert [one["sounding_transposition"] for one in cast["castings"]] == [0, -12]
    assert all(one["playable"] == one["notes"] == 4 for one in cast["castings"])
    assert any("Trumpet" in reason for reason in cast["castings"][0]["reasons"])
    notes = pair.client.get(f"{pair.path}/score").json()["notes"]
    assert {note["part"]: note["player"] for note in notes} == {0: 1, 1: 0}
    assert all(note["fingering"] == {"type": "valves", "valves": note["valves"]} for note in notes)
    assert all(note["in_played_part"] for note in notes)


def test_every_player_has_skeletons_and_parameters_of_their_own(pair: Owned) -> None:
    manifest = pair.client.get(f"{pair.path}/manifest").json()
    assert [(one["name"], one["rig"], one["player"]) for one in manifest["skeletons"]] == [
        ("player", "trumpeter", 0),
        ("trumpet", "trumpet", 0),
        ("players/2/player", "soloist", 1),
        ("players/2/trumpet", "trumpet", 1),
    ]
    paths = {parameter["path"] for parameter in manifest["parameters"]}
    for path in ("trumpet/valve/1", "trumpet/mute", "face/cheek_puff", "player/sway", "player/stance"):
        assert {path, f"players/2/{path}"} <= paths


def test_each_player_plays_exactly_wherever_they_stand(pair: Owned) -> None:
    frames = take(pair.client, pair.id, 0.0, pair.body["duration_s"])
    apart = frames.poses["player"].positions["hips"] - frames.poses["players/2/player"].positions["hips"]
    assert np.linalg.norm(apart, axis=1).min() > 0.9
    for prefix in ("", "players/2/"):
        player, trumpet = frames.poses[f"{prefix}player"], frames.poses[f"{prefix}trumpet"]
        pressed = 0
        for entry in trumpet.rig["buttons"]:
            valve = frames.parameters[f"{prefix}trumpet/valve/{entry['valve']}"][:, :1]
            local = np.array(entry["position"]) + valve * np.array(entry["travel"])
            root = trumpet.rig["joints"][0]["name"]
            top = trumpet.positions[root] + trumpet.rotations[root].apply(local)
            gap = np.linalg.norm(player.named("effectors", entry["effector"]) - top, axis=1)
            pressed += int((valve == 1.0).sum())
            assert gap[valve[:, 0] > 0].max(initial=0.0) <= 0.0005
            assert gap.max() <= 0.008
        assert pressed > 20
        mouth = player.named("contacts", "lips") - trumpet.named("contacts", "mouthpiece")
        assert np.linalg.norm(mouth, axis=1)[frames.sounding].max() <= 0.001
        for sole in ("leftSole", "rightSole"):
            place = player.named("contacts", sole)
            assert np.abs(place - place[0]).max() <= 0.001
        for index, joint in enumerate(player.rig["joints"]):
            if "limits" in joint and joint["parent"] is not None:
                turned = Rotation.from_quat(frames.local[f"{prefix}player"][:, index])
                assert excess(joint, turned) <= 3e-5, joint["name"]


def test_who_chose_no_seat_gives_way_to_who_did(client: httpx.Client) -> None:
    made = upload(client, relay(), **SONG)
    drums: dict[str, Any] = {"part": 3, "instrument": "drums"}
    for castings, seats in (
        ([{"part": 0}, drums], ["middle", "drums"]),
        ([{"part": 0}, {**drums, "seat": "middle"}], ["right", "middle"]),
        ([{"part": 0, "seat": "drums"}, drums], ["drums", "middle"]),
        ([{"part": 0, "seat": "left"}, {"part": 2}], ["left", "middle"]),
    ):
        cast = made.change("PUT", "/cast", json={"castings": castings}).raise_for_status().json()
        assert [one["seat"] for one in cast["castings"]] == seats
    made.change("DELETE")


def test_a_second_player_changes_nothing_for_the_first_but_the_seat(client: httpx.Client) -> None:
    castings = [{"part": 1, "seat": "middle"}, {"part": 0, "seat": "left", "transposition": -12}]
    rest: dict[str, Any] = {"show": ("show.json", b'{"version": 1, "tracks": []}')}
    both = upload(client, duet(), **SONG, **rest, cast=json.dumps({"castings": castings}))
    alone = upload(client, duet(), **SONG, **rest)
    assert all(one["seat_chosen"] for one in client.get(f"{both.path}/cast").json()["castings"])
    one, two = (take(client, made.id, 0.0, 2.0) for made in (alone, both))
    for skeleton in ("player", "trumpet"):
        np.testing.assert_array_equal(one.local[skeleton], two.local[skeleton])
    for path in one.parameters:
        np.testing.assert_array_equal(one.parameters[path], two.parameters[path], err_msg=path)
    for made in (both, alone):
        made.change("DELETE")


def test_a_show_moves_each_player_and_keeps_what_a_smaller_cast_has_not(pair: Owned) -> None:
    track = {"keyframes": [{"time": 0, "value": 0.0}]}
    path = "players/2/player/sway"
    pair.change("PUT", f"/show/tracks/{path}", json={"parameter": path, **track}).raise_for_status()
    frames = take(pair.client, pair.id, 0.5, 1.5)
    assert np.all(frames.parameters[path] == 0.0)
    assert np.all(frames.parameters["player/sway"] == 1.0)
    pair.change("PUT", "/cast", json={"castings": [{"part": 1}]}).raise_for_status()
    told = pair.client.get(pair.path).json()["warnings"]
    assert [one["place"] for one in told if one["kind"] == "show-unknown-parameter"] == [path]
    pair.change("PUT", "/cast", json=FLUTE_TOO).raise_for_status()
    assert np.all(take(pair.client, pair.id, 0.5, 1.5).parameters[path] == 0.0)


@pytest.mark.parametrize(
    ("castings", "place", "told"),
    [
        ([{"player": "nobody"}], "player", "there are trumpeter, soloist"),
        ([{"instrument": "kazoo"}], "instrument", "there are trumpet"),
        ([{"seat": "moon"}], "seat", "there are middle, left, right"),
        ([{"part": 1}, {"part": 7}], "castings/1/part", "there are 0 to 1"),
        ([{"part": 1}, {"part": 1}], "castings/1/part", "part 1 is played by another player already"),
        ([{"seat": "left"}, {"seat": "left"}], "castings/1/seat", "taken already"),
        (
            [{"instrument": "drums"}, {"instrument": "drums"}],
            "castings/1/instrument",
            "one drum kit on the stage",
        ),
    ],
)
def test_a_cast_that_cannot_play_is_refused_with_its_place(
    client: httpx.Client, castings: list[dict[str, Any]], place: str, told: str
) -> None:
    made = upload(client, duet(), **SONG)
    before = client.get(f"{made.path}/cast").json()
    refused = made.change("PUT", "/cast", json={"castings": castings})
    assert refused.status_code == 422
    assert refused.headers["content-type"] == "application/problem+json"
    assert place in refused.json()["detail"]
    assert told in refused.json()["detail"]
    assert client.get(f"{made.path}/cast").json() == before
    too_many = made.change("PUT", "/cast", json={"castings": [{}] * 5})
    assert too_many.status_code == 422
    made.change("DELETE")


def test_a_form_says_a_cast_or_what_one_player_plays(client: httpx.Client) -> None:
    files = {"score": ("s.mid", scale(4))}
    form = {"cast": json.dumps({"castings": [{}]}), "part": "0"}
    refused = client.post("/api/v1/sessions", files=files, data=form)
    assert refused.status_code == 422
    assert "leave out part" in refused.json()["detail"]
    broken = client.post("/api/v1/sessions", files=files, data={"cast": "{"})
    assert broken.status_code == 422
    assert "cast" in broken.json()["detail"]


def test_a_cast_outlives_the_server(tmp_path: Path) -> None:
    with serve(tmp_path) as before, httpx.Client(base_url=before.address, timeout=30) as client:
        made = upload(client, duet(), **SONG, cast=json.dumps(FLUTE_TOO))
        told = client.get(f"{made.path}/cast").json()
    with serve(tmp_path) as after, httpx.Client(base_url=after.address, timeout=30) as client:
        assert client.get(f"{made.path}/cast").json() == told


def test_what_there_is_to_cast(client: httpx.Client) -> None:
    told = client.get("/api/v1/instruments").json()
    assert {"name": "trumpet", "title": "B♭ trumpet", "rig": "trumpet"}.items() <= told["instruments"][
        0
    ].items()
    assert told["instruments"][0]["players"] == ["trumpeter", "soloist"]
    assert told["seats"][0] == "middle"
    assert told["max_players"] == 4


def told(session: Owned) -> list[tuple[int, str, str]]:
    """Part, instrument and player of each casting that `GET .../cast` tells."""
    castings = session.client.get(f"{session.path}/cast").raise_for_status().json()["castings"]
    return [(one["part"], one["instrument"], one["player"]) for one in castings]


TWO = [(0, "trumpet", "trumpeter"), (1, "trumpet", "soloist")]


def test_a_score_of_several_trumpets_is_cast_by_itself_with_reasons(client: httpx.Client) -> None:
    made = upload(client, trumpets(2), **SONG)
    cast = client.get(f"{made.path}/cast").json()
    assert cast["auto"] is True
    assert told(made) == TWO
    assert [one["seat"] for one in cast["castings"]] == ["right", "left"]
    assert cast["castings"][1]["cast_because"][0] == "named “Trumpet 2”: a part for the trumpet"
    assert cast["unplayed"] == []
    # The answer to the upload tells it too, without what else each could play.
    summary = {name: value for name, value in cast.items() if name not in {"castings", "tune"}}
    assert {name: made.body["cast"][name] for name in summary} == summary
    assert [one["part"] for one in made.body["cast"]["castings"]] == [0, 1]
    assert (made.body["part"], made.body["player"]) == (0, "trumpeter")
    made.change("DELETE")


def test_of_what_nobody_plays_it_is_told_why(client: httpx.Client) -> None:
    made = upload(client, relay(), **SONG)
    cast = client.get(f"{made.path}/cast").json()
    assert [(one["part"], one["part_name"]) for one in cast["unplayed"]] == [
        (1, "Trumpet (muted)"),
        (2, "Flute"),
    ]
    reasons = [one["reason"] for one in cast["unplayed"]]
    assert "plays only where “Trumpet” rests" in reasons[0]
    assert reasons[1:] == ["no player for flute yet; it is heard"]
    assert cast["castings"][1]["cast_because"] == ["a part for drums"]
    alone = made.change("PUT", "/cast", json={"castings": [{"part": 0}]}).raise_for_status().json()
    assert alone["unplayed"][2]["reason"] == "drums; nobody was cast for them; it is heard"
    made.change("DELETE")


@pytest.mark.parametrize(
    "form", [{"part": "1"}, {"player": "soloist"}, {"cast": json.dumps({"castings": [{}]})}]
)
def test_an_upload_that_says_who_plays_is_obeyed(client: httpx.Client, form: dict[str, str]) -> None:
    made = upload(client, trumpets(2), **SONG, **form)
    assert len(told(made)) == 1
    assert made.body["cast"]["auto"] is False
    made.change("DELETE")


@pytest.mark.parametrize("back", [("PATCH", "", {"cast": "auto"}), ("PUT", "/cast", {"cast": "auto"})])
def test_one_goes_back_to_the_cast_that_was_found(client: httpx.Client, back: tuple[str, str, Any]) -> None:
    made = upload(client, trumpets(2), **SONG, cast="auto")
    made.change("PUT", "/cast", json={"castings": [{"part": 1}]}).raise_for_status()
    assert told(made) == [(1, "trumpet", "trumpeter")]
    method, path, body = back
    made.change(method, path, json=body).raise_for_status()
    assert told(made) == TWO
    assert client.get(made.path).json()["cast"]["auto"] is True
    twice = made.change("PATCH", "", json={"cast": "auto", "part": 0})
    assert twice.status_code == 422
    assert "leave out part" in twice.json()["detail"]
    wrong = made.change(method, path, json={"cast": "best"})
    assert wrong.status_code == 422
    assert "auto" in wrong.text
    made.change("DELETE")


def test_the_first_player_may_take_another_s_part_and_then_they_change(client: httpx.Client) -> None:
    made = upload(client, trumpets(2), **SONG)
    changed = made.change("PATCH", "", json={"part": 1}).raise_for_status().json()
    assert (changed["part"], changed["cast"]["auto"]) == (1, False)
    assert told(made) == [(1, "trumpet", "trumpeter"), (0, "trumpet", "soloist")]
    made.change("PATCH", "", json={"joined_parts": [0]}).raise_for_status()
    assert told(made) == [(1, "trumpet", "trumpeter")]
    made.change("DELETE")


def test_a_found_cast_outlives_the_server_and_another_sequence_is_cast_anew(tmp_path: Path) -> None:
    with serve(tmp_path) as before, httpx.Client(base_url=before.address, timeout=30) as client:
        made = upload(client, trumpets(3), **SONG)
        cast = client.get(f"{made.path}/cast").json()
        several = upload(client, collection(), **SONG)
        assert several.change("PATCH", "", json={"sequence": 1}).json()["cast"]["auto"] is True
    with serve(tmp_path) as after, httpx.Client(base_url=after.address, timeout=30) as client:
        assert client.get(f"{made.path}/cast").json() == cast


def test_the_first_show_is_written_anew_for_more_players_unless_it_was_edited(client: httpx.Client) -> None:
    made = upload(client, trumpets(2), **SONG)

    def tracks() -> set[str]:
        return {track["parameter"] for track in client.get(f"{made.path}/show").json()["tracks"]}

    spot = "lights/spots/1/target"
    assert spot in tracks()
    made.change("PUT", "/cast", json={"castings": [{}]}).raise_for_status()
    assert spot not in tracks()
    key = {"keyframes": [{"time": 0, "value": 0.5}]}
    made.change("PUT", "/show/tracks/player/sway", json=key).raise_for_status()
    made.change("PUT", "/cast", json={"cast": "auto"}).raise_for_status()
    assert spot not in tracks()
    assert "player/sway" in tracks()
    made.change("DELETE")


def test_every_player_s_parameters_are_listed_for_all_and_for_a_session(client: httpx.Client) -> None:
    made = upload(client, trumpets(2), **SONG)
    manifest = client.get(f"{made.path}/manifest").json()
    own = client.get(f"{made.path}/parameters").raise_for_status().json()
    listed = [entry["path"] for entry in (*own["parameters"], *own["streamed"])]
    assert listed == [entry["path"] for entry in manifest["parameters"]]
    assert {"players/2/player/sway", "players/2/player/glance", "player/glance"} <= set(listed)
    assert not any(path.startswith("players/3/") for path in listed)
    everything = client.get("/api/v1/parameters").json()
    for kind in ("parameters", "streamed"):
        known = {entry["path"] for entry in everything[kind]}
        assert {entry["path"] for entry in own[kind]} <= known
        assert any(path.startswith("players/4/") for path in known)
    streamed = {entry["path"] for entry in everything["streamed"]}
    assert {"trumpet/valve/1", "players/4/cornet/valve/1", "players/2/face/smile"} <= streamed
    made.change("DELETE")


def test_hands_are_told_and_a_left_handed_trumpeter_is_refused(client: httpx.Client) -> None:
    made = upload(client, scale(4), **SONG, handedness="right")
    assert made.body["handedness"] == "right"
    assert client.get(f"{made.path}/score").json()["handedness"] == "right"
    assert client.get("/api/v1/instruments").json()["instruments"][0]["handedness"] == ["right"]
    form = {"handedness": "left"}
    for refused in (
        made.change("PUT", "/cast", json={"castings": [{"handedness": "left"}]}),
        made.change("PATCH", "", json={"handedness": "left"}),
        client.post("/api/v1/sessions", files={"score": ("s.mid", scale(4))}, data=form),
    ):
        assert refused.status_code == 422
        assert refused.json()["detail"] == (
            "handedness: the B♭ trumpet is played right-handed, not left-handed"
        )
    unknown = made.change("PUT", "/cast", json={"castings": [{"handedness": "both"}]})
    assert unknown.status_code == 422
    assert "'left' or 'right'" in unknown.text
    made.change("DELETE")


def trumpet_and_drums() -> bytes:
    """A few notes, and two bars of rock under them."""
    melody = mido.MidiTrack(
        [mido.MetaMessage("track_name", name="Trumpet"), mido.Message("program_change", program=56)]
    )
    for pitch in (60, 62, 64, 65):
        melody.append(mido.Message("note_on", note=pitch, time=0))
        melody.append(mido.Message("note_off", note=pitch, time=960))
    kit = mido.MidiTrack([mido.MetaMessage("track_name", name="Kit")])
    for eighth in range(16):
        keys = [42, *([36] if eighth % 4 == 0 else []), *([38] if eighth % 4 == 2 else [])]
        for key in keys:
            kit.append(mido.Message("note_on", channel=9, note=key, velocity=90, time=0))
        for place, key in enumerate(keys):
            kit.append(mido.Message("note_off", channel=9, note=key, time=0 if place else 240))
    data = io.BytesIO()
    mido.MidiFile(ticks_per_beat=480, tracks=[melody, kit]).save(file=data)
    return data.getvalue()


def test_a_drummer_leads_with_the_left_hand_and_does_so_after_a_restart(tmp_path: Path) -> None:
    """Chosen with the upload, changed by PUT and PATCH, kept; frames are those of the mirrored kit."""
    drummer = {"part": 1, "instrument": "drums", "player": "soloist", "handedness": "left"}
    castings: list[dict[str, Any]] = [{"part": 0}, drummer]

    def hands(client: httpx.Client, path: str) -> set[tuple[str, str]]:
        notes = client.get(f"{path}/score").raise_for_status().json()["notes"]
        struck = [note["fingering"] for note in notes if note["player"] == 1]
        return {(one["piece"], one["hand"] or one["foot"]) for one in struck}

    def kit(client: httpx.Client, path: str) -> str:
        skeletons = client.get(f"{path}/manifest").raise_for_status().json()["skeletons"]
        return next(one["rig"] for one in skeletons if one["name"] == "players/2/drums")

    left = {("hi_hat", "left"), ("snare", "right"), ("kick", "left")}
    right = {("hi_hat", "right"), ("snare", "left"), ("kick", "right")}
    with serve(tmp_path) as server, httpx.Client(base_url=server.address, timeout=30.0) as client:
        listed = client.get("/api/v1/instruments").json()["instruments"]
        assert {one["name"]: one["handedness"] for one in listed}["drums"] == ["right", "left"]
        files: dict[str, Any] = {"song": ("s.wav", song(8.0))}
        made = upload(client, trumpet_and_drums(), **files, cast=json.dumps({"castings": castings}))
        told = client.get(f"{made.path}/cast").json()["castings"]
        assert [one["handedness"] for one in told] == ["right", "left"]
        assert (hands(client, made.path), kit(client, made.path)) == (left, "drumkit_left_handed")
        reasons = {
            note["reason"] for note in client.get(f"{made.path}/score").json()["notes"] if note["player"]
        }
        assert "left leads on the hi-hat" in reasons
        assert "left foot on the bass drum" in reasons
        frames = take(client, made.id, 0.0, 2.0)

        castings[1]["handedness"] = "right"
        made.change("PUT", "/cast", json={"castings": castings}).raise_for_status()
        assert (hands(client, made.path), kit(client, made.path)) == (right, "drumkit")
        others = take(client, made.id, 0.0, 2.0)
        assert not np.array_equal(frames.local["players/2/player"], others.local["players/2/player"])
        np.testing.assert_array_equal(frames.local["player"], others.local["player"])

        castings[0]["handedness"], castings[1]["handedness"] = "left", "left"
        refused = made.change("PUT", "/cast", json={"castings": castings})
        assert refused.status_code == 422
        assert "castings/0/handedness: the B♭ trumpet is played right-handed, not left" in refused.text
        castings[0]["handedness"] = "right"
        made.change("PUT", "/cast", json={"castings": castings}).raise_for_status()
    with serve(tmp_path) as server, httpx.Client(base_url=server.address, timeout=30.0) as client:
        assert (hands(client, made.path), kit(client, made.path)) == (left, "drumkit_left_handed")
        alone = {"castings": [castings[1]]}
        client.put(f"{made.path}/cast", json=alone, headers=made.headers).raise_for_status()
        answer = client.patch(made.path, json={"handedness": "right"}, headers=made.headers)
        assert answer.raise_for_status().json()["handedness"] == "right"
        assert client.get(f"{made.path}/manifest").json()["skeletons"][1]["rig"] == "drumkit"
        client.patch(made.path, json={"handedness": "left"}, headers=made.headers).raise_for_status()
        assert client.get(f"{made.path}/manifest").json()["skeletons"][1]["rig"] == "drumkit_left_handed"
