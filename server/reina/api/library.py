"""The bundled shows, and what a show may hold."""

import json
from functools import lru_cache
from pathlib import Path
from typing import Any

from fastapi import APIRouter

from reina.api.http.access import ServerSettings, Store
from reina.curves import interpolations
from reina.performance import any_player_pattern
from reina.protocol.links import API
from reina.protocol.resources import ShowLibrary, ShowSummary
from reina.show.show_schema import show_schema

router = APIRouter(tags=["show"])


@router.get("/shows")
def list_shows(settings: ServerSettings) -> ShowLibrary:
    """The bundled shows: any of them may be put into any session, whatever it plays."""
    shows: list[ShowSummary] = []
    for path in sorted((settings.examples_dir / "shows").glob("*.json")):
        title, description = _words(path, path.stat().st_mtime_ns)
        href = f"{API}/examples/shows/{path.name}"
        shows.append(ShowSummary(name=path.stem, title=title, description=description, href=href))
    return ShowLibrary(shows=shows)


@router.get("/shows/schema")
def get_schema(store: Store) -> dict[str, Any]:
    """JSON Schema of shows, over the parameters of any cast and the interpolations of this server."""
    return show_schema(store.stage.schema_parameters(), interpolations(), any_player_pattern)


@lru_cache(maxsize=256)
def _words(path: Path, modified_ns: int) -> tuple[str, str]:  # noqa: ARG001 - a file that is written anew is read anew
    """A show's title, and what it says of itself."""
    document: dict[str, Any] = json.loads(path.read_bytes())
    return document.get("title") or path.stem, document.get("description", "")
