"""Parts that one player plays together."""

import numpy as np
import pytest
from tests.unit.instruments.scores import melody, score_of

from reina.instruments import describe_notes, describe_score
from reina.instruments.brass.family import FAMILY
from reina.music import NotInScoreError

TRUMPET = FAMILY["trumpet"]
SCORE = score_of(
    melody([65, 67], start=0.0),
    melody([84], start=0.5),
    melody([69, 70], start=1.0),
    melody([36], start=0.0),
    melody([62, 72], start=2.0),
    names=["Lead", "Flute", "Lead solo", "Drums", "Lead"],
    programs=[56, 73, 56, None, 56],
    drums=3,
)
"""A melody over parts 0, 2 and 4; a flute and drums beside it."""


def test_the_line_is_made_of_the_notes_of_all_of_them():
    played = TRUMPET.play(SCORE, 0, joined_parts=(4, 2))
    assert (played.part, played.joined_parts, played.parts) == (0, (2, 4), (0, 2, 4))
    assert played.line.sounding_pitch.tolist() == [65, 67, 69, 70, 62, 72]
    assert SCORE.notes.part[played.line.note_index].tolist() == [0, 0, 2, 2, 4, 4]
    assert np.all(np.diff(played.line.onset_s) > 0)
    assert played.fingering.playable.all()


def test_a_part_is_played_alone_unless_others_are_joined():
    played = TRUMPET.play(SCORE, 0)
    assert (played.joined_parts, played.parts) == ((), (0,))
    assert played.line.sounding_pitch.tolist() == [65, 67]


def test_fingerings_are_chosen_over_the_whole_line():
    one_part = score_of(melody([65, 67, 69, 70, 62, 72], interval_s=0.1))
    spread = score_of(
        melody([65, 69, 62], interval_s=0.2, hold=0.475),
        melody([67, 70, 72], interval_s=0.2, hold=0.475, start=0.1),
    )
    whole, joined = TRUMPET.play(one_part, 0), TRUMPET.play(spread, 1, joined_parts=[0])
    assert joined.fingering.valves.tolist() == whole.fingering.valves.tolist()
    assert joined.fingering.reasons == whole.fingering.reasons
    assert joined.line.phrase.tolist() == whole.line.phrase.tolist()


def test_notes_of_two_parts_at_one_time_are_a_chord():
    score = score_of([(0.0, 1.0, 65)], [(0.0, 1.0, 69)])
    played = TRUMPET.play(score, 1, joined_parts=(0,))
    assert played.line.sounding_pitch.tolist() == [69]
    (warning,) = played.warnings
    assert (warning.kind, warning.place) == ("chord_note_dropped", "part 0, note 0 at 0.000 s")
    low, high = describe_notes(score, TRUMPET, played)
    assert (low["valves"], high["valves"]) == (None, [2])
    assert "another one" in low["reason"]


def test_overlaps_of_two_parts_are_shortened_and_told_of_the_part_they_lie_in():
    score = score_of([(1.0, 2.0, 65)], [(0.0, 1.5, 69)])
    played = TRUMPET.play(score, 0, joined_parts=(1,))
    assert played.line.end_s.tolist() == [1.0, 2.0]
    assert [(warning.kind, warning.place) for warning in played.warnings] == [
        ("note_shortened", "part 1, note 0 at 0.000 s")
    ]


def test_all_of_them_are_transposed_and_moved_by_the_same_octaves():
    score = score_of(melody([43, 45]), melody([46, 48], start=1.0), melody([90], start=2.0))
    played = TRUMPET.play(score, 0, 2, octave_fit=True, joined_parts=(1,))
    assert played.transposition == 14
    assert played.line.sounding_pitch.tolist() == [57, 59, 60, 62]
    notes = describe_notes(score, TRUMPET, played)
    assert [note["sounding_pitch"] for note in notes] == [57, 59, 60, 62, 90]
    assert [note["reason"] for note in notes if note["valves"] is None] == ["nobody plays this part"]


def test_what_is_out_of_range_is_told_of_the_part_it_lies_in():
    score = score_of(melody([60]), melody([30], start=1.0))
    played = TRUMPET.play(score, 0, joined_parts=(1,))
    told = {warning.kind: warning.place for warning in played.warnings}
    assert told["not_playable"] == "part 1, note 1 at 1.000 s"


def test_a_description_names_them():
    described = describe_score(SCORE, TRUMPET, TRUMPET.play(SCORE, 2, joined_parts=(0,)))
    assert (described["part"], described["joined_parts"]) == (2, [0])
    assert [note["part"] for note in described["notes"] if note["valves"] is not None] == [0, 0, 2, 2]


@pytest.mark.parametrize(
    ("joined_parts", "place", "fault"),
    [
        ((1, 9), "joined_parts/1", "there is no part 9"),
        ((-1,), "joined_parts/0", "there is no part -1"),
        ((0,), "joined_parts/0", "part 0 is the part that the others are joined to"),
        ((1, 2, 1), "joined_parts/2", "part 1 is named twice"),
        ((3,), "joined_parts/0", "part 3 (“Drums”) is drums"),
    ],
)
def test_what_cannot_be_joined_is_told_with_what_can(joined_parts: tuple[int, ...], place: str, fault: str):
    with pytest.raises(NotInScoreError) as refused:
        TRUMPET.play(SCORE, 0, joined_parts=joined_parts)
    assert refused.value.location == place
    assert refused.value.detail == f"{fault}; parts that can be joined to part 0: 1 to 2, 4"


def test_nothing_can_be_joined_to_the_only_part():
    with pytest.raises(NotInScoreError, match="parts that can be joined to part 0: none"):
        TRUMPET.play(score_of(melody([60])), 0, joined_parts=(1,))
