"""What a timeline editor reads: curves, the music's time, the shape of the sound."""

from __future__ import annotations

import struct
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.integration.scores import scale, song
from tests.integration.server import upload

if TYPE_CHECKING:
    import httpx
    from tests.integration.server import Owned

ROOT = Path(__file__).parents[2]
LIGHT, COLOR, RIM = "lights/key/intensity", "blocks/color", "lights/rim/intensity"
SHOW: dict[str, Any] = {
    "version": 1,
    "time": "beats",
    "tracks": [
        {
            "parameter": LIGHT,
            "keyframes": [
                {"key": "k1", "time": 0, "value": 1.0},
                {"key": "k2", "time": 2, "value": 3.0},
                {"key": "k3", "time": 3, "value": 2.0, "interpolation": "step"},
            ],
        },
        {
            "parameter": COLOR,
            "muted": True,
            "keyframes": [{"time": 0, "value": "#000000"}, {"time": 4, "value": "#FF0000"}],
        },
        {
            "parameter": RIM,
            "keyframes": [{"time": 0, "value": 1.0}],
            "events": {"on": "bars", "amount": 2.0, "blend": "add", "decay": 2},
        },
    ],
}


@pytest.fixture
def shown(owned: Owned) -> Owned:
    owned.change("PUT", "/show", json=SHOW).raise_for_status()
    return owned


def curves(owned: Owned, *parameters: str, **query: float) -> httpx.Response:
    asked = {"start_s": 0.0, "end_s": 2.0, "points": 9, "parameter": list(parameters)} | query
    return owned.client.get(f"{owned.path}/show/curves", params=asked)


def line(answer: httpx.Response, number: int = 0) -> dict[str, Any]:
    return answer.raise_for_status().json()["curves"][number]


def test_a_curve_is_the_track_at_even_times_with_its_jumps(shown: Owned) -> None:
    answer = curves(shown, LIGHT)
    assert answer.json()["times_s"] == [0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2]
    curve = line(answer)
    assert curve["keys"] == {"values": [[1, 1.5, 2, 2.5, 3, 3, 2, 2, 2]], "jumps": [6]}
    assert curve["keys_s"] == [0, 1, 1.5]
    assert curve["with_events"] is None
    assert curve["etag"] == shown.client.get(f"{shown.path}/show/tracks/{LIGHT}").headers["etag"]


def test_a_curve_is_what_the_frames_carry(shown: Owned) -> None:
    manifest = shown.client.get(f"{shown.path}/manifest").json()
    data = shown.client.get(f"{shown.path}/frames", params={"start_s": 0, "end_s": 2}).content
    answer = curves(shown, LIGHT, RIM, end_s=119 / 60, points=120)
    for number, path in enumerate((LIGHT, RIM)):
        parameter = next(entry for entry in manifest["parameters"] if entry["path"] == path)
        offsets = range(parameter["offset"], len(data), manifest["frame_size"])
        framed = [struct.unpack_from("<f", data, offset)[0] for offset in offsets]
        curve = line(answer, number)
        told = (curve["with_events"] or curve["keys"])["values"][0]
        assert told == pytest.approx(framed, abs=2e-6)


def test_a_muted_track_shows_what_it_would_do_and_events_stand_beside_the_keys(shown: Owned) -> None:
    answer = curves(shown, COLOR, RIM, LIGHT)
    muted = line(answer)["keys"]["values"]
    assert [component[0] for component in muted] == [0, 0, 0]
    assert muted[0][-1] == pytest.approx(1.0)
    rim = line(answer, 1)
    assert rim["keys"]["values"] == [[1.0] * 9]
    assert rim["with_events"]["values"][0][:5] == pytest.approx([3, 2.125, 1.5, 1.125, 1])


def test_a_parameter_without_a_track_rests_at_its_default(shown: Owned) -> None:
    default = next(
        entry
        for entry in shown.client.get("/api/v1/parameters").json()["parameters"]
        if entry["path"] == "camera/fov"
    )["default"]
    curve = line(curves(shown, "camera/fov", points=2))
    assert curve["keys"]["values"] == [pytest.approx([default, default], abs=1e-6)]
    assert curve["keys_s"] == []
    assert curve["etag"] == '"none"'


def test_curves_are_sent_again_only_when_their_own_tracks_change(shown: Owned) -> None:
    known = curves(shown, LIGHT).headers["etag"]
    again = {"If-None-Match": known}
    url = curves(shown, LIGHT).url
    shown.change("DELETE", f"/show/tracks/{RIM}").raise_for_status()
    assert shown.client.get(url, headers=again).status_code == 304
    assert curves(shown, LIGHT, end_s=3).headers["etag"] != known
    shown.change("PATCH", f"/show/tracks/{LIGHT}/keyframes/k1", json={"value": 0}).raise_for_status()
    changed = shown.client.get(url, headers=again)
    assert changed.status_code == 200
    assert line(changed)["keys"]["values"][0][0] == 0


def test_a_track_that_is_not_kept_has_a_curve(shown: Owned) -> None:
    before = shown.client.get(f"{shown.path}/show").text
    track = {"parameter": LIGHT, "keyframes": [{"time": 0, "value": 0}, {"time": 4, "value": 4}]}
    answer = shown.change(
        "POST", "/show/curves", json={"track": track}, params={"start_s": 0, "end_s": 2, "points": 3}
    )
    assert line(answer)["keys"]["values"] == [[0, 2, 4]], "in the show's beats"
    assert shown.client.get(f"{shown.path}/show").text == before
    refusals: list[tuple[dict[str, Any], int]] = [
        ({**track, "parameter": "lights/none"}, 404),
        ({"keyframes": []}, 422),
        ({**track, "keyframes": [{"time": 0, "value": "bright"}]}, 422),
    ]
    for wrong, status in refusals:
        refused = shown.change(
            "POST", "/show/curves", json={"track": wrong}, params={"start_s": 0, "end_s": 2}
        )
        assert refused.status_code == status, refused.text
        assert refused.headers["content-type"] == "application/problem+json"


def test_what_cannot_be_sampled_is_refused(shown: Owned) -> None:
    assert curves(shown, "lights/none").status_code == 404
    assert curves(shown).status_code == 422
    assert curves(shown, LIGHT, points=2001).status_code == 422
    assert curves(shown, LIGHT, start_s=3).status_code == 422
    assert curves(shown, *[LIGHT] * 65).status_code == 422
    too_many = curves(shown, *[LIGHT] * 30, points=2000)
    assert too_many.status_code == 422
    assert "40000 samples" in too_many.json()["detail"]
    for points in (1, 3):
        moment = line(curves(shown, LIGHT, start_s=1, end_s=1, points=points))["keys"]
        assert len(moment["values"][0]) == points
        assert moment["jumps"] == []


def test_the_musics_time_turns_units_into_one_another(owned: Owned) -> None:
    music = owned.client.get(f"{owned.path}/time").raise_for_status().json()
    assert music["beats_s"] == [0.5 * beat for beat in range(8)]
    assert music["bars_s"][:2] == [0, 2]
    assert music["onsets_s"] == [0.25 * note for note in range(16)]
    knots = music["knots"]
    assert all(len(knots[unit]) == len(knots["beats"]) for unit in ("seconds", "bars"))
    assert [4 * bar for bar in knots["bars"]] == pytest.approx(knots["beats"])
    assert [beat / 2 for beat in knots["beats"]] == pytest.approx(knots["seconds"])


def test_the_musics_time_follows_pickup_and_tempo(client: httpx.Client) -> None:
    """The carnival has a pickup of an eighth, bars of 6/8, and another tempo from beat 24 on."""
    score = (ROOT / "examples/scores/carnival-of-venice.mid").read_bytes()
    session = upload(client, score, song=("song.wav", song()))
    try:
        music = client.get(f"{session.path}/time").raise_for_status().json()
        drawn = client.get(f"{session.path}/score").raise_for_status().json()
        knots = {unit: np.array(at, dtype=np.float64) for unit, at in music["knots"].items()}
        assert music["bars_s"] == drawn["bar_lines_s"]
        for bar, second in enumerate(music["bars_s"]):
            assert np.interp(bar, knots["bars"], knots["seconds"]) == pytest.approx(second)
        for beat, second in enumerate(music["beats_s"]):
            assert np.interp(beat, knots["beats"], knots["seconds"]) == pytest.approx(second)
        played = [note for note in drawn["notes"] if note["part"] == drawn["part"]]
        onsets_s = np.array([note["onset_s"] for note in played], dtype=np.float64)
        onsets_beats = np.interp(onsets_s, knots["seconds"], knots["beats"])
        np.testing.assert_allclose(onsets_beats, [note["onset_beats"] for note in played], atol=1e-6)
        assert music["onsets_s"] == sorted({note["onset_s"] for note in played})
        assert len(drawn["tempi"]) == 2
        # A curve in bars is that curve: half of bar 10 is over a quarter of the way from 9 to 11.
        track = {
            "parameter": LIGHT,
            "time": "bars",
            "keyframes": [{"time": 9, "value": 0}, {"time": 11, "value": 4}],
        }
        moment = float(np.interp(9.5, knots["bars"], knots["seconds"]))
        answer = session.change(
            "POST",
            "/show/curves",
            json={"track": track},
            params={"start_s": moment, "end_s": moment, "points": 1},
        )
        assert line(answer)["keys"]["values"] == [[pytest.approx(1.0, abs=1e-6)]]
    finally:
        session.change("DELETE")


def test_peaks_fill_the_song(owned: Owned) -> None:
    answer = owned.client.get(f"{owned.path}/song/peaks", params={"points": 10}).raise_for_status()
    peaks = answer.json()
    assert peaks["duration_s"] == pytest.approx(1.0)
    loud = 8000 / 32768
    assert peaks["highest"] == pytest.approx([loud] * 10, abs=1e-3)
    assert peaks["lowest"] == pytest.approx([-loud] * 10, abs=1e-3)
    assert owned.client.get(f"{owned.path}/song/peaks", params={"points": 0}).status_code == 422


def test_peaks_grow_while_the_song_is_made(client: httpx.Client) -> None:
    session = upload(client, scale(4, bpm=123.0))
    try:
        path = f"{session.path}/song/peaks"
        until = time.monotonic() + 60
        first = answer = client.get(path)
        while (answer.status_code == 202 or not answer.json()["complete"]) and time.monotonic() < until:
            time.sleep(0.2)
            answer = client.get(path)
        assert answer.status_code == 200, answer.text
        assert answer.json()["complete"]
        assert max(answer.json()["highest"]) > 0.05, "it sounds"
        if first.status_code == 202:
            assert first.json()["status"] == "rendering"
            assert first.headers["retry-after"] == "1"
    finally:
        session.change("DELETE")
