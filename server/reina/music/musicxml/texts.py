"""Lyrics, rehearsal marks and words, as they are played."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.music.texts import ScoreText, TextKind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.music.musicxml.model import Place, Syllable, WrittenPart
    from reina.music.musicxml.timeline import Timeline
    from reina.music.tempo import TempoMap

MAX_TEXTS = 20_000


def read_texts(
    parts: Sequence[WrittenPart], timeline: Timeline, tempo_map: TempoMap
) -> tuple[ScoreText, ...]:
    """Return the lyrics of the part that has most of them, and the marks and words of all, by their time.

    On its nth playing a measure has its nth verse, or the last one that it has.
    """
    found: list[tuple[float, TextKind, str]] = []
    fullest = max(parts, key=lambda part: len(part.syllables), default=None)
    sung = fullest.syllables if fullest else []
    verses: dict[Place, dict[int, Syllable]] = {}
    for syllable in sung:
        verses.setdefault(syllable.place, {}).setdefault(syllable.verse, syllable)
    for beat, played, place in timeline.unroll(list(verses), lambda place: place, holds=False):
        there = verses[place]
        fitting = [verse for verse in there if verse <= played.playing]
        if fitting:
            found.append((beat, "lyric", there[max(fitting)].text))
    words = list(dict.fromkeys(word for part in parts for word in part.words))
    for beat, _, word in timeline.unroll(words, lambda word: word.place, holds=False):
        found.append((beat, word.kind, word.text))
    found.sort(key=lambda text: text[0])
    return tuple(
        ScoreText(kind, tempo_map.seconds(beat), beat, text) for beat, kind, text in found[:MAX_TEXTS]
    )
