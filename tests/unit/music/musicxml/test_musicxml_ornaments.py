"""Trills, mordents, turns and tremolos of MusicXML, as players play them."""

from __future__ import annotations

import numpy as np
import pytest
from tests.unit.music.musicxml.musicxml_text import (
    B_FLAT,
    attributes,
    document,
    measures,
    notations,
    note,
    slur,
    tempo,
    tied,
)

from reina.instruments import INSTRUMENTS
from reina.music import Limits, Score, ScoreLimitError, read_score


def ornaments(inner: str) -> str:
    return notations(f"<ornaments>{inner}</ornaments>")


def read(inner: str, fifths: int = 0, extra: str = "") -> Score:
    body = measures(attributes(fifths=fifths, extra=extra) + tempo(120) + inner)
    return read_score(document(body), filename="Test.musicxml")


def played(score: Score) -> list[tuple[int, float]]:
    return [(one.sounding_pitch, round(one.duration_s, 3)) for one in score.notes]


TRILL = ornaments("<trill-mark/>")


def test_a_trill_goes_to_the_keys_upper_neighbour_six_times_a_second_and_ends_on_its_note() -> None:
    score = read(note("B4", 4, inner=TRILL), fifths=1)
    pitches = score.notes.sounding_pitch.tolist()
    assert pitches == [71, 72] * 11 + [71]
    assert np.allclose(np.diff(score.notes.onset_s), 2.0 / 23)
    assert score.notes.tongued.tolist() == [1] + [0] * 22
    assert score.duration_s == pytest.approx(2.0)
    assert score.warnings == ()


@pytest.mark.parametrize(
    ("name", "fifths", "before", "mark", "upper"),
    [
        ("E4", 0, "", "", 65),
        ("E4", 1, "", "", 66),
        ("A4", -1, "", "", 70),
        ("A4", -1, "", "natural", 71),
        ("B4", 0, "", "flat", 71),
        ("F#4", 0, note("G#4"), "", 68),
        ("B3", 0, "", "sharp", 61),
    ],
)
def test_the_neighbour_is_the_keys_or_the_measures_or_the_signs(
    name: str, fifths: int, before: str, mark: str, upper: int
) -> None:
    sign = f"<accidental-mark>{mark}</accidental-mark>" if mark else ""
    score = read(before + note(name, 2, inner=ornaments(f"<trill-mark/>{sign}")), fifths=fifths)
    assert upper in {one.sounding_pitch for one in score.notes if one.duration_s < 0.1}


def test_an_accidental_of_another_measure_no_longer_counts() -> None:
    body = measures(attributes() + note("G#4", 4), note("F#4", 4, inner=TRILL))
    pitches = set(read_score(document(body)).notes.sounding_pitch.tolist())
    assert pitches == {68, 66, 67}


def test_a_trill_of_a_part_in_b_flat_sounds_a_tone_lower() -> None:
    score = read(note("E5", 2, inner=TRILL), fifths=2, extra=B_FLAT)
    assert set(score.notes.sounding_pitch.tolist()) == {74, 76}


def test_a_trill_lasts_over_ties_and_may_begin_within() -> None:
    over = read(note("C5", 2, inner=TRILL + tied("start")) + note("C5", 2, inner=tied("stop")))
    assert len(over.notes) == 23
    within = read(note("C5", 2, inner=tied("start")) + note("C5", 2, inner=TRILL + tied("stop")))
    assert played(within)[0] == (72, 1.0)
    assert within.notes.sounding_pitch.tolist()[1:4] == [72, 74, 72]


def test_a_trills_line_goes_on_above_the_notes_beneath_it() -> None:
    begins = ornaments('<trill-mark/><wavy-line type="start"/>')
    ends = ornaments('<wavy-line type="stop"/>')
    score = read(note("C5", 1, inner=begins) + note("E5", 1) + note("G5", 1, inner=ends) + note("C5", 1))
    assert [pitch for pitch, _ in played(score)] == [
        *[72, 74] * 2,
        72,
        *[76, 77] * 2,
        76,
        *[79, 81] * 2,
        79,
        72,
    ]


def test_a_trill_may_begin_above() -> None:
    score = read(note("C5", 2, inner=ornaments('<trill-mark start-note="upper"/>')))
    assert score.notes.sounding_pitch.tolist()[:2] == [74, 72]
    assert score.notes.sounding_pitch.tolist()[-1] == 72


def test_trills_are_as_fast_at_any_tempo() -> None:
    slow = read_score(document(measures(attributes() + tempo(30) + note("C5", 1, inner=TRILL))))
    assert np.diff(slow.notes.onset_s).max() == pytest.approx(0.085, abs=0.003)


def test_mordents_and_turns() -> None:
    lower = read(note("C5", 2, inner=ornaments("<mordent/>")))
    assert played(lower) == [(72, 0.075), (71, 0.075), (72, 0.85)]
    upper = read(note("C5", 2, inner=ornaments('<inverted-mordent long="yes"/>')))
    assert [pitch for pitch, _ in played(upper)] == [72, 74, 72, 74, 72]
    turn = read(note("C5", 2, inner=ornaments("<turn/>")))
    assert played(turn) == [(74, 0.11), (72, 0.11), (71, 0.11), (72, 0.67)]
    sharp = '<accidental-mark placement="below">sharp</accidental-mark>'
    other = read(note("D5", 2, inner=ornaments(f"<inverted-turn/>{sharp}")))
    assert [pitch for pitch, _ in played(other)] == [73, 74, 76, 74]
    late = read(note("C5", 2, inner=ornaments("<delayed-turn/>")))
    assert played(late) == [(72, 0.56), (74, 0.11), (72, 0.11), (71, 0.11), (72, 0.11)]


def test_short_notes_have_quicker_ornaments() -> None:
    turn = read(note("C5", 0.25, inner=ornaments("<turn/>")))
    assert [length for _, length in played(turn)] == pytest.approx([0.031] * 4, abs=1e-3)


def test_a_tremolo_repeats_its_note_by_its_slashes_and_tongues_each() -> None:
    two = read(note("C5", 1, inner=ornaments('<tremolo type="single">2</tremolo>')))
    assert played(two) == [(72, 0.125)] * 4
    assert two.notes.tongued.tolist() == [1] * 4
    eighth = read(note("C5", 0.5, inner=ornaments("<tremolo>1</tremolo>")))
    assert played(eighth) == [(72, 0.125)] * 2
    fast = read(note("C5", 1, inner=ornaments("<tremolo>5</tremolo>")))
    assert len(fast.notes) == 8


def test_a_slur_into_a_trill_is_no_tongue() -> None:
    score = read(note("C5", 2, inner=slur("start")) + note("D5", 2, inner=TRILL + slur("stop")))
    assert score.notes.tongued.tolist() == [1] + [0] * (len(score.notes) - 1)


def test_grace_notes_after_a_trill_take_of_it() -> None:
    after = note("B4", 0.25, before='<grace slash="yes"/>') + note("C5", 0.25, before='<grace slash="yes"/>')
    score = read(note("C5", 2, inner=TRILL) + after + note("B4", 2))
    assert score.notes.sounding_pitch.tolist()[-3:] == [71, 72, 71]
    assert score.notes.onset_s.tolist()[-3] == pytest.approx(1.0 - 0.125)


def test_what_is_not_played_is_told_once() -> None:
    both = ornaments("<trill-mark/><schleifer/>")
    tremolo = ornaments('<tremolo type="start">3</tremolo>')
    gliss = notations('<glissando type="start"/>') + notations("<arpeggiate/>")
    score = read(note("C5", 1, inner=both) * 2 + note("C5", 1, inner=tremolo) + note("C5", inner=gliss))
    assert sorted(warning.message for warning in score.warnings) == [
        "a glissando: not played",
        "a schleifer: not played, and 1 more",
        "a tremolo: not played",
        "an arpeggiate: not played",
    ]


def test_trills_cannot_make_a_small_file_large() -> None:
    data = document(measures(attributes() + note("C5", 4, inner=TRILL), *[note("C5", 4, inner=TRILL)] * 9))
    with pytest.raises(ScoreLimitError, match="trills"):
        read_score(data, limits=Limits(notes=100))


def test_fingers_follow_the_trill() -> None:
    score = read(note("D4", 4, inner=TRILL))
    trumpet = INSTRUMENTS["trumpet"]
    played_part = trumpet.play(score, 0)
    assert len(played_part.fingering.notes) == len(score.notes)
    assert len({str(fingers) for fingers in played_part.fingering.notes}) == 2
