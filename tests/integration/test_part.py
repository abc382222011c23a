"""A player's part over HTTP: keys, names, bars of values, and the choice of usual fingerings."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import mido
import pytest
from tests.integration.scores import duet, song
from tests.integration.server import serve, upload
from tests.integration.stranger import take

if TYPE_CHECKING:
    from tests.integration.server import Owned

SONG: dict[str, Any] = {"song": ("s.wav", song())}
SCORES = Path(__file__).parents[2] / "examples" / "scores"
MARCH = SCORES / "prince-of-denmarks-march.mid"
SAINTS = SCORES / "when-the-saints.mid"


def in_key(key: str, pitches: list[int]) -> bytes:
    """A MIDI file of quarters in a key."""
    track = mido.MidiTrack([mido.MetaMessage("key_signature", key=key, time=0)])
    for pitch in pitches:
        track.append(mido.Message("note_on", note=pitch, velocity=90, time=0))
        track.append(mido.Message("note_off", note=pitch, time=480))
    file = mido.MidiFile(tracks=[track])
    buffer = io.BytesIO()
    file.save(file=buffer)
    return buffer.getvalue()


def part_of(session: Owned, **query: int) -> dict[str, Any]:
    """A part."""
    return session.client.get(f"{session.path}/part", params=query).raise_for_status().json()


def score_of(session: Owned) -> dict[str, Any]:
    """The score."""
    return session.client.get(f"{session.path}/score").raise_for_status().json()


@pytest.fixture
def march(client: httpx.Client) -> Owned:
    """The bundled march."""
    return upload(client, MARCH.read_bytes(), MARCH.name, **SONG)


def test_a_part_holds_every_note_of_the_line_in_full_bars(march: Owned) -> None:
    part, score = part_of(march), score_of(march)
    line = [note for note in score["notes"] if note["valves"] is not None]
    assert [note["index"] for note in part["notes"]] == [note["index"] for note in line]
    for own, note in zip(part["notes"], line, strict=True):
        for name in ("written_name", "sounding_name", "valves", "usual_valves", "reason"):
            assert own[name] == note[name]
    for measure in part["measures"]:
        assert sum(entry["ticks"] for entry in measure["entries"]) == measure["ticks"] == 192
    first = part["measures"][0]["entries"]
    assert [(entry["value"], entry["written"]["name"], entry["trill"] is not None) for entry in first] == [
        (2, "E5", False),
        (2, "F♯5", True),
    ]
    assert part["notes"][first[1]["trill"]]["written_name"] == "G♯5"
    assert first[1]["written"]["accidental"] is None, "the signature says it"
    assert (part["instrument_title"], part["clef"], part["written_above_sounding"]) == (
        "B♭ trumpet",
        "treble",
        2,
    )
    assert part["tempi"][0]["bpm"] == pytest.approx(112, abs=0.01)
    assert [tempo["word"] for tempo in part["tempi"]] == ["", "rit."]


def test_score_and_part_tell_the_key_as_it_sounds_and_as_it_is_written(march: Owned) -> None:
    key = {"name": "D major", "fifths": 2, "written_name": "E major", "written_fifths": 4, "source": "notes"}
    for told in (score_of(march), part_of(march)):
        assert told["keys"] == [{"onset_beats": 0.0, "onset_s": 0.0, **key}]
    measure = part_of(march)["measures"][0]
    assert (measure["fifths"], measure["written_fifths"]) == (2, 4)


def test_a_key_of_the_file_spells_the_notes(client: httpx.Client) -> None:
    for key, names, written in (
        ("Ab", ["A♭4", "D♭5", "G♭5"], ["B♭4", "E♭5", "A♭5"]),
        ("E", ["G♯4", "C♯5", "F♯5"], ["A♯4", "D♯5", "G♯5"]),
    ):
        session = upload(client, in_key(key, [68, 73, 78]), **SONG)
        notes = score_of(session)["notes"]
        assert [note["sounding_name"] for note in notes] == names
        assert [note["written_name"] for note in notes] == written
        assert score_of(session)["keys"][0]["source"] == "file"
        session.change("PATCH", json={"transposition": 1})
        assert score_of(session)["keys"][0]["name"] == {"Ab": "A major", "E": "F major"}[key]


def test_each_player_has_a_part(client: httpx.Client) -> None:
    castings = [{"part": 0}, {"part": 1, "player": "soloist"}]
    session = upload(client, duet(), cast=json.dumps({"castings": castings}), **SONG)
    parts = [part_of(session, player=player) for player in (0, 1)]
    assert [part["player"] for part in parts] == [0, 1]
    indices = [{note["index"] for note in part["notes"]} for part in parts]
    assert indices[0]
    assert indices[1]
    assert not indices[0] & indices[1]
    answer = client.get(f"{session.path}/part", params={"player": 2})
    assert (answer.status_code, answer.json()["type"]) == (404, "urn:reina:problem:unknown-player")
    assert "0 to 1, not 2" in answer.json()["detail"]


def test_a_drummers_part_holds_every_hit_once(client: httpx.Client) -> None:
    session = upload(client, SAINTS.read_bytes(), SAINTS.name, **SONG)
    part, score = part_of(session, player=1), score_of(session)
    assert (part["instrument"], part["clef"], part["written_above_sounding"]) == ("drums", "percussion", 0)
    of_score = {note["index"]: note for note in score["notes"]}
    assert len(part["notes"]) > 200
    for own in part["notes"]:
        note = of_score[own["index"]]
        struck = note["fingering"]
        limb = f"{struck['hand']}_hand" if struck["hand"] else f"{struck['foot']}_foot"
        assert (own["piece"], own["limb"], own["onset_s"]) == (struck["piece"], limb, note["onset_s"])
        assert own["reason"] == note["reason"] != ""
    # The file's drums have no two sounds of one stroke: every note that is struck is one hit.
    fingered = [note for note in score["notes"] if note["fingering"] is not None]
    struck = [note["index"] for note in fingered if note["fingering"]["type"] == "strike"]
    assert sorted(note["index"] for note in part["notes"]) == sorted(struck)
    assert (part_of(session, player=0)["clef"], part_of(session)["instrument"]) == ("treble", "trumpet")
    heads = [
        head["note"]
        for measure in part["measures"]
        for entry in measure["entries"]
        for head in (*entry["heads"], *(grace["head"] for grace in entry["graces"]))
        if not entry["tied_from"]
    ]
    assert sorted(heads) == list(range(len(part["notes"]))), "each hit is one head"


def test_two_sounds_of_one_stroke_are_one_head(client: httpx.Client) -> None:
    track = mido.MidiTrack()
    for _ in range(8):
        for pitch, velocity in ((40, 60), (38, 100)):
            track.append(mido.Message("note_on", channel=9, note=pitch, velocity=velocity, time=0))
        track.append(mido.Message("note_off", channel=9, note=38, time=480))
        track.append(mido.Message("note_off", channel=9, note=40, time=0))
    buffer = io.BytesIO()
    mido.MidiFile(tracks=[track]).save(file=buffer)
    session = upload(client, buffer.getvalue(), **SONG)
    part, score = part_of(session), score_of(session)
    loud = [note["index"] for note in score["notes"] if note["velocity"] > 0.6]
    assert (len(score["notes"]), [note["index"] for note in part["notes"]]) == (16, loud)


def test_usual_fingerings_alone_are_chosen_and_kept(tmp_path: Path) -> None:
    with serve(tmp_path) as server, httpx.Client(base_url=server.address, timeout=30.0) as client:
        session = upload(client, MARCH.read_bytes(), MARCH.name, **SONG)
        before = score_of(session)["notes"]
        alternates = [note for note in before if note["valves"] != note["usual_valves"]]
        assert alternates
        assert all("in place of" in note["reason"] for note in alternates)
        frames = take(client, session.id, 0.0, 4.0).parameters
        answer = session.change("PATCH", json={"usual_fingerings": True})
        assert answer.raise_for_status().json()["usual_fingerings"] is True
        notes = score_of(session)["notes"]
        assert [note["valves"] for note in notes] == [note["usual_valves"] for note in before]
        usual = take(client, session.id, 0.0, 4.0).parameters
        assert any((usual[path] != frames[path]).any() for path in usual if "valve" in path)
        assert client.get(f"{session.path}/cast").json()["castings"][0]["usual_fingerings"] is True
        session.change("PATCH", json={"transposition": 1}).raise_for_status()
        assert score_of(session)["usual_fingerings"] is True
        session.change("PATCH", json={"transposition": 0}).raise_for_status()
        path, headers = session.path, session.headers
    with serve(tmp_path) as server, httpx.Client(base_url=server.address, timeout=30.0) as client:
        assert client.get(path).json()["usual_fingerings"] is True
        client.patch(path, json={"usual_fingerings": False}, headers=headers).raise_for_status()
        again = client.get(f"{path}/score").json()["notes"]
        assert [note["valves"] for note in again] == [note["valves"] for note in before]


def test_usual_fingerings_come_with_a_form_and_a_cast(client: httpx.Client) -> None:
    form = upload(client, MARCH.read_bytes(), MARCH.name, usual_fingerings="true", **SONG)
    assert client.get(form.path).json()["usual_fingerings"] is True
    castings = [{"part": 0, "usual_fingerings": True}]
    session = upload(client, MARCH.read_bytes(), MARCH.name, cast=json.dumps({"castings": castings}), **SONG)
    assert client.get(f"{session.path}/cast").json()["castings"][0]["usual_fingerings"] is True


def test_instruments_tell_their_fingering_charts(client: httpx.Client) -> None:
    instruments = {one["name"]: one for one in client.get("/api/v1/instruments").json()["instruments"]}
    trumpet = instruments["trumpet"]
    assert (trumpet["clef"], trumpet["valves"], len(trumpet["chart"])) == ("treble", 3, 38)
    lines = {line["written_pitch"]: line for line in trumpet["chart"]}
    assert [line["sounding_pitch"] for line in trumpet["chart"]] == list(range(52, 90))
    assert lines[60]["fingerings"] == [[]]
    assert lines[73] == {
        "sounding_pitch": 71,
        "written_pitch": 73,
        "sounding_names": ["B4"],
        "written_names": ["C♯5", "D♭5"],
        "fingerings": [[1, 2], [3], [1, 2, 3]],
    }
    assert instruments["cornet"]["chart"][-1]["written_names"] == ["E6"]
