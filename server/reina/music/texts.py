"""Words that a score carries: lyrics, marks of places, other texts."""

from dataclasses import dataclass
from typing import Literal

TextKind = Literal["lyric", "marker", "text"]


@dataclass(frozen=True)
class ScoreText:
    """A text at a time.

    Attributes:
        kind: ``lyric`` is a syllable that is sung there: a space stands between words, a line feed ends a
            line, two end a verse. ``marker`` is a rehearsal mark or a section's name, ``text`` anything else.
        onset_s: When, seconds.
        onset_beats: When, quarter notes from the score's beginning.
        text: The text.
    """

    kind: TextKind
    onset_s: float
    onset_beats: float
    text: str
