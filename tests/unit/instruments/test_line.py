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


def test_a_note_without_length_gives_way_to_the_note_at_its_place():
    line, warnings = line_of((0.0, 0.05, 74), (0.0, 0.49, 72), (0.5, 0.55, 74), (0.5, 0.99, 72))
    assert line.sounding_pitch.tolist() == [72, 72]
    np.testing.assert_allclose(line.end_s - line.onset_s, 0.49)
    assert [warning.kind for warning in warnings] == ["ornament_dropped", "ornament_dropped"]
    assert "no room" in warnings[0].message


def test_a_grace_note_at_the_place_of_its_note_sounds_before_it_where_there_is_room():
    line, warnings = line_of((0.0, 0.4, 70), (0.5, 0.54, 74), (0.5, 1.0, 72), (1.0, 1.5, 60), (1.0, 1.04, 74))
    assert line.sounding_pitch.tolist() == [70, 74, 72, 60]
    np.testing.assert_allclose(line.onset_s, [0.0, 0.46, 0.5, 1.0])
    assert [warning.kind for warning in warnings] == ["ornament_moved", "ornament_dropped"]


def test_a_grace_note_that_reaches_into_its_note_sounds_before_it():
    line, warnings = line_of((0.48, 0.53, 74), (0.5, 1.0, 72))
    assert line.sounding_pitch.tolist() == [74, 72]
    assert line.onset_s.tolist() == [0.48, 0.5]
    assert [warning.kind for warning in warnings] == ["note_shortened"]


def test_thirty_second_notes_are_graces_at_the_place_of_a_longer_note():
    # 62.5 ms: one at 120 a minute. One that begins early and reaches into its note may be a sixteenth.
    line, _ = line_of((0.0, 0.3, 60), (0.5, 0.5625, 65), (0.5, 1.0, 64), (1.48, 1.6, 59), (1.5, 2.0, 64))
    assert line.sounding_pitch.tolist() == [60, 65, 64, 59, 64]
    np.testing.assert_allclose(line.onset_s, [0.0, 0.4375, 0.5, 1.48, 1.5])


def test_a_chord_of_taps_and_a_staccato_melody_keep_their_top_note():
    line, _ = line_of((0.0, 0.05, 60), (0.0, 0.05, 67), (1.0, 2.0, 60), (1.0, 1.1, 67))
    assert line.sounding_pitch.tolist() == [67, 67]


def test_a_note_that_stands_twice_keeps_its_longer_copy():
    line, _ = line_of((0.0, 0.05, 60), (0.0, 1.0, 60))
    assert line.end_s.tolist() == [1.0]


def test_what_is_out_of_range_takes_the_place_of_nothing_that_can_be_played():
    specs = [
        (0.0, 0.01, 108),
        (0.0, 0.5, 60),
        (0.5, 1.0, 24),
        (0.5, 1.0, 62),
        (0.7, 0.8, 108),
        (1.2, 1.5, 108),
    ]
    log = WarningLog()
    line = playable_line(score_of(specs), 0, 0, log, playable=range(52, 90))
    assert line.sounding_pitch.tolist() == [60, 62, 108]
    assert line.end_s.tolist() == [0.5, 1.0, 1.5]
    assert [warning.kind for warning in log.warnings()] == ["out_of_range_dropped"] * 3
    assert "C4 sounds in its place" in log.warnings()[0].message


def test_a_held_key_switch_ends_where_the_music_begins():
    specs = [(0.0, 9.0, 24), (1.0, 1.5, 60), (1.48, 2.0, 24), (2.0, 2.5, 62)]
    line = playable_line(score_of(specs), 0, 0, WarningLog(), playable=range(52, 90))
    assert line.sounding_pitch.tolist() == [24, 60, 24, 62]
    assert line.end_s.tolist() == [1.0, 1.48, 2.0, 2.5]


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
    lost = score.notes.duration_s[line.note_index] - (line.end_s - line.onset_s)
    assert set(line.note_index[lost > 0.001].tolist()) == set(line.shortened.tolist())
    assert sum(warning.kind.endswith("dropped") for warning in warnings) == len(line.dropped)
    if not any(warning.kind == "ornament_dropped" for warning in warnings):
        assert line.sounding_pitch.max() == max(pitch for _, _, pitch in specs)


@given(notes, st.integers(40, 90), st.integers(0, 40))
def test_what_the_instrument_does_not_have_changes_nothing_that_it_has(
    specs: list[NoteSpec], lowest: int, span: int
):
    instrument = range(lowest, lowest + span)
    score = score_of(specs)
    line = playable_line(score, 0, 0, WarningLog(), playable=instrument)
    assert np.all(line.end_s > line.onset_s)
    assert np.all(line.onset_s[1:] >= line.end_s[:-1])
    assert sorted([*line.note_index.tolist(), *line.dropped.tolist()]) == list(range(len(specs)))
    alone = [spec for spec in specs if spec[2] in instrument]
    if alone:
        wanted, _ = line_of(*alone)
        within = np.isin(line.sounding_pitch, instrument)
        assert line.sounding_pitch[within].tolist() == wanted.sounding_pitch.tolist()
        assert line.onset_s[within].tolist() == wanted.onset_s.tolist()
        assert np.all(wanted.end_s - line.end_s[within] <= 0.5 * (wanted.end_s - wanted.onset_s))
