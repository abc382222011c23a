"""What was repaired or left out on the way, told to the person who sent the score."""

from collections import Counter
from dataclasses import dataclass

MAX_OF_A_KIND = 20


@dataclass(frozen=True)
class ScoreWarning:
    """One thing that is not as the file says.

    Attributes:
        kind: A stable name for programs, such as ``unreleased_note`` (docs/music.md lists them).
        place: Where: ``"track 2, byte 118"``, ``"tracks/0/notes/3"``, ``"part 1, note 12"``.
        message: What was found and what was made of it.
    """

    kind: str
    place: str
    message: str


class WarningLog:
    """Collects warnings; of a fault that occurs thousands of times the first are told, then their number."""

    def __init__(self, most_of_a_kind: int = MAX_OF_A_KIND) -> None:
        self._most = most_of_a_kind
        self._warnings: list[ScoreWarning] = []
        self._counts: Counter[str] = Counter()

    def add(self, kind: str, place: str, message: str, count: int = 1) -> None:
        """Tell of a repair; `count` is how many times the message stands for."""
        before = self._counts[kind]
        self._counts[kind] += count
        if before < self._most:
            self._warnings.append(ScoreWarning(kind, place, message))

    def count(self, kind: str) -> int:
        """Return how often a kind was told of, those included that are left out of the list."""
        return self._counts[kind]

    def room(self, kind: str) -> bool:
        """Return whether a further warning of this kind would still be listed."""
        return self._counts[kind] < self._most

    def warnings(self) -> tuple[ScoreWarning, ...]:
        """Return the warnings in the order of their finding, then how many more there were of each kind."""
        listed = Counter(warning.kind for warning in self._warnings)
        more = [
            ScoreWarning(kind, "whole score", f"{count - listed[kind]} more of the kind {kind}")
            for kind, count in self._counts.items()
            if count > listed[kind] >= self._most
        ]
        return (*self._warnings, *more)
