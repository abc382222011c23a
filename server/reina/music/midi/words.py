"""Lyrics, markers and other words of a MIDI file, karaoke files (``.kar``) among them.

A karaoke file says ``@KMIDI KARAOKE FILE`` in a text and has its lyrics as texts of a track named "Words": a
backslash begins a paragraph, a slash a line, and a blank stands before each word. Other texts that begin with
``@`` are its head: ``@T`` lines its title, ``@L`` its language.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from reina.music.midi.text import decode_text, decode_words
from reina.music.midi.track import CUE_POINT, LYRIC, MARKER, TEXT, TRACK_NAME, Meta, Track
from reina.music.texts import ScoreText, TextKind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.music.midi.division import Division
    from reina.music.tempo import TempoMap

HEAD = b"@"
KARAOKE = b"@K"
TITLE = b"@T"
WORDS_TRACK = re.compile(rb"\s*(words|lyrics?)\s*\0*", re.IGNORECASE)
FEWEST = 2
"""A karaoke file has more texts than one that are sung."""

_LINE_END = re.compile(r"\r\n|\r|\n")
_CONTROL = re.compile(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u2028\u2029\ufeff]+")


def karaoke_title(tracks: Sequence[Track], encoding: str) -> str:
    """Return the title that a karaoke file's head gives, "" if there is none."""
    if not _is_karaoke(tracks):
        return ""
    heads = (meta.data[len(TITLE) :] for meta in _texts(tracks, TEXT) if meta.data.startswith(TITLE))
    return next((title for title in (decode_text(head, encoding) for head in heads) if title), "")


def read_texts(
    tracks: Sequence[Track], encoding: str, division: Division, tempo_map: TempoMap
) -> tuple[ScoreText, ...]:
    """Return the words of a file by their time.

    Of several tracks with lyrics the one that has most of them is read.

    Args:
        tracks: The tracks.
        encoding: The character set of the texts.
        division: Ticks and beats.
        tempo_map: Beats and seconds.
    """
    sung = _sung(tracks)
    found: list[tuple[int, TextKind, str]] = []
    if sung:
        syllables = [_syllable(decode_words(meta.data, encoding)) for meta in sung]
        for meta, text in zip(sung, _spaced(syllables), strict=True):
            if text:
                found.append((meta.tick, "lyric", text))
    taken = {id(meta) for meta in sung}
    kinds: tuple[tuple[int, TextKind], ...] = ((MARKER, "marker"), (CUE_POINT, "text"), (TEXT, "text"))
    for kind, called in kinds:
        for meta in _texts(tracks, kind):
            if id(meta) in taken or meta.data.startswith(HEAD):
                continue
            text = decode_text(meta.data, encoding)
            if text:
                found.append((meta.tick, called, text))
    found.sort(key=lambda one: one[0])
    ticks_per_beat = division.ticks_per_beat
    return tuple(
        ScoreText(kind, tempo_map.seconds(tick / ticks_per_beat), tick / ticks_per_beat, text)
        for tick, kind, text in found
    )


def _texts(tracks: Sequence[Track], kind: int) -> list[Meta]:
    return [meta for track in tracks for meta in track.words if meta.kind == kind]


def _is_karaoke(tracks: Sequence[Track]) -> bool:
    return any(meta.data.startswith(KARAOKE) for meta in _texts(tracks, TEXT))


def _sung(tracks: Sequence[Track]) -> list[Meta]:
    """Return the texts that are sung: those of the track that has most, by lyric events or as karaoke."""
    lyrics = [[meta for meta in track.words if meta.kind == LYRIC] for track in tracks]
    is_karaoke = _is_karaoke(tracks)
    nothing: list[Meta] = []
    words: list[list[Meta]] = []
    named: list[list[Meta]] = []
    for track in tracks:
        texts = [meta for meta in track.words if meta.kind == TEXT and not meta.data.startswith(HEAD)]
        if any(meta.kind == TRACK_NAME and WORDS_TRACK.fullmatch(meta.data) for meta in track.metas):
            named.append(texts)
        elif is_karaoke:
            words.append(texts)
    karaoke = max(named, key=len, default=nothing) or max(words, key=len, default=nothing)
    most = max(lyrics, key=len, default=nothing)
    return karaoke if len(karaoke) >= max(len(most), FEWEST) else most


def _syllable(text: str) -> str:
    """Return a syllable with its line ends as line feeds."""
    text = _CONTROL.sub("", _LINE_END.sub("\n", text))
    if text.startswith("\\"):
        return "\n\n" + text[1:]
    if text.startswith("/"):
        return "\n" + text[1:]
    return text


def _spaced(syllables: list[str]) -> list[str]:
    """Put blanks between the words of lyrics that have none, where a hyphen does not join them."""
    if any(text[:1].isspace() or text[-1:].isspace() for text in syllables if text.strip("\n")):
        return syllables
    return [
        text[:-1] if text.endswith("-") and len(text) > 1 else text + " " if text.strip() else text
        for text in syllables
    ]
