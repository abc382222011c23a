"""The application: routes, guards and problem details, put together."""

from __future__ import annotations

import asyncio
import time
from contextlib import asynccontextmanager
from typing import TYPE_CHECKING

import anyio.lowlevel
from fastapi import Depends, FastAPI

import reina
from reina.api import (
    alignment,
    blocks,
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
    people,
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
from reina.api.http.answers import Answers
from reina.api.http.compression import Compression
from reina.api.http.ending import Ending, UntilTheEnd
from reina.api.http.guard import Guard
from reina.api.http.headers import ProtectingHeaders
from reina.api.http.observed import Observed, RouteNoted
from reina.api.http.pieces import InPieces
from reina.api.http.proxies import BehindProxies, TrustedProxies
from reina.api.http.query import known_query
from reina.api.http.rates import BoundedRates, Rates
from reina.api.http.retrieval import Retrieval
from reina.api.http.sign_in import SignIn
from reina.api.http.unread_body import UnreadBody
from reina.api.lab import routes as lab
from reina.api.lab.work import lab_pool
from reina.api.observation import Observation
from reina.api.settings import Settings
from reina.protocol.links import API
from reina.sessions.bus.redis_bus import RedisBus
from reina.sessions.stage import Stage
from reina.sessions.storage.session_storage import SessionStorage
from reina.sessions.store import SessionStore
from reina.sessions.transcriptions import Transcriptions
from reina.sessions.unseen import sweep_unseen
from reina.sound.alignment.aligner_process import Aligner
from reina.sound.renderer import SongRenderer
from reina.system.elsewhere import Elsewhere
from reina.system.turns import Turns
from reina.system.wall_time import WallTime

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Callable

DESCRIPTION = """\
A score becomes players on a stage. Make a session of a MIDI, MusicXML or JSON score, then watch it: over the
WebSocket `/api/v1/sessions/{id}/stream` (docs/protocol.md says what comes), or frame by frame over HTTP.

Whatever answers to GET answers to HEAD too, and to conditions (RFC 9110, 13): keep what was answered, and ask
again with its `ETag`. Errors are problem details (RFC 9457). Watching needs a session's id, changing it its
control token, or that who made it is signed in.
"""


def create_app(
    settings: Settings | None = None,
    *,
    stage: Stage | None = None,
    storage: SessionStorage | None = None,
    now: Callable[[], float] | None = None,
) -> FastAPI:
    """The server as an ASGI application.

    Args:
        settings: Where files are and whom it answers; defaults that work in the repository.
        stage: Who plays on what; read from the settings' rigs at the start when None.
        storage: What keeps the sessions; opened at the start when None.
        now: Server time, seconds; never goes back, and runs as the event loop's clock does. When None it is
            the calendar's where there are several servers, and this process's own otherwise.

    Raises:
        InputError: A setting cannot be.
    """
    chosen = settings or Settings()
    if now is None:
        now = WallTime() if chosen.bus else time.monotonic
    clock = now

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncGenerator[None]:
        # This loads what the first request would: by then there may be no file left to read it from.
        await anyio.lowlevel.checkpoint()
        elsewhere = Elsewhere(chosen.scheduler) if chosen.scheduler else None
        renderer = SongRenderer(chosen.data_dir, most_bytes=chosen.song_cache_bytes, elsewhere=elsewhere)
        kept = storage or await asyncio.to_thread(
            SessionStorage.open, chosen.data_dir, chosen.database, chosen.files
        )
        store = SessionStore(
            kept,
            stage or Stage.load(chosen.rigs_dir),
            renderer,
            now=clock,
            wall=clock if chosen.bus else time.time,
            memory_bytes=chosen.memory_bytes,
            disk=chosen.disk,
            staging_bytes=chosen.staging_bytes,
            aligner=Aligner(elsewhere=elsewhere),
            blocks_origin=chosen.blocks_origin,
            bus=RedisBus(chosen.bus) if chosen.bus else None,
        )
        await store.loaded.prune_songs()
        await store.begin()
        app.state.store = store
        # A password that stands in a file as it is takes a moment.
        app.state.sign_in = await asyncio.to_thread(SignIn, chosen, clock)
        app.state.computing = Turns()
        app.state.lab_pool = lab_pool()
        app.state.transcriptions = Transcriptions()
        app.state.answers = Answers()
        observed = Observation(chosen, store, now=clock, ending=app.state.ending)
        app.state.readiness = observed.readiness
        await observed.start()
        sweeping = asyncio.create_task(sweep_unseen(store, chosen.end_unseen_s))
        yield
        sweeping.cancel()
        await observed.aclose()
        await app.state.transcriptions.aclose()
        await app.state.lab_pool.aclose()
        await store.aclose()
        if elsewhere is not None:
            await elsewhere.aclose()

    app = FastAPI(
        title="Reina",
        version=reina.__version__,
        description=DESCRIPTION,
        lifespan=lifespan,
        # FastAPI's own page for it loads scripts from elsewhere; /docs is one of the page's files.
        docs_url=None,
        redoc_url=None,
    )
    app.state.settings = chosen
    app.state.ending = Ending()
    app.state.readiness = None
    app.state.now = now
    for module in (
        sessions,
        files,
        frames,
        blocks,
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
        people,
        stream,
    ):
        app.include_router(
            module.router, prefix=API, responses=problems.RESPONSES, dependencies=[Depends(known_query)]
        )
    app.include_router(page.router)
    problems.install(app)
    describe(app)
    app.add_middleware(RouteNoted)
    app.add_middleware(Compression)
    app.add_middleware(BoundedRates, rates=Rates.named(chosen.rates), now=now)
    app.add_middleware(Guard, settings=chosen)
    app.add_middleware(Retrieval)
    app.add_middleware(InPieces)
    app.add_middleware(UnreadBody)
    app.add_middleware(UntilTheEnd, ending=app.state.ending)
    app.add_middleware(ProtectingHeaders)
    app.add_middleware(Observed, log_requests=chosen.log_requests)
    app.add_middleware(BehindProxies, proxies=TrustedProxies.named(chosen.trusted_proxies))
    return app
