"""A score in another time: as a recording of it goes."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from reina.music.errors import ScoreError
from reina.music.metre import MetreMap
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

    Raises:
        ScoreError: None of its notes is heard.
    """
    notes = score.notes
    kept = heard.is_heard(notes.onset_s)
    if not np.any(kept):
        raise ScoreError("no note of the score would be heard: all of it lies outside the recording")
    onset_s = heard.song_times(notes.onset_s)
    end_s = heard.song_times(notes.onset_s + notes.duration_s)
    columns = {field.name: getattr(notes, field.name) for field in fields(notes)}
    columns |= {"onset_s": onset_s, "duration_s": np.maximum(end_s - onset_s, MIN_STEP_S)}
    moved = Notes.from_columns(**{name: column[kept] for name, column in columns.items()})
    controls_s = np.array([control.onset_s for control in score.controls])
    texts_s = np.array([text.onset_s for text in score.texts])
    controls = zip(score.controls, heard.song_times(controls_s).tolist(), strict=True)
    texts = zip(
        score.texts, heard.song_times(texts_s).tolist(), heard.is_heard(texts_s).tolist(), strict=True
    )
    return replace(
        score,
        notes=moved,
        tempo_map=_heard_beats(score, heard),
        controls=tuple(control._replace(onset_s=at_s) for control, at_s in controls),
        texts=tuple(replace(text, onset_s=at_s) for text, at_s, is_heard in texts if is_heard),
        duration_s=float(np.max(moved.onset_s + moved.duration_s, initial=0.0)),
        written_tempos=score.written_tempo_map,
    )


def from_second_zero(score: Score) -> Score:
    """Return a score whose beat 0 is second 0, as in files: what is heard later begins with bars of rest.

    They have the first metre, and as near its tempo as whole bars allow. A pickup ends the last of them.
    """
    begins_s = score.tempo_map.seconds(0.0)
    if begins_s < MIN_STEP_S:
        return score
    metre = score.metre_map
    pickup = metre.pickup_beats
    signatures = list(metre.signatures)
    if pickup > 0 and len(signatures) > 1 and signatures[1].onset_beats == pickup:
        # The pickup is written as a metre of its own.
        signatures = [replace(signatures[1], onset_beats=0.0), *signatures[2:]]
    bar = signatures[0].bar_beats
    bars = max(1, round((begins_s / float(score.tempo_map.seconds_per_beat[0]) + pickup) / bar))
    lead = bars * bar - pickup
    beats = np.concatenate((score.tempo_map.onset_beats, [score.duration_beats + 1.0]))
    notes = score.notes
    moved = Notes.from_columns(
        **{field.name: getattr(notes, field.name) for field in fields(notes)}
        | {"onset_beats": notes.onset_beats + lead}
    )
    return replace(
        score,
        notes=moved,
        tempo_map=TempoMap.through(
            np.concatenate(([0.0], beats + lead)), np.concatenate(([0.0], score.tempo_map.seconds(beats)))
        ),
        metre_map=MetreMap(
            [
                replace(each, onset_beats=each.onset_beats + lead if each.onset_beats > 0 else 0.0)
                for each in signatures
            ]
        ),
        controls=tuple(
            control._replace(onset_beats=control.onset_beats + lead) for control in score.controls
        ),
        texts=tuple(replace(text, onset_beats=text.onset_beats + lead) for text in score.texts),
        key_signatures=tuple(
            replace(key, onset_beats=key.onset_beats + lead if key.onset_beats > 0 else 0.0)
            for key in score.key_signatures
        ),
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
