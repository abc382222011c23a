"""Trills that a file plays out note by note are one note with a sign."""

from collections.abc import Sequence
from dataclasses import dataclass

FASTEST_WRITTEN_S = 0.115
"""What alternates faster than this is a trill: sixteenths at 130 a minute."""

MIN_NOTES = 6


@dataclass(frozen=True)
class Trill:
    """A run of notes that is written as one.

    Attributes:
        first: Its first note in the line.
        last: Its last.
        main: A note of it that has the pitch that is written, the lower one.
        upper: A note of it that has the other.
    """

    first: int
    last: int
    main: int
    upper: int


def find_trills(pitches: Sequence[int], onset_s: Sequence[float], end_s: Sequence[float]) -> list[Trill]:
    """Return the trills of a line: neighbours a semitone or a tone apart that alternate fast."""
    trills: list[Trill] = []
    first = 0
    while first + MIN_NOTES <= len(pitches):
        last = _run_from(first, pitches, onset_s, end_s)
        if last - first + 1 >= MIN_NOTES:
            lower = min(pitches[first], pitches[first + 1])
            main = last if pitches[last] == lower else last - 1
            trills.append(Trill(first, last, main, last - 1 if main == last else last))
            first = last + 1
        else:
            first = max(last, first + 1)
    return trills


def _run_from(first: int, pitches: Sequence[int], onset_s: Sequence[float], end_s: Sequence[float]) -> int:
    if abs(pitches[first + 1] - pitches[first]) not in (1, 2):
        return first
    last = first
    while (
        last + 1 < len(pitches)
        and pitches[last + 1] == pitches[first + (last + 1 - first) % 2]
        and onset_s[last + 1] - onset_s[last] <= FASTEST_WRITTEN_S
        and onset_s[last + 1] - end_s[last] <= FASTEST_WRITTEN_S / 2
    ):
        last += 1
    return last
