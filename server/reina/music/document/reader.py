"""A JSON document into a score."""

from collections.abc import Iterable
from typing import Any, TypeVar, cast

from pydantic import BaseModel, ValidationError
from pydantic_core import from_json

from reina.music.document.model import ScoreDocument
from reina.music.document.own import read_own
from reina.music.document.tone import read_tone
from reina.music.document.tonejs import ToneDocument
from reina.music.errors import ScoreError
from reina.music.limits import Limits
from reina.music.score import Score

MOST_PROBLEMS = 20
Document = TypeVar("Document", bound=BaseModel)


def read_json(data: bytes, *, title: str, limits: Limits) -> Score:
    """Read a JSON score of either form; `reina.music.read_score` says more.

    Raises:
        ScoreError: If it is no JSON, of another shape, or without notes; it names the path in the document.
    """
    limits.check("events", data.count(b"{"), what="number of JSON objects")
    document = _parse(data)
    if document.get("format") == "reina-score" or "parts" in document:
        _count(document.get("parts"), "parts", limits)
        return read_own(_validate(ScoreDocument, document), title=title, limits=limits)
    if "tracks" in document:
        _count(document.get("tracks"), "tracks", limits)
        return read_tone(_validate(ToneDocument, document), title=title, limits=limits)
    raise ScoreError(
        'a JSON score is either {"format": "reina-score", "parts": [...]} or, by Tone.js\'s converter, '
        f'{{"header": ..., "tracks": [...]}}; this one has {_keys(document)}',
        where="/",
    )


def _parse(data: bytes) -> dict[str, Any]:
    if data[:2] in {b"\xff\xfe", b"\xfe\xff"}:
        data = data.decode("utf-16", errors="replace").encode()
    try:
        document = from_json(data.removeprefix(b"\xef\xbb\xbf"), allow_inf_nan=False)
    except ValueError as error:
        raise ScoreError(f"this is no JSON: {error}", where="/") from error
    if not isinstance(document, dict):
        raise ScoreError(f"a JSON score is an object, not {_kind(document)}", where="/")
    return cast("dict[str, Any]", document)


def _count(parts: object, name: str, limits: Limits) -> None:
    """Check how much there is before anything is made of it."""
    if not isinstance(parts, list):
        return
    entries = cast("list[object]", parts)
    limits.check("tracks", len(entries), what=f"number of {name}", where=name)
    notes = sum(_length(part, "notes") for part in entries)
    limits.check("notes", notes, what="number of notes", where=name)


def _length(part: object, key: str) -> int:
    notes = cast("dict[str, object]", part).get(key) if isinstance(part, dict) else None
    return len(cast("list[object]", notes)) if isinstance(notes, list) else 0


def _validate(model: type[Document], document: dict[str, Any]) -> Document:
    try:
        return model.model_validate(document)
    except ValidationError as error:
        count = error.error_count()
        problems = [
            ("/".join(map(str, fault["loc"])), _say(fault["msg"], fault["input"]))
            for fault in error.errors(include_url=False, include_context=False)[:MOST_PROBLEMS]
        ]
        where, what = problems[0]
        more = f" (and {count - 1} more faults)" if count > 1 else ""
        raise ScoreError(f"{what}{more}", where=where, problems=problems) from error


def _say(message: str, value: object) -> str:
    message = message.removeprefix("Value error, ")
    message = message[:1].lower() + message[1:]
    if isinstance(value, str | int | float | bool):
        return f"{message}, not {str(value)[:40]!r}" if isinstance(value, str) else f"{message}, not {value}"
    return message


def _kind(value: object) -> str:
    kinds = {"list": "a list", "str": "a string", "bool": "a truth value", "NoneType": "null"}
    return kinds.get(type(value).__name__, "a number")


def _keys(document: Iterable[str]) -> str:
    return ", ".join(sorted(document)[:5]) or "no members"
