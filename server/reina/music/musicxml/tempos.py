"""The tempos of all parts together, as they are played: marks, *rit.* and *accel.*, fermatas."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from dataclasses import dataclass, replace
from math import ceil, sqrt
from typing import TYPE_CHECKING

import numpy as np

from reina.music.musicxml.model import TempoMark, TempoReturn, TempoShift
from reina.music.musicxml.tables import FASTEST, SLOWEST
from reina.music.tempo import TempoMap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.music.arrays import FloatArray
    from reina.music.limits import Limits
    from reina.music.musicxml.model import WrittenPart
    from reina.music.musicxml.timeline import Timeline

DEFAULT_BPM = 120.0
LONGEST_CHANGE_BEATS = 16.0
"""A change that nothing ends has come to its tempo after four bars of four."""
LONGEST_DASHED_BEATS = 64.0
STEPS_A_BEAT = 4
MOST_STEPS = 128
MOST_MARKS = 50_000
"""A score that changes its tempo oftener has each further change in one step."""
SAME_BEAT = 1e-6
LONGEST_HOLD_S = 4.0
"""What a fermata adds at most."""
HELD_BEFORE_LINE_BEATS = 1.0
"""What a fermata on a bar line holds."""


def read_tempo_map(parts: Sequence[WrittenPart], timeline: Timeline, limits: Limits) -> TempoMap:
    """Merge the tempos of all parts; a repeat is played as fast as it was written there.

    Raises:
        ScoreLimitError: If the tempo changes more often than messages are read.
    """
    marks = _with_holds(_marks(parts, timeline), _holds(parts, timeline), timeline)
    of_measure = Counter(mark.place[0] for mark in marks)
    changes = sum(of_measure[played.measure] for played in timeline.played)
    limits.check("events", changes, what="number of changes of tempo")
    beats, lengths = [0.0], [60.0 / DEFAULT_BPM]
    for beat, played, mark in timeline.unroll(marks, lambda mark: mark.place, holds=True):
        if mark.bpm is not None and (not mark.times or played.playing in mark.times):
            beats.append(beat)
            lengths.append(60.0 / mark.bpm)
    return TempoMap(beats, lengths)


_Event = TempoMark | TempoShift | TempoReturn


def _marks(parts: Sequence[WrittenPart], timeline: Timeline) -> list[TempoMark]:
    """Return the tempos as they are written, each with its number; changes are many small steps."""
    events: list[_Event] = [mark for part in parts for mark in part.tempos]
    events += [mark for part in parts for mark in part.tempo_words]
    # A number goes before words at its place: "Lento, rit." slows down from there.
    events.sort(key=lambda event: (event.place, isinstance(event, TempoShift)))
    marks: list[TempoMark] = []
    now = base = first = DEFAULT_BPM
    for index, event in enumerate(events):
        same_place = bool(index) and events[index - 1].place == event.place
        if isinstance(event, TempoMark):
            if event.bpm is None and same_place and marks:
                continue  # Several parts have the same sign.
            now = base = event.bpm if event.bpm is not None else _bounded(now * event.ratio)
            first = now if not marks else first
            marks.append(replace(event, bpm=now))
        elif same_place and type(events[index - 1]) is type(event):
            continue
        elif isinstance(event, TempoReturn):
            if event.to_first:
                base = first
            elif same_place:
                continue  # "Allegro, a tempo": the number says it.
            now = base
            marks.append(TempoMark(event.place, now))
        elif not event.gradual:
            now = _bounded(now * event.ratio)
            marks.append(TempoMark(event.place, now))
        else:
            later = index + 1
            while later < len(events) and events[later].place == event.place:
                later += 1
            following = events[later] if later < len(events) else None
            most = MOST_STEPS if len(marks) < MOST_MARKS else 1
            steps, now, is_cut = _change(event, now, following, timeline, most)
            marks += steps
            if is_cut:
                # What follows a repeat or a jump is another passage.
                marks[-1] = TempoMark(marks[-1].place, base)
                now = base
    return marks


def _change(
    shift: TempoShift, now: float, following: _Event | None, timeline: Timeline, most: int
) -> tuple[list[TempoMark], float, bool]:
    """Return the steps of a change, `most` of them, what it comes to, and whether a repeat cuts it off.

    The last step stands where the change ends. Players brake, and runners stop, so that the square of the
    tempo falls evenly along the way.
    """
    begin = timeline.written_beats(shift.place)
    next_at = timeline.written_beats(following.place) if following else timeline.written_end
    longest = begin + LONGEST_CHANGE_BEATS
    if shift.end is not None:
        longest = min(timeline.written_beats(shift.end), begin + LONGEST_DASHED_BEATS)
    section = timeline.section_end(shift.place, longest)
    end = min(next_at, longest, timeline.written_end if section is None else section)
    span = end - begin
    target = _bounded(now * shift.ratio)
    if isinstance(following, TempoMark) and following.bpm is not None and next_at <= end + SAME_BEAT:
        # "rit." before a slower tempo leads there.
        leads = (following.bpm - now) * (shift.ratio - 1) > 0
        target = following.bpm if leads else target
    if span <= SAME_BEAT:
        return [TempoMark(shift.place, now)], now, False
    is_cut = section is not None and section <= end + SAME_BEAT and next_at > section - SAME_BEAT
    count = min(ceil(span * STEPS_A_BEAT), most)
    bend = (target / now) ** 2 - 1
    marks: list[TempoMark] = []
    for step in range(count):
        low, high = sqrt(1 + bend * step / count), sqrt(1 + bend * (step + 1) / count)
        # The mean length of a beat over the step: 1 / sqrt(1 + bend x), integrated.
        bpm = now * (low + high) / 2
        marks.append(TempoMark(timeline.place_at(begin + span * step / count), _bounded(bpm)))
    return [*marks, TempoMark(timeline.place_at(end), target)], target, is_cut


def _bounded(bpm: float) -> float:
    return min(max(bpm, SLOWEST), FASTEST)


@dataclass(frozen=True)
class _Stretch:
    """Where all parts wait, as written: from, to, and how many quarter notes are added."""

    begin: float
    end: float
    added: float


def _holds(parts: Sequence[WrittenPart], timeline: Timeline) -> list[_Stretch]:
    """Return where all parts wait; signs of several parts over one another are one.

    What is held is the last that begins beneath a sign, in whatever part: those before it go on.
    """
    held: list[_Stretch] = []
    for hold in (hold for part in parts for hold in part.holds):
        measure, offset = hold.place
        begin = timeline.written_beats((measure, min(offset, timeline.lengths[measure])))
        beats = hold.beats or min(HELD_BEFORE_LINE_BEATS, begin)
        begin = begin if hold.beats else begin - beats
        added = hold.added if hold.beats else hold.added * beats
        end = min(begin + beats, timeline.written_end)
        if end > begin + SAME_BEAT:
            held.append(_Stretch(begin, end, added))
    if not held:
        return []
    held.sort(key=lambda one: (one.begin, one.end))
    merged: list[_Stretch] = []
    for one in held:
        last = merged[-1] if merged else None
        if last is not None and one.begin < last.end - SAME_BEAT:
            merged[-1] = _Stretch(last.begin, max(last.end, one.end), max(last.added, one.added))
        else:
            merged.append(one)
    onsets: FloatArray = np.unique(
        [timeline.written_beats(note.place) for part in parts for note in part.notes if not note.grace]
    )
    stretches: list[_Stretch] = []
    for one in merged:
        before = int(np.searchsorted(onsets, one.end - SAME_BEAT)) - 1
        last = float(onsets[before]) if before >= 0 else one.begin
        stretches.append(_Stretch(min(max(one.begin, last), one.end - SAME_BEAT), one.end, one.added))
    return stretches


def _with_holds(
    marks: Sequence[TempoMark], stretches: Sequence[_Stretch], timeline: Timeline
) -> list[TempoMark]:
    """Return the tempos with the waiting in them."""
    if not stretches:
        return list(marks)
    at = [timeline.written_beats(mark.place) for mark in marks]
    begins = [one.begin for one in stretches]

    def bpm_at(beat: float) -> float:
        before = bisect_right(at, beat + SAME_BEAT) - 1
        return (marks[before].bpm if before >= 0 else None) or DEFAULT_BPM

    def slowed(beat: float, bpm: float) -> float:
        index = bisect_right(begins, beat + SAME_BEAT) - 1
        if index < 0 or beat >= stretches[index].end - SAME_BEAT:
            return bpm
        one = stretches[index]
        added = min(one.added, LONGEST_HOLD_S * bpm / 60.0)
        return _bounded(bpm / (1 + added / (one.end - one.begin)))

    held = [
        replace(mark, bpm=slowed(beat, mark.bpm or DEFAULT_BPM)) for beat, mark in zip(at, marks, strict=True)
    ]
    for beat in (beat for one in stretches for beat in (one.begin, one.end)):
        before = bisect_right(at, beat + SAME_BEAT) - 1
        if before < 0 or abs(at[before] - beat) > SAME_BEAT:
            held.append(TempoMark(timeline.place_at(beat), slowed(beat, bpm_at(beat))))
    return held
