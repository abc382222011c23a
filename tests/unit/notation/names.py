"""Pitches by their names, for tests."""

import numpy as np

from reina.music.arrays import IntArray
from reina.notation import Key, named, spell

STEPS = {"C": 0, "D": 2, "E": 4, "F": 5, "G": 7, "A": 9, "B": 11}
ALTERATIONS = {"♭": -1, "": 0, "♯": 1}


def number(name: str) -> int:
    """``"F♯4"`` -> 66."""
    return STEPS[name[0]] + ALTERATIONS[name[1:-1]] + 12 * (int(name[-1]) + 1)


def numbers(names: str) -> IntArray:
    return np.array([number(name) for name in names.split()], dtype=np.int64)


def spelled(names: str, key: Key) -> str:
    """What the pitches of these names are called in a key, one note a half beat."""
    pitches = numbers(names)
    places = spell(pitches, np.arange(len(pitches), dtype=np.float64) * 0.5, [key])
    return " ".join(named(*pair) for pair in zip(pitches.tolist(), places.tolist(), strict=True))
