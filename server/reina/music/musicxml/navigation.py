"""In which order measures are played: repeats, endings, Da Capo, Dal Segno, codas, Fine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.music.errors import ScoreLimitError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.music.musicxml.model import WrittenMeasure
    from reina.music.warnings import WarningLog

MAX_TIMES = 100
"""A repeat that is asked for more often is made so often."""


@dataclass(frozen=True)
class _Ending:
    """An ending: the passes that take it, its last measure, and what its group of endings is like."""

    passes: frozenset[int]
    end: int
    total: int
    """How often the music before the group is played."""
    is_last: bool
    """Whether it is the last of its group."""
    takes_rest: bool
    """Whether it is taken on passes that no ending of its group names."""
    named: frozenset[int]
    """The passes that some ending of its group names."""

    def is_taken(self, now: int) -> bool:
        """Whether a pass goes through it."""
        return now in self.passes or (self.takes_rest and now not in self.named)


def playing_order(measures: Sequence[WrittenMeasure], *, most: int, log: WarningLog) -> list[int]:
    """Return the measures in the order in which they are played.

    A repeat is not made again after a jump, unless it says so or stands in the coda; of endings the last one
    is taken then. A jump is made once. "To Coda" and "Fine" hold at the end of the measure that they stand
    in, and after a jump alone.

    Args:
        measures: The measures as they are written.
        most: How many may be played.
        log: Is told of jumps that lead nowhere.

    Raises:
        ScoreLimitError: If more are played.
    """
    _find_to_coda(measures)
    endings: dict[int, _Ending] = _endings(measures)
    order: list[int] = []
    at: int = 0
    start: int = 0
    passed = 1
    made: set[int] = set()
    jumped = in_coda = False
    ending: _Ending | None = None
    target: int | None
    while at < len(measures):
        measure = measures[at]
        if measure.forward and at != start:
            start, passed = at, 1
        after_jump = jumped and not in_coda
        begun: _Ending | None = endings.get(int(at))
        if begun is not None:
            ending = begun
            now = begun.total if after_jump else passed
            if not begun.is_taken(now):
                at = int(begun.end) + 1
                ending = None
                if begun.is_last:
                    # Nothing is left of the group: what follows is another passage.
                    start, passed = at, 1
                continue
        order.append(at)
        if len(order) > most:
            raise ScoreLimitError(f"more than {most:,} measures are played, the most that are read")
        within = ending if ending is not None and at <= ending.end else None
        times = (
            max(within.total, measure.backward if not within.is_last else 0) if within else measure.backward
        )
        if measure.backward and passed < min(times, MAX_TIMES) and (not after_jump or measure.after_jump):
            passed += 1
            at = start
            ending = None
            continue
        closes = measure.backward > 0 or (within is not None and within.is_last and at == within.end)
        if closes:
            start, passed = at + 1, 1
        if jumped and measure.fine:
            break
        if jumped and not in_coda and measure.to_coda is not None:
            target = _find(measures, measure.to_coda, at, coda=True)
            if target is not None:
                at = start = int(target)
                in_coda, ending, passed = True, None, 1
                continue
            _tell(log, measure, at, "To Coda", "no coda follows")
        if at not in made and (measure.da_capo or measure.dal_segno is not None):
            made.add(at)
            target = 0 if measure.da_capo else _find(measures, measure.dal_segno or "", at, coda=False)
            if target is not None:
                at = start = int(target)
                jumped, in_coda, ending, passed = True, False, None, 1
                continue
            _tell(log, measure, at, "Dal Segno", "no sign stands before it")
        at += 1
    return order


def _find_to_coda(measures: Sequence[WrittenMeasure]) -> None:
    """Take the first of two codas for "To Coda" where nothing else says it: its sign is the same."""
    codas = [measure for measure in measures if measure.coda]
    jumps = any(measure.da_capo or measure.dal_segno is not None for measure in measures)
    if len(codas) > 1 and jumps and all(measure.to_coda is None for measure in measures):
        codas[0].to_coda = min(codas[0].coda)
        codas[0].coda.clear()


def _tell(log: WarningLog, measure: WrittenMeasure, at: int, what: str, why: str) -> None:
    log.add("jump_left_out", f"measure {measure.number or at + 1}", f"{what} was left out: {why}")


def _find(measures: Sequence[WrittenMeasure], name: str, at: int, *, coda: bool) -> int | None:
    """Return where a coda after, or a sign before, a measure stands: that of the name, else any."""
    places = range(at + 1, len(measures)) if coda else range(at, -1, -1)
    named: list[int] = []
    for place in places:
        names = measures[place].coda if coda else measures[place].segno
        if name in names:
            return place
        if names:
            named.append(place)
    return named[0] if named else None


def _endings(measures: Sequence[WrittenMeasure]) -> dict[int, _Ending]:
    """Return the endings by the measure in which they begin; those that follow one another are a group."""
    found: dict[int, _Ending] = {}
    group: list[tuple[int, int, frozenset[int]]] = []

    def close() -> None:
        total = max((max(passes) for _, _, passes in group), default=1)
        # A first ending alone is left out the last time; any other ending alone is no choice at all.
        skipped = len(group) == 1 and measures[group[0][1]].backward > 0 and 1 in group[0][2]
        total += skipped
        named = frozenset(number for _, _, passes in group for number in passes)
        for number, (begin, end, passes) in enumerate(group):
            is_last = number == len(group) - 1
            found[begin] = _Ending(passes, end, total, is_last, is_last and not skipped, named)
        group.clear()

    at = 0
    while at < len(measures):
        passes = measures[at].ending_begins
        if not passes:
            at += 1
            continue
        if group and group[-1][1] + 1 != at:
            close()
        end = _end_of_ending(measures, at)
        group.append((at, end, passes))
        at = end + 1
    close()
    return found


def _end_of_ending(measures: Sequence[WrittenMeasure], begin: int) -> int:
    """Return the last measure of an ending; it is one measure long where its end is missing."""
    end = begin
    while not (measures[end].ending_ends or measures[end].backward):
        end += 1
        if end == len(measures) or measures[end].ending_begins:
            return begin
    return end
