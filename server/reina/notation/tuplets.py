"""Triplets over two beats: three quarters in the time of a half note."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from reina.notation.bars import Bar
from reina.notation.rhythm import Rhythm
from reina.notation.values import TICKS_PER_QUARTER

TRIPLET_EIGHTH, TRIPLET_QUARTER = 16, 32


def join_tuplets(bars: Sequence[Bar], rhythm: Rhythm) -> Rhythm:
    """Make one triplet of two beats whose notes begin only where three even ones would."""
    begins = {placed.begin for placed in rhythm.notes}
    joined: dict[int, tuple[int, int]] = {}
    for bar in bars:
        groups = bar.shape.groups
        for group, next_group in pairwise(groups):
            for first in range(bar.begin + group, bar.begin + next_group - TICKS_PER_QUARTER, 96):
                pair = [rhythm.tuplets.get(at) for at in (first, first + TICKS_PER_QUARTER)]
                if pair != [(TICKS_PER_QUARTER, TRIPLET_EIGHTH)] * 2:
                    continue
                places = {at - first for at in begins if first <= at < first + 96}
                if {32, 64} <= places <= {0, 32, 64}:
                    joined[first] = (96, TRIPLET_QUARTER)
    if not joined:
        return rhythm
    gone = {first + TICKS_PER_QUARTER for first in joined}
    tuplets = {at: tuplet for at, tuplet in rhythm.tuplets.items() if at not in gone} | joined
    ordered = sorted(joined)
    notes = list(rhythm.notes)
    for index, placed in enumerate(notes):
        for first in ordered:
            if first < placed.end < first + 96 and (placed.end - first) % TRIPLET_QUARTER:
                later = first + -(-(placed.end - first) // TRIPLET_QUARTER) * TRIPLET_QUARTER
                notes[index] = replace(placed, end=later)
    return replace(rhythm, notes=tuple(notes), tuplets=tuplets)
