"""A line of notes as its player would have it on paper."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from reina.music.arrays import FloatArray, NarrowIntArray
from reina.music.score import Score
from reina.notation.bars import bars_of
from reina.notation.measures import Measure, measures_of
from reina.notation.quantise import quantise
from reina.notation.rhythm import Rhythm
from reina.notation.tempo_marks import TempoMark, tempo_marks
from reina.notation.trills import Trill, find_trills

LATE_TICKS = 7
"""A last note that reaches no further into a bar is let go late, and the bar is not there."""
SPARE_BEATS = 0.2
"""So near to its end a last note may be that begins with the next bar."""
LONGEST_BEAT = 4.0
"""Quarter notes. A note is written up to half a beat from where it is played, in the next bar if need be;
empty bars at the end are not kept."""


@dataclass(frozen=True)
class WrittenPart:
    """A part.

    Attributes:
        measures: All bars up to the end of the last note.
        trills: The trills among its notes, by their first note.
        swing: Whether swung eighths are written even.
        tempo_marks: What is printed above it.
    """

    measures: tuple[Measure, ...]
    trills: dict[int, Trill]
    swing: bool
    tempo_marks: tuple[TempoMark, ...]


def write_part(score: Score, onset_s: FloatArray, end_s: FloatArray, pitches: NarrowIntArray) -> WrittenPart:
    """Write a line of M notes, one at a time.

    Args:
        score: Its tempo and metre.
        onset_s: (M,) seconds, ascending.
        end_s: (M,) seconds, none after the next onset.
        pitches: (M,) MIDI numbers.
    """
    tempo_map = score.tempo_map
    until = score.duration_beats
    if len(end_s):
        until = float(tempo_map.beats(float(end_s[-1]))) + SPARE_BEATS
    bars = bars_of(score.metre_map, until + LONGEST_BEAT if len(end_s) else until)
    trills = find_trills(pitches.tolist(), onset_s.tolist(), end_s.tolist())
    inner = {note for trill in trills for note in range(trill.first + 1, trill.last + 1)}
    kept = [note for note in range(len(onset_s)) if note not in inner]
    ends = end_s.copy()
    for trill in trills:
        ends[trill.first] = end_s[trill.last]
    onset_beats = tempo_map.beats(onset_s[kept])
    rhythm = quantise(
        bars,
        onset_beats.tolist(),
        tempo_map.beats(ends[kept]).tolist(),
        _seconds_per_beat(score, onset_beats).tolist(),
    )
    rhythm = _numbered(rhythm, kept)
    if rhythm.notes:
        last = rhythm.notes[-1]
        needed = max(last.begin + 1, last.end - LATE_TICKS)
        bars = [bar for bar in bars if bar.begin < needed]
        rhythm = _within(bars[-1].end, rhythm)
    return WrittenPart(
        measures=tuple(measures_of(bars, rhythm)),
        trills={trill.first: trill for trill in trills},
        swing=rhythm.swing,
        tempo_marks=tempo_marks(score.written_tempo_map, until),
    )


def _seconds_per_beat(score: Score, onset_beats: FloatArray) -> FloatArray:
    tempo_map = score.tempo_map
    segment = np.maximum(np.searchsorted(tempo_map.onset_beats, onset_beats + 1e-9, side="right") - 1, 0)
    return tempo_map.seconds_per_beat[segment]


def _numbered(rhythm: Rhythm, kept: Sequence[int]) -> Rhythm:
    """Name notes by their place in the whole line."""
    notes = tuple(
        replace(one, note=kept[one.note], graces=tuple(kept[grace] for grace in one.graces))
        for one in rhythm.notes
    )
    return Rhythm(notes, rhythm.tuplets, rhythm.swing)


def _within(end: int, rhythm: Rhythm) -> Rhythm:
    """End the last note with the last bar, whose end is given in ticks."""
    notes = (*rhythm.notes[:-1], replace(rhythm.notes[-1], end=min(rhythm.notes[-1].end, end)))
    return Rhythm(notes, rhythm.tuplets, rhythm.swing)
