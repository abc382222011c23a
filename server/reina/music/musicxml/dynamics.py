"""How loud each note of a part is: its dynamics and hairpins, in the order in which they are written."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.music.musicxml.model import Hairpin
from reina.music.musicxml.tables import DEFAULT_LEVEL, STEP

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.music.musicxml.model import Place, WrittenPart

NEAR_BEATS = 1.0
"""A dynamic so soon after a hairpin's end is the one that it leads to."""
OPEN_BEATS = 32.0
"""A crescendo by words leads to the next dynamic if that is no farther."""
SAME_BEAT = 1e-6
LEAST = 1 / 127


@dataclass(frozen=True)
class _Segment:
    """The level from `begin` on: on its way from `low` to `high` until `end`, then `high`."""

    begin: float
    end: float
    low: float
    high: float

    def at(self, beat: float) -> float:
        if self.end <= self.begin or beat >= self.end:
            return self.high
        return self.low + (self.high - self.low) * max(beat - self.begin, 0.0) / (self.end - self.begin)


def velocities_of(part: WrittenPart, beats_of: Callable[[Place], float]) -> list[float]:
    """Return the velocity of each of a part's notes, 0..1.

    Args:
        part: The part.
        beats_of: Tells a place as quarter notes from the beginning, as if nothing was repeated.
    """
    segments = _segments(part, beats_of)
    begins = [segment.begin for segment in segments]
    accents: dict[float, float] = {}
    for mark in part.dynamics:
        if mark.accent is not None:
            accents[round(beats_of(mark.place), 6)] = mark.accent
    velocities: list[float] = []
    for note in part.notes:
        if note.velocity is not None:
            velocities.append(note.velocity)
            continue
        beat = beats_of(note.place)
        level = segments[bisect_right(begins, beat + SAME_BEAT) - 1].at(beat)
        accent = accents.get(round(beat, 6)) if accents else None
        if accent is not None:
            # "fp" is louder than what follows, "pf" is softer.
            level = accent
        velocities.append(min(max(level + note.louder, LEAST), 1.0))
    return velocities


def _segments(part: WrittenPart, beats_of: Callable[[Place], float]) -> list[_Segment]:
    marks = sorted(
        ((beats_of(mark.place), mark.level) for mark in part.dynamics if mark.level is not None),
        key=lambda mark: mark[0],
    )
    mark_beats = [beat for beat, _ in marks]
    events: list[tuple[float, int, float | Hairpin]] = [(beat, 0, level) for beat, level in marks]
    events += [(beats_of(hairpin.begin), 1, hairpin) for hairpin in part.hairpins]
    events.sort(key=lambda event: event[:2])
    segments = [_Segment(0.0, 0.0, DEFAULT_LEVEL, DEFAULT_LEVEL)]
    for beat, _, what in events:
        if not isinstance(what, Hairpin):
            segments.append(_Segment(beat, beat, what, what))
            continue
        now = segments[-1].at(beat)
        following = bisect_right(mark_beats, beat + SAME_BEAT)
        to = marks[following] if following < len(marks) else None
        if what.end is None:
            if to is None or to[0] - beat > OPEN_BEATS:
                continue
            end = to[0]
        else:
            end = beats_of(what.end)
        target = min(max(now + what.sign * STEP, LEAST), 1.0)
        if to is not None and to[0] <= end + NEAR_BEATS and (to[1] - now) * what.sign > 0:
            target = to[1]
        segments.append(_Segment(beat, end, now, target))
    return segments
