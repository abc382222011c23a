"""The WebSocket: a session's frames and control messages."""

import asyncio
import contextlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated

from fastapi import APIRouter, Query, WebSocket, WebSocketDisconnect
from pydantic import BaseModel, ValidationError

from reina.api.http.access import unknown_session
from reina.api.http.direct_line import CLOSING_GRACE_S, DIRECT_LINE, DirectLine
from reina.api.http.problems import ProblemError, problem_of_input
from reina.errors import InputError
from reina.protocol import SUBPROTOCOL
from reina.protocol.messages import Lead, Pong, StreamError, viewer_message
from reina.protocol.websocket import message_of, text_frame
from reina.sessions.viewer import Viewer

if TYPE_CHECKING:
    from reina.sessions.packed_blocks import Form
    from reina.sessions.session import Session
    from reina.sessions.store import SessionStore

router = APIRouter()

MAX_FRAMES_PER_MESSAGE = 12
SIZES = {str(size): size for size in range(1, MAX_FRAMES_PER_MESSAGE + 1)}
PACKED: "dict[str, Form | None]" = {"0": None, "1": "packed", "lossless": "lossless"}
"""What may be asked for in place of frames: packed blocks of a form."""
NOTES = {"1": True, "0": False}
"""Whether notes are told of as they begin and end."""
ASKED_FOR = {"frames_per_message", "notes", "packed"}
GONE = (WebSocketDisconnect, OSError, RuntimeError)
"""What sending raises once the viewer has gone, or was closed under it, as for a message too large."""


class AsgiConnection:
    """A viewer's connection behind an ASGI server that offers no `DirectLine`.

    Args:
        socket: The WebSocket.
        patience: What ends who waits for the viewer.
    """

    def __init__(self, socket: WebSocket, patience: asyncio.Timeout) -> None:
        self._socket = socket
        self._patience = patience
        self._sending: asyncio.Task[None] | None = None
        self.is_full = False
        """Whether a frame is still being sent."""
        self.on_free: Callable[[], None] | None = None
        """Called when it is not any more."""

    def write(self, frame: bytes) -> None:
        """Begin to send a frame."""
        self.is_full = True
        self._sending = asyncio.create_task(self._send(message_of(frame)))

    async def close(self, code: int, reason: str) -> None:
        """Say goodbye; a viewer that does not read is told when it reads again, if it does so soon."""
        try:
            async with asyncio.timeout(CLOSING_GRACE_S):
                await self._socket.close(code, reason)
        except TimeoutError:
            with contextlib.suppress(RuntimeError):  # it has gone meanwhile
                self._patience.reschedule(asyncio.get_running_loop().time())
        except GONE:
            pass

    async def _send(self, data: bytes | str) -> None:
        kind = "bytes" if isinstance(data, bytes) else "text"
        # Whoever leaves does so in the middle of a message: who receives hears of it.
        with contextlib.suppress(*GONE):
            await self._socket.send({"type": "websocket.send", kind: data})
            self.is_full = False
            if self.on_free is not None:
                self.on_free()


class Watching:
    """Somebody who watches a session, from joining to leaving.

    Args:
        viewer: Who.
        session: What.
        store: Keeps the session.
        now: Server time, seconds.
    """

    __slots__ = ("_now", "_session", "_store", "_viewer")

    def __init__(
        self, viewer: Viewer, session: "Session", store: "SessionStore", now: Callable[[], float]
    ) -> None:
        self._viewer = viewer
        self._session = session
        self._store = store
        self._now = now
        session.join(viewer)

    def hear(self, message: str) -> None:
        """Answer what the viewer says."""
        received_s = self._now()
        try:
            said = viewer_message.validate_json(message)
        except ValidationError:
            detail = (
                'viewers send {"type": "ping", "id": 1} or {"type": "lead", "lead_s": 0.5} (0.1 to 1.5), '
                "and nothing else"
            )
            self._say(StreamError(title="Not understood", detail=detail))
        else:
            if isinstance(said, Lead):
                self._session.take_lead(self._viewer, said.lead_s)
            else:
                self._say(Pong(id=said.id, server_time_s=received_s))

    def leave(self) -> None:
        """It has gone."""
        self._session.leave(self._viewer)
        self._viewer.let_go()
        self._store.sightings.note(self._session.id)

    def _say(self, message: BaseModel) -> None:
        self._viewer.post_text(text_frame(message.model_dump_json()))


@router.websocket("/sessions/{session_id}/stream")
async def stream(
    socket: WebSocket,
    session_id: str,
    frames_per_message: Annotated[str, Query()] = "1",
    packed: Annotated[str, Query()] = "0",
    notes: Annotated[str, Query()] = "1",
) -> None:
    """Refuse before the handshake ends, or send until either side goes."""
    store: SessionStore = socket.app.state.store
    now: Callable[[], float] = socket.app.state.now
    session, problem = await _found(store, session_id)
    size, form = SIZES.get(frames_per_message), PACKED.get(packed)
    if session is not None and SUBPROTOCOL not in socket.scope["subprotocols"]:
        offered = ", ".join(socket.scope["subprotocols"]) or "none"
        detail = f"this server speaks {SUBPROTOCOL}; the viewer offered {offered}"
        problem = ProblemError(400, "other-version", "The stream has another version", detail)
    elif session is not None and (unknown := set(socket.query_params) - ASKED_FOR):
        known, asked = ", ".join(sorted(ASKED_FOR)), ", ".join(sorted(unknown))[:100]
        detail = f"the stream may be asked for {known}, not for {asked}"
        problem = ProblemError(422, "request-invalid", "The request does not fit", detail)
    elif session is not None and size is None:
        detail = f"frames_per_message is 1 to {MAX_FRAMES_PER_MESSAGE}, not {frames_per_message[:20]}"
        problem = ProblemError(422, "request-invalid", "The request does not fit", detail)
    elif session is not None and packed not in PACKED:
        detail = f"packed is {', '.join(PACKED)}, not {packed[:20]}"
        problem = ProblemError(422, "request-invalid", "The request does not fit", detail)
    elif session is not None and notes not in NOTES:
        problem = ProblemError(
            422, "request-invalid", "The request does not fit", f"notes is 0 or 1, not {notes[:20]}"
        )
    if problem or session is None or size is None:
        if problem:
            await socket.send_denial_response(problem.response())
        return
    with session.asked():
        await socket.accept(subprotocol=SUBPROTOCOL)
        await session.ready(form=form)
        line: DirectLine | None = socket.scope.get("extensions", {}).get(DIRECT_LINE)
        if line is not None:
            viewer = Viewer(line, frames_per_message=size, form=form, hears_notes=NOTES[notes])
            watching = Watching(viewer, session, store, now)
            line.hand_over(watching.hear, watching.leave)
            return
        patience = asyncio.timeout(None)
        connection = AsgiConnection(socket, patience)
        viewer = Viewer(connection, frames_per_message=size, form=form, hears_notes=NOTES[notes])
        await _listen(socket, Watching(viewer, session, store, now), patience)


async def _listen(socket: WebSocket, watching: Watching, patience: asyncio.Timeout) -> None:
    try:
        async with patience:
            while (message := await socket.receive())["type"] != "websocket.disconnect":
                watching.hear(message.get("text") or "")
    except TimeoutError:
        if not patience.expired():
            raise
    finally:
        watching.leave()


async def _found(store: "SessionStore", session_id: str) -> "tuple[Session | None, ProblemError | None]":
    """A session, or why it cannot be watched."""
    try:
        session = await store.get(session_id)
    except InputError as error:
        return None, problem_of_input(error)
    return session, unknown_session(session_id) if session is None else None
