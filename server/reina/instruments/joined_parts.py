"""Parts that one player plays together: one instrument's music that a file spreads over several parts."""

from collections.abc import Iterable, Sequence

import numpy as np

from reina.music.arrays import IntArray
from reina.music.errors import NotInScoreError
from reina.music.score import Score


def check_joined_parts(score: Score, part: int, joined_parts: Sequence[int]) -> tuple[int, ...]:
    """Return the parts that are joined to a part, ascending.

    Args:
        score: The score.
        part: Index of the part that they are joined to; the score has it.
        joined_parts: Their indices, in any order.

    Raises:
        NotInScoreError: If the score lacks one of them, or it is drums, `part` itself or named twice.
    """
    for place, joined in enumerate(joined_parts):
        fault = None
        if not 0 <= joined < len(score.parts):
            fault = f"there is no part {joined}"
        elif joined == part:
            fault = f"part {joined} is the part that the others are joined to"
        elif score.parts[joined].is_drums:
            fault = f"part {joined} (“{score.parts[joined].name}”) is drums"
        elif joined in joined_parts[:place]:
            fault = f"part {joined} is named twice"
        if fault is not None:
            others = [other.index for other in score.parts if other.index != part and not other.is_drums]
            raise NotInScoreError(
                f"{fault}; parts that can be joined to part {part}: {_as_runs(others) or 'none'}",
                location=f"joined_parts/{place}",
            )
    return tuple(sorted(joined_parts))


def notes_of_parts(score: Score, parts: Sequence[int]) -> IntArray:
    """Return the indices into the score's notes of several parts' notes, (M,) int64, in their order."""
    return np.flatnonzero(np.isin(score.notes.part, parts))


def _as_runs(indices: Iterable[int]) -> str:
    """Ascending indices in few words: ``"0, 2 to 5, 7"``."""
    runs: list[tuple[int, int]] = []
    for index in indices:
        if runs and index == runs[-1][1] + 1:
            runs[-1] = (runs[-1][0], index)
        else:
            runs.append((index, index))
    return ", ".join(str(first) if first == last else f"{first} to {last}" for first, last in runs)
