"""Ornaments: what a note's signs say, and the notes that players make of it."""

from __future__ import annotations

from dataclasses import replace
from math import floor
from typing import TYPE_CHECKING

from reina.music.musicxml import tables
from reina.music.musicxml.element import Element, whole_of
from reina.music.musicxml.model import Ornament

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from reina.music.musicxml.played_note import PlayedNote
    from reina.music.tempo import TempoMap

STROKE_S = 0.085
"""How long each note of a trill lasts: six times to and fro in a second, as players do it."""
MORDENT_S = 0.075
TURN_S = 0.11
SHORTEST_STROKE_S = 0.06
"""Of a tremolo: a good double tongue, or a bow."""
MOST_STROKES = 2_000
"""Of one note."""
MEASURED_SLASHES = 8
FLAGS = {"eighth": 1, "16th": 2, "32nd": 3, "64th": 4, "128th": 5}


def ornament_of(
    signs: Element, kind_of_note: str, neighbour: Callable[[int, int | None], int]
) -> tuple[Ornament | None, list[Element]]:
    """Read the signs of a note.

    Args:
        signs: The element ``ornaments``.
        kind_of_note: The value that is written, ``"quarter"``.
        neighbour: Tells the pitch so many steps above the note, with an accidental or as the key has it.

    Returns:
        What is made of the note, None if it is played as it is written; and the signs that are not played.
    """
    made: Ornament | None = None
    left: list[Element] = []
    accidentals = [mark for mark in signs if mark.name == "accidental-mark"]
    above = _alter(accidentals, "above")
    below = _alter(accidentals, "below")
    for sign in signs:
        one: Ornament | None = None
        match sign.name:
            case "trill-mark" | "shake":
                one = Ornament(
                    "trill", neighbour(1, above), other_first=sign.attribute("start-note") == "upper"
                )
            case "mordent":
                # The one with the stroke through it goes down, the one without goes up.
                alter = below if below is not None else above
                one = Ornament("mordent", neighbour(-1, alter), is_long=sign.attribute("long") == "yes")
            case "inverted-mordent":
                one = Ornament("mordent", neighbour(1, above), is_long=sign.attribute("long") == "yes")
            case "turn" | "vertical-turn" | "delayed-turn":
                kind = "delayed-turn" if sign.name[0] == "d" else "turn"
                one = Ornament(kind, neighbour(1, above), neighbour(-1, below))
            case "inverted-turn" | "inverted-vertical-turn" | "delayed-inverted-turn":
                kind = "delayed-turn" if sign.name[0] == "d" else "turn"
                one = Ornament(kind, neighbour(-1, below), neighbour(1, above))
            case "tremolo" if sign.attribute("type") in {"", "single", "unmeasured"}:
                slashes = whole_of(sign.text.strip() or "3")
                if slashes is not None and 0 <= slashes <= MEASURED_SLASHES:
                    flags = (slashes or 3) + FLAGS.get(kind_of_note, 0)
                    one = Ornament("tremolo", unit_beats=0.5**flags)
            case "accidental-mark" | "other-ornament" | "wavy-line":
                continue
            case _:
                pass
        if one is not None and made is None:
            made = one
        else:
            left.append(sign)
    return made, left


def _alter(marks: list[Element], placement: str) -> int | None:
    """Return what an accidental beside an ornament says, above it where it says nothing of its place."""
    for mark in marks:
        if (mark.attribute("placement") or "above") == placement:
            return tables.ACCIDENTALS.get(mark.text.strip())
    return None


def played_out(note: PlayedNote, tempo_map: TempoMap) -> Iterator[PlayedNote]:
    """Yield the notes that are made of one with an ornament, evenly in time."""
    ornament = note.ornament
    if ornament is None:
        yield note
        return
    begin_s, end_s = tempo_map.seconds(note.ornament_from), tempo_map.seconds(note.end)
    strokes = list(_strokes(ornament, note.pitch, end_s - begin_s, note.end - note.ornament_from))
    edges_s = [begin_s]
    for _, length in strokes:
        edges_s.append(edges_s[-1] + length)
    edges = [tempo_map.beats(edge) for edge in edges_s]
    edges[0], edges[-1] = note.ornament_from, note.end
    is_first = True
    if note.ornament_from > note.onset:
        yield replace(note, end=note.ornament_from, ornament=None)
        is_first = False
    for (pitch, _), at, until in zip(strokes, edges, edges[1:], strict=False):
        slurred = note.slurred if is_first else ornament.kind != "tremolo"
        yield replace(note, onset=at, end=until, pitch=pitch, slurred=slurred, ornament=None)
        is_first = False


def _strokes(
    ornament: Ornament, pitch: int, lasts_s: float, lasts_beats: float
) -> Iterator[tuple[int, float]]:
    """Yield the pitches of an ornament and how many seconds each lasts."""
    first, second = ornament.first, ornament.second
    match ornament.kind:
        case "trill":
            # It ends with the note itself: of an odd number, or of an even one if it begins with the other.
            odd = 0 if ornament.other_first else 1
            count = min(max(2 * round((lasts_s / STROKE_S - odd) / 2) + odd, 2 + odd), MOST_STROKES + odd)
            for number in range(count):
                is_other = (number % 2 == 0) == ornament.other_first
                yield (first if is_other else pitch), lasts_s / count
        case "mordent":
            times = 2 if ornament.is_long else 1
            short = min(MORDENT_S, lasts_s / (2 * times + 2))
            for _ in range(times):
                yield pitch, short
                yield first, short
            yield pitch, lasts_s - 2 * times * short
        case "turn":
            short = min(TURN_S, lasts_s / 4)
            yield from ((first, short), (pitch, short), (second, short), (pitch, lasts_s - 3 * short))
        case "delayed-turn":
            short = min(TURN_S, lasts_s / 8)
            yield pitch, lasts_s - 4 * short
            yield from ((first, short), (pitch, short), (second, short), (pitch, short))
        case "tremolo":
            count = max(round(lasts_beats / ornament.unit_beats), 1)
            count = min(count, max(floor(lasts_s / SHORTEST_STROKE_S), 1), MOST_STROKES)
            for _ in range(count):
                yield pitch, lasts_s / count
