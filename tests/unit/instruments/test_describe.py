import json

from tests.unit.instruments.scores import melody, score_of

from reina.instruments import INSTRUMENTS, describe_notes, describe_score

TRUMPET = INSTRUMENTS["trumpet"]
SCORE = score_of(
    [(0.0, 1.1, 65), (1.0, 2.0, 69), (1.0, 2.0, 62), (2.0, 3.0, 40)],
    melody([36, 38]),
    names=["Trumpet", "Bass"],
    programs=[56, 32],
)


def test_a_description_holds_what_a_page_needs():
    described = describe_score(SCORE, TRUMPET, TRUMPET.play(SCORE, 0))
    assert json.loads(json.dumps(described)) == described
    assert described["title"] == "Test"
    assert (described["instrument"], described["part"], described["transposition"]) == ("trumpet", 0, 0)
    assert [(part["name"], part["program"], part["notes"]) for part in described["parts"]] == [
        ("Trumpet", 56, 4),
        ("Bass", 32, 2),
    ]
    assert described["parts"][0]["score"] > described["parts"][1]["score"]
    assert described["parts"][0]["reasons"][0].startswith("named “Trumpet”")
    assert described["tempo"] == [{"onset_beats": 0.0, "onset_s": 0.0, "bpm": 120.0}]
    assert described["metre"] == [{"onset_beats": 0.0, "onset_s": 0.0, "numerator": 4, "denominator": 4}]
    assert described["bar_lines_s"] == [0.0, 2.0]
    assert {warning["kind"] for warning in described["warnings"]} == {
        "note_shortened",
        "chord_note_dropped",
        "not_playable",
        "octave_fit_possible",
    }


def test_notes_carry_their_fingering_or_the_reason_why_not():
    notes = describe_notes(SCORE, TRUMPET, TRUMPET.play(SCORE, 0), part=0)
    assert [note["sounding_pitch"] for note in notes] == [65, 62, 69, 40]
    assert [note["written_pitch"] for note in notes] == [67, 64, 71, 42]
    assert [note["valves"] for note in notes] == [[], None, [2], None]
    assert [note["shortened"] for note in notes] == [True, False, False, False]
    assert [note["played_duration_s"] for note in notes] == [1.0, None, 1.0, 1.0]
    assert "one note at a time" in notes[1]["reason"]
    assert "below the lowest note" in notes[3]["reason"]
    assert notes[0]["reason"] == "open: usual for written G4"


def test_other_parts_are_listed_without_valves():
    notes = describe_notes(SCORE, TRUMPET, TRUMPET.play(SCORE, 0, 2))
    assert len(notes) == 6
    bass = [note for note in notes if note["part"] == 1]
    assert [note["valves"] for note in bass] == [None, None]
    assert [note["sounding_pitch"] for note in bass] == [36, 38]
    assert next(note for note in notes if note["part"] == 0)["sounding_pitch"] == 67
