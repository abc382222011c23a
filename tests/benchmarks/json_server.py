"""What one writes first: FastAPI, and each frame as JSON, values by names; for bench_stream.py to watch.

Prints ``port N``, and from the first line of its input on sends 60 frames a second by one ticker with
absolute deadlines. The frames are Reina's, made beforehand, numbers rounded to five places; the text of a
frame is made once for all viewers.
"""

from __future__ import annotations

import asyncio
import json
import os
import struct
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import uvicorn
from bench_frame import performance
from fastapi import FastAPI, WebSocket, WebSocketDisconnect
from stream_stacks import Stack, run

if TYPE_CHECKING:
    import socket


def frames() -> list[dict[str, Any]]:
    """A second of a player under a show, as documents."""
    subject = performance(200)
    layout, block = subject.layout, subject.evaluate(1)
    joints = [f"{skeleton.name}/{joint}" for skeleton in layout.skeletons for joint in skeleton.joints]
    found: list[dict[str, Any]] = []
    for number in range(len(block.parameters)):
        rotations, places, values = (
            array[number].astype(float).round(5).tolist()
            for array in (block.rotations, block.root_positions, block.parameters)
        )
        parameters: dict[str, Any] = {}
        start = 0
        for parameter in layout.parameters:
            length = parameter.length
            parameters[parameter.path] = values[start] if length == 1 else values[start : start + length]
            start += length
        found.append(
            {
                "rotations": dict(zip(joints, rotations, strict=True)),
                "root_positions": places,
                "parameters": parameters,
            }
        )
    return found


class JsonStream(Stack):
    """Sends every viewer the text, one after another."""

    def __init__(self) -> None:
        super().__init__()
        self._frames = frames()
        self._viewers: list[WebSocket] = []
        self._application = FastAPI()
        self._application.websocket("/")(self._watch)

    async def _watch(self, viewer: WebSocket) -> None:
        await viewer.accept()
        self._viewers.append(viewer)
        with suppress(WebSocketDisconnect):
            while True:
                await viewer.receive_text()

    async def serve(self, listening: socket.socket) -> None:
        config = uvicorn.Config(self._application, log_level="error", lifespan="off")
        self._serving = asyncio.create_task(uvicorn.Server(config).serve([listening]))

    async def send(self, message: bytes) -> None:
        _, _, _, index, at_s, due_s = struct.unpack_from("<BBHIdd", message)
        head = {"index": index, "song_time_s": at_s, "due_time_s": due_s}
        text = json.dumps({**head, **self._frames[index % len(self._frames)]}, separators=(",", ":"))
        for viewer in [*self._viewers]:
            try:
                await viewer.send_text(text)
            except WebSocketDisconnect:
                self._viewers.remove(viewer)


if __name__ == "__main__":
    with asyncio.Runner() as runner:
        runner.run(run(JsonStream(), 24, 60.0))
        os._exit(0)
