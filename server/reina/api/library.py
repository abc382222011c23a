"""The bundled shows, and what a show may hold."""

import asyncio
import json
import logging
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fastapi import APIRouter, Request, Response

from reina.api.examples import modified_ns
from reina.api.http.access import ServerSettings, Store
from reina.curves import interpolations
from reina.performance import any_player_pattern
from reina.protocol.links import API
from reina.protocol.resources import ShowLibrary, ShowSummary
from reina.show.document import ShowHead
from reina.show.show_schema import show_schema
from reina.system.json_text import json_text

if TYPE_CHECKING:
    from reina.system.turns import Turns

router = APIRouter(tags=["show"])

LONGEST_REASON = 300

_log = logging.getLogger(__name__)


@router.get("/shows")
def list_shows(settings: ServerSettings) -> ShowLibrary:
    """The bundled shows: any of them may be put into any session, whatever it plays."""
    shows: list[ShowSummary] = []
    for path in sorted((settings.examples_dir / "shows").glob("*.json")):
        words = _words(path, modified_ns(path))
        if words is None:
            continue
        title, description = words
        href = f"{API}/examples/shows/{path.name}"
        shows.append(ShowSummary(name=path.stem, title=title, description=description, href=href))
    return ShowLibrary(shows=shows)


@router.get("/shows/schema", response_model=dict[str, Any])
async def get_schema(request: Request, store: Store) -> Response:
    """JSON Schema of shows, over the parameters of any cast and the interpolations of this server."""
    state, stage = request.app.state, store.stage
    if not hasattr(state, "show_schema_text"):
        computing: Turns = state.computing
        async with computing.of("schema"):
            state.show_schema_text = await asyncio.to_thread(
                lambda: json_text(
                    show_schema(stage.schema_parameters(), interpolations(), any_player_pattern)
                )
            )
    return Response(state.show_schema_text, media_type="application/json")


@lru_cache(maxsize=256)
def _words(path: Path, modified_ns: int) -> tuple[str, str] | None:  # noqa: ARG001 - a file that is written anew is read anew
    """A show's title, and what it says of itself; None, and a line in the log, where it is no show."""
    try:
        head = ShowHead.model_validate(json.loads(path.read_bytes()), extra="ignore")
    except (ValueError, RecursionError, OSError) as error:
        _log.warning("the show %s is left out: %s", path.name, " ".join(str(error).split())[:LONGEST_REASON])
        return None
    return head.title or path.stem, head.description
