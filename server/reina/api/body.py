"""Request bodies that are read in pieces and held to a limit on the way."""

from typing import TYPE_CHECKING

from reina.api.problems import ProblemError
from reina.api.upload import FILE_LIMITS, MEGABYTE

if TYPE_CHECKING:
    from fastapi import Request


async def read_show_body(request: "Request") -> bytes:
    """A show, a track or edits of a show.

    Raises:
        ProblemError: 413 when it is larger than a show may be.
    """
    body = bytearray()
    async for chunk in request.stream():
        body += chunk
        if len(body) > FILE_LIMITS["show"]:
            limit = FILE_LIMITS["show"] // MEGABYTE
            raise ProblemError(413, "show-too-large", "Content Too Large", f"show is larger than {limit} MB")
    return bytes(body)
