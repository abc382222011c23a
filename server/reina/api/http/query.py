"""What an address asks beside its path: only what the route knows, so that a slip of the pen is told."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fastapi.dependencies.utils import get_flat_params
from fastapi.params import Query
from fastapi.requests import HTTPConnection  # noqa: TC002 - FastAPI reads it from the annotation
from fastapi.routing import APIRoute

from reina.api.http.problems import MAX_FAULTS, ProblemError
from reina.protocol.resources import Fault

if TYPE_CHECKING:
    from collections.abc import Iterable


async def known_query(connection: HTTPConnection) -> None:
    """A dependency: refuse names in the query that the route does not know.

    It is asynchronous since others are run on threads.

    Raises:
        ProblemError: 422, which names those that it knows.
    """
    route = connection.scope.get("route")
    if isinstance(route, APIRoute) and connection.scope["query_string"]:
        fields = get_flat_params(route.dependant)
        refuse_unknown(connection, [field.alias for field in fields if isinstance(field.field_info, Query)])


def refuse_unknown(connection: HTTPConnection, known: Iterable[str]) -> None:
    """Refuse names in a query that are not known.

    Raises:
        ProblemError: 422.
    """
    names = list(known)
    unknown = [name for name in connection.query_params if name not in names]
    if not unknown:
        return
    right = f"it may ask {', '.join(names)}" if names else "nothing can be asked here"
    raise ProblemError(
        422,
        "request-invalid",
        "The request does not fit",
        f"the address asks {', '.join(repr(name[:50]) for name in unknown[:MAX_FAULTS])}; {right}",
        errors=[Fault(detail=f"not known; {right}", location=f"query/{name}") for name in unknown],
    )
