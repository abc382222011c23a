"""The application: routes, guards and problem details, put together."""

from __future__ import annotations

import asyncio
import time
from contextlib import asynccontextmanager
from typing import TYPE_CHECKING

from fastapi import FastAPI

import reina
from reina.api import catalogue, examples, frames, page, problems, rigs, sessions, show, song, stream
from reina.api.compression import Compression
from reina.api.description import describe
from reina.api.guard import Guard
from reina.api.settings import Settings
from reina.protocol.links import API
from reina.sessions.production import Stage
from reina.sessions.sound import SongRenderer
from reina.sessions.store import SessionStore

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Callable

DEFAULT_SHOW = "shows/default.json"
DESCRIPTION = """\
A score becomes a trumpeter. Make a session of a MIDI or JSON score, then watch it: over the WebSocket
`/api/v1/sessions/{id}/stream` (docs/protocol.md says what comes), or frame by frame over HTTP.

Errors are problem details (RFC 9457). Watching needs a session's id, changing it its control token.
"""


def create_app(settings: Settings | None = None, *, now: Callable[[], float] = time.monotonic) -> FastAPI:
    """The server as an ASGI application.

    Args:
        settings: Where files are and whom it answers; defaults that work in the repository.
        now: Server time, seconds; never goes back, and runs as the event loop's clock does.
    """
    chosen = settings or Settings()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncGenerator[None]:
        renderer = SongRenderer(chosen.data_dir)
        stage = Stage.load(chosen.rigs_dir, chosen.examples_dir / DEFAULT_SHOW)
        store = SessionStore(chosen.data_dir, stage, renderer, now=now)
        app.state.store = store
        app.state.computing = asyncio.Semaphore(1)
        yield
        await store.aclose()

    app = FastAPI(
        title="Reina", version=reina.__version__, description=DESCRIPTION, lifespan=lifespan, redoc_url=None
    )
    app.state.settings = chosen
    app.state.now = now
    for module in (sessions, frames, song, show, rigs, examples, catalogue, stream):
        app.include_router(module.router, prefix=API, responses=problems.RESPONSES)
    app.include_router(page.router)
    problems.install(app)
    describe(app)
    app.add_middleware(Compression)
    app.add_middleware(Guard, settings=chosen)
    return app
