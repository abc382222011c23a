"""The bars of a score in ticks."""

from collections.abc import Sequence
from dataclasses import dataclass

from reina.music.metre import MetreMap, TimeSignature
from reina.notation.metre_shape import MetreShape, shape_of
from reina.notation.values import SHORTEST, TICKS_PER_QUARTER


@dataclass(frozen=True)
class Bar:
    """One bar.

    Attributes:
        number: As musicians count: the first whole one is 1, a pickup is 0.
        begin_beats: Where it begins, quarter notes.
        begin: The same place in ticks.
        shape: Its length and beats.
        numerator: Of its metre; of a pickup that of the bars after it.
        denominator: Of its metre.
    """

    number: int
    begin_beats: float
    begin: int
    shape: MetreShape
    numerator: int
    denominator: int

    @property
    def end(self) -> int:
        """Where it ends, ticks."""
        return self.begin + self.shape.ticks

    def ticks_at(self, beats: float) -> float:
        """Return a place in quarter notes as ticks from the score's beginning."""
        return self.begin + (beats - self.begin_beats) * TICKS_PER_QUARTER


def bars_of(metre_map: MetreMap, until_beats: float) -> list[Bar]:
    """Return the bars that begin before a beat, one at least.

    A bar that the next signature cuts short is as long as it is; lengths are whole sixty-fourths.
    """
    lines = metre_map.bar_lines(until_beats).tolist() or [0.0]
    later = metre_map.signatures
    signature = 0
    has_pickup = metre_map.pickup_beats > 0
    bars: list[Bar] = []
    begin = 0
    for index, line in enumerate(lines):
        while signature + 1 < len(later) and later[signature + 1].onset_beats <= line + 1e-9:
            signature += 1
        metre = later[signature]
        is_pickup = has_pickup and index == 0
        end = _end(metre_map, later, signature, line, is_pickup)
        if is_pickup and signature + 1 < len(later) and later[signature + 1].onset_beats <= end + 1e-9:
            metre = later[signature + 1]
        whole = shape_of(metre.numerator, metre.denominator)
        ticks = max(SHORTEST, round((end - line) * TICKS_PER_QUARTER / SHORTEST) * SHORTEST)
        if ticks >= whole.ticks or end - line >= metre.bar_beats - 1e-9:
            shape = whole
        else:
            shape = whole.pickup(ticks) if is_pickup else whole.cut(ticks)
        number = index + (0 if has_pickup else 1)
        bars.append(Bar(number, line, begin, shape, metre.numerator, metre.denominator))
        begin = bars[-1].end
    return bars


def _end(
    metre_map: MetreMap, later: Sequence[TimeSignature], signature: int, line: float, is_pickup: bool
) -> float:
    if is_pickup:
        return metre_map.pickup_beats
    end = line + later[signature].bar_beats
    if signature + 1 < len(later):
        end = min(end, later[signature + 1].onset_beats)
    return end
