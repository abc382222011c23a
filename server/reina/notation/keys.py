"""Keys: those that a file has, or else the one that its notes are in; and keys of transposing instruments.

The key of notes is found as Krumhansl and Schmuckler do: the durations of the twelve pitch classes are
correlated with a profile of each of the 24 keys, and the best fits (C. L. Krumhansl, Cognitive Foundations
of Musical Pitch, 1990, chapter 4). The profiles are those of J. Albrecht and D. Shanahan (The Use of Large
Corpora to Train a New Type of Key-Finding Algorithm, Music Perception 31, 2013), counted in scores: they
take fewer keys for their dominant's than Krumhansl and Kessler's, which were found by asking listeners.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from reina.music.arrays import BoolArray, FloatArray, IntArray
from reina.music.score import Score

MAJOR = (0.238, 0.006, 0.111, 0.006, 0.137, 0.094, 0.016, 0.214, 0.009, 0.080, 0.008, 0.081)
MINOR = (0.220, 0.006, 0.104, 0.123, 0.019, 0.103, 0.012, 0.214, 0.062, 0.022, 0.061, 0.052)
"""How much of the music each pitch class above the tonic has, in major and in minor."""

SCALE = (0, 2, 4, 5, 7, 9, 11)

MAX_FIFTHS = 6
"""A transposed key has no more accidentals than these: of seven the other spelling has five."""

MIN_FIT = 0.66
"""Music of which less is in the scale of the key found is in none; of a chromatic scale it is 7/12."""

DOUBTED_FIT, DOUBTED_GAIN = 0.8, 0.15
"""A file's only key is doubted where it is C major, which programs write unasked, if less than this share of
the music is in its scale and so much more in that of the key that the notes are in."""

_FLATTEST = -8
_TONICS = tuple("F♭ C♭ G♭ D♭ A♭ E♭ B♭ F C G D A E B F♯ C♯ G♯ D♯ A♯".split())  # noqa: SIM905 - one line


@dataclass(frozen=True)
class Key:
    """A key from a beat on.

    Attributes:
        onset_beats: Where it begins, quarter notes.
        fifths: Sharps of its signature; flats are negative.
        is_minor: Whether it is a minor key.
        source: ``file`` where the file says so, ``notes`` where it is found from the notes, ``none`` where
            the notes are in no key: then there is no signature, for whichever instrument it is written.
    """

    onset_beats: float
    fifths: int
    is_minor: bool = False
    source: Literal["file", "notes", "none"] = "file"

    @property
    def tonic(self) -> int:
        """Its tonic on the line of fifths, where F is -1, C 0 and G 1."""
        return self.fifths + (3 if self.is_minor else 0)

    @property
    def name(self) -> str:
        """Its name for people, ``"E♭ major"``."""
        if self.source == "none":
            return "no key"
        return f"{_TONICS[self.tonic - _FLATTEST]} {'minor' if self.is_minor else 'major'}"

    def transposed(self, semitones: int) -> "Key":
        """Return the key that it becomes with everything moved, of two spellings the simpler one."""
        if semitones % 12 == 0 or self.source == "none":
            return self
        return replace(self, fifths=simplest(self.fifths + fifths_of(semitones)))


NO_KEY = Key(0.0, 0, source="none")


def fifths_of(semitones: int) -> int:
    """Return by how many fifths an interval of semitones moves a key, -5 to 6."""
    return (7 * semitones + 5) % 12 - 5


def simplest(fifths: int) -> int:
    """Return the same key with six sharps or flats at most."""
    while fifths > MAX_FIFTHS:
        fifths -= 12
    while fifths < -MAX_FIFTHS:
        fifths += 12
    return fifths


def keys_of(score: Score) -> tuple[Key, ...]:
    """Return the keys of a score as it sounds, by their beat; the first from beat 0."""
    found = tuple(Key(one.onset_beats, one.fifths, one.is_minor) for one in score.key_signatures)
    if found and not (len(found) == 1 and found[0].fifths == 0 and not found[0].is_minor):
        return (replace(found[0], onset_beats=0.0), *found[1:])
    weights = _weights(score)
    heard = estimate_key(weights)
    if found and (heard.source == "none" or not _is_doubtful(weights, heard)):
        return (replace(found[0], onset_beats=0.0),)
    return (heard,)


def estimate_key(weights: FloatArray) -> Key:
    """Return the key that music is in.

    Args:
        weights: (12,) how much of it each pitch class has, from C; the unit does not matter.
    """
    if not np.any(weights > 0) or np.ptp(weights) == 0:
        return NO_KEY
    best, fit = NO_KEY, -np.inf
    for fifths in (0, 1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 6):
        for is_minor in (False, True):
            key = Key(0.0, fifths, is_minor, "notes")
            profile = np.roll(MINOR if is_minor else MAJOR, 7 * key.tonic % 12)
            correlation = float(np.corrcoef(weights, profile)[0, 1])
            if correlation > fit + 1e-12:
                best, fit = key, correlation
    return best if _fit(weights, best.fifths) >= MIN_FIT else NO_KEY


def key_at(keys: Sequence[Key], beats: float) -> Key:
    """Return the key that holds at a beat."""
    return next((key for key in reversed(keys) if key.onset_beats <= beats + 1e-9), keys[0])


def _is_doubtful(weights: FloatArray, heard: Key) -> bool:
    fit = _fit(weights, 0)
    return fit < DOUBTED_FIT and _fit(weights, heard.fifths) - fit > DOUBTED_GAIN


def _fit(weights: FloatArray, fifths: int) -> float:
    """Return which share of the music is in the scale of a signature."""
    scale = [(step + 7 * fifths) % 12 for step in SCALE]
    return float(np.sum(weights[scale]) / max(np.sum(weights), 1e-12))


def _weights(score: Score) -> FloatArray:
    notes = score.notes
    drums: IntArray = np.array([part.index for part in score.parts if part.is_drums], dtype=np.int64)
    tones: BoolArray = ~np.isin(notes.part, drums)
    pitch_classes = notes.sounding_pitch[tones] % 12
    counted = np.bincount(pitch_classes, weights=notes.duration_beats[tones], minlength=12)
    return counted.astype(np.float64)
