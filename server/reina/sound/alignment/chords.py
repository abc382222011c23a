"""The chords of a stretch and where each is heard, on a line from beat to beat."""

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from reina.music import Score
from reina.sound.alignment.bands import Floats
from reina.sound.alignment.beats import fit_beats
from reina.sound.alignment.onsets import chords_of, refine_onsets
from reina.sound.alignment.score_bands import Times
from reina.sound.alignment.segments import Stretch

ROUNDS = 2
"""Onsets are looked for anew about the line that the first ones gave."""
SLACK_S = 0.03
NEAREST_S = 0.02
"""A beat nearer to a stretch's edge has no knot of its own."""
AGREEMENT_S = 0.03
"""An onset so far from its beat's line agrees with it by a third."""
TUNE_SHARE = 0.2
"""A part that has such a share of the notes that the busiest has may have the tune."""
FEWEST_NOTES = 12
"""Of fewer notes alone it would be chance."""
LEAST_AGREEMENT = 0.2
"""A chord at the edge of a gap that agrees less is not heard."""


@dataclass(frozen=True, eq=False)
class ScoreNotes:
    """The notes of a score, as far as they are listened for: (N,) each.

    Attributes:
        is_drum: Whether the pitch names a drum.
        part: Which part has it.
    """

    onset_s: Times
    end_s: Times
    pitch: NDArray[np.int64]
    velocity: Times
    is_drum: NDArray[np.bool_]
    part: NDArray[np.int64]

    @classmethod
    def of(cls, score: Score) -> "ScoreNotes":
        """Those of a score."""
        notes = score.notes
        drums = [part.index for part in score.parts if part.is_drums]
        return cls(
            notes.onset_s,
            notes.end_s,
            notes.sounding_pitch.astype(np.int64),
            notes.velocity,
            np.isin(notes.part, drums),
            notes.part.astype(np.int64),
        )

    def of_parts(self, parts: list[int]) -> "ScoreNotes":
        """Those of some parts."""
        kept = np.isin(self.part, parts)
        return ScoreNotes(*(getattr(self, field.name)[kept] for field in fields(self)))


def some_parts(notes: ScoreNotes) -> list[ScoreNotes]:
    """What may be heard where not all of a score is: all but its tune, or its tune alone.

    The tune is taken for the highest part that has a good share of the notes. None has fewer
    notes than `FEWEST_NOTES`.
    """
    tonal = notes.part[~notes.is_drum]
    parts = np.unique(tonal).tolist()
    if len(parts) < 2:
        return []
    counts = {part: int(np.count_nonzero(tonal == part)) for part in parts}
    frequent = [part for part in parts if counts[part] >= TUNE_SHARE * max(counts.values())]
    tune = max(frequent, key=lambda part: float(np.median(notes.pitch[notes.part == part])))
    choices = [[part for part in parts if part != tune], [tune]]
    return [
        notes.of_parts(choice) for choice in choices if sum(counts[part] for part in choice) >= FEWEST_NOTES
    ]


@dataclass(frozen=True, eq=False)
class HeardStretch:
    """A stretch of the score and where it is heard.

    Attributes:
        knots_s: (K,) its ends and the beats between, in the score.
        line_s: (K,) where they are in the recording.
        chord_s: (G,) where its chords stand in the score.
        agreement: (G,) 0..1, how clearly something begins where each is thought to.
    """

    knots_s: Times
    line_s: Times
    chord_s: Times
    agreement: Times

    def place(self, score_s: Times) -> Times:
        """Where places of the score are in the recording."""
        return np.interp(score_s, self.knots_s, self.line_s)

    def trimmed(self, *, at_start: bool, at_end: bool) -> "HeardStretch":
        """Without chords at an edge for which nothing begins: they are part of what is left out."""
        good = np.flatnonzero(self.agreement >= LEAST_AGREEMENT)
        if len(good) < 2:
            return self
        begin, end = float(self.knots_s[0]), float(self.knots_s[-1])
        first, last = int(good[0]), int(good[-1])
        if at_start:
            begin = max(begin, float(self.chord_s[first]))
        if at_end and last + 1 < len(self.chord_s):
            end = min(end, float(self.chord_s[last + 1]))
        inner = (self.knots_s > begin + NEAREST_S) & (self.knots_s < end - NEAREST_S)
        knots_s = np.concatenate(([begin], self.knots_s[inner], [end]))
        kept = (self.chord_s >= begin) & (self.chord_s <= end)
        return HeardStretch(knots_s, self.place(knots_s), self.chord_s[kept], self.agreement[kept])


def hear_stretch(
    notes: ScoreNotes, stretch: Stretch, scaled: Floats, beats_s: Times, transposition: int
) -> HeardStretch:
    """Place the chords of a stretch where they begin in the recording, and lay a line from beat to beat.

    Args:
        notes: Of the whole score.
        stretch: Where the path has it.
        scaled: Of the recording, as `refine_onsets` takes it.
        beats_s: Where the beats are in the score.
        transposition: Semitones by which the recording sounds higher.
    """
    begin, end = float(stretch.score_s[0]), float(stretch.score_s[-1])
    inner = beats_s[(beats_s > begin + NEAREST_S) & (beats_s < end - NEAREST_S)]
    knots_s = np.concatenate(([begin], inner, [end]))
    members = np.flatnonzero((notes.onset_s >= begin - SLACK_S) & (notes.onset_s <= end + SLACK_S))
    onset_s = notes.onset_s[members]
    firsts = chords_of(onset_s)
    chord_s = onset_s[firsts]
    pitches: list[NDArray[np.int64]] = []
    has_drums = np.zeros(len(firsts), dtype=np.bool_)
    for chord, indices in enumerate(np.split(members, firsts[1:]) if len(firsts) else []):
        drums = notes.is_drum[indices]
        has_drums[chord] = bool(drums.any())
        pitches.append(notes.pitch[indices][~drums] + transposition)
    places, first_at = np.unique(stretch.score_s, return_index=True)
    line_s = np.interp(knots_s, places, stretch.song_s[first_at])
    agreement = np.zeros(len(chord_s))
    for _ in range(ROUNDS if len(chord_s) else 0):
        heard_s, clarity = refine_onsets(scaled, np.interp(chord_s, knots_s, line_s), pitches, has_drums)
        line_s = fit_beats(knots_s, chord_s, heard_s, clarity)
        off_s = heard_s - np.interp(chord_s, knots_s, line_s)
        agreement = clarity * np.exp(-((off_s / AGREEMENT_S) ** 2))
    return HeardStretch(knots_s, line_s, chord_s, agreement)
