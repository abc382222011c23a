"""Played notes as written ones: cases with what a copyist would write, and what holds of all of them."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.unit.notation.rhythms import score_of_beats, text, write, written

from reina.notation import WrittenPart, write_part
from reina.notation.values import VALUES

QUARTERS = [0.0, 1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ("onsets", "bars"),
    [
        (QUARTERS, ["q q q q"]),
        ([0, 1.5, 2, 3.5], ["q. e q. e"]),
        ([0, 0.75, 1, 1.75, 2], ["e._0 s_0 e._1 s_1 h"]),
        ([0, 0.5, 1, 1.5, 2, 3], ["e_0 e_0 e_0 e_0 q q"]),
        ([0, 0.25, 0.5, 0.75, 1, 1.5, 2], ["s_0 s_0 s_0 s_0 e_1 e_1 h"]),
        ([0, 0.5, 1.5, 2, 3], ["e q e q q"]),
        ([0, 1, 3], ["q h q"]),
        ([0, 1 / 3, 2 / 3, 1, 2], ["e3_0 e3_0 e3_0 q h"]),
        ([0, 2 / 3, 1, 5 / 3, 2], ["q3 e3 q3 e3 h"]),
        ([0, 1 / 6, 1 / 3, 0.5, 2 / 3, 5 / 6, 1], ["s3_0 s3_0 s3_0 s3_0 s3_0 s3_0 h."]),
        ([0, 2 / 3, 4 / 3, 2, 3], ["q3 q3 q3 q q"]),
        ([0, 0.125, 0.25, 0.5, 1], ["t_0 t_0 s_0 e_0 h."]),
        ([0, 2.5, 3], ["h~ e_0 e_0 q"]),
        ([0, 0.5, 3], ["e q.~ q q"]),
    ],
)
def test_values_in_common_time(onsets: list[float], bars: list[str]):
    assert written(onsets, last=4.0 - onsets[-1]) == bars


@pytest.mark.parametrize(
    ("metre", "onsets", "last", "bars"),
    [
        ((3, 4), [0, 2, 3, 4, 5], 1, ["h q", "q q q"]),
        ((3, 4), [0, 0.5, 1, 1.5, 2, 2.5], 0.5, ["e_0 e_0 e_0 e_0 e_0 e_0"]),
        ((6, 8), [0, 1, 1.5, 2, 2.5], 0.5, ["q e e_0 e_0 e_0"]),
        ((6, 8), [0, 0.5, 1.5], 1.5, ["e q q."]),
        ((6, 8), [0, 0.75, 1, 1.5, 1.75, 2, 2.25, 2.5, 2.75], 0.25, ["e._0 s_0 e_0 s_1 s_1 s_1 s_1 s_1 s_1"]),
        ((6, 8), [0, 0.75, 1.5], 1.5, ["e._0 e._0 q."]),
        ((12, 8), [0, 3], 3, ["h. h."]),
        ((9, 8), [0], 4.5, ["h.~ q."]),
        ((5, 8), [0, 0.5, 1, 1.5, 2], 0.5, ["e_0 e_0 e_0 e_1 e_1"]),
        ((7, 8), [0, 1, 2], 1.5, ["q q q."]),
        ((2, 2), [0, 2, 3], 1, ["h q q"]),
        ((5, 4), [0, 3], 2, ["h. h"]),
        ((3, 8), [0, 0.5, 1], 0.5, ["e_0 e_0 e_0"]),
        ((4, 2), [0, 4], 4, ["w w"]),
    ],
)
def test_values_in_other_metres(metre: tuple[int, int], onsets: list[float], last: float, bars: list[str]):
    assert written(onsets, last=last, metres=[(0.0, *metre)]) == bars


def test_a_pickup_is_the_end_of_a_bar():
    metres = [(0.0, 1, 8), (0.5, 6, 8)]
    score = score_of_beats([0, 0.5, 2], [0.48, 1.95, 3.4], metres=metres)
    part = write(score)
    assert [text(measure) for measure in part.measures] == ["e", "q. q."]
    assert [(one.bar.number, one.bar.numerator, one.bar.denominator) for one in part.measures] == [
        (0, 6, 8),
        (1, 6, 8),
    ]
    assert written([0, 0.5, 1, 2, 3], metres=[(0.0, 4, 4)], pickup=1.0, last=1) == ["e_0 e_0", "q q q rq"]


def test_a_metre_that_changes_early_cuts_its_bar():
    assert written([0, 4, 6, 7, 8], metres=[(0.0, 4, 4), (6.0, 3, 4)], last=1) == ["w", "h", "q q q"]


def test_notes_over_bar_lines_are_tied():
    assert written([0, 3, 6], last=2) == ["h. q~", "h h"]
    assert written([0, 3.5, 12], last=4) == ["h.~ e_0 e_0~", "w~", "w", "w"]


def test_rests():
    score = score_of_beats([1, 8.5, 15], [1.95, 9, 16])
    assert [text(measure) for measure in write(score).measures] == [
        "rq q rh",
        "rW",
        "re e rq rh",
        "rh rq q",
    ]
    score = score_of_beats([0, 1.5], [0.5, 3], metres=[(0.0, 6, 8)])
    assert [text(measure) for measure in write(score).measures] == ["e re re q."]


def test_notes_that_are_let_go_early_are_staccato_or_rested():
    assert written(QUARTERS, hold=0.5, last=1)[0].startswith("q' q' q'")
    assert written([0, 2], hold=0.5, last=2) == ["q rq q rq"]
    assert written(QUARTERS, hold=0.8) == ["q q q q"]


def test_what_has_no_room_is_a_grace_note():
    assert written([0, 0.94, 1, 2], last=1) == ["q qg q rq"]


def test_a_trill_is_one_note():
    onsets = [0.0, *(2 + 0.1875 * step for step in range(8)), 4.0]
    ends = [*(onset - 0.01 for onset in onsets[1:]), 8.0]
    pitches = [74, *([78, 76] * 4), 78]
    part = write(score_of_beats(onsets, ends, bpm=112, pitches=pitches))
    assert [text(measure) for measure in part.measures] == ["h h", "w"]
    trill = part.trills[1]
    assert (trill.last, pitches[trill.main], pitches[trill.upper]) == (8, 76, 78)


def test_an_alternation_that_can_be_counted_is_no_trill():
    onsets = [step * 0.25 for step in range(16)]
    pitches = [74, 76] * 8
    score = score_of_beats(onsets, [onset + 0.24 for onset in onsets], bpm=100, pitches=pitches)
    assert text(write(score).measures[0]).count("s_") == 16


def played(onsets: np.ndarray, seed: int, spread_beats: float) -> list[float]:
    rng = np.random.default_rng(seed)
    return np.maximum(onsets + rng.normal(0, spread_beats, len(onsets)), 0.0).tolist()


TUNE = np.array([0, 1, 1.5, 2, 3, 4, 4.5, 5, 5.5, 6, 7, 8, 9.5, 10, 12, 12.25, 12.5, 12.75, 13, 14, 15, 16.0])


@pytest.mark.parametrize("seed", range(10))
def test_what_people_play_is_written_as_it_was_meant(seed: int):
    """At 100 beats a minute, 12 ms off (a standard deviation, as pianists have)."""
    exact = written(TUNE.tolist(), last=4, bpm=100)
    assert written(played(TUNE, seed, 0.012 * 100 / 60), last=4, bpm=100) == exact


@pytest.mark.parametrize("seed", range(5))
def test_played_triplets_are_triplets(seed: int):
    onsets = np.concatenate([beat + np.array([0, 1 / 3, 2 / 3]) for beat in range(4)])
    got = written(played(onsets, seed, 0.02), last=1 / 3)
    assert got == ["e3_0 e3_0 e3_0 e3_1 e3_1 e3_1 e3_2 e3_2 e3_2 e3_3 e3_3 e3_3"]


@pytest.mark.parametrize("off", [0.6, 2 / 3, 0.7])
def test_swung_eighths_are_written_even(off: float):
    onsets = [beat + phase for beat in range(12) for phase in (0.0, off)]
    part = write(score_of_beats(onsets, [*onsets[1:], 12.0]))
    assert part.swing
    assert [text(measure) for measure in part.measures] == ["e_0 e_0 e_0 e_0 e_1 e_1 e_1 e_1"] * 3


def test_triplets_among_even_eighths_are_no_swing():
    onsets = [0, 1 / 3, 2 / 3, 1, 1.5, 2, 2.5, 3, 3.5, 4, 14 / 3, 5, 17 / 3]
    assert not write(score_of_beats(onsets, [*onsets[1:], 6.0])).swing


SIMPLE = [(4, 4), (3, 4), (2, 4), (2, 2), (5, 4), (4, 3)]
METRES = st.sampled_from([*SIMPLE, (6, 8), (9, 8), (12, 8), (5, 8), (7, 8), (3, 8), (11, 16)])


@st.composite
def anything(draw: st.DrawFn) -> tuple[list[float], list[float], list[tuple[float, int, int]], float]:
    gaps = draw(st.lists(st.floats(0.02, 5.0), min_size=1, max_size=40))
    onsets = (np.cumsum(gaps) - draw(st.floats(0.0, 1.0)) * gaps[0]).tolist()
    holds = draw(st.lists(st.floats(0.02, 1.0), min_size=len(gaps), max_size=len(gaps)))
    lengths = [*np.diff(onsets).tolist(), draw(st.floats(0.05, 9.0))]
    ends = [onset + hold * length for onset, hold, length in zip(onsets, holds, lengths, strict=True)]
    metres = [(0.0, *draw(METRES)), (draw(st.floats(0.3, 30.0)), *draw(METRES))]
    return onsets, ends, metres, draw(st.floats(40, 250))


def check(part: WrittenPart, notes: int) -> None:
    """What holds of whatever is written."""
    begin = 0
    tied = None
    seen: list[tuple[int, int]] = []
    lasted: dict[int, int] = {}
    for measure in part.measures:
        assert measure.bar.begin == begin
        begin += measure.bar.shape.ticks
        assert sum(entry.ticks for entry in measure.entries) == measure.bar.shape.ticks
        at = 0
        for entry in measure.entries:
            assert entry.begin == at
            at += entry.ticks
            if not entry.is_bar_rest:
                assert entry.ticks == entry.value.ticks * (1 if entry.tuplet is None else 2 / 3)
                assert entry.value in VALUES.values()
            if entry.tied_from:
                assert entry.placed is not None
                assert entry.placed.note == tied
            elif entry.placed is not None:
                assert tied is None
                assert measure.bar.begin + entry.begin == entry.placed.begin
                seen.append((entry.placed.begin, entry.placed.note))
            if entry.placed is None:
                assert not entry.tied_to
                assert tied is None
            else:
                lasted[entry.placed.note] = lasted.get(entry.placed.note, 0) + entry.ticks
                assert lasted[entry.placed.note] <= entry.placed.end - entry.placed.begin
            tied = entry.placed.note if entry.placed is not None and entry.tied_to else None
        for tuplet in range(len(measure.tuplets)):
            inside = [entry.ticks for entry in measure.entries if entry.tuplet == tuplet]
            assert sum(inside) in (48, 96)
        for number in {entry.beam for entry in measure.entries} - {None}:
            beamed = [index for index, entry in enumerate(measure.entries) if entry.beam == number]
            assert beamed == list(range(beamed[0], beamed[-1] + 1))
            assert len(beamed) > 1
            assert all(measure.entries[index].value.fraction >= 8 for index in beamed)
    assert tied is None
    assert all(a < b for a, b in pairwise(seen))
    placed = {entry.placed.note: entry.placed for m in part.measures for entry in m.entries if entry.placed}
    assert lasted == {note: one.end - one.begin for note, one in placed.items()}
    told = set(placed) | {grace for one in placed.values() for grace in one.graces}
    told |= {note for trill in part.trills.values() for note in range(trill.first, trill.last + 1)}
    assert told == set(range(notes))


@settings(max_examples=200)
@given(anything())
def test_bars_are_full_onsets_in_order_ties_whole_and_no_note_is_lost(
    case: tuple[list[float], list[float], list[tuple[float, int, int]], float],
):
    onsets, ends, metres, bpm = case
    check(write(score_of_beats(onsets, ends, metres=metres, bpm=bpm)), len(onsets))


def test_a_last_note_that_is_written_with_the_next_bar_has_that_bar():
    """Beats of a third of a whole note, so that half of one is longer than the note."""
    onsets = [1.125, 2.25, 3.875, 5.75, 7.59375, 10.625]
    metres = [(0.0, 4, 4), (0.3125, 4, 3)]
    check(write(score_of_beats(onsets, [*onsets[1:], 10.75], metres=metres, bpm=40.0)), len(onsets))


def test_a_line_without_notes_is_rests():
    score = score_of_beats([0.0], [8.0])
    empty = np.zeros(0)
    part = write(score)
    assert len(part.measures) == 2
    none = write_part(score, empty, empty, np.zeros(0, dtype=np.int64))
    assert [text(measure) for measure in none.measures] == ["rW", "rW"]
