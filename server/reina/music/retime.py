"""A score in another time: as a recording of it goes."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from reina.music.notes import Notes
from reina.music.tempo import TempoMap

if TYPE_CHECKING:
    from reina.music.arrays import BoolArray, FloatArray
    from reina.music.score import Score

JUST_BEFORE_S = 1e-3
MIN_STEP_S = 1e-6
"""So long each stretch lasts at least, so that every time has its beat; bars that are not heard, too."""


class SongTimes(Protocol):
    """Where a score is heard in a recording of it."""

    @property
    def bends_s(self) -> FloatArray:
        """(K,) seconds of the score between which it is heard evenly, ascending."""
        ...

    def song_times(self, score_s: FloatArray, /) -> FloatArray:
        """Where seconds of the score are heard, an array of the same shape; never falls where they rise."""
        ...

    def is_heard(self, score_s: FloatArray, /) -> BoolArray:
        """Whether seconds of the score are heard at all, an array of the same shape."""
        ...


def retimed(score: Score, heard: SongTimes) -> Score:
    """Return a score as it is heard: notes, controllers, beats and bars in the seconds of a recording.

    Notes that begin in what is not heard are left out; those that are held into it end there. Beats, bars and
    pitches stay as they are. The tempos as they are written stay in `written_tempo_map`.

    Args:
        score: The score, in its own seconds.
        heard: Where its seconds are heard.
    """
    notes = score.notes
    kept = heard.is_heard(notes.onset_s)
    onset_s = heard.song_times(notes.onset_s)
    end_s = heard.song_times(notes.onset_s + notes.duration_s)
    columns = {field.name: getattr(notes, field.name) for field in fields(notes)}
    columns |= {"onset_s": onset_s, "duration_s": np.maximum(end_s - onset_s, MIN_STEP_S)}
    moved = Notes.from_columns(**{name: column[kept] for name, column in columns.items()})
    controls = [
        control._replace(onset_s=at_s)
        for control, at_s in zip(
            score.controls,
            heard.song_times(np.array([control.onset_s for control in score.controls])).tolist(),
            strict=True,
        )
    ]
    return replace(
        score,
        notes=moved,
        tempo_map=_heard_beats(score, heard),
        controls=tuple(controls),
        duration_s=float(np.max(moved.onset_s + moved.duration_s, initial=0.0)),
        written_tempos=score.written_tempo_map,
    )


def _heard_beats(score: Score, heard: SongTimes) -> TempoMap:
    """The beats of a score where they are heard."""
    end_s = score.tempo_map.seconds(score.duration_beats)
    bends_s = heard.bends_s
    # Where a recording has something that the score has not, one place of the score is heard for long: what
    # comes just before it keeps its tempo.
    knots_s = np.concatenate(([0.0, end_s + 1.0], score.tempo_map.onset_s, bends_s, bends_s - JUST_BEFORE_S))
    beats = np.unique(np.maximum(score.tempo_map.beats(knots_s), 0.0))
    # What is nearer than the rounding of a time is one place.
    beats = beats[np.concatenate(([True], np.diff(beats) > MIN_STEP_S))]
    song_s = heard.song_times(score.tempo_map.seconds(beats))
    steps = np.maximum(np.diff(song_s), MIN_STEP_S)
    return TempoMap.through(beats, np.concatenate((song_s[:1], song_s[0] + np.cumsum(steps))))
