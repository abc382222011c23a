"""Conditional requests (RFC 9110, 13): a stale write is refused, and what is known is not sent again."""

import re
from collections.abc import Mapping
from email.utils import parsedate
from typing import Annotated

from fastapi import Header, Response

from reina.api.http.problems import ProblemError

NOT_MODIFIED = 304
PRECONDITION_FAILED = 412
_TAG = re.compile(r'(?:W/)?"[^"]*"')

IfMatch = Annotated[
    str | None,
    Header(
        description="The `ETag` of the show, or of the track that is written to, as it was read. When it has "
        "changed since, nothing is changed and the answer is 412. Without this header the write is made in "
        "any case."
    ),
]
IF_NONE_MATCH_TEXT = "The `ETag` that is known; when it is still so the answer is 304."
IfNoneMatch = Annotated[str | None, Header(description=IF_NONE_MATCH_TEXT)]
"""For routes that save themselves some work by it; all others are compared once they have answered."""


Prefer = Annotated[
    str | None,
    Header(description="`return=minimal` (RFC 7240): the answer leaves out the tracks that changed."),
]


def wants_minimal(prefer: str | None) -> bool:
    """Whether a brief answer is preferred."""
    return any(part.strip().lower() == "return=minimal" for part in re.split("[,;]", prefer or ""))


def require_match(if_match: str | None, *etags: str) -> None:
    """Refuse a write whose condition does not hold.

    Args:
        if_match: The header's value; None makes no condition.
        etags: The validators that count, the one that is told first.

    Raises:
        ProblemError: 412.
    """
    if if_match is None or any(named(if_match, etag, strongly=True) for etag in etags):
        return
    raise ProblemError(
        PRECONDITION_FAILED,
        "stale-write",
        "The show has changed meanwhile",
        f"If-Match names {if_match}, and it is {etags[0]} now; read it again and decide anew",
        headers={"ETag": etags[0]},
    )


def named(header: str, etag: str, *, strongly: bool) -> bool:
    """Whether the value of a condition's header names a validator (RFC 9110, 8.8.3.2).

    Args:
        header: ``"*"``, or entity tags in a list.
        etag: The validator.
        strongly: By strong comparison, under which a weak validator never holds.
    """
    if header.strip() == "*":
        return True
    tags: list[str] = _TAG.findall(header)
    if strongly:
        return etag in tags and not etag.startswith("W/")
    return etag.removeprefix("W/") in (tag.removeprefix("W/") for tag in tags)


def precondition(asked: Mapping[str, str], answered: Mapping[str, str]) -> int | None:
    """What the conditions of a GET lead to, in the order of RFC 9110, 13.2.2.

    Args:
        asked: The request's headers, by names in small letters.
        answered: Those of the answer without conditions.

    Returns:
        304 or 412; None when the answer is to be sent as it is.
    """
    etag, modified = answered.get("etag", ""), answered.get("last-modified", "")
    if "if-match" in asked:
        if not named(asked["if-match"], etag, strongly=True):
            return PRECONDITION_FAILED
    elif _later(modified, asked.get("if-unmodified-since", "")):
        return PRECONDITION_FAILED
    if "if-none-match" in asked:
        return NOT_MODIFIED if named(asked["if-none-match"], etag, strongly=False) else None
    return NOT_MODIFIED if _later(modified, asked.get("if-modified-since", "")) is False else None


def _later(date: str, other: str) -> bool | None:
    """Whether a date (RFC 9110, 5.6.7) lies after another; None when one of them is none."""
    first, second = parsedate(date), parsedate(other)
    return None if first is None or second is None else first[:6] > second[:6]


def validated(text: str | bytes, etag: str) -> Response:
    """JSON with its validator."""
    headers = {"ETag": etag, "Cache-Control": "no-cache"}
    return Response(text, media_type="application/json", headers=headers)


def not_modified(etag: str) -> Response:
    """Where it is told from the validator alone that the asker has it already."""
    headers = {"ETag": etag, "Cache-Control": "no-cache", "Vary": "Accept-Encoding"}
    return Response(status_code=NOT_MODIFIED, headers=headers)
