"""From files to a session."""

from __future__ import annotations

import gzip
import io
import json
import time
import zipfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING

import pytest
from tests.integration.scores import duet, scale, show, song, sung
from tests.integration.server import rendered, upload
from tests.unit.music.musicxml.musicxml_text import (
    B_FLAT,
    attributes,
    compressed,
    direction,
    document,
    measures,
    note,
    words,
)

from reina.cli import main

if TYPE_CHECKING:
    import httpx
    from tests.integration.server import Owned

EXAMPLES = Path(__file__).parents[2] / "examples"
CASES = Path(__file__).parents[1] / "cases"


def test_a_score_becomes_a_session(client: httpx.Client) -> None:
    session = upload(client, scale(16), "Scale in B flat.mid")
    body = session.body
    assert body["title"] == "Scale in B flat"
    assert body["notes"] == 16
    assert body["parts"] == [{"index": 0, "name": "Trumpet", "program": 56, "is_drums": False, "notes": 16}]
    assert body["links"]["page"] == f"/s/{session.id}"
    assert len(body["control_token"]) >= 43
    again = client.get(session.path).json()
    assert again.keys() == body.keys() - {"control_token"}
    assert all(again[field] == body[field] for field in again.keys() - {"song"})
    session.change("DELETE").raise_for_status()


def test_the_api_and_inspect_tell_a_musician_the_same(
    client: httpx.Client, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    session = upload(client, sung(), "sung.mid")
    findings = session.body["findings"]
    assert [one["text"] for one in findings] == [
        "No trumpet in this file: the player plays Vocals",
        "2 of 11 notes lie outside the trumpet's range; an octave up, none would",
        "Plays the top note of 3 chords",
        "Leaves out 2 notes below the trumpet's range",
    ]
    details = [detail for one in findings if one["about"] != "choice" for detail in one["details"]]
    assert sorted(details, key=str) == sorted(session.body["warnings"], key=str), "none is lost"
    file = tmp_path / "sung.mid"
    file.write_bytes(sung())
    assert main(["inspect", "--json", str(file)]) == 0
    assert json.loads(capsys.readouterr().out)["findings"] == findings
    assert main(["inspect", str(file)]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert all(f"  {one['text']}" in printed for one in findings)
    moved = session.change("PATCH", json={"octave_fit": True}).json()["findings"]
    assert "Moved an octave up, into the trumpet's range" in [one["text"] for one in moved]
    session.change("DELETE").raise_for_status()


@pytest.mark.parametrize("case", ["json-cc", "json-null"])
def test_a_json_score_with_strange_fields_is_played(client: httpx.Client, case: str) -> None:
    right = json.loads((CASES / f"{case}.json").read_text())["right"]
    session = upload(
        client, (CASES / f"{case}-score.json").read_bytes(), "score.json", song=("s.wav", song())
    )
    assert len(client.get(f"{session.path}/score").json()["notes"]) == right["notes"]
    assert all(warning["place"].startswith("tracks/0/") for warning in session.body["warnings"])
    assert session.body["warnings"]
    session.change("DELETE").raise_for_status()


def test_compressed_scores_are_opened(client: httpx.Client) -> None:
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("Band/Scale in B flat.mid", scale(16))
        file.writestr("Band/cover.png", b"\x89PNG")
    for data, name in (
        (gzip.compress(scale(16)), "Scale in B flat.mid.gz"),
        (archive.getvalue(), "download.zip"),
    ):
        session = upload(client, data, name, song=("s.wav", song()))
        assert (session.body["title"], session.body["notes"]) == ("Scale in B flat", 16)
        assert [warning["kind"] for warning in session.body["warnings"]] == ["unpacked"]
        assert len(client.get(f"{session.path}/score").json()["notes"]) == 16
        session.change("DELETE").raise_for_status()


def test_musicxml_becomes_a_session_with_its_words(client: httpx.Client) -> None:
    sung = '<lyric number="1"><syllabic>{}</syllabic><text>{}</text></lyric>'
    mark = direction("<rehearsal>A</rehearsal>")
    score = document(
        measures(
            attributes(extra=B_FLAT) + words("Allegro") + note("C5", 2, inner=sung.format("begin", "Hal")),
            mark + note("D5", 4, inner=sung.format("end", "lo")),
        )
    )
    body = upload(client, compressed(score), "Hallo.mxl").body
    assert (body["title"], body["notes"]) == ("Hallo", 2)
    told = client.get(f"/api/v1/sessions/{body['id']}/score").json()
    assert [one["sounding_pitch"] for one in told["notes"]] == [70, 72]
    assert [one["written_pitch"] for one in told["notes"]] == [72, 74]
    assert told["lyrics"] == [
        {
            "start_s": 0.0,
            "end_s": 5.0,
            "syllables": [{"onset_s": 0.0, "text": "Hal"}, {"onset_s": 1.0, "text": "lo"}],
        }
    ]
    assert told["markers"] == [{"onset_s": 1.0, "onset_beats": 2.0, "text": "A"}]
    assert told["texts"] == [{"onset_s": 0.0, "onset_beats": 0.0, "text": "Allegro"}]


def test_the_notes_come_with_their_fingering(client: httpx.Client) -> None:
    session = upload(client, scale(3), song=("s.wav", song()))
    score = client.get(f"{session.path}/score").json()
    assert [note["sounding_pitch"] for note in score["notes"]] == [58, 59, 60]
    assert [note["written_pitch"] for note in score["notes"]] == [60, 61, 62]
    # C4, C♯4 and D4 on paper: open, all three, first and third.
    assert [note["valves"] for note in score["notes"]] == [[], [1, 2, 3], [1, 3]]
    assert [note["onset_s"] for note in score["notes"]] == pytest.approx([0.0, 0.25, 0.5])
    assert score["tempi"] == [{"onset_beats": 0.0, "onset_s": 0.0, "bpm": 120.0}]
    assert score["metres"][0]["numerator"] == 4
    assert score["bar_lines_s"][0] == 0.0
    session.change("DELETE").raise_for_status()


def test_another_part_can_be_chosen(client: httpx.Client) -> None:
    session = upload(client, duet(), song=("s.wav", song()))
    assert session.body["part"] == 1
    assert [choice["part"] for choice in session.body["choices"]] == [1, 0]
    notes = client.get(f"{session.path}/score").json()["notes"]
    assert {note["part"] for note in notes if note["valves"] is not None} == {1}
    changed = session.change("PATCH", json={"part": 0, "transposition": -12, "title": "Flute, for trumpet"})
    assert changed.json()["part"] == 0
    assert changed.json()["title"] == "Flute, for trumpet"
    score = client.get(f"{session.path}/score", params={"part": 0}).json()
    assert {note["part"] for note in score["notes"]} == {0}
    assert score["notes"][0]["sounding_pitch"] == 72
    assert all(note["valves"] is not None for note in score["notes"])
    session.change("DELETE").raise_for_status()


def test_part_and_transposition_can_come_with_the_upload(client: httpx.Client) -> None:
    session = upload(client, duet(), song=("s.wav", song()), part="0", transposition="-12", title="Mine")
    assert (session.body["part"], session.body["transposition"], session.body["title"]) == (0, -12, "Mine")
    session.change("DELETE").raise_for_status()


def test_an_uploaded_song_is_served_with_ranges(client: httpx.Client) -> None:
    sound = song(2.0)
    session = upload(client, scale(2), song=("take one.wav", sound), show=("show.json", show()))
    assert session.body["song"]["status"] == "ready"
    assert session.body["song"]["source"] == "uploaded"
    whole = client.get(f"{session.path}/song")
    assert whole.content == sound
    assert whole.headers["content-type"] == "audio/wav"
    assert whole.headers["accept-ranges"] == "bytes"
    part = client.get(f"{session.path}/song", headers={"Range": "bytes=100-199"})
    assert part.status_code == 206
    assert part.content == sound[100:200]
    assert part.headers["content-range"] == f"bytes 100-199/{len(sound)}"
    assert client.get(f"{session.path}/show").json()["title"] == "One light"
    session.change("DELETE").raise_for_status()


def test_music_lasts_as_long_as_the_longer_of_score_and_song(client: httpx.Client) -> None:
    longer = upload(client, scale(2), song=("s.wav", song(30.0, rate=1000)))
    assert longer.body["duration_s"] == pytest.approx(30.0)
    shorter = upload(client, scale(2), song=("s.wav", song(0.1)))
    assert 0.5 <= shorter.body["duration_s"] <= 5.0
    for session in (longer, shorter):
        session.change("DELETE").raise_for_status()


def test_a_score_without_a_song_is_rendered_as_it_is_played(client: httpx.Client) -> None:
    session = upload(client, scale(4))
    assert session.body["song"]["source"] == "rendered"
    href = session.body["song"]["href"]
    answer = rendered(client, href)
    assert answer.status_code == 200
    assert answer.headers["content-type"] == "audio/flac"
    assert answer.content[:4] == b"fLaC"
    wav = client.get(href, params={"format": "wav"})
    assert wav.headers["content-type"] == "audio/wav"
    assert wav.content[:4] == b"RIFF"
    assert int(wav.headers["content-length"]) == len(wav.content) > len(answer.content)
    moved = session.change("PATCH", json={"transposition": 3}).json()["song"]
    assert moved["href"] != href
    assert rendered(client, moved["href"]).content != answer.content
    back = session.change("PATCH", json={"transposition": 0}).json()["song"]
    assert back["href"] == href
    assert rendered(client, href).content == answer.content
    session.change("DELETE").raise_for_status()


def test_a_song_is_heard_in_segments_while_it_is_rendered(client: httpx.Client) -> None:
    session = upload(client, scale(600, bpm=101.0))
    state = session.body["song"]
    deadline = time.monotonic() + 60
    while state["segments"] is None:
        assert time.monotonic() < deadline
        state = client.get(f"{session.path}/song/state").raise_for_status().json()
    segments = state["segments"]
    assert segments["count"] == -(-segments["song_s"] // segments["segment_s"])
    first = rendered(client, f"{segments['href']}/0")
    assert first.headers["content-type"] == segments["media_type"] == "audio/ogg"
    assert "immutable" in first.headers["cache-control"]
    assert first.content[:4] == b"OggS"
    # Whoever seeks is given that place next: of what lies before it, little is rendered by then.
    late = rendered(client, f"{segments['href']}/{segments['count'] - 2}")
    assert late.status_code == 200
    assert late.content != first.content
    peaks = client.get(f"{session.path}/song/peaks", params={"points": segments["count"]}).json()
    assert peaks["highest"][0] > 0.05
    assert peaks["highest"][-2] > 0.05
    again = client.get(f"{segments['href']}/0", headers={"If-None-Match": first.headers["etag"]})
    assert again.status_code == 304
    assert client.get(f"{segments['href']}/{segments['count']}").status_code == 404
    assert client.get(f"{segments['href']}/-1").status_code == 404
    session.change("PATCH", json={"transposition": 3}).raise_for_status()
    gone = rendered(client, f"{segments['href']}/0")
    assert gone.status_code == 410
    assert gone.json()["title"] == "The sound is another now"
    session.change("DELETE").raise_for_status()


def test_who_waits_for_a_sound_that_becomes_another_is_told_where_that_is(client: httpx.Client) -> None:
    session = upload(client, scale(600, bpm=101.0))
    answers: list[httpx.Response] = []

    def ask_on(href: str, changed: Event) -> None:
        while not changed.is_set():
            answers.append(client.get(href))

    for transposition in (1, 2, 3):
        deadline = time.monotonic() + 60
        while (state := client.get(f"{session.path}/song/state").json())["segments"] is None:
            assert time.monotonic() < deadline
        changed = Event()
        with ThreadPoolExecutor(1) as waiting:
            waiting.submit(ask_on, f"{state['segments']['href']}/{state['segments']['count'] - 1}", changed)
            session.change("PATCH", json={"transposition": transposition}).raise_for_status()
            changed.set()
    # What was ready before is sent, and what was asked for after the change is gone.
    assert {answer.status_code for answer in answers} <= {200, 202, 410}
    assert {answer.json()["status"] for answer in answers if answer.status_code == 202} == {"rendering"}
    session.change("DELETE").raise_for_status()


def test_each_viewer_may_hear_a_part_alone_without_it_or_higher(client: httpx.Client) -> None:
    session = upload(client, duet())
    own = session.body["song"]["href"]
    asked = [{"stem": "part"}, {"stem": "rest"}, {"semitones": -2}, {"stem": "part", "semitones": -2}]
    states = [client.get(f"{session.path}/song/state", params=query).json() for query in asked]
    assert len({own, *(state["href"] for state in states)}) == 5
    sounds = [rendered(client, state["href"]) for state in states]
    assert {sound.headers["content-type"] for sound in sounds} == {"audio/flac"}
    assert len({sound.content for sound in (*sounds, rendered(client, own))}) == 5
    for query in asked:
        segments = client.get(f"{session.path}/song/state", params=query).json()["segments"]
        assert rendered(client, f"{segments['href']}/0").content[:4] == b"OggS"
    # Nothing of the session has changed for anybody else.
    assert client.get(f"{session.path}/song/state").json()["href"] == own
    for query, word in (
        ({"stem": "part", "player": 7}, "`player` is 0 to"),
        ({"semitones": 13}, "less than or equal to 12"),
        ({"stem": "solo"}, "'all', 'part' or 'rest'"),
    ):
        refused = client.get(f"{session.path}/song/state", params=query)
        assert refused.status_code == 422
        assert word in refused.text
    session.change("DELETE").raise_for_status()


def test_an_uploaded_song_has_no_segments_and_is_not_converted(client: httpx.Client) -> None:
    session = upload(client, scale(2), song=("s.wav", song()))
    refused = client.get(f"{session.path}/song", params={"stem": "rest"})
    assert refused.status_code == 422
    assert refused.json()["title"] == "A recording is heard as it is"
    assert session.body["song"]["segments"] is None
    assert client.get(f"{session.path}/song/state").json() == session.body["song"]
    assert client.get(f"{session.path}/song/segments/0123456789abcdef/0").status_code == 410
    assert client.get(f"{session.path}/song", params={"format": "wav"}).content == song()
    assert client.get(f"{session.path}/song", params={"format": "mp3"}).status_code == 422
    session.change("DELETE").raise_for_status()


def test_only_public_sessions_are_listed(client: httpx.Client, owned: Owned) -> None:
    def listed() -> list[str]:
        return [session["id"] for session in client.get("/api/v1/sessions").json()["sessions"]]

    assert owned.id not in listed()
    owned.change("PATCH", json={"public": True}).raise_for_status()
    assert owned.id in listed()


def test_a_session_that_was_ended_is_gone(client: httpx.Client) -> None:
    session = upload(client, scale(2), song=("s.wav", song()))
    assert session.change("DELETE").status_code == 204
    assert client.get(session.path).status_code == 404
    assert client.get(f"{session.path}/song").status_code == 404


def test_the_bundled_pieces_can_be_posted_as_they_are(client: httpx.Client) -> None:
    examples = client.get("/api/v1/examples").json()["examples"]
    assert len(examples) >= 3
    assert examples[0]["show"] is not None, "the first visit shows a piece with its own show"
    first = examples[0]
    score = client.get(first["score"]).content
    assert score == (EXAMPLES / "scores" / first["score"].rsplit("/", 1)[-1]).read_bytes()
    show_file = client.get(first["show"]).content
    session = upload(client, score, first["score"], show=("show.json", show_file), song=("s.wav", song()))
    assert session.body["title"] == first["title"]
    session.change("DELETE").raise_for_status()
