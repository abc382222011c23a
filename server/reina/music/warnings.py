"""What was repaired or left out on the way, told to the person who sent the score."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

MAX_OF_A_KIND = 20

Values: TypeAlias = Mapping[str, str | int]
"""What a warning's words hold of this score, by name: ``{"octaves": -1}``."""


@dataclass(frozen=True)
class ScoreWarning:
    """One thing that is not as the file says.

    Attributes:
        kind: A stable name for programs, such as ``unreleased_note`` (docs/music.md lists them).
        place: Where: ``"track 2, byte 118"``, ``"tracks/0/notes/3"``, ``"part 1, note 12"``.
        message: What was found and what was made of it.
        count: How many things it is about, as a musician counts them: 0 where it says more of one that was
            told already, such as a chord's third note.
        values: What a musician's words for it hold beside the count. Warnings of a kind that differ in them
            are counted apart, so there are few: on which side of the range a note lies, not its pitch.
    """

    kind: str
    place: str
    message: str
    count: int = 1
    values: Values = field(default_factory=dict[str, str | int])


_Sort: TypeAlias = tuple[str, tuple[tuple[str, str | int], ...]]
"""What is counted together: a kind, and the values of its warnings."""


class WarningLog:
    """Collects warnings; of a fault that occurs thousands of times the first are told, then their number."""

    def __init__(self, most_of_a_kind: int = MAX_OF_A_KIND) -> None:
        self._most = most_of_a_kind
        self._warnings: list[ScoreWarning] = []
        self._told: Counter[_Sort] = Counter()
        self._things: Counter[_Sort] = Counter()

    def add(
        self,
        kind: str,
        place: str,
        message: str,
        count: int = 1,
        *,
        things: int | None = None,
        values: Values | None = None,
    ) -> None:
        """Tell of a repair.

        Args:
            kind: As `ScoreWarning` has it.
            place: As `ScoreWarning` has it.
            message: As `ScoreWarning` has it.
            count: How many times the message stands for.
            things: How many things it is about, where that is another number.
            values: As `ScoreWarning` has them.
        """
        things = count if things is None else things
        warning = ScoreWarning(kind, place, message, things, values or {})
        sort = _sort(warning)
        if self._told[sort] < self._most:
            self._warnings.append(warning)
        self._told[sort] += count
        self._things[sort] += things

    def count(self, kind: str) -> int:
        """Return how often a kind was told of, those included that are left out of the list."""
        return sum(count for sort, count in self._told.items() if sort[0] == kind)

    def room(self, kind: str) -> bool:
        """Return whether a further warning of this kind would still be listed."""
        return self.count(kind) < self._most

    def warnings(self) -> tuple[ScoreWarning, ...]:
        """Return the warnings in the order of their finding, then how many more there were of each kind."""
        listed = Counter(map(_sort, self._warnings))
        things = self._things.copy()
        for warning in self._warnings:
            things[_sort(warning)] -= warning.count
        more = [
            ScoreWarning(
                sort[0],
                "whole score",
                f"{count - listed[sort]} more of the kind {sort[0]}",
                things[sort],
                dict(sort[1]),
            )
            for sort, count in self._told.items()
            if count > listed[sort] >= self._most
        ]
        return (*self._warnings, *more)


def _sort(warning: ScoreWarning) -> _Sort:
    return warning.kind, tuple(sorted(warning.values.items()))
