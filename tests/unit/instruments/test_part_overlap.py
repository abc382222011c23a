"""How far two parts play together."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.instruments.scores import score_of

from reina.instruments.part_overlap import overlap_share, unison_share
from reina.music.notes import Notes

NOTES = st.lists(
    st.tuples(st.integers(0, 60), st.integers(1, 8), st.integers(55, 60)), min_size=1, max_size=25
).map(lambda drawn: [(start / 4, (start + length) / 4, pitch) for start, length, pitch in drawn])


def parts(one: list[tuple[float, float, int]], other: list[tuple[float, float, int]]) -> tuple[Notes, Notes]:
    score = score_of(sorted(one), sorted(other))
    return score.notes.take(score.note_indices(0)), score.notes.take(score.note_indices(1))


@given(NOTES, NOTES)
def test_shares_are_those_that_are_counted_note_by_note(
    one: list[tuple[float, float, int]], other: list[tuple[float, float, int]]
) -> None:
    first, second = parts(one, other)
    same = [any(n[2] == m[2] and abs(n[0] - m[0]) < 0.05 for m in other) for n in one]
    assert unison_share(first, second) == pytest.approx(np.mean(same))
    # A grid fine enough that every note begins and ends on it.
    grid = np.arange(0, 18, 0.25) + 0.125
    sounds = np.any([(grid > m[0]) & (grid < m[1]) for m in other], axis=0)
    heard = sum(sounds[(grid > n[0]) & (grid < n[1])].sum() for n in one)
    assert overlap_share(first, second) == pytest.approx(heard * 0.25 / sum(n[1] - n[0] for n in one))


def test_notes_a_little_apart_are_struck_together() -> None:
    first, second = parts([(0.0, 1.0, 60), (2.0, 3.0, 62)], [(0.05, 1.0, 60), (2.5, 3.0, 62)])
    assert unison_share(first, second) == 0.5
