"""Who sends a request: an address, by which what one may have is counted."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from starlette.requests import HTTPConnection


def sender_of(connection: HTTPConnection) -> str:
    """The address that a request comes from; "" where there is none. It is told to nobody."""
    return connection.client.host if connection.client else ""
