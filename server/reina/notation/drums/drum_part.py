"""The hits of a drummer as they stand on paper: two voices, filled to the next hit within a beat, no ties."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

from reina.notation.bars import Bar, bars_of
from reina.notation.drums.staff_places import (
    GHOSTS,
    GRACES,
    Head,
    Mark,
    StaffPlace,
    head_of,
    is_foot,
    mark_of,
    place_of,
)
from reina.notation.measures import Entry, measures_of
from reina.notation.quantise import quantise
from reina.notation.rhythm import Placed, Rhythm
from reina.notation.tempo_marks import TempoMark, tempo_marks

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from reina.music.score import Score
    from reina.notation.drums.struck import Struck
    from reina.notation.values import Value

TOGETHER_S = 0.03
"""Hits of different limbs that are no farther apart stand above one another."""
GRACE_REACH_S = 0.25
"""A grace note belongs to a hit that comes no later."""
SPARE_BEATS = 0.2


@dataclass(frozen=True)
class DrumStroke:
    """A hit on paper.

    Attributes:
        hit: Its place among the hits.
        place: Where it stands on the staff.
        head: With which head.
        mark: The sign at it.
        is_ghost: Whether it stands in brackets.
        hand: The letter beneath it: R or L; None for a foot.
    """

    hit: int
    place: StaffPlace
    head: Head
    mark: Mark | None
    is_ghost: bool
    hand: Literal["R", "L"] | None


@dataclass(frozen=True)
class DrumEntry:
    """Hits at one time, or a rest, in one of a bar's voices.

    Attributes:
        begin: Ticks from the bar's beginning.
        ticks: How long it lasts on paper.
        value: What is written.
        strokes: From the lowest place up; none: a rest.
        graces: The grace notes before them: one is a flam, two are a drag.
        is_bar_rest: Whether it is the rest of a whole bar.
        tuplet: Which tuplet of the voice in this bar it is in, from 0, or None.
        beam: Which beam of the voice in this bar it is under, from 0, or None.
    """

    begin: int
    ticks: int
    value: Value
    strokes: tuple[DrumStroke, ...] = ()
    graces: tuple[DrumStroke, ...] = ()
    is_bar_rest: bool = False
    tuplet: int | None = None
    beam: int | None = None


@dataclass(frozen=True)
class DrumMeasure:
    """A bar.

    Attributes:
        bar: Which.
        hands: What hands play, stems up; nothing where feet alone play in it.
        feet: What feet play, stems down; nothing where none do.
    """

    bar: Bar
    hands: tuple[DrumEntry, ...]
    feet: tuple[DrumEntry, ...]

    @property
    def is_silent(self) -> bool:
        """Whether nothing is played in it."""
        return not any(entry.strokes for entry in (*self.hands, *self.feet))


@dataclass(frozen=True)
class WrittenDrums:
    """A drum part.

    Attributes:
        measures: All bars up to the last hit, one at least.
        swing: Whether swung eighths are written even.
        tempo_marks: What is printed above it.
    """

    measures: tuple[DrumMeasure, ...]
    swing: bool
    tempo_marks: tuple[TempoMark, ...]


@dataclass(frozen=True)
class _Moment:
    """Hits that stand above one another: their places among all hits."""

    onset_s: float
    onset_beats: float
    hits: tuple[int, ...]


def write_drums(score: Score, hits: Sequence[Struck]) -> WrittenDrums:
    """Write a drummer's hits.

    Hits that are graces by their technique stand before the next hit on their piece. Where two hits of one
    limb fall on one place of the paper the first is a grace note.

    Args:
        score: Its tempo and metre.
        hits: In any order.
    """
    order = sorted(range(len(hits)), key=lambda hit: (hits[hit].onset_s, hit))
    plain = [hit for hit in order if hits[hit].technique not in GRACES]
    moments = _moments(hits, plain)
    until = moments[-1].onset_beats + SPARE_BEATS if moments else 0.0
    bars = bars_of(score.metre_map, until)
    tempo_map = score.tempo_map
    seconds = tempo_map.seconds_per_beat
    changes = tempo_map.onset_beats.tolist()
    onset_beats = [moment.onset_beats for moment in moments]
    ends = [*onset_beats[1:], *([onset_beats[-1] + 1.0] if onset_beats else [])]
    rhythm = quantise(
        bars,
        onset_beats,
        ends,
        [float(seconds[max(bisect_right(changes, beat + 1e-9) - 1, 0)]) for beat in onset_beats],
    )
    if rhythm.notes:
        bars = [bar for bar in bars if bar.begin <= rhythm.notes[-1].begin]
    graces = _graces(hits, order, plain)
    places = _on_places(moments, rhythm, hits, graces)
    return WrittenDrums(
        measures=tuple(_measures(bars, rhythm, places, graces, hits)),
        swing=rhythm.swing,
        tempo_marks=tempo_marks(score.written_tempo_map, max(until, SPARE_BEATS)),
    )


def _moments(hits: Sequence[Struck], plain: Sequence[int]) -> list[_Moment]:
    """Put hits together that different limbs strike at one time."""
    moments: list[_Moment] = []
    group: list[int] = []

    def close() -> None:
        if group:
            first = hits[group[0]]
            beats = sum(hits[hit].onset_beats for hit in group) / len(group)
            moments.append(_Moment(first.onset_s, beats, tuple(group)))
            group.clear()

    for hit in plain:
        is_late = group and hits[hit].onset_s - hits[group[0]].onset_s > TOGETHER_S
        if is_late or hits[hit].limb in {hits[other].limb for other in group}:
            close()
        group.append(hit)
    close()
    return moments


def _graces(hits: Sequence[Struck], order: Sequence[int], plain: Sequence[int]) -> dict[int, list[int]]:
    """Return the grace notes before each hit: that is the next on their piece, else the next at all."""
    graces: dict[int, list[int]] = {}
    onsets = [hits[hit].onset_s for hit in plain]
    for grace in order:
        if hits[grace].technique not in GRACES:
            continue
        at = bisect_right(onsets, hits[grace].onset_s)
        near = [
            hit
            for hit in plain[at : at + 6]
            if hits[hit].onset_s - hits[grace].onset_s <= GRACE_REACH_S and not is_foot(hits[hit])
        ]
        main = next((hit for hit in near if hits[hit].piece == hits[grace].piece), near[0] if near else None)
        if main is not None:
            graces.setdefault(main, []).append(grace)
    return graces


def _on_places(
    moments: Sequence[_Moment], rhythm: Rhythm, hits: Sequence[Struck], graces: dict[int, list[int]]
) -> dict[int, list[int]]:
    """Return the hits on each place of the paper, in ticks.

    No hit is lost: of two of one limb on one place the first is put among the `graces` of the second.
    """
    places: dict[int, list[int]] = {}
    begin_of: dict[int, int] = {}
    for placed in rhythm.notes:
        for moment in (*placed.graces, placed.note):
            begin_of[moment] = placed.begin
    last = 0
    for number, moment in enumerate(moments):
        last = begin_of.get(number, last)
        there = places.setdefault(last, [])
        for hit in moment.hits:
            same = next((other for other in there if hits[other].limb == hits[hit].limb), None)
            if same is not None:
                there.remove(same)
                graces[hit] = [*graces.pop(same, []), same, *graces.get(hit, [])]
            there.append(hit)
    return places


def _measures(
    bars: Sequence[Bar],
    rhythm: Rhythm,
    places: dict[int, list[int]],
    graces: dict[int, list[int]],
    hits: Sequence[Struck],
) -> Iterable[DrumMeasure]:
    voices: list[list[tuple[DrumEntry, ...]]] = []
    for feet in (False, True):
        begins = sorted(
            begin for begin, there in places.items() if any(is_foot(hits[hit]) == feet for hit in there)
        )
        ends = _ends(bars, rhythm, begins)
        notes = tuple(Placed(begin, begin, end) for begin, end in zip(begins, ends, strict=True))
        measures = measures_of(bars, replace(rhythm, notes=notes))
        own = {begin: [hit for hit in there if is_foot(hits[hit]) == feet] for begin, there in places.items()}
        voices.append(
            [
                tuple(
                    _entry(entry, own.get(_begin(entry), ()), graces, hits)
                    for entry in _without_ties(measure.entries)
                )
                for measure in measures
            ]
        )
    for bar, hands, feet_ in zip(bars, *voices, strict=True):
        plays = [any(entry.strokes for entry in voice) for voice in (hands, feet_)]
        yield DrumMeasure(
            bar,
            hands=hands if plays[0] or not plays[1] else (),
            feet=feet_ if plays[1] else (),
        )


def _begin(entry: Entry) -> int:
    return entry.placed.begin if entry.placed is not None else -1


def _ends(bars: Sequence[Bar], rhythm: Rhythm, begins: Sequence[int]) -> list[int]:
    """Return where each hit of a voice ends on paper: at the next one, at the end of its beat or tuplet."""
    lines: list[int] = []
    for bar in bars:
        lines += [bar.begin + beat for beat in bar.shape.beats[:-1]]
    lines.append(bars[-1].end)
    inside = {
        line
        for begin, (length, _) in rhythm.tuplets.items()
        for line in lines
        if begin < line < begin + length
    }
    lines = [line for line in lines if line not in inside]
    ends: list[int] = []
    for begin, following in pairwise([*begins, bars[-1].end]):
        line = lines[min(bisect_right(lines, begin), len(lines) - 1)]
        ends.append(max(min(line, following), begin + 1))
    return ends


def _without_ties(entries: Sequence[Entry]) -> list[Entry]:
    """Make rests of what a note would be tied to: a hit is as long as its first value."""
    untied = [
        replace(entry, placed=None, beam=None, tied_from=False) if entry.tied_from else entry
        for entry in entries
    ]
    counts: dict[int, int] = {}
    for entry in untied:
        if entry.beam is not None:
            counts[entry.beam] = counts.get(entry.beam, 0) + 1
    alone = {beam for beam, count in counts.items() if count == 1}
    return [replace(entry, beam=None) if entry.beam in alone else entry for entry in untied]


def _entry(
    entry: Entry, struck: Sequence[int], graces: dict[int, list[int]], hits: Sequence[Struck]
) -> DrumEntry:
    ordered = sorted(struck, key=lambda hit: _height(place_of(hits[hit])))
    before = sorted(
        (grace for hit in ordered for grace in graces.get(hit, ())), key=lambda hit: hits[hit].onset_s
    )
    return DrumEntry(
        begin=entry.begin,
        ticks=entry.ticks,
        value=entry.value,
        strokes=tuple(_stroke(hit, hits[hit]) for hit in ordered),
        graces=tuple(_stroke(hit, hits[hit]) for hit in before),
        is_bar_rest=entry.is_bar_rest,
        tuplet=entry.tuplet,
        beam=entry.beam,
    )


def _height(place: StaffPlace) -> int:
    return 7 * place.octave + "CDEFGAB".index(place.letter)


def _stroke(number: int, hit: Struck) -> DrumStroke:
    hand: Literal["R", "L"] | None = None
    if not is_foot(hit):
        hand = "R" if hit.limb == "right_hand" else "L"
    return DrumStroke(number, place_of(hit), head_of(hit), mark_of(hit), hit.technique in GHOSTS, hand)
