"""The application: routes, guards and problem details, put together."""

from __future__ import annotations

import asyncio
import time
from contextlib import asynccontextmanager
from typing import TYPE_CHECKING

from fastapi import FastAPI

import reina
from reina.api import (
    alignment,
    cast,
    catalogue,
    curves,
    examples,
    export,
    files,
    frames,
    library,
    page,
    part,
    rigs,
    sessions,
    show,
    show_edits,
    song,
    stances,
    stream,
    tracks,
    transcriptions,
)
from reina.api.description import describe
from reina.api.http import problems
from reina.api.http.compression import Compression
from reina.api.http.ending import Ending, UntilTheEnd
from reina.api.http.guard import Guard
from reina.api.http.retrieval import Retrieval
from reina.api.http.unread_body import UnreadBody
from reina.api.lab import routes as lab
from reina.api.lab.work import lab_pool
from reina.api.settings import Settings
from reina.protocol.links import API
from reina.sessions.stage import Stage
from reina.sessions.storage.session_storage import SessionStorage
from reina.sessions.store import SessionStore
from reina.sessions.transcriptions import Transcriptions
from reina.sound.renderer import SongRenderer
from reina.system.turns import Turns

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Callable

DESCRIPTION = """\
A score becomes players on a stage. Make a session of a MIDI, MusicXML or JSON score, then watch it: over the
WebSocket `/api/v1/sessions/{id}/stream` (docs/protocol.md says what comes), or frame by frame over HTTP.

Whatever answers to GET answers to HEAD too, and to conditions (RFC 9110, 13): keep what was answered, and ask
again with its `ETag`. Errors are problem details (RFC 9457). Watching needs a session's id, changing it its
control token.
"""


def create_app(
    settings: Settings | None = None,
    *,
    stage: Stage | None = None,
    storage: SessionStorage | None = None,
    now: Callable[[], float] = time.monotonic,
) -> FastAPI:
    """The server as an ASGI application.

    Args:
        settings: Where files are and whom it answers; defaults that work in the repository.
        stage: Who plays on what; read from the settings' rigs at the start when None.
        storage: What keeps the sessions; opened at the start when None.
        now: Server time, seconds; never goes back, and runs as the event loop's clock does.
    """
    chosen = settings or Settings()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncGenerator[None]:
        renderer = SongRenderer(chosen.data_dir)
        kept = storage or await asyncio.to_thread(SessionStorage.open, chosen.data_dir, chosen.database)
        store = SessionStore(
            kept,
            stage or Stage.load(chosen.rigs_dir),
            renderer,
            now=now,
            song_cache_bytes=chosen.song_cache_bytes,
        )
        await store.prune_songs()
        store.begin()
        app.state.store = store
        app.state.computing = Turns()
        app.state.lab_pool = lab_pool()
        app.state.transcriptions = Transcriptions()
        yield
        await app.state.transcriptions.aclose()
        await app.state.lab_pool.aclose()
        await store.aclose()

    app = FastAPI(
        title="Reina", version=reina.__version__, description=DESCRIPTION, lifespan=lifespan, redoc_url=None
    )
    app.state.settings = chosen
    app.state.ending = Ending()
    app.state.now = now
    for module in (
        sessions,
        files,
        frames,
        export,
        song,
        alignment,
        show,
        show_edits,
        curves,
        tracks,
        rigs,
        examples,
        library,
        *([lab] if chosen.lab else []),
        cast,
        part,
        stances,
        catalogue,
        transcriptions,
        stream,
    ):
        app.include_router(module.router, prefix=API, responses=problems.RESPONSES)
    app.include_router(page.router)
    problems.install(app)
    describe(app)
    app.add_middleware(Compression)
    app.add_middleware(Guard, settings=chosen)
    app.add_middleware(Retrieval)
    app.add_middleware(UnreadBody)
    app.add_middleware(UntilTheEnd, ending=app.state.ending)
    return app
