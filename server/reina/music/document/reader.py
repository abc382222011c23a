"""A JSON document into a score."""

import json
import re
from collections.abc import Iterable
from typing import cast

from pydantic import ValidationError
from pydantic_core import from_json

from reina.music.document.fields import JsonObject, path_part, shown
from reina.music.document.model import ScoreDocument
from reina.music.document.own import read_own
from reina.music.document.tone import read_tone
from reina.music.errors import ScoreError
from reina.music.limits import Limits
from reina.music.score import Score
from reina.music.warnings import WarningLog

MAX_PROBLEMS = 20

LONE_SURROGATE = re.compile(
    r"((?<!\\)(?:\\\\)*)\\u(?:d[89ab][0-9a-f]{2}(?!\\ud[c-f])|(?<!\\ud[89ab][0-9a-f]{2}\\u)d[c-f][0-9a-f]{2})",
    re.ASCII | re.IGNORECASE,
)
"""Half a character, as JavaScript writes a text that was cut inside one."""


def read_json(data: bytes, *, title: str, limits: Limits) -> Score:
    """Read a JSON score of either form; `reina.music.read_score` says more.

    Raises:
        ScoreError: If it is no JSON, of another shape, or without notes; it names the path in the document.
    """
    limits.check("events", data.count(b"{") + data.count(b"["), what="number of JSON objects and lists")
    log = WarningLog()
    document = _parse(data, log)
    if document.get("format") == "reina-score" or "parts" in document:
        _count(document.get("parts"), "parts", limits)
        return read_own(_validate(document), title=title, limits=limits, log=log)
    if "tracks" in document:
        _count(document.get("tracks"), "tracks", limits)
        return read_tone(document, title=title, limits=limits, log=log)
    raise ScoreError(
        'a JSON score is either {"format": "reina-score", "parts": [...]} or, by Tone.js\'s converter, '
        f'{{"header": ..., "tracks": [...]}}; this one has {_keys(document)}',
        location="/",
    )


def _parse(data: bytes, log: WarningLog) -> JsonObject:
    encoding = json.detect_encoding(data)
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as error:
        log.add(
            "bad_text", f"byte {error.start}", f"is not {encoding.upper()}; such letters are shown as \ufffd"
        )
        text = data.decode(encoding, errors="replace")
    try:
        document = _values(text)
    except ValueError as error:
        raise ScoreError(f"this is no JSON: {error}", location="/") from error
    if not isinstance(document, dict):
        raise ScoreError(f"a JSON score is an object, not {shown(document)}", location="/")
    return cast("JsonObject", document)


def _values(text: str) -> object:
    """Parse JSON; NaN and Infinity, which many programs write, are left to those who use the number."""
    try:
        return from_json(text, allow_inf_nan=True)
    except ValueError:
        whole = LONE_SURROGATE.sub(r"\1\\ufffd", text)
        if whole == text:
            raise
        return from_json(whole, allow_inf_nan=True)


def _count(parts: object, name: str, limits: Limits) -> None:
    """Check how much there is before anything is made of it."""
    if not isinstance(parts, list):
        return
    entries = cast("list[object]", parts)
    limits.check("tracks", len(entries), what=f"number of {name}", location=name)
    notes = sum(_length(part, "notes") for part in entries)
    limits.check("notes", notes, what="number of notes", location=name)


def _length(part: object, key: str) -> int:
    notes = cast("dict[str, object]", part).get(key) if isinstance(part, dict) else None
    return len(cast("list[object]", notes)) if isinstance(notes, list) else 0


def _validate(document: JsonObject) -> ScoreDocument:
    try:
        return ScoreDocument.model_validate(document)
    except ValidationError as error:
        count = error.error_count()
        problems = [
            ("/".join(map(str, fault["loc"])), _say(fault["msg"], fault["input"]))
            for fault in error.errors(include_url=False, include_context=False)[:MAX_PROBLEMS]
        ]
        where, what = problems[0]
        more = f" (and {count - 1} more faults)" if count > 1 else ""
        raise ScoreError(f"{what}{more}", location=where, problems=problems) from error


def _say(message: str, value: object) -> str:
    message = message.removeprefix("Value error, ")
    message = message[:1].lower() + message[1:]
    if isinstance(value, str | int | float | bool):
        return f"{message}, not {shown(value)}"
    return message


def _keys(document: Iterable[str]) -> str:
    return ", ".join(path_part(key) for key in sorted(document)[:5]) or "no members"
