"""The score that players play."""

import numpy as np
from tests.unit.instruments.scores import melody, score_of

from reina.instruments import INSTRUMENTS
from reina.instruments.as_played import score_as_played

TRUMPET = INSTRUMENTS["trumpet"]


def test_chords_become_the_line_and_other_parts_stay() -> None:
    chords = [(0.0, 0.5, 60), (0.0, 0.5, 64), (0.5, 1.0, 67), (1.0, 1.5, 20)]
    score = score_of(melody([70, 71]), chords, names=("Violin", "Trumpet"))
    played = TRUMPET.play(score, 1, 2)
    line = score_as_played(score, [played])
    own = line.notes.take(np.flatnonzero(line.notes.part == 1))
    assert own.sounding_pitch.tolist() == [66, 69]
    assert own.onset_s.tolist() == [0.0, 0.5]
    others = line.notes.take(np.flatnonzero(line.notes.part == 0))
    assert others.sounding_pitch.tolist() == [70, 71]
    assert score.notes.sounding_pitch.tolist().count(20) == 1


def test_joined_parts_are_one_and_the_rest_is_counted_anew() -> None:
    score = score_of(melody([60, 62]), melody([64, 65], start=2.0), melody([50]), names=("A", "B", "C"))
    played = TRUMPET.play(score, 0, 0, joined_parts=(1,))
    line = score_as_played(score, [played])
    assert [part.name for part in line.parts] == ["A", "C"]
    assert [part.index for part in line.parts] == [0, 1]
    assert line.notes.part.tolist().count(0) == 4


def test_a_part_that_nobody_can_play_is_gone() -> None:
    score = score_of(melody([10, 12]), melody([60]), names=("Trumpet", "Flute"))
    line = score_as_played(score, [TRUMPET.play(score, 0, 0)])
    assert [part.name for part in line.parts] == ["Flute"]
    assert line.notes.sounding_pitch.tolist() == [60]
