"""Conditional requests (RFC 9110, 13): a stale write is refused, and what is known is not sent again."""

import re
from typing import Annotated

from fastapi import Header, Response

from reina.api.problems import ProblemError

NOT_MODIFIED = 304
_TAG = re.compile(r'(?:W/)?"[^"]*"')

IfMatch = Annotated[
    str | None,
    Header(
        description="The `ETag` of the show, or of the track that is written to, as it was read. When it has "
        "changed since, nothing is changed and the answer is 412. Without this header the write is made in "
        "any case."
    ),
]
IfNoneMatch = Annotated[
    str | None, Header(description="The `ETag` that is known; when it is still so the answer is 304.")
]


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
    if if_match is None or if_match.strip() == "*":
        return
    given: list[str] = _TAG.findall(if_match)
    # Compared strongly: a weak validator never holds.
    if not set(given) & set(etags):
        raise ProblemError(
            412,
            "stale-write",
            "The show has changed meanwhile",
            f"If-Match names {if_match}, and it is {etags[0]} now; read it again and decide anew",
            headers={"ETag": etags[0]},
        )


def conditional(text: str, etag: str, if_none_match: str | None) -> Response:
    """JSON with its validator, or 304 where the asker has it already."""
    headers = {"ETag": etag, "Cache-Control": "no-cache"}
    known: list[str] = _TAG.findall(if_none_match or "")
    if etag in (tag.removeprefix("W/") for tag in known) or (if_none_match or "").strip() == "*":
        return Response(status_code=NOT_MODIFIED, headers=headers)
    return Response(text, media_type="application/json", headers=headers)
