"""Fingering over phrases."""

import itertools
from typing import Any, SupportsIndex

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.unit.instruments.scores import NoteSpec, melody, score_of, written

from reina.instruments import ValvesFingering
from reina.instruments.brass.chart import Valves
from reina.instruments.brass.family import FAMILY
from reina.instruments.brass.fingering import BrassPart
from reina.instruments.brass.phrase import Choice, Costs, choose, moved, note_cost, step_cost
from reina.music import ScoreError

TRUMPET = FAMILY["trumpet"]


def play(notes: list[NoteSpec]) -> BrassPart:
    return TRUMPET.play(score_of(notes), 0)


def fingerings(notes: list[NoteSpec]) -> list[list[int] | None]:
    played = play(notes)
    return [pressed(played, note) for note in range(len(played.line))]


def pressed(played: BrassPart, note: int) -> list[int] | None:
    fingering = played.fingering.notes[note]
    return list(fingering.valves) if isinstance(fingering, ValvesFingering) else None


def test_slow_notes_take_the_usual_fingering():
    for direction in (range(52, 90), range(89, 51, -1)):
        pitches = list(direction)
        played = play(melody(pitches, interval_s=0.5))
        assert played.fingering.primary.all()
        for note, pitch in enumerate(pitches):
            assert pressed(played, note) == list(TRUMPET.model.chart[pitch].primary)


def test_valve_1_is_the_first_column():
    played = play(melody(written(65, 71, 66)))
    assert played.fingering.valves.tolist() == [
        [True, False, False],
        [False, True, False],
        [False, True, False],
    ]
    assert fingerings(melody(written(62))) == [[1, 3]]


@pytest.mark.parametrize("interval", [0.125, 0.1, 0.08])
def test_a_fast_e_between_two_f_takes_1_2(interval: float):
    # As in Arban's studies: E5 with 1-2 lies on F5's harmonic, the middle finger alone moves.
    assert fingerings(melody(written(77, 76, 77), interval)) == [[1], [1, 2], [1]]
    assert fingerings(melody(written(*[77, 76] * 6, 77), interval)) == [[1], [1, 2]] * 6 + [[1]]


def test_a_slow_e_between_two_f_is_open():
    assert fingerings(melody(written(77, 76, 77), 0.4)) == [[1], [], [1]]


@pytest.mark.parametrize("lower", range(52, 88))
def test_a_fast_trill_asks_no_more_of_fingers_and_lips_than_the_usual_fingerings(lower: int):
    chart, tube = TRUMPET.model.chart, TRUMPET.model.tube

    def effort(pitches: tuple[int, int], a: Valves, b: Valves) -> float:
        harmonics = abs(tube.harmonic(pitches[0], a) - tube.harmonic(pitches[1], b))
        return len(moved(a, b)) + 0.75 * harmonics * (1 if a != b else 2)

    for upper in (lower + 1, lower + 2):
        if upper not in chart:
            continue
        pressed = fingerings(melody([lower, upper] * 8, 0.075))[7:9]
        (taken_upper, taken_lower) = (tuple(valves or ()) for valves in pressed)
        usual = effort((lower, upper), chart[lower].primary, chart[upper].primary)
        assert effort((lower, upper), taken_lower, taken_upper) <= usual


def test_a_fast_a_beside_g_takes_3_and_a_slow_one_1_2():
    assert fingerings(melody(written(67, 69, 67), 0.08))[1] == [3]
    assert fingerings(melody(written(67, 69, 67), 0.3)) == [[], [1, 2], []]


@pytest.mark.parametrize(
    "scale", [(60, 62, 64, 65, 67, 69, 71, 72, 74, 76, 77, 79), (70, 72, 74, 75, 77, 79, 81, 82)]
)
def test_fast_scales_keep_their_usual_fingerings(scale: tuple[int, ...]):
    played = play(melody(written(*scale, *reversed(scale)), 0.125))
    assert played.fingering.primary.all()


def test_each_note_says_what_was_chosen_and_why():
    played = play(melody(written(77, 76, 77), 0.1))
    usual, alternate, _ = played.fingering.reasons
    assert usual == "1: usual for written F5"
    assert alternate == (
        "1-2 in place of open beside F5 at 10 notes a second: "
        "stays on harmonic 6, so that the valves alone change the note"
    )
    fast = play(melody(written(67, 69, 72), 0.08)).fingering.reasons[1]
    assert fast == "3 in place of 1-2 beside G4, C5 at 12 notes a second: moves 2 fingers and not 4"


def test_usual_fingerings_alone_are_those_of_the_chart():
    score = score_of(melody(written(77, 76, 77, 69, 67, 69, 91, 90, 91), 0.08))
    trumpet = TRUMPET
    assert not trumpet.play(score, 0).fingering.primary.all()
    usual = trumpet.play(score, 0, usual_fingerings=True)
    chart = {note.sounding_pitch: list(note.fingerings[0]) for note in trumpet.fingering_chart}
    pitches = usual.line.sounding_pitch.tolist()
    assert [pressed(usual, note) for note in range(len(pitches))] == [chart[p] for p in pitches]
    assert usual.fingering.primary.all()


def test_what_is_out_of_range_is_not_played_with_other_valves():
    played = play(melody([51, 52, 89, 90]))
    assert played.fingering.playable.tolist() == [False, True, True, False]
    assert not played.fingering.valves[[0, 3]].any()
    assert [pressed(played, note) for note in range(4)] == [None, [1, 2, 3], [], None]
    assert played.fingering.reasons[0] == "E♭3 lies below the lowest note of the B♭ trumpet, E3"
    assert played.fingering.reasons[3] == "F♯6 lies above the highest note of the B♭ trumpet, F6"
    assert [warning.kind for warning in played.warnings] == ["not_playable", "not_playable"]
    assert played.warnings[0].place == "part 0, note 0 at 0.000 s"


def test_the_third_slide_goes_out_for_long_low_notes_only():
    slow = play(melody(written(61, 62, 64, 65), 0.5)).fingering
    assert slow.slide[0] > slow.slide[1] > 0.1
    assert list(slow.slide[2:]) == [0, 0]
    np.testing.assert_allclose(slow.cents[:2], 0, atol=1e-9)
    fast = play(melody(written(61, 62, 64, 65), 0.1)).fingering
    assert list(fast.slide) == [0, 0, 0, 0]
    assert fast.cents[0] > 30


def test_written_pitch_is_said_to_be_so():
    score = score_of(melody([72]))
    played = TRUMPET.play(score, 0, written=True)
    assert played.transposition == -2
    assert played.line.sounding_pitch.tolist() == [70]
    assert pressed(played, 0) == []
    assert [warning.kind for warning in played.warnings] == ["written_pitch"]
    assert TRUMPET.play(score, 0).line.sounding_pitch.tolist() == [72]


def test_transposition_and_octave_fit_are_told():
    low = score_of(melody([40, 43, 45, 53]))
    trumpet = TRUMPET
    as_it_is = trumpet.play(low, 0)
    assert as_it_is.fingering.playable.tolist() == [False, False, False, True]
    assert [w.kind for w in as_it_is.warnings].count("octave_fit_possible") == 1
    fitted = trumpet.play(low, 0, octave_fit=True)
    assert fitted.transposition == 12
    assert fitted.fingering.playable.all()
    assert [(w.kind, "1 octave up" in w.message) for w in fitted.warnings] == [("octave_fit", True)]
    by_hand = trumpet.play(low, 0, 14)
    assert by_hand.line.sounding_pitch.tolist() == [54, 57, 59, 67]
    assert by_hand.warnings == ()
    high = trumpet.play(score_of(melody([96, 98, 100])), 0, octave_fit=True)
    assert high.transposition == -12


def test_a_part_that_is_not_there_is_refused():
    with pytest.raises(ScoreError, match="no part 1; there are 0 to 0"):
        TRUMPET.play(score_of(melody([60])), 1)


def test_a_rest_begins_anew():
    # With a breath between, the neighbour no longer speaks for the alternate.
    notes = [
        *melody(written(77), 0.1),
        *melody(written(76), 0.1, start=1.0),
        *melody(written(77), 0.1, start=2.0),
    ]
    assert fingerings(notes) == [[1], [], [1]]


def test_moved_fingers_and_speed():
    assert moved((1, 2), (2, 3)) == {1, 3}
    costs = Costs()
    assert costs.speed(costs.reference_s) == 1
    assert costs.speed(0) == costs.fastest
    two = step_cost(Choice((), 0, 4, 0), Choice((1, 2), 0, 4, 0), costs.reference_s, costs)
    one = step_cost(Choice((), 0, 4, 0), Choice((1,), 0, 4, 0), costs.reference_s, costs)
    lips = step_cost(Choice((), 0, 4, 0), Choice((), 0, 5, 0), costs.reference_s, costs)
    assert one < two < 2 * one
    assert lips == costs.harmonic * costs.lips_alone
    assert note_cost(Choice((), 0, 4, 0), 1.0, costs) == 0


valves = st.sets(st.integers(1, 3)).map(lambda pressed: tuple(sorted(pressed)))
tables = st.lists(
    st.lists(st.tuples(valves, st.integers(2, 12), st.floats(-40, 40)), min_size=1, max_size=3),
    min_size=1,
    max_size=5,
)


@settings(max_examples=60)
@given(tables, st.lists(st.sampled_from([0.05, 0.1, 0.2, 0.5]), min_size=5, max_size=5))
def test_no_way_through_the_phrase_is_cheaper(
    table: list[list[tuple[Valves, int, float]]], intervals: list[float]
):
    costs = Costs()
    choices = [[Choice(v, rank, h, c) for rank, (v, h, c) in enumerate(entries)] for entries in table]
    onsets = [sum(intervals[:note]) for note in range(len(choices))]
    ends = [onset + 0.04 for onset in onsets]

    def cost(way: tuple[int, ...]) -> float:
        taken = [choices[note][index] for note, index in enumerate(way)]
        alone = sum(note_cost(c, e - o, costs) for c, o, e in zip(taken, onsets, ends, strict=True))
        steps = sum(
            step_cost(a, b, onsets[i + 1] - onsets[i], costs)
            for i, (a, b) in enumerate(itertools.pairwise(taken))
        )
        return alone + steps

    best = min(cost(way) for way in itertools.product(*(range(len(of_note)) for of_note in choices)))
    assert cost(tuple(choose(choices, onsets, ends, costs))) == pytest.approx(best)


@settings(max_examples=60)
@given(st.lists(st.tuples(st.integers(45, 95), st.sampled_from([0.06, 0.12, 0.3])), min_size=1, max_size=25))
def test_every_playable_note_is_played_with_a_fingering_of_its_chart(notes: list[tuple[int, float]]):
    specs: list[NoteSpec] = []
    at = 0.0
    for pitch, duration in notes:
        specs.append((at, at + duration, pitch))
        at += duration
    played = play(specs)
    for note, (pitch, _) in enumerate(notes):
        down = pressed(played, note)
        if 52 <= pitch <= 89:
            entry = TRUMPET.model.chart[pitch]
            assert down is not None
            assert tuple(down) in (entry.primary, *entry.alternates)
            assert played.fingering.primary[note] == (tuple(down) == entry.primary)
        else:
            assert down is None


class CountedNames(list[str]):
    """Counts how often some of them are copied."""

    copies = 0

    def __getitem__(self, index: SupportsIndex | slice) -> Any:
        if isinstance(index, slice):
            self.copies += 1
            return super().__getitem__(index)
        return super().__getitem__(index)


def test_of_a_long_phrase_no_note_costs_the_phrase():
    line = play(melody([60 + at % 20 for at in range(300)], interval_s=0.1)).line
    names = CountedNames("C" for _ in range(len(line)))
    TRUMPET.finger(line, names)
    assert len(set(line.phrase.tolist())) == 1
    assert names.copies == 1
