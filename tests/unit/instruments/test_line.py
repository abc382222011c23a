"""Chords and overlaps become one note at a time, and each note that is changed is told of."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.instruments.scores import NoteSpec, score_of

from reina.instruments.line import playable_line
from reina.instruments.played import Line
from reina.music import ScoreWarning, WarningLog


def line_of(*notes: NoteSpec, transposition: int = 0) -> tuple[Line, tuple[ScoreWarning, ...]]:
    log = WarningLog(10_000)
    return playable_line(score_of(notes), 0, transposition, log), log.warnings()


def test_a_line_is_left_as_it_is():
    line, warnings = line_of((0.0, 0.5, 60), (0.5, 1.0, 62), (1.5, 2.0, 64))
    assert line.note_index.tolist() == [0, 1, 2]
    assert line.onset_s.tolist() == [0.0, 0.5, 1.5]
    assert line.end_s.tolist() == [0.5, 1.0, 2.0]
    assert line.sounding_pitch.tolist() == [60, 62, 64]
    assert warnings == ()


def test_of_a_chord_the_top_note_is_played():
    line, warnings = line_of((0.0, 1.0, 60), (0.0, 1.0, 67), (0.01, 1.0, 64))
    assert line.sounding_pitch.tolist() == [67]
    assert [warning.kind for warning in warnings] == ["chord_note_dropped", "chord_note_dropped"]
    assert line.dropped.tolist() == [0, 2]
    assert "G4 sounds above" in warnings[0].message


def test_a_spread_chord_keeps_its_top_note():
    line, _ = line_of((0.0, 1.0, 60), (0.012, 1.0, 64), (0.024, 1.0, 67))
    assert line.sounding_pitch.tolist() == [67]


def test_the_same_note_twice_is_played_once():
    line, warnings = line_of((0.0, 1.0, 60), (0.0, 1.0, 60))
    assert line.sounding_pitch.tolist() == [60]
    assert len(warnings) == 1


def test_an_overlap_ends_the_earlier_note():
    line, warnings = line_of((0.0, 1.0, 60), (0.9, 2.0, 62), (1.9, 3.0, 59))
    assert line.end_s.tolist() == [0.9, 1.9, 3.0]
    assert [warning.kind for warning in warnings] == ["note_shortened", "note_shortened"]
    assert line.shortened.tolist() == [0, 1]
    assert "100 ms earlier" in warnings[0].message


def test_an_inner_voice_is_left_out():
    line, warnings = line_of((0.0, 2.0, 72), (0.5, 1.0, 64), (1.0, 1.5, 65), (2.0, 3.0, 71))
    assert line.sounding_pitch.tolist() == [72, 71]
    assert [warning.kind for warning in warnings] == ["inner_note_dropped", "inner_note_dropped"]


def test_a_higher_note_goes_before_a_held_one():
    line, _ = line_of((0.0, 2.0, 60), (0.5, 1.0, 72))
    assert line.sounding_pitch.tolist() == [60, 72]
    assert line.end_s.tolist() == [0.5, 1.0]


def test_a_grace_note_is_no_chord():
    line, warnings = line_of((0.0, 0.02, 62), (0.02, 1.0, 60))
    assert line.sounding_pitch.tolist() == [62, 60]
    assert warnings == ()


def test_transposition_out_of_midi_is_told():
    line, warnings = line_of((0.0, 1.0, 60), (1.0, 2.0, 120), transposition=12)
    assert line.sounding_pitch.tolist() == [72]
    assert [warning.kind for warning in warnings] == ["pitch_out_of_midi"]


def test_phrases_begin_after_a_breath():
    line, _ = line_of((0.0, 0.5, 60), (0.7, 1.0, 62), (1.25, 2.0, 64), (2.3, 3.0, 65))
    assert line.phrase.tolist() == [0, 0, 1, 2]


def test_only_the_part_is_taken():
    score = score_of([(0.0, 1.0, 60)], [(0.0, 1.0, 72), (1.0, 2.0, 74)])
    line = playable_line(score, 1, 0, WarningLog())
    assert score.notes.sounding_pitch[line.note_index].tolist() == [72, 74]


notes = st.lists(
    st.tuples(st.floats(0, 5), st.floats(0.001, 2), st.integers(40, 90)).map(
        lambda n: (n[0], n[0] + n[1], n[2])
    ),
    min_size=1,
    max_size=30,
)


@given(notes)
def test_one_note_at_a_time_and_nothing_is_lost_unsaid(specs: list[NoteSpec]):
    line, warnings = line_of(*specs)
    assert np.all(line.end_s > line.onset_s)
    assert np.all(line.onset_s[1:] >= line.end_s[:-1])
    assert sorted([*line.note_index.tolist(), *line.dropped.tolist()]) == list(range(len(specs)))
    score = score_of(specs)
    ends = score.notes.end_s[line.note_index]
    cut = set(line.note_index[ends - line.end_s > 0.001].tolist())
    assert cut == set(line.shortened.tolist())
    assert sum(warning.kind.endswith("dropped") for warning in warnings) == len(line.dropped)
    assert line.sounding_pitch.max() == max(pitch for _, _, pitch in specs)
