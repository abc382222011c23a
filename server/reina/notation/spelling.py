"""Pitch spelling: F♯ or G♭.

A pitch's name is its place on the line of fifths (… B♭ -2, F -1, C 0, G 1, … F♯ 6), which says letter and
accidental at once. What belongs to the key keeps the key's name. A pitch that does not has one name with a
sharp and one with a flat; the cheapest way through the whole line is taken (Viterbi), where

- a name costs by how far it lies from the key on the line of fifths, so that the rare ones are the last;
- a step costs by how strange the interval is that the two names make: diatonic ones nothing, an augmented
  second or a diminished fourth something;
- a chromatic semitone (F-F♯) costs little on the way out of the key and more on the way back into it:
  C C♯ D and D D♭ C, as chromatic scales are taught (rising sharps, falling flats, but B♭ and F♯ both ways).

Names of two accidentals are never used: in a key where they would be right the simpler name stands.
"""

import math
from bisect import bisect_right
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from reina.music.arrays import FloatArray, IntArray, NarrowIntArray, read_only
from reina.notation.keys import Key

LETTERS = "FCGDAEB"
"""By fifths: so sharps are added to a signature, and flats the other way round."""
ACCIDENTALS = {-1: "♭", 0: "", 1: "♯"}
FLATTEST, SHARPEST = -8, 12
"""F♭ and B♯: what has one accidental lies between."""

NAME_COSTS = (0.0, 0.0, 0.0, 0.0, 0.2, 0.35, 0.5, 0.7, 1.2)
"""Of a name outside the key, by its distance from the middle of the key's scale; beyond it grows by 1.3."""
RAISED_IN_MINOR = 0.1
"""Of the raised sixth and seventh of a minor key, which belong to it."""
STEP_COSTS = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.5, 0.8, 0.7, 1.2, 1.8, 5.0)
"""Of an interval, by its fifths: 7 is a chromatic semitone, 8 a diminished fourth, 9 an augmented second,
12 the same pitch by another name."""
OUT_OF_KEY, INTO_KEY = 0.3, 1.0
"""Of a chromatic semitone that leaves the key, and of one that comes back."""
FORGET_BEATS = 4.0
"""After a rest of this length the note before says nothing of the next one's name."""


def spell(
    pitches: NarrowIntArray, onset_beats: FloatArray, keys: Sequence[Key], *, semitones: int = 0
) -> IntArray:
    """Return the place of each pitch's name on the line of fifths, (N,) int64, within -8 to 12.

    Args:
        pitches: (N,) MIDI numbers, by onset.
        onset_beats: (N,) where they begin, quarter notes.
        keys: The keys of the music as it is written in the file.
        semitones: By how much the pitches are away from the file's: the keys are moved along.
    """
    moved = [key.transposed(semitones) for key in keys]
    tables = [_Names(key) for key in moved]
    begins = [key.onset_beats - 1e-9 for key in moved]
    before: list[tuple[int, float]] = [(0, 0.0)]
    came_from: list[list[int]] = []
    names: list[list[int]] = []
    last_pitch, last_beat = -1, -math.inf
    for pitch, beat in zip(pitches.tolist(), onset_beats.tolist(), strict=True):
        table = tables[max(bisect_right(begins, beat) - 1, 0)]
        free = beat - last_beat > FORGET_BEATS
        now: list[tuple[int, float]] = []
        steps: list[int] = []
        for name, cost in table.of(pitch % 12):
            ways = [
                total + (0.0 if free else table.step(other, name, abs(pitch - last_pitch)))
                for other, total in before
            ]
            best = min(range(len(ways)), key=ways.__getitem__)
            steps.append(best)
            now.append((name, ways[best] + cost))
        came_from.append(steps)
        names.append([name for name, _ in now])
        before = now
        last_pitch, last_beat = pitch, beat
    spelled = np.zeros(len(names), dtype=np.int64)
    at = min(range(len(before)), key=lambda index: before[index][1])
    for index in range(len(names) - 1, -1, -1):
        spelled[index] = names[index][at]
        at = came_from[index][at]
    return read_only(spelled)


class _Names:
    """What each pitch class may be called in a key, and what that costs."""

    def __init__(self, key: Key) -> None:
        self._lowest = key.fifths - 1
        self._raised = {key.tonic + 3, key.tonic + 5} if key.is_minor else set[int]()
        self._middle = key.fifths + (3 if key.is_minor else 2)
        self._of = [self._names(pitch_class) for pitch_class in range(12)]

    def of(self, pitch_class: int) -> list[tuple[int, float]]:
        """Return the names of a pitch class, places on the line of fifths, each with its cost."""
        return self._of[pitch_class]

    def step(self, before: int, name: int, semitones: int) -> float:
        """Return what it costs to go from one name to another."""
        apart = abs(name - before)
        if apart == 7 and semitones == 1:
            return OUT_OF_KEY if self._is_diatonic(before) else INTO_KEY
        return STEP_COSTS[min(apart, 12)]

    def _is_diatonic(self, name: int) -> bool:
        return 0 <= name - self._lowest <= 6

    def _names(self, pitch_class: int) -> list[tuple[int, float]]:
        all_names = [place for place in range(FLATTEST, SHARPEST + 1) if 7 * place % 12 == pitch_class]
        diatonic = [name for name in all_names if self._is_diatonic(name)]
        if diatonic:
            return [(diatonic[0], 0.0)]
        return sorted(((name, self._cost(name)) for name in all_names), key=lambda one: one[1])[:2]

    def _cost(self, name: int) -> float:
        if name in self._raised:
            return RAISED_IN_MINOR
        apart = abs(name - self._middle)
        known = NAME_COSTS[min(apart, len(NAME_COSTS) - 1)]
        return known + 1.3 * max(0, apart - len(NAME_COSTS) + 1)


def letter(name: int) -> str:
    """Return the letter of a name, a place on the line of fifths."""
    return LETTERS[(name + 1) % 7]


def alteration(name: int) -> int:
    """Return the accidental of a name: 1 is a sharp, -1 a flat."""
    return (name + 1) // 7


def octave(pitch: int, name: int) -> int:
    """Return the octave of a pitch by its name: B♯3 sounds as C4."""
    return (pitch - alteration(name)) // 12 - 1


@lru_cache(maxsize=4096)
def named(pitch: int, name: int) -> str:
    """Return a pitch's name for people, ``"F♯5"``; C4 is 60.

    All notes of a name share one text.
    """
    return f"{letter(name)}{ACCIDENTALS[alteration(name)]}{octave(pitch, name)}"


def both_names(pitch: int) -> tuple[str, ...]:
    """Return what a pitch is called in charts: ``("F♯4", "G♭4")`` for a black key, else one name."""
    flat, sharp = -6, 10
    places = [place for place in range(flat, sharp + 1) if 7 * place % 12 == pitch % 12]
    natural = [place for place in places if alteration(place) == 0]
    return tuple(named(pitch, place) for place in (natural or sorted(places, reverse=True)))
