"""The tempos of all parts together, as they are played."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from reina.music.musicxml.tables import FASTEST, SLOWEST
from reina.music.tempo import TempoMap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.music.musicxml.model import TempoMark, WrittenPart
    from reina.music.musicxml.timeline import Timeline

DEFAULT_BPM = 120.0


def read_tempo_map(parts: Sequence[WrittenPart], timeline: Timeline) -> TempoMap:
    """Merge the tempos of all parts; a repeat is played as fast as it was written there."""
    marks: list[TempoMark] = []
    bpm = DEFAULT_BPM
    for mark in sorted((mark for part in parts for mark in part.tempos), key=lambda mark: mark.place):
        if mark.bpm is None and marks and marks[-1].place == mark.place:
            continue  # Several parts have the same sign.
        bpm = mark.bpm if mark.bpm is not None else min(max(bpm * mark.ratio, SLOWEST), FASTEST)
        marks.append(replace(mark, bpm=bpm))
    beats, lengths = [0.0], [60.0 / DEFAULT_BPM]
    for beat, played, mark in timeline.unroll(marks, lambda mark: mark.place, holds=True):
        if mark.bpm is not None and (not mark.times or played.playing in mark.times):
            beats.append(beat)
            lengths.append(60.0 / mark.bpm)
    return TempoMap(beats, lengths)
