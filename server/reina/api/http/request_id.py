"""The id of the request that is being answered."""

from contextvars import ContextVar

request_id: ContextVar[str | None] = ContextVar("request_id", default=None)
"""None outside of requests. It is known in the tasks and threads that a request begins, too."""


def instance() -> str | None:
    """What problem details call the request that they answer (RFC 9457, 3.1.5); None outside of requests."""
    known_by = request_id.get()
    return None if known_by is None else f"urn:reina:request:{known_by}"
