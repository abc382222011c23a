"""A recording is put in time with its score by the server, and by hand, over HTTP and on the stream."""

from __future__ import annotations

import io
import json
import time
from typing import TYPE_CHECKING, Any

import mido
import numpy as np
import pytest
import soundfile
from tests.integration.scores import scale, song
from tests.integration.server import Owned, serve, upload
from tests.unit.sound.alignment.renditions import RATE, SCORES, Rendition, example, record
from tests.unit.sound.recording.coded import as_coded
from websockets.sync.client import connect
from websockets.typing import Subprotocol

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    import httpx

NAME = "prince-of-denmarks-march"
LEAD_IN_S, SLOWER = 3.0, 1.15
PATIENCE_S = 60.0


def state(session: Owned) -> dict[str, Any]:
    """What the server says once it has looked for the score."""
    until = time.monotonic() + PATIENCE_S
    while True:
        told = session.client.get(f"{session.path}/alignment").raise_for_status().json()
        if told["status"] != "searching":
            return told
        assert time.monotonic() < until, told
        time.sleep(0.1)


def recording() -> bytes:
    """The march, slower, after three seconds of silence, as FLAC."""
    made = record(Rendition(NAME, tempo=(SLOWER, 0.0), lead_in_s=LEAD_IN_S))
    file = io.BytesIO()
    with soundfile.SoundFile(file, "w", samplerate=RATE, channels=1, format="FLAC", subtype="PCM_16") as flac:
        flac.write(made.samples[:, None])
    return file.getvalue()


@pytest.fixture(scope="module")
def aligned(client: httpx.Client) -> Iterator[Owned]:
    """A session of the march with a recording that is slower and begins later."""
    score = next(SCORES.glob(f"{NAME}.*")).read_bytes()
    session = upload(client, score, song=("march.flac", recording()))
    assert state(session)["status"] == "found"
    yield session
    session.change("DELETE")


def notes(session: Owned) -> list[dict[str, Any]]:
    return session.client.get(f"{session.path}/score").raise_for_status().json()["notes"]


def test_notes_bars_and_frames_are_where_they_are_heard(aligned: Owned) -> None:
    told = state(aligned)
    assert told["confidence"] > 0.7
    assert told["alignment"]["is_same_music"] is True
    score = example(NAME)
    wanted = LEAD_IN_S + SLOWER * score.notes.onset_s
    heard = np.array([note["onset_s"] for note in notes(aligned)])
    assert len(heard) == len(wanted)
    errors = np.abs(np.sort(heard) - np.sort(wanted))
    assert np.median(errors) < 0.010
    assert np.quantile(errors, 0.95) < 0.040

    answer = aligned.client.get(f"{aligned.path}/score").json()
    assert answer["bar_lines_s"][0] == pytest.approx(LEAD_IN_S, abs=0.05)
    assert answer["tempi"][0]["onset_s"] == pytest.approx(LEAD_IN_S, abs=0.05)
    session = aligned.client.get(aligned.path).json()
    assert session["alignment"]["status"] == "found"

    assert told["is_searchable"] is True
    bars = told["bars"]
    assert [bar["number"] for bar in bars] == list(range(1, len(bars) + 1))
    assert all(bar["is_heard"] and bar["confidence"] > 0.4 and len(bar["beats"]) == 4 for bar in bars[:-1])
    lines = score.tempo_map.seconds(score.metre_map.bar_lines(score.duration_beats))
    assert [bar["beats"][0]["score_s"] for bar in bars[: len(lines)]] == pytest.approx(lines, abs=1e-3)
    assert [bar["beats"][0]["song_s"] for bar in bars[: len(lines)]] == pytest.approx(
        answer["bar_lines_s"][: len(lines)], abs=1e-3
    )
    assert session["duration_s"] >= LEAD_IN_S + SLOWER * score.duration_s - 0.1


def test_the_score_in_time_with_the_recording_is_taken_away_as_midi(aligned: Owned) -> None:
    data = aligned.client.get(f"{aligned.path}/export.mid").raise_for_status().content
    file = mido.MidiFile(file=io.BytesIO(data))
    at_s = 0.0
    begins: list[float] = []
    for message in file:
        at_s += message.time
        if isinstance(message, mido.Message) and message.type == "note_on" and message.velocity > 0:
            begins.append(at_s)
    wanted = sorted(note["onset_s"] for note in notes(aligned))
    # A player's notes may be fewer: what nobody can play is gone.
    assert begins[0] == pytest.approx(wanted[0], abs=0.003)
    assert begins[-1] == pytest.approx(wanted[-1], abs=0.003)


def test_offset_and_anchors_are_put_seen_and_taken_back(aligned: Owned) -> None:
    before = [note["onset_s"] for note in notes(aligned)]
    moved = aligned.change("PUT", "/alignment", json={"offset_s": 0.25})
    assert moved.status_code == 200
    assert moved.json()["alignment"]["offset_s"] == 0.25
    assert [note["onset_s"] for note in notes(aligned)] == pytest.approx(
        [at + 0.25 for at in before], abs=1e-6
    )

    first_s = example(NAME).notes.onset_s[0]
    put = aligned.change("PUT", "/alignment", json={"anchors": [{"score_s": first_s, "song_s": 5.0}]})
    assert put.status_code == 200
    assert notes(aligned)[0]["onset_s"] == pytest.approx(5.0)
    kept = put.json()["alignment"]

    assert aligned.change("PUT", "/alignment", json={}).status_code == 200
    assert [note["onset_s"] for note in notes(aligned)] == pytest.approx(before, abs=1e-6)

    again = aligned.change("PUT", "/alignment", json=kept)
    assert again.status_code == 200
    assert notes(aligned)[0]["onset_s"] == pytest.approx(5.0)
    assert aligned.change("PUT", "/alignment", json={}).status_code == 200


@pytest.mark.parametrize(
    ("fields", "place", "said"),
    [
        (
            {"anchors": [{"score_s": 2.0, "song_s": 8.0}, {"score_s": 4.0, "song_s": 7.0}]},
            "anchors/1/song_s",
            "backwards",
        ),
        ({"anchors": [{"score_s": 2.0, "song_s": 1e5}]}, "anchors/0/song_s", "not within the song"),
        ({"offset_s": 1e5}, "offset_s", "out of the song"),
        ({"offset": 1}, "offset", "Extra inputs"),
        ({"points": [], "score_duration_s": 9.0, "song_duration_s": 9.0}, "points", "two points"),
    ],
)
def test_what_cannot_be_is_refused_with_its_place(
    aligned: Owned, fields: dict[str, Any], place: str, said: str
) -> None:
    before = aligned.client.get(f"{aligned.path}/alignment").json()
    refused = aligned.change("PUT", "/alignment", json=fields)
    assert refused.status_code == 422
    assert place in refused.text
    assert said in refused.text
    assert aligned.client.get(f"{aligned.path}/alignment").json() == before


def test_a_map_of_every_beat_of_a_long_piece_and_every_tap_on_it_can_be_put(client: httpx.Client) -> None:
    made = upload(client, scale(16), song=("s.wav", song(6.0)))
    state(made)
    beats = 10_000
    points = [
        {"score_s": round(n * 4 / beats, 4), "song_s": round(n * 5 / beats, 4), "confidence": 0.123456789}
        for n in range(beats)
    ]
    long = {"points": points, "score_duration_s": 4.0, "song_duration_s": 6.0}
    put = made.change("PUT", "/alignment", json=long)
    assert put.status_code == 200, put.text[:300]
    kept = put.json()["alignment"]
    assert len(kept["points"]) == beats
    taps = [{"score_s": n / 500, "song_s": n / 400} for n in range(2000)]
    tapped = made.change("PUT", "/alignment", json={"anchors": taps})
    assert tapped.status_code == 200, tapped.text[:300]
    again = made.change("PUT", "/alignment", json=kept)
    assert again.json()["alignment"] == kept, "what the server gave can be put back"
    made.change("DELETE")


def test_a_long_alignment_of_very_many_faults_tells_the_first(aligned: Owned) -> None:
    nothing: dict[str, int] = {}
    bodies: list[dict[str, Any]] = [
        {"points": [nothing] * 100_000, "score_duration_s": 4.0, "song_duration_s": 6.0},
        {"anchors": [nothing] * 9000},
        {"anchors": [{f"x{n}": 1 for n in range(20_000)}]},
    ]
    for body in bodies:
        refused = aligned.change("PUT", "/alignment", json=body)
        assert refused.status_code == 422
        assert len(refused.content) < 2000
        assert len(refused.json()["errors"]) <= 2


def test_other_music_stays_at_zero_and_may_be_moved_by_hand(client: httpx.Client) -> None:
    made = upload(client, scale(16), song=("s.wav", song(6.0)))
    told = state(made)
    assert told["status"] == "unlike"
    before = [note["onset_s"] for note in notes(made)]
    assert before == pytest.approx([0.25 * number for number in range(16)])
    assert made.change("PUT", "/alignment", json={"offset_s": 1.0}).status_code == 200
    assert notes(made)[0]["onset_s"] == pytest.approx(1.0)
    away = made.change("PUT", "/alignment", json={"offset_s": -5.9})
    assert away.status_code == 422
    assert "no note of the score would be heard" in away.json()["detail"]
    assert notes(made)[0]["onset_s"] == pytest.approx(1.0), "what stood stays"
    assert made.change("POST", "/alignment/search").status_code == 202
    assert state(made)["alignment"]["offset_s"] == 1.0, "what was put right stays"
    assert made.change("PUT", "/alignment", json={}).status_code == 200
    assert [note["onset_s"] for note in notes(made)] == before
    made.change("DELETE")


def test_a_rendered_song_is_in_time_already(client: httpx.Client) -> None:
    made = upload(client, scale(4))
    assert client.get(f"{made.path}/alignment").json() == {
        "status": "none",
        "progress": 0.0,
        "confidence": None,
        "detail": None,
        "is_searchable": False,
        "song_duration_s": None,
        "bars": [],
        "alignment": None,
    }
    for refused in (
        made.change("PUT", "/alignment", json={"offset_s": 1.0}),
        made.change("POST", "/alignment/search"),
    ):
        assert refused.status_code == 409
        assert "rendered from the score" in refused.json()["detail"]
    made.change("DELETE")


def test_it_is_kept_when_the_server_is_started_again(tmp_path: Path) -> None:
    import httpx

    with serve(tmp_path) as running, httpx.Client(base_url=running.address, timeout=30.0) as client:
        made = upload(client, scale(16), song=("s.wav", song(6.0)))
        state(made)
        made.change("PUT", "/alignment", json={"offset_s": 0.5}).raise_for_status()
        token, path = made.body["control_token"], made.path
    with serve(tmp_path) as running, httpx.Client(base_url=running.address, timeout=30.0) as client:
        again = client.get(f"{path}/alignment").json()
        assert (again["status"], again["alignment"]["offset_s"]) == ("unlike", 0.5)
        assert client.get(f"{path}/score").json()["notes"][0]["onset_s"] == pytest.approx(0.5)
        headers = {"Authorization": f"Bearer {token}"}
        assert client.delete(path, headers=headers).status_code == 204


def test_viewers_hear_of_it(client: httpx.Client, server: Any) -> None:
    made = upload(client, scale(16), song=("s.wav", song(6.0)))
    state(made)
    with connect(server.stream(made.body["id"]), subprotocols=[Subprotocol("reina.v1")]) as viewer:
        hello = json.loads(viewer.recv())
        assert hello["alignment"]["status"] == "unlike"
        made.change("PUT", "/alignment", json={"offset_s": 1.0}).raise_for_status()
        heard: list[str] = []
        while "alignment_changed" not in heard:
            message = viewer.recv(timeout=20)
            if isinstance(message, str):
                heard.append(json.loads(message)["type"])
        assert "score_changed" in heard
    made.change("DELETE")


def as_wav(samples: Any, rate: int = RATE) -> bytes:
    file = io.BytesIO()
    soundfile.write(file, samples, rate, format="WAV", subtype="PCM_16")
    return file.getvalue()


@pytest.mark.parametrize(("container", "name"), [("webm", "taps.webm"), ("mp4", "taps.m4a")])
def test_what_a_page_decodes_is_listened_to(client: httpx.Client, container: str, name: str) -> None:
    samples = record(Rendition("taps", tempo=(SLOWER, 0.0), lead_in_s=LEAD_IN_S)).samples
    song = as_coded(samples, RATE, container)
    made = upload(client, next(SCORES.glob("taps.*")).read_bytes(), song=(name, song))
    told = state(made)
    assert (told["status"], told["is_searchable"]) == ("none", False)
    refused = made.change("POST", "/alignment/search")
    assert refused.status_code == 409
    assert "song/analysis" in refused.json()["detail"]
    assert client.get(f"{made.path}/song/peaks").status_code == 204

    assert client.put(f"{made.path}/song/analysis", content=as_wav(samples)).status_code == 401
    for body, said in (
        (b"no sound", "no audio file"),
        (b"", "empty"),
        (song, "not decoded here either"),
        (as_wav(samples[: 5 * RATE]), "it is not this song"),
        (as_wav(samples[::10], RATE // 10), "22,050 are enough"),
    ):
        answer = made.change("PUT", "/song/analysis", content=body)
        assert (answer.status_code, said in answer.json()["detail"]) == (422, True), answer.text
    assert state(made)["status"] == "none"

    taken = made.change("PUT", "/song/analysis", content=as_wav(samples))
    assert (taken.status_code, taken.json()["status"]) == (202, "searching")
    told = state(made)
    assert (told["status"], told["is_searchable"]) == ("found", True)
    assert told["song_duration_s"] == pytest.approx(len(samples) / RATE, abs=1e-3)
    assert notes(made)[0]["onset_s"] == pytest.approx(LEAD_IN_S, abs=0.05)
    assert client.get(f"{made.path}/song/peaks").json()["duration_s"] == pytest.approx(len(samples) / RATE)
    served = client.get(f"{made.path}/song")
    assert (served.headers["content-type"], served.content) == (f"audio/{container}", song)
    assert made.change("POST", "/alignment/search").status_code == 202
    made.change("DELETE")


def test_only_what_the_server_does_not_decode_is_sent_to_it_decoded(client: httpx.Client) -> None:
    made = upload(client, scale(4), song=("s.wav", song(6.0)))
    state(made)
    refused = made.change("PUT", "/song/analysis", content=song(6.0))
    assert refused.status_code == 409
    assert "decodes this song itself" in refused.json()["title"]
    made.change("DELETE")
    rendered = upload(client, scale(4))
    assert rendered.change("PUT", "/song/analysis", content=song(6.0)).status_code == 409
    rendered.change("DELETE")


def test_players_follow_the_recording_s_key_where_that_is_chosen(client: httpx.Client) -> None:
    sound = as_wav(record(Rendition("ode-to-joy", transposition=-3)).samples)
    made = upload(client, next(SCORES.glob("ode-to-joy.*")).read_bytes(), "ode.json", song=("o.wav", sound))
    told = state(made)
    assert told["alignment"]["transposition"] == -3

    def pitches() -> list[tuple[int, int]]:
        return [(note["part"], note["sounding_pitch"]) for note in notes(made)]

    def fifths() -> int:
        return client.get(f"{made.path}/part").raise_for_status().json()["keys"][0]["fifths"]

    before, cast, key = pitches(), client.get(f"{made.path}/cast").json(), fifths()
    with_key = made.change("PUT", "/alignment", json={"follows_key": True, "offset_s": 0.1})
    assert with_key.status_code == 200
    assert with_key.json()["alignment"]["follows_key"] is True
    assert pitches() == [(part, pitch - 3) for part, pitch in before]
    assert (fifths() - key - 3) % 12 == 0
    assert client.get(f"{made.path}/cast").json()["castings"][0]["transposition"] == 0
    assert made.change("PATCH", json={"transposition": 12}).status_code == 200
    assert notes(made)[0]["sounding_pitch"] in (before[0][1] - 3, before[0][1] + 9)
    assert made.change("PATCH", json={"transposition": 0}).status_code == 200
    assert made.change("POST", "/alignment/search").status_code == 202
    assert state(made)["alignment"]["follows_key"] is True, "what was chosen stays"
    assert made.change("PUT", "/alignment", json={}).status_code == 200
    assert pitches() == before
    after = client.get(f"{made.path}/cast").json()
    assert after["castings"] == cast["castings"]
    made.change("DELETE")
