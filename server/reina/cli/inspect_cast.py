"""What `reina inspect --cast` tells: who plays what, each player's notes, and what nobody plays."""

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from reina.api.cast import cast_of
from reina.cli.score_tables import (
    finding_lines,
    fingering_lines,
    heading,
    named_parts,
    section,
    table,
    warning_lines,
)
from reina.errors import InputError
from reina.instruments import Cast, describe_finding, describe_notes, describe_warnings
from reina.protocol import resources
from reina.sessions.description import cast_summary
from reina.sessions.production import Production

_FIELDS: TypeAdapter[resources.CastFields | resources.AutoCast] = TypeAdapter(
    resources.CastFields | resources.AutoCast
)


def asked_cast(text: str, sequence: int | None = None) -> Cast:
    """The cast that the command line asks for.

    Args:
        text: ``auto``, JSON, or the name of a file of JSON.
        sequence: Which sequence of a file of format 2, where the cast says none.

    Raises:
        InputError: It is none of these, or the file cannot be read.
    """
    if text == "auto":
        return Cast(sequence=sequence, auto=True)
    data = b""
    try:
        data = text.encode() if text.lstrip().startswith("{") else Path(text).read_bytes()
        return cast_of(_FIELDS.validate_python(json.loads(data)), sequence)
    except ValidationError as error:
        # Of both forms the faults of the one that was meant.
        meant = "AutoCast" if b'"cast"' in data else "CastFields"
        faults = [fault for fault in error.errors() if fault["loc"][:1] == (meant,)] or error.errors()
        told = "; ".join(f"{'/'.join(map(str, fault['loc'][1:]))}: {fault['msg']}" for fault in faults)
        raise InputError(f"the cast does not fit: {told}") from error
    except OSError as error:
        raise InputError(f"the cast {text}: {error.strerror}") from error
    except ValueError as error:
        raise InputError(f"the cast is no JSON: {error}") from error


def cast_document(production: Production) -> dict[str, Any]:
    """Who plays what, and each player's notes and warnings, as JSON has it."""
    score = production.score
    document: dict[str, Any] = cast_summary(production).model_dump()
    for casting, performer in zip(document["castings"], production.performers, strict=True):
        played = performer.played
        casting["played_notes"] = [
            note
            for part in played.parts
            for note in describe_notes(score, performer.instrument, played, part)
        ]
        casting["warnings"] = describe_warnings(played.warnings)
    document["findings"] = [describe_finding(finding) for finding in production.findings]
    return {"title": score.title, "duration_s": score.duration_s, **document}


def cast_lines(production: Production) -> Iterable[str]:
    """The same as tables."""
    score, summary = production.score, cast_summary(production)
    yield from heading(score)
    yield from finding_lines(production.findings)
    yield from section("Cast" if not summary.auto else "Cast, as the score asks for it")
    yield from table(
        ("player", "figure", "instrument", "seat", "hand", "part", "name", "playable", "because"),
        [
            (
                str(number),
                casting.player,
                casting.instrument,
                casting.seat,
                casting.handedness,
                ", ".join(map(str, (casting.part, *casting.joined_parts))),
                casting.part_name,
                f"{casting.playable} of {casting.notes}",
                "; ".join(casting.cast_because),
            )
            for number, casting in enumerate(summary.castings, start=1)
        ],
    )
    yield from section(f"Nobody plays: {len(summary.unplayed) or 'no part'}")
    yield from table(
        ("part", "name", "because"),
        [(str(one.part), one.part_name, one.reason) for one in summary.unplayed],
    )
    yield from warning_lines(score.warnings)
    for number, performer in enumerate(production.performers, start=1):
        yield from section(f"Player {number}: {named_parts(performer.played.parts)}")
        yield from warning_lines(performer.played.warnings)
        yield from fingering_lines(score, performer.instrument, performer.played)
