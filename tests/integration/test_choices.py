"""What of a file is played, and how it is taken: its sequence, written pitch, octaves."""

from __future__ import annotations

import asyncio
import json
import time
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from tests.integration.scores import chords, collection, duet, scale, song
from tests.integration.server import serve, upload
from tests.integration.stranger import take
from tests.integration.watching import watch

if TYPE_CHECKING:
    from pathlib import Path

    from tests.integration.server import Owned, Running

SONG: dict[str, Any] = {"song": ("s.wav", song())}
LOW = [{"beat": beat, "duration": 1, "pitch": pitch} for beat, pitch in enumerate((43, 46, 48, 51))]
"""A fifth below the trumpet's lowest note and up: an octave higher all of it can be played."""


def low_part() -> bytes:
    """A part of Reina's own form, below the trumpet's range."""
    return json.dumps(
        {"format": "reina-score", "title": "Low", "parts": [{"name": "Trumpet", "notes": LOW}]}
    ).encode()


def played(session: Owned) -> list[tuple[int, list[int] | None]]:
    """The sounding pitch and the valves of each note, after a look at the frames: there the same are down."""
    score = session.client.get(f"{session.path}/score").raise_for_status().json()
    notes: list[dict[str, Any]] = [note for note in score["notes"] if note["part"] == score["part"]]
    motion = take(session.client, session.id, 0.0, score["duration_s"])
    for note in notes:
        if note["valves"] is not None:
            frame = round((note["onset_s"] + note["duration_s"] / 2) * 60)
            down = [v for v in (1, 2, 3) if motion.parameters[f"trumpet/valve/{v}"][frame, 0] > 0.5]
            assert down == note["valves"]
    return [(note["sounding_pitch"], note["valves"]) for note in notes]


def kinds(body: dict[str, Any]) -> list[str]:
    """The kinds of the warnings of a session or a score."""
    return [warning["kind"] for warning in body["warnings"]]


def rendered(client: httpx.Client, href: str) -> bytes:
    """A song, once it is made."""
    deadline = time.monotonic() + 60
    while (answer := client.get(href)).status_code == 202:
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert answer.status_code == 200
    return answer.content


def test_of_a_file_of_format_2_one_sequence_is_played_and_another_may_be(client: httpx.Client) -> None:
    session = upload(client, collection(), **SONG)
    assert (session.body["sequence"], session.body["sequences"], session.body["notes"]) == (0, 3, 4)
    assert "sequences" in kinds(session.body)
    first = played(session)
    assert [pitch for pitch, _ in first] == [58, 62, 65, 70]
    show = client.get(f"{session.path}/show").json()
    changed = session.change("PATCH", json={"sequence": 1}).raise_for_status().json()
    assert (changed["sequence"], changed["sequences"], changed["notes"]) == (1, 3, 8)
    assert changed["duration_s"] > session.body["duration_s"]
    assert "sequences" not in kinds(changed), "it was chosen"
    second = played(session)
    assert [pitch for pitch, _ in second] == list(range(60, 68))
    assert second[:4] != first
    assert client.get(f"{session.path}/score").json()["sequence"] == 1
    assert client.get(f"{session.path}/show").json() != show, "the show was written for the other piece"
    back = session.change("PATCH", json={"sequence": 0}).json()
    assert back["duration_s"] == session.body["duration_s"]
    assert played(session) == first
    session.change("DELETE")


def test_a_sequence_can_be_chosen_with_the_upload(client: httpx.Client) -> None:
    session = upload(client, collection(), sequence="2", **SONG)
    assert (session.body["sequence"], session.body["sequences"], session.body["notes"]) == (2, 3, 2)
    assert [pitch for pitch, _ in played(session)] == [63, 58]
    session.change("DELETE")


def test_viewers_are_told_of_another_sequence_and_start_at_its_beginning(
    server: Running, client: httpx.Client
) -> None:
    session = upload(client, collection(), **SONG)
    session.control("seek", song_time_s=1.0)
    session.control("loop", start_s=0.5, end_s=1.5)

    async def scenario() -> dict[str, Any]:
        async with watch(server, session.id) as viewer:
            answer = await asyncio.to_thread(session.change, "PATCH", json={"sequence": 1})
            await viewer.until(lambda: viewer.of_type("score_changed") and viewer.of_type("show_changed"))
            transport = (await asyncio.to_thread(client.get, f"{session.path}/transport")).json()
            await viewer.frame(0, epoch=transport["epoch"])
            assert (transport["song_time_s"], transport["loop"]) == (0.0, None)
            told = viewer.of_type("score_changed")[-1]
            assert told["duration_s"] == answer.json()["duration_s"] > viewer.hello["duration_s"]
            return told

    told = asyncio.run(scenario())
    assert (told["sequence"], told["part"], told["written"], told["octave_fit"]) == (1, 0, False, False)
    session.change("DELETE")


def test_a_part_notated_for_the_trumpet_is_played_and_heard_a_tone_lower(client: httpx.Client) -> None:
    session = upload(client, scale(4))
    # C4 to E♭4 as they sound, D4 to F4 on paper.
    before = played(session)
    as_it_sounds = rendered(client, session.body["song"]["href"])
    changed = session.change("PATCH", json={"written": True, "transposition": 2}).json()
    assert played(session) == before, "a tone higher, a tone lower"
    assert (changed["transposition"], changed["sounding_transposition"]) == (2, 0)
    changed = session.change("PATCH", json={"transposition": 0}).json()
    assert (changed["written"], changed["sounding_transposition"]) == (True, -2)
    assert "written_pitch" in kinds(changed)
    after = played(session)
    assert [pitch for pitch, _ in after] == [pitch - 2 for pitch, _ in before]
    assert [valves for _, valves in after] != [valves for _, valves in before]
    heard = rendered(client, changed["song"]["href"])
    assert heard != as_it_sounds
    moved = session.change("PATCH", json={"written": False, "transposition": -2}).json()
    assert played(session) == after
    assert rendered(client, moved["song"]["href"]) == heard
    session.change("DELETE")
    with_upload = upload(client, scale(4), written="true", **SONG)
    assert with_upload.body["written"] is True
    assert played(with_upload) == after
    with_upload.change("DELETE")


def test_a_part_out_of_range_is_moved_by_octaves_when_asked(server: Running, client: httpx.Client) -> None:
    session = upload(client, low_part(), "low.json")
    assert kinds(session.body).count("not_playable") == len(LOW)
    assert "octave_fit_possible" in kinds(session.body)
    assert [valves for _, valves in played(session)] == [None] * len(LOW)

    async def scenario() -> None:
        async with watch(server, session.id) as viewer:
            await asyncio.to_thread(session.change, "PATCH", json={"octave_fit": True})
            await viewer.until(lambda: viewer.of_type("score_changed"))
            assert viewer.of_type("score_changed")[0]["octave_fit"] is True

    asyncio.run(scenario())
    body = client.get(session.path).json()
    assert (body["octave_fit"], body["transposition"], body["sounding_transposition"]) == (True, 0, 12)
    assert kinds(body) == kinds(client.get(f"{session.path}/score").json()) == ["octave_fit"]
    notes = played(session)
    assert [pitch for pitch, _ in notes] == [55, 58, 60, 63]
    assert all(valves is not None for _, valves in notes)
    heard = rendered(client, body["song"]["href"])
    moved = session.change("PATCH", json={"octave_fit": False, "transposition": 12}).json()
    assert rendered(client, moved["song"]["href"]) == heard
    session.change("DELETE")
    with_upload = upload(client, low_part(), "low.json", octave_fit="true", **SONG)
    assert played(with_upload) == notes
    with_upload.change("DELETE")


def test_what_was_dropped_and_shortened_is_told(client: httpx.Client) -> None:
    session = upload(client, chords(), transposition="3", **SONG)
    for body in (session.body, client.get(f"{session.path}/score").json()):
        told = {warning["kind"]: warning for warning in body["warnings"]}
        assert told["chord_note_dropped"]["place"] == "part 0, note 0 at 0.000 s"
        assert told["chord_note_dropped"]["message"] == "E♭4 is not played: G4 sounds above it"
        assert told["note_shortened"]["place"] == "part 0, note 2 at 0.500 s"
    # The note that is left out stands a minor third higher as the others do.
    assert [pitch for pitch, _ in played(session)] == [63, 67, 65, 68]
    assert played(session)[0][1] is None
    session.change("DELETE")


def test_choices_outlive_a_restart(tmp_path: Path) -> None:
    with serve(tmp_path) as server, httpx.Client(base_url=server.address, timeout=30) as client:
        session = upload(
            client, collection(), sequence="1", written="1", octave_fit="on", in_time="true", **SONG
        )
        before, notes = client.get(session.path).json(), played(session)
        server.stop()
    with serve(tmp_path) as server, httpx.Client(base_url=server.address, timeout=30) as client:
        again = type(session)(client, session.body)
        assert client.get(session.path).json() == before
        assert played(again) == notes


@pytest.mark.parametrize(
    ("choice", "kind", "told"),
    [
        ({"sequence": 3}, "not-in-score", "the file holds 3 sequences, 0 to 2; there is no sequence 3"),
        ({"sequence": -1}, "request-invalid", "sequence"),
        ({"sequence": "two"}, "request-invalid", "sequence"),
        ({"part": 4}, "not-in-score", "there is no part 4; there are 0 to 0"),
        ({"sequence": 1, "part": 1}, "not-in-score", "there is no part 1"),
        ({"written": "both"}, "request-invalid", "written"),
        ({"octave_fit": "up"}, "request-invalid", "octave_fit"),
    ],
)
def test_choices_that_cannot_be_are_refused(
    client: httpx.Client, choice: dict[str, Any], kind: str, told: str
) -> None:
    session = upload(client, collection(), **SONG)
    form = {field: str(value) for field, value in choice.items()}
    for answer in (
        session.change("PATCH", json=choice),
        client.post("/api/v1/sessions", files={"score": ("a.mid", collection())}, data=form),
    ):
        assert answer.status_code == 422, answer.text
        assert answer.headers["content-type"] == "application/problem+json"
        assert answer.json()["type"] == f"urn:reina:problem:{kind}"
        assert told in answer.json()["detail"]
    same = client.get(session.path).json()
    assert all(same[field] == session.body[field] for field in same)
    session.change("DELETE")


def test_a_file_of_one_piece_has_one_sequence(client: httpx.Client) -> None:
    session = upload(client, duet(), sequence="0", **SONG)
    assert (session.body["sequence"], session.body["sequences"]) == (0, 1)
    answer = session.change("PATCH", json={"sequence": 1})
    assert "the file holds one sequence, 0; there is no sequence 1" in answer.json()["detail"]
    session.change("DELETE")
