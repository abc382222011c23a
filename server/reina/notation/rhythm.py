"""A line of notes in written time."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Placed:
    """A note in its written time.

    Attributes:
        note: Its place in the line.
        begin: Ticks from the score's beginning.
        end: After `begin`; not after the next note's begin.
        is_staccato: Whether it sounds far shorter.
        graces: Notes of the line that sound so shortly before it that they are its grace notes.
    """

    note: int
    begin: int
    end: int
    is_staccato: bool = False
    graces: tuple[int, ...] = ()


@dataclass(frozen=True)
class Rhythm:
    """A line in written time.

    Attributes:
        notes: By their begin.
        tuplets: Where each beat that is a tuplet begins, ticks -> its length and its grid, ticks.
        swing: Whether eighths that were swung are written even.
    """

    notes: tuple[Placed, ...]
    tuplets: dict[int, tuple[int, int]]
    swing: bool
