"""What all parts on paper have alike on the wire: bars of rest that are joined, printed tempos."""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING

from reina.protocol import written_part as wire

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.notation import Bar, TempoMark

TICKS_PER_QUARTER = 48
SAME_BEAT = 1e-6


def joined(measures: Sequence[wire.PartMeasure]) -> list[wire.PartMeasure]:
    """Make one of bars of rest that follow each other, in one metre and one key."""
    joined: list[wire.PartMeasure] = []
    for measure in measures:
        before = joined[-1] if joined else None
        if before is not None and _is_rest(before) and _is_rest(measure) and _is_alike(before, measure):
            joined[-1] = before.model_copy(update={"bars": before.bars + 1, "end_s": measure.end_s})
        else:
            joined.append(measure)
    return joined


def _is_rest(measure: wire.PartMeasure) -> bool:
    return all(entry.is_bar_rest for entry in measure.entries) and measure.number > 0


def _is_alike(a: wire.PartMeasure, b: wire.PartMeasure) -> bool:
    of_a, of_b = (
        (one.numerator, one.denominator, one.ticks, one.written_fifths, one.fifths) for one in (a, b)
    )
    return of_a == of_b


def tempi(
    bars: Sequence[Bar], marks: Sequence[TempoMark], measures: Sequence[wire.PartMeasure]
) -> list[wire.PartTempo]:
    """Return the tempos that are printed.

    Args:
        bars: All bars.
        marks: The tempos.
        measures: The bars as they are sent, rests joined.
    """
    bar_begins = [bar.begin_beats for bar in bars]
    first_bar = bars[0].number
    numbers = [measure.number for measure in measures]

    def tempo(mark: TempoMark) -> wire.PartTempo:
        bar = max(bisect_right(bar_begins, mark.onset_beats + SAME_BEAT) - 1, 0)
        measure = max(bisect_right(numbers, bar + first_bar) - 1, 0)
        ticks = round((mark.onset_beats - bar_begins[bar]) * TICKS_PER_QUARTER)
        return wire.PartTempo(
            measure=measure, begin_ticks=max(ticks, 0), bpm=mark.beats_per_minute, word=mark.word
        )

    return [tempo(mark) for mark in marks]
