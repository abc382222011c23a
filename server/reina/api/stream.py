"""The WebSocket: a session's frames and control messages."""

import asyncio
import contextlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, Query, WebSocket, WebSocketDisconnect
from pydantic import ValidationError

from reina.api.http.access import unknown_session
from reina.api.http.problems import ProblemError, problem_of_input
from reina.errors import InputError
from reina.protocol import SUBPROTOCOL
from reina.protocol.messages import Lead, Pong, StreamError, viewer_message
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
ASKED_FOR = {"frames_per_message", "packed"}
CLOSED_UNDER_WAY = 1006


class WebSocketConnection:
    """A WebSocket as a viewer's connection; sending raises WebSocketDisconnect once the viewer has gone."""

    def __init__(self, socket: WebSocket) -> None:
        self._socket = socket

    async def send_bytes(self, data: bytes) -> None:
        """Send a binary message."""
        await self._send({"type": "websocket.send", "bytes": data})

    async def send_text(self, data: str) -> None:
        """Send a text message."""
        await self._send({"type": "websocket.send", "text": data})

    async def close(self, code: int, reason: str) -> None:
        """Say goodbye."""
        await self._socket.close(code, reason)

    async def _send(self, message: dict[str, Any]) -> None:
        try:
            await self._socket.send(message)
        except RuntimeError as error:
            # What the ASGI server raises when the connection was closed under it, as for a message too large.
            raise WebSocketDisconnect(CLOSED_UNDER_WAY) from error


@router.websocket("/sessions/{session_id}/stream")
async def stream(
    socket: WebSocket,
    session_id: str,
    frames_per_message: Annotated[str, Query()] = "1",
    packed: Annotated[str, Query()] = "0",
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
        known, asked = " and ".join(sorted(ASKED_FOR)), ", ".join(sorted(unknown))[:100]
        detail = f"the stream may be asked for {known}, not for {asked}"
        problem = ProblemError(422, "request-invalid", "The request does not fit", detail)
    elif session is not None and size is None:
        detail = f"frames_per_message is 1 to {MAX_FRAMES_PER_MESSAGE}, not {frames_per_message[:20]}"
        problem = ProblemError(422, "request-invalid", "The request does not fit", detail)
    elif session is not None and packed not in PACKED:
        detail = f"packed is {', '.join(PACKED)}, not {packed[:20]}"
        problem = ProblemError(422, "request-invalid", "The request does not fit", detail)
    if problem or session is None or size is None:
        if problem:
            await socket.send_denial_response(problem.response())
        return
    with session.asked():
        await _send_until_the_end(socket, session, size, form, now)
    store.sightings.note(session.id)


async def _send_until_the_end(
    socket: WebSocket, session: "Session", size: int, form: "Form | None", now: Callable[[], float]
) -> None:
    await socket.accept(subprotocol=SUBPROTOCOL)
    viewer = Viewer(WebSocketConnection(socket), frames_per_message=size, form=form)
    await session.ready(form=form)
    session.join(viewer)
    sending = asyncio.create_task(viewer.run())
    receiving = asyncio.create_task(_receive(socket, viewer, session, now))
    try:
        await asyncio.wait({sending, receiving}, return_when=asyncio.FIRST_COMPLETED)
    finally:
        session.leave(viewer)
        for task in (sending, receiving):
            task.cancel()
            # Whoever leaves does so in the middle of a message: that is no error.
            with contextlib.suppress(asyncio.CancelledError, WebSocketDisconnect, OSError):
                await task


async def _found(store: "SessionStore", session_id: str) -> "tuple[Session | None, ProblemError | None]":
    """A session, or why it cannot be watched."""
    try:
        session = await store.get(session_id)
    except InputError as error:
        return None, problem_of_input(error)
    return session, unknown_session(session_id) if session is None else None


async def _receive(socket: WebSocket, viewer: Viewer, session: "Session", now: Callable[[], float]) -> None:
    """Answer what the viewer says until it goes."""
    while True:
        message = await socket.receive()
        received_s = now()
        if message["type"] == "websocket.disconnect":
            return
        try:
            said = viewer_message.validate_json(message.get("text") or "")
        except ValidationError:
            detail = (
                'viewers send {"type": "ping", "id": 1} or {"type": "lead", "lead_s": 0.5} (0.1 to 1.5), '
                "and nothing else"
            )
            viewer.post_text(StreamError(title="Not understood", detail=detail).model_dump_json())
        else:
            if isinstance(said, Lead):
                session.take_lead(viewer, said.lead_s)
            else:
                viewer.post_text(Pong(id=said.id, server_time_s=received_s).model_dump_json())
