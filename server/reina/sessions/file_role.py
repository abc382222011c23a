"""What a file is for: a score, a song or a show, by what stands at its beginning.

One rule for everybody who has files and does not know: the page that they are dropped on, and an upload that
was sent as what it is not.
"""

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import PurePath
from typing import Literal

from reina.music.file_kinds import kind_of
from reina.music.musicxml.detect import is_musicxml
from reina.music.packed import GZIP_MAGIC, MIDI_SUFFIXES, MUSICXML_SUFFIXES, ZIP_MAGICS
from reina.music.read import JSON_BEGINNINGS
from reina.sound.recording.probe import FORMATS, MP3, SUPPORTED

Role = Literal["score", "song", "show"]

LOOKED_AT_BYTES = 65_536
"""So much of a file's beginning says what it is."""

SCORE_FIELDS = frozenset({"format", "header", "notes", "parts"})
"""Of a JSON document that is a score, in Reina's own form or by Tone.js's converter."""
SCORE_TRACK_FIELDS = frozenset(
    {"channel", "controlChanges", "instrument", "instrumentNumber", "isPercussion", "notes", "pitchBends"}
)
"""Of its tracks."""
SHOW_FIELDS = frozenset({"markers", "time", "version"})
SHOW_TRACK_FIELDS = frozenset({"events", "keyframes", "parameter"})

SONG_SUFFIXES = frozenset(
    {".aac", ".aif", ".aifc", ".aiff", ".flac", ".m4a", ".m4b", ".mp3", ".mp4"}
    | {".oga", ".ogg", ".opus", ".wav", ".weba", ".webm", ".wma"}
)
SCORE_SUFFIXES = MIDI_SUFFIXES | MUSICXML_SUFFIXES | {".gz", ".zip", ".json"}
NAME_ADVICE = f"a score is MIDI, MusicXML or JSON, a song {SUPPORTED}, a show JSON"

_TOKEN = re.compile(r'"((?:[^"\\]|\\.)*)"(\s*:)?|[{}\[\]]')


@dataclass(frozen=True)
class FileRole:
    """What a file is.

    Attributes:
        role: What it can be used as; None: as nothing.
        name: What it is, for people: ``"a MIDI file"``, ``"a PDF"``.
        advice: What to send in its place; empty where it can be used.
    """

    role: Role | None
    name: str
    advice: str = ""


MIDI_FILE = FileRole("score", "a MIDI file")
MUSICXML = FileRole("score", "MusicXML")
JSON_SCORE = FileRole("score", "a score in JSON")
SHOW = FileRole("show", "a show")
OTHER_JSON = FileRole("score", "JSON")
"""What is in doubt is left to the reader of scores, which says what is wrong and where."""


def role_of(data: bytes, filename: str | None = None) -> FileRole:
    """Tell what a file is by its beginning, and by its name only where that says nothing.

    Args:
        data: The file, or its first `LOOKED_AT_BYTES`.
        filename: Its name.
    """
    head = data[:LOOKED_AT_BYTES]
    if not head:
        return FileRole(None, "an empty file", NAME_ADVICE)
    if head.startswith(b"MThd") or (head.startswith(b"RIFF") and head.startswith(b"RMID", 8)):
        return MIDI_FILE
    if head.startswith((GZIP_MAGIC, *ZIP_MAGICS)):
        return FileRole("score", "a compressed file")
    for audio in (*FORMATS, MP3):
        if audio.recognizes(head):
            return FileRole("song", f"a recording ({audio.name})")
    if is_musicxml(head):
        return MUSICXML
    kind = kind_of(head)
    if kind is not None:
        return FileRole("song", kind.name) if kind.is_recording else FileRole(None, kind.name, kind.advice)
    if head[:64].lstrip(b" \t\r\n").startswith(JSON_BEGINNINGS):
        return _role_of_document(head)
    return MIDI_FILE if b"MThd" in head else _by_name(filename)


def _role_of_document(head: bytes) -> FileRole:
    """What the JSON is that begins so: shows, and scores by Tone.js's converter, both have tracks."""
    fields: set[str] = set()
    of_tracks: set[str] = set()
    for path in _keys(head.decode(json.detect_encoding(head), errors="replace")):
        if len(path) == 1:
            fields.add(path[0])
        elif len(path) == 3 and path[:2] == ("tracks", ""):
            of_tracks.add(path[2])
    if fields & SCORE_FIELDS or of_tracks & SCORE_TRACK_FIELDS:
        return JSON_SCORE
    if of_tracks & SHOW_TRACK_FIELDS or ("tracks" in fields and fields & SHOW_FIELDS):
        return SHOW
    return OTHER_JSON


def _keys(text: str) -> Iterator[tuple[str, ...]]:
    """The paths of a JSON text's members, three steps at most; its end may be missing; ``""`` is an item."""
    open_: list[tuple[str, str]] = []
    """What is open, each with the member of it that is being read."""
    for token in _TOKEN.finditer(text):
        mark = token[0][0]
        if mark in "{[":
            open_.append((mark, ""))
        elif mark in "}]":
            del open_[-1:]
        elif token[2] is not None and open_ and open_[-1][0] == "{":
            open_[-1] = ("{", token[1])
            if len(open_) <= 3:
                yield tuple(member for _, member in open_)


def _by_name(filename: str | None) -> FileRole:
    suffix = PurePath(filename or "").suffix.lower()
    if suffix in SONG_SUFFIXES:
        return FileRole("song", "a recording")
    if suffix in SCORE_SUFFIXES:
        return FileRole("score", "a score")
    return FileRole(None, "a file of a kind that is not known here", NAME_ADVICE)
