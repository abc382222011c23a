"""Written measures on the time axis: how long each is, and where it begins as written and as played."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from reina.music.metre import MetreMap, TimeSignature

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from reina.music.musicxml.model import Place, WrittenMeasure
    from reina.music.warnings import WarningLog

T = TypeVar("T")

ROUNDING_BEATS = 0.02
"""What a measure's length may differ from its metre's by the rounding of tuplets."""
SAME_BEAT = 1e-6
OWN_DENOMINATORS = (4, 8, 16, 32, 64)


@dataclass(frozen=True)
class PlayedMeasure:
    """A measure as it is played: which, from which beat, and for which time, from 1."""

    measure: int
    begin: float
    playing: int


class Timeline:
    """Where measures begin, as written and as played.

    Args:
        measures: The measures as they are written.
        order: In which order they are played.
        log: Is told of measures that are not full.
    """

    def __init__(self, measures: Sequence[WrittenMeasure], order: Sequence[int], log: WarningLog) -> None:
        self.measures = measures
        self.lengths = _lengths(measures, log)
        self._written: list[float] = []
        begin = 0.0
        for length in self.lengths:
            self._written.append(begin)
            begin += length
        self.played: list[PlayedMeasure] = []
        counts: Counter[int] = Counter()
        begin = 0.0
        for measure in order:
            counts[measure] += 1
            self.played.append(PlayedMeasure(measure, begin, counts[measure]))
            begin += self.lengths[measure]
        self.end = begin

    def written_beats(self, place: Place) -> float:
        """Return a place as quarter notes from the beginning, as if nothing was repeated."""
        return self._written[place[0]] + place[1]

    def place_at(self, beats: float) -> Place:
        """Return the place so many quarter notes from the beginning, as if nothing was repeated."""
        measure = max(bisect_right(self._written, beats + SAME_BEAT) - 1, 0)
        return measure, max(beats - self._written[measure], 0.0)

    @property
    def written_end(self) -> float:
        """How many quarter notes are written."""
        return self._written[-1] + self.lengths[-1]

    def section_end(self, place: Place, until: float) -> float | None:
        """Return where, as written, playing may next go on elsewhere: at a repeat, a jump or Fine.

        None if that is nowhere in the measures that begin before `until`, quarter notes from the beginning.
        """
        for number in range(place[0], len(self.measures)):
            measure = self.measures[number]
            if self._written[number] >= until:
                return None
            jumps = measure.backward or measure.da_capo or measure.dal_segno is not None or measure.fine
            if jumps or measure.ending_ends:
                return self._written[number] + self.lengths[number]
        return None

    def unroll(
        self, marks: Iterable[T], place_of: Callable[[T], Place], *, holds: bool
    ) -> list[tuple[float, PlayedMeasure, T]]:
        """Return where marks come in the order of playing.

        Args:
            marks: What is written.
            place_of: Tells where.
            holds: Whether a mark holds until the next one as it is written: then it also comes where playing
                goes on at another place, at which it holds.
        """
        ordered = sorted(marks, key=place_of)
        places = [place_of(mark) for mark in ordered]
        unrolled: list[tuple[float, PlayedMeasure, T]] = []
        before = -2
        for played in self.played:
            at = bisect_right(places, (played.measure, -1.0))
            if holds and at and played.measure != before + 1:
                unrolled.append((played.begin, played, ordered[at - 1]))
            length = self.lengths[played.measure]
            while at < len(ordered) and places[at][0] == played.measure:
                unrolled.append((played.begin + min(places[at][1], length), played, ordered[at]))
                at += 1
            before = played.measure
        return unrolled

    def metre_map(self) -> MetreMap:
        """Return the metres as played; what follows a measure of another length begins a bar all the same."""
        signatures: list[TimeSignature] = []
        pickup = 0.0
        now: tuple[int, int] | None = None
        since = 0.0
        for number, played in enumerate(self.played):
            length = self.lengths[played.measure]
            metre = self.measures[played.measure].metre
            if metre is None or length > _bar_beats(metre) + SAME_BEAT:
                metre = _own_metre(length)
            if number == 0 and len(self.played) > 1 and length < _bar_beats(metre) - SAME_BEAT:
                pickup = length
            if metre != now or not _on_grid(played.begin - since, _bar_beats(metre)):
                signatures.append(TimeSignature(played.begin, *metre))
                now, since = metre, played.begin
            if number == 0 and pickup:
                since = pickup
        return MetreMap(signatures, pickup_beats=pickup)


def _lengths(measures: Sequence[WrittenMeasure], log: WarningLog) -> list[float]:
    lengths: list[float] = []
    for number, measure in enumerate(measures):
        full = _bar_beats(measure.metre) if measure.metre else 0.0
        length = measure.length
        if not length:
            length = full or 4.0
        elif full and abs(length - full) < ROUNDING_BEATS:
            length = full
        elif length < full and 0 < number < len(measures) - 1 and not _is_cut(measures, number):
            where = f"measure {measure.number or number + 1}"
            log.add(
                "short_measure", where, f"{length:g} of {full:g} quarter notes are there; rests fill the rest"
            )
            length = full
        lengths.append(length)
    return lengths


def _is_cut(measures: Sequence[WrittenMeasure], number: int) -> bool:
    """Whether a measure is short on purpose: a pickup, or one half of a bar at a repeat or a jump."""
    this, following, before = measures[number], measures[number + 1], measures[number - 1]
    ends = this.backward or this.ending_ends or this.fine or this.da_capo or this.dal_segno is not None
    begins = this.forward or this.ending_begins or this.coda or this.segno or before.backward or before.fine
    goes_on = following.implicit or following.forward or following.segno or following.coda
    return bool(this.implicit or before.implicit or ends or begins or goes_on)


def _bar_beats(metre: tuple[int, int]) -> float:
    return metre[0] * 4.0 / metre[1]


def _own_metre(length: float) -> tuple[int, int]:
    """Return a metre of a bar that lasts so many quarter notes, to a sixty-fourth."""
    for denominator in OWN_DENOMINATORS:
        numerator = length * denominator / 4
        if abs(numerator - round(numerator)) < SAME_BEAT and numerator >= 1:
            return round(numerator), denominator
    return max(1, round(length * 16)), 64


def _on_grid(beats: float, bar_beats: float) -> bool:
    bars = beats / bar_beats
    return abs(bars - round(bars)) * bar_beats < SAME_BEAT
