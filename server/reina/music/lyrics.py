"""The lines of a score's lyrics."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.music.texts import ScoreText

LONG_GAP_S = 5.0
"""A silence of the singer that ends a line."""
LONGEST_LINE = 60
"""Characters after which a line ends at the next word."""
HELD_S = 4.0
"""How long a line holds after its last syllable, unless the next begins before."""


@dataclass(frozen=True)
class SungSyllable:
    """A syllable and when it is sung."""

    onset_s: float
    text: str


@dataclass(frozen=True)
class LyricLine:
    """A line of lyrics: from its first syllable until the next line begins, or it is long over."""

    start_s: float
    end_s: float
    syllables: tuple[SungSyllable, ...]

    @property
    def text(self) -> str:
        """The whole line."""
        return "".join(syllable.text for syllable in self.syllables)


def lyric_lines(texts: Iterable[ScoreText]) -> tuple[LyricLine, ...]:
    """Return the lines of all lyrics as their line feeds have them; very long ones, and silences, are broken.

    Args:
        texts: What a score carries, by time.
    """
    lines: list[list[SungSyllable]] = [[]]
    length = 0
    for text in texts:
        if text.kind != "lyric":
            continue
        before = lines[-1]
        is_silent = bool(before) and text.onset_s - before[-1].onset_s > LONG_GAP_S
        if is_silent or (length > LONGEST_LINE and before[-1].text.endswith(" ")):
            lines.append([])
            length = 0
        for number, piece in enumerate(text.text.split("\n")):
            if number:
                lines.append([])
                length = 0
            if piece.strip() or (piece and lines[-1]):
                lines[-1].append(SungSyllable(text.onset_s, piece))
                length += len(piece)
    kept = [trimmed for trimmed in map(_trimmed, lines) if trimmed]
    starts = [*(line[0].onset_s for line in kept), float("inf")][1:]
    return tuple(
        LyricLine(line[0].onset_s, min(following, line[-1].onset_s + HELD_S), line)
        for line, following in zip(kept, starts, strict=False)
    )


def _trimmed(line: list[SungSyllable]) -> tuple[SungSyllable, ...]:
    """Return a line without the blanks about it."""
    while line and not line[-1].text.strip():
        line = line[:-1]
    if not line:
        return ()
    last = line[-1]
    line = [*line[:-1], SungSyllable(last.onset_s, last.text.rstrip())]
    return (SungSyllable(line[0].onset_s, line[0].text.lstrip()), *line[1:])
