"""Who plays what, as it is said on the stage, in the API and by `reina inspect`."""

from typing import Any

from tests.unit.instruments.scores import melody, score_of

from reina.instruments import INSTRUMENTS, Casting, choice_findings, score_findings
from reina.music import Finding, Score

TRUMPET = INSTRUMENTS["trumpet"]


def told(score: Score, *castings: Casting) -> list[str]:
    found = choice_findings(score, castings or [Casting(part=0)], INSTRUMENTS, [()] * (len(castings) or 1))
    return [finding.text for finding in found]


def playing(score: Score, **wishes: Any) -> dict[str, Finding]:
    return {one.kind: one for one in score_findings(score, TRUMPET, TRUMPET.play(score, 0, **wishes))}


def test_that_there_is_no_trumpet_is_said():
    score = score_of(melody([60]), melody([62]), names=["Vocals", "Guitar"], programs=[53, 24])
    assert told(score) == ["No trumpet in this file: the player plays Vocals"]


def test_a_part_of_the_instruments_own_is_said_where_there_are_others():
    score = score_of(melody([60]), melody([62]), names=["Flute", "Tromba in Si♭"], programs=[73, 56])
    assert told(score, Casting(part=1)) == ["Plays Tromba in Si♭, a part for trumpet"]
    assert told(score, Casting(part=0)) == ["Plays Flute"]
    alone = score_of(melody([60]), names=["Trumpet"], programs=[56])
    assert told(alone) == ["Plays Trumpet"]


def test_joined_parts_are_named_too():
    score = score_of(melody([60]), melody([62]), names=["Lead", "Solo"], programs=[0, 0])
    (text,) = told(score, Casting(part=0, joined_parts=(1,)))
    assert text == "No trumpet in this file: the player plays Lead and Solo"


def test_several_players_are_named_by_their_parts_and_what_nobody_plays_too():
    names = ["Trumpet 1", "Trumpet 2", "Flute", "Oboe", "Horn", "Tuba", "Harp", "Viola"]
    score = score_of(*(melody([60 + at]) for at in range(8)), names=names, programs=[56, 56, *[0] * 6])
    players, heard = told(score, Casting(part=0), Casting(part=1))
    assert players == "2 play: Trumpet 1, Trumpet 2"
    assert heard == "Flute, Oboe, Horn, Tuba and 2 more are heard, and nobody plays them"


def test_drums_alone_are_said_and_no_octave_is_offered():
    score = score_of(melody([36, 38, 57]), names=["Kit"], programs=[None], drums=0)
    found = playing(score)
    assert found["drums_alone"].text.startswith("Drums alone in this file. They are heard")
    assert "octave_fit_possible" not in found
    assert found["not_playable"].text == "Leaves out 2 notes below the trumpet's range"


def test_a_drummer_has_a_part_of_her_own():
    alone = score_of(melody([36, 38]), names=["Kit"], programs=[None], drums=0)
    assert told(alone, Casting(part=0, instrument="drums")) == ["Plays Kit"]
    both = score_of(melody([60]), melody([36, 38]), names=["Trumpet", "Kit"], programs=[56, None], drums=1)
    assert told(both, Casting(part=1, instrument="drums")) == ["Plays Kit, a part for drums"]
    score = score_of(melody([60]), names=["Trumpet"], programs=[56])
    (said,) = told(score, Casting(part=0, instrument="drums"))
    assert said == "No drums in this file: the player plays Trumpet"


def test_chords_are_counted_and_not_their_notes():
    triads = [(at * 1.0, at + 0.9, pitch) for at in range(3) for pitch in (60, 64, 67)]
    found = playing(score_of(triads, names=["Piano"], programs=[0]))
    assert found["chord_note_dropped"].text == "Plays the top note of 3 chords"
    assert len(found["chord_note_dropped"].details) == 6


def test_another_octave_is_offered_with_what_it_brings():
    low = score_of(melody([36, 40, 52]), names=["Bass"], programs=[32])
    offer = playing(low)["octave_fit_possible"]
    assert (offer.values["out"], offer.values["left"], offer.values["side"]) == (2, 0, "up")
    assert offer.text == "2 of 3 notes lie outside the trumpet's range; 2 octaves up, none would"
    moved = playing(low, octave_fit=True)
    assert moved["octave_fit"].text == "Moved 2 octaves up, into the trumpet's range"
    assert "not_playable" not in moved


def test_written_pitch_says_how_it_sounds():
    score = score_of(melody([67]), names=["Trumpet"], programs=[56])
    said = playing(score, written=True)["written_pitch"].text
    assert said == "Read as written for the trumpet: it sounds 2 semitones lower"
