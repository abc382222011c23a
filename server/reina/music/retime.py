"""A score in another time: as a recording of it goes."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

import numpy as np

from reina.music.arrays import read_only
from reina.music.notes import Notes
from reina.music.tempo import TempoMap

if TYPE_CHECKING:
    from reina.music.arrays import BoolArray, FloatArray
    from reina.music.score import Score

MIN_STEP_S = 1e-6
"""So long each stretch lasts at least, so that every time has its beat; bars that are not heard, too."""


@dataclass(frozen=True, eq=False)
class TimeWarp:
    """Where each second of a score is heard.

    Attributes:
        score_s: (K,) at least two, ascending, seconds of the score.
        song_s: (K,) where they are heard, not descending. Before the first and after the last, a second of
            the score lasts a second.
        absent_s: (M, 2) stretches of the score, ascending, seconds, that are not heard at all.
    """

    score_s: FloatArray
    song_s: FloatArray
    absent_s: FloatArray

    def song_times(self, score_s: FloatArray) -> FloatArray:
        """Return where seconds of the score are heard, an array of the same shape."""
        inside = np.interp(score_s, self.score_s, self.song_s)
        early = np.minimum(score_s - self.score_s[0], 0.0)
        late = np.maximum(score_s - self.score_s[-1], 0.0)
        return inside + early + late

    def are_absent(self, score_s: FloatArray) -> BoolArray:
        """Return which seconds of the score are not heard, an array of the same shape."""
        absent = np.zeros(np.shape(score_s), dtype=np.bool_)
        for start_s, end_s in self.absent_s.tolist():
            absent |= (score_s >= start_s) & (score_s < end_s)
        return absent


def retimed(score: Score, warp: TimeWarp) -> Score:
    """Return a score as it is heard: notes, controllers, beats and bars in the seconds of a recording.

    Notes that begin in what is not heard are left out; those that are held into it end there. Beats, bars and
    pitches stay as they are. The tempos as they are written stay in `written_tempo_map`.

    Args:
        score: The score, in its own seconds.
        warp: Where its seconds are heard.
    """
    notes = score.notes
    kept = ~warp.are_absent(notes.onset_s)
    onset_s = warp.song_times(notes.onset_s)
    end_s = warp.song_times(notes.onset_s + notes.duration_s)
    columns = {field.name: getattr(notes, field.name) for field in fields(notes)}
    columns |= {"onset_s": onset_s, "duration_s": np.maximum(end_s - onset_s, MIN_STEP_S)}
    heard = Notes.from_columns(**{name: column[kept] for name, column in columns.items()})
    controls = [
        control._replace(onset_s=at_s)
        for control, at_s in zip(
            score.controls,
            warp.song_times(np.array([control.onset_s for control in score.controls])).tolist(),
            strict=True,
        )
    ]
    return replace(
        score,
        notes=heard,
        tempo_map=_heard_beats(score, warp),
        controls=tuple(controls),
        duration_s=float(np.max(heard.onset_s + heard.duration_s, initial=0.0)),
        written_tempos=score.written_tempo_map,
    )


def _heard_beats(score: Score, warp: TimeWarp) -> TempoMap:
    """The beats of a score where they are heard."""
    end_s = score.tempo_map.seconds(score.duration_beats)
    knots_s = np.concatenate(
        ([0.0, max(end_s, 0.0) + 1.0], score.tempo_map.onset_s, warp.score_s, warp.absent_s.ravel())
    )
    beats = np.unique(np.maximum(score.tempo_map.beats(knots_s), 0.0))
    # What is nearer than the rounding of a time is one place.
    beats = beats[np.concatenate(([True], np.diff(beats) > MIN_STEP_S))]
    song_s = warp.song_times(score.tempo_map.seconds(beats))
    steps = np.maximum(np.diff(song_s), MIN_STEP_S)
    return TempoMap.through(beats, read_only(np.concatenate((song_s[:1], song_s[0] + np.cumsum(steps)))))
