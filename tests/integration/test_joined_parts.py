"""Parts that the player plays together with their own: chosen, told, shown in the frames and kept."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from tests.integration.scores import relay, song
from tests.integration.server import serve, upload
from tests.integration.stranger import take
from tests.integration.watching import watch

if TYPE_CHECKING:
    from pathlib import Path

    from tests.integration.server import Owned, Running

SONG: dict[str, Any] = {"song": ("s.wav", song())}
TRUMPET, MUTED, FLUTE, DRUMS = range(4)
"""The parts of the relay."""


def score_of(session: Owned) -> dict[str, Any]:
    return session.client.get(f"{session.path}/score").raise_for_status().json()


def played(session: Owned) -> list[tuple[int, int, list[int]]]:
    """The part, pitch and valves of each note that is played; the same valves are down in the frames."""
    score = score_of(session)
    motion = take(session.client, session.id, 0.0, score["duration_s"])
    notes = [note for note in score["notes"] if note["valves"] is not None]
    for note in notes:
        frame = round((note["onset_s"] + note["duration_s"] / 2) * 60)
        down = [v for v in (1, 2, 3) if motion.parameters[f"trumpet/valve/{v}"][frame, 0] > 0.5]
        assert down == note["valves"]
    return [(note["part"], note["sounding_pitch"], note["valves"]) for note in notes]


WHOLE: list[tuple[int, int, list[int]]] = [
    (TRUMPET, 65, []),
    (TRUMPET, 67, [1, 2]),
    (MUTED, 69, [2]),
    (MUTED, 70, []),
]


def test_parts_are_joined_with_the_upload(client: httpx.Client) -> None:
    session = upload(client, relay(), part=f"{TRUMPET}", joined_parts=f"{MUTED}", **SONG)
    assert (session.body["part"], session.body["joined_parts"]) == (TRUMPET, [MUTED])
    assert played(session) == WHOLE
    score = score_of(session)
    assert (score["part"], score["joined_parts"]) == (TRUMPET, [MUTED])
    assert {note["part"] for note in score["notes"] if note["in_played_part"]} == {TRUMPET, MUTED}
    session.change("DELETE")


def test_by_default_a_part_is_played_alone(client: httpx.Client) -> None:
    for fields in ({}, {"joined_parts": ""}):
        session = upload(client, relay(), **fields, **SONG)
        assert session.body["joined_parts"] == score_of(session)["joined_parts"] == []
        assert played(session) == WHOLE[:2]
        session.change("DELETE")


def test_parts_are_joined_and_parted_later_and_viewers_are_told(
    server: Running, client: httpx.Client
) -> None:
    session = upload(client, relay(), **SONG)

    async def scenario() -> list[list[int]]:
        async with watch(server, session.id) as viewer:
            for joined in ([MUTED, FLUTE], [MUTED], []):
                told = len(viewer.of_type("score_changed"))
                answer = await asyncio.to_thread(session.change, "PATCH", json={"joined_parts": joined})
                assert answer.raise_for_status().json()["joined_parts"] == joined
                await viewer.until(lambda told=told: len(viewer.of_type("score_changed")) > told)
            return [message["joined_parts"] for message in viewer.of_type("score_changed")]

    assert asyncio.run(scenario()) == [[MUTED, FLUTE], [MUTED], []]
    assert played(session) == WHOLE[:2]
    session.change("DELETE")


def test_notes_of_joined_parts_are_told_as_they_pass(server: Running, client: httpx.Client) -> None:
    session = upload(client, relay(), joined_parts=f"{MUTED}", **SONG)

    async def scenario() -> list[tuple[int, int]]:
        async with watch(server, session.id) as viewer:
            await asyncio.to_thread(session.control, "play")
            await viewer.until(lambda: len(viewer.of_type("note_on")) == len(WHOLE))
            return [(note["part"], note["sounding_pitch"]) for note in viewer.of_type("note_on")]

    assert asyncio.run(scenario()) == [(part, pitch) for part, pitch, _ in WHOLE]
    session.change("DELETE")


def test_of_two_parts_at_one_time_the_other_note_is_told_as_left_out(client: httpx.Client) -> None:
    session = upload(client, relay(), joined_parts=f"{FLUTE}", **SONG)
    notes = score_of(session)["notes"]
    assert [note["part"] for note in notes if note["valves"] is not None] == [FLUTE, FLUTE]
    (low, _) = [note for note in notes if note["part"] == TRUMPET]
    assert (low["in_played_part"], low["valves"]) == (True, None)
    assert "one note at a time" in low["reason"]
    told = [warning for warning in session.body["warnings"] if warning["kind"] == "chord_note_dropped"]
    assert [warning["place"] for warning in told] == ["part 0, note 0 at 0.000 s"]
    session.change("DELETE")


def test_all_parts_that_are_played_are_transposed(client: httpx.Client) -> None:
    session = upload(client, relay(), joined_parts=f"{MUTED}", transposition="-2", **SONG)
    assert [pitch for _, pitch, _ in played(session)] == [63, 65, 67, 68]
    flute = [note["sounding_pitch"] for note in score_of(session)["notes"] if note["part"] == FLUTE]
    assert flute == [86, 88]
    session.change("DELETE")


def test_another_part_is_played_alone_unless_others_are_named(client: httpx.Client) -> None:
    session = upload(client, relay(), joined_parts=f"{MUTED}", **SONG)
    same = session.change("PATCH", json={"part": TRUMPET, "title": "Relay"}).json()
    assert same["joined_parts"] == [MUTED]
    assert session.change("PATCH", json={"part": FLUTE}).json()["joined_parts"] == []
    both = session.change("PATCH", json={"part": MUTED, "joined_parts": [TRUMPET]}).json()
    assert (both["part"], both["joined_parts"]) == (MUTED, [TRUMPET])
    assert played(session) == WHOLE
    session.change("DELETE")


def test_what_is_joined_outlives_a_restart(tmp_path: Path) -> None:
    with serve(tmp_path) as server, httpx.Client(base_url=server.address, timeout=30) as client:
        session = upload(client, relay(), joined_parts="2, 1", in_time="true", **SONG)
        before, notes = client.get(session.path).json(), played(session)
        assert before["joined_parts"] == [MUTED, FLUTE]
        server.stop()
    with serve(tmp_path) as server, httpx.Client(base_url=server.address, timeout=30) as client:
        again = type(session)(client, session.body)
        assert client.get(session.path).json() == before
        assert played(again) == notes


@pytest.mark.parametrize(
    ("joined", "kind", "told"),
    [
        ([MUTED, 9], "not-in-score", "joined_parts/1: there is no part 9"),
        ([MUTED, MUTED], "not-in-score", "joined_parts/1: part 1 is named twice"),
        ([TRUMPET], "not-in-score", "joined_parts/0: part 0 is the part that the others are joined to"),
        ([DRUMS], "not-in-score", "joined_parts/0: part 3 (“Drums”) is drums"),
        ([-1], "request-invalid", "joined_parts/0"),
        (["solo"], "request-invalid", "joined_parts/0"),
        ([10**30], "not-in-score", "joined_parts/0: there is no part 1000"),
    ],
)
def test_what_cannot_be_joined_is_refused_with_what_can(
    client: httpx.Client, joined: list[Any], kind: str, told: str
) -> None:
    session = upload(client, relay(), **SONG)
    form = {"joined_parts": ",".join(map(str, joined))}
    for answer in (
        session.change("PATCH", json={"joined_parts": joined}),
        client.post("/api/v1/sessions", files={"score": ("a.mid", relay())}, data=form),
    ):
        assert answer.status_code == 422, answer.text
        assert answer.json()["type"] == f"urn:reina:problem:{kind}"
        assert told in answer.json()["detail"]
        if kind == "not-in-score":
            assert answer.json()["detail"].endswith("parts that can be joined to part 0: 1 to 2")
    assert client.get(session.path).json()["joined_parts"] == []
    session.change("DELETE")


def test_the_form_names_parts_between_commas_and_the_change_as_a_list(client: httpx.Client) -> None:
    session = upload(client, relay(), **SONG)
    for answer in (
        session.change("PATCH", json={"joined_parts": "1,2"}),
        client.post("/api/v1/sessions", files={"score": ("a.mid", relay())}, data={"joined_parts": "1;2"}),
        client.post("/api/v1/sessions", files={"score": ("a.mid", relay())}, data={"joined_parts": "[1]"}),
    ):
        assert answer.status_code == 422, answer.text
        assert "joined_parts" in answer.json()["detail"]
    session.change("DELETE")


def test_a_show_that_answers_the_player_s_part_answers_joined_parts_too(client: httpx.Client) -> None:
    events = {"on": "notes", "where": {"part": TRUMPET}, "amount": 9.0, "blend": "replace", "decay": 0.1}
    track: dict[str, Any] = {"parameter": "lights/key/intensity", "keyframes": [], "events": events}
    session = upload(client, relay(), **SONG)
    body: dict[str, Any] = {"version": 1, "time": "seconds", "tracks": [track]}
    session.change("PUT", "/show", json=body).raise_for_status()

    def flashes() -> list[bool]:
        motion = take(client, session.id, 0.0, 2.0)
        light = motion.parameters["lights/key/intensity"][:, 0]
        return [bool(light[round(onset * 60)] > 8.9) for onset in (0.0, 0.5, 1.0, 1.5)]

    assert flashes() == [True, True, False, False]
    session.change("PATCH", json={"joined_parts": [MUTED]}).raise_for_status()
    assert flashes() == [True, True, True, True]
    session.change("DELETE")
