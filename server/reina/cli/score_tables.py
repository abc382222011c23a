"""A score, and how it is played, as tables in plain text."""

from collections.abc import Iterable, Sequence

import numpy as np

from reina.instruments import Instrument, NoteNames, PlayedPart
from reina.music import Finding, Score, ScoreWarning
from reina.music.lyrics import lyric_lines

REST = "–"

FINGERING_HEADS = ("bar", "beat", "second", "lasts", "written", "sounds", "fingering", "why")
"""Of `fingering_rows`."""


def heading(score: Score) -> Iterable[str]:
    """Title, length and notes, and which of several sequences it is."""
    minutes, seconds = divmod(score.duration_s, 60)
    yield f"{score.title}  {int(minutes)}:{seconds:05.2f}  {len(score.notes)} notes"
    if score.sequences > 1:
        yield f"sequence {score.sequence} of {score.sequences}"


def finding_lines(findings: Sequence[Finding]) -> Iterable[str]:
    """A section of what a musician is told."""
    yield from section("To know")
    for finding in findings:
        who = "" if finding.player is None else f"player {finding.player + 1}: "
        yield f"  {who if len({one.player for one in findings} - {None}) > 1 else ''}{finding.text}"


def warning_lines(warnings: Sequence[ScoreWarning]) -> Iterable[str]:
    """A section of warnings."""
    yield from section(f"Warnings: {len(warnings) or 'none'}")
    yield from table(("kind", "place", "what"), [(w.kind, w.place, w.message) for w in warnings])


def words_lines(score: Score) -> Iterable[str]:
    """Sections of marks and other words, and of the lines of lyrics; nothing where there are none."""
    positions = score.metre_map.positions(np.array([text.onset_beats for text in score.texts]))
    words = [
        (str(place.bar), f"{place.beat:g}", f"{text.onset_s:.3f}", text.kind, text.text)
        for text, place in zip(score.texts, positions, strict=True)
        if text.kind != "lyric"
    ]
    if words:
        yield from section("Words")
        yield from table(("bar", "beat", "second", "kind", "text"), words)
    sung = [(f"{line.start_s:.3f}", line.text) for line in lyric_lines(score.texts)]
    if sung:
        yield from section("Lyrics")
        yield from table(("second", "line"), sung)


def fingering_lines(score: Score, instrument: Instrument, played: PlayedPart) -> Iterable[str]:
    """A section of what is played, note by note."""
    yield from section(f"Fingerings of {named_parts(played.parts)}, transposed by {played.transposition}")
    yield from table(FINGERING_HEADS, fingering_rows(score, instrument, played))


def named_parts(parts: Sequence[int]) -> str:
    """``part 0`` or ``parts 0, 2``."""
    return f"part{'' if len(parts) == 1 else 's'} {', '.join(map(str, parts))}"


def fingering_rows(score: Score, instrument: Instrument, played: PlayedPart) -> list[tuple[str, ...]]:
    """What is played, note by note, in the columns of `FINGERING_HEADS`."""
    rows: list[tuple[str, ...]] = []
    line, fingering = played.line, played.fingering
    names = NoteNames(score, [(instrument, played)])
    positions = score.metre_map.positions(score.notes.onset_beats[line.note_index])
    for place, position in enumerate(positions):
        sounding, written = names.of(int(line.note_index[place]))
        played_so = fingering.notes[place]
        rows.append(
            (
                str(position.bar),
                f"{position.beat:g}",
                f"{line.onset_s[place]:.3f}",
                f"{line.end_s[place] - line.onset_s[place]:.3f}",
                written,
                sounding,
                REST if played_so is None else instrument.show_fingering(played_so),
                fingering.reasons[place],
            )
        )
    return rows


def section(title: str) -> tuple[str, str]:
    """An empty line and a title."""
    return ("", title)


def table(heads: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> Iterable[str]:
    """Rows under their heads, each column as wide as it needs; nothing of no rows."""
    if not rows:
        return
    widths = [max(map(len, column)) for column in zip(heads, *rows, strict=True)]
    for row in (heads, *rows):
        yield "  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
