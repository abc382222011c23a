"""Octaves that bring a part into an instrument's range."""

import numpy as np

from reina.music.arrays import IntArray

OCTAVES = (0, -1, 1, -2, 2, -3, 3, -4, 4)


def fitting_octaves(pitches: IntArray, lowest: int, highest: int) -> int:
    """Return by how many octaves to move `pitches` so that most of them lie within `lowest` to `highest`.

    Of equals the smallest move, down before up; 0 if none brings more into range.
    """

    def inside(octaves: int) -> int:
        moved = pitches + 12 * octaves
        return int(np.count_nonzero((moved >= lowest) & (moved <= highest)))

    return max(OCTAVES, key=inside)
