"""Many viewers of one session in one light process: raw WebSockets that only take the time.

Run by bench_stream.py. Prints one JSON object: of all viewers, how many frames came, the intervals between
them and the delays behind the time at which each was to be sent, as percentiles in milliseconds.
"""

from __future__ import annotations

import argparse
import asyncio
import base64
import json
import os
import struct
import time
from array import array

import numpy as np

FIRST_EXTENDED, SECOND_EXTENDED = 126, 127
BINARY = 2
HEADER = struct.Struct("<BBHIdd")


class LoadViewer(asyncio.Protocol):
    """One viewer: counts frames, and notes when each came and when it was due."""

    def __init__(self, request: bytes, joined: asyncio.Future[None]) -> None:
        self.arrived = array("d")
        self.due = array("d")
        self.index = array("q")
        self._request = request
        self._joined = joined
        self._rest = b""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        transport.write(self._request)

    def data_received(self, data: bytes) -> None:
        now = time.monotonic()
        data = self._rest + data
        at = 0
        if not self._joined.done():
            end = data.find(b"\r\n\r\n")
            if end < 0:
                self._rest = data
                return
            if not data.startswith(b"HTTP/1.1 101"):
                self._joined.set_exception(ConnectionError(data[:200].decode()))
                return
            self._joined.set_result(None)
            at = end + 4
        size = len(data)
        while at + 2 <= size:
            length, head = data[at + 1] & 127, 2
            if length == FIRST_EXTENDED:
                head = 4
                if at + head > size:
                    break
                length = (data[at + 2] << 8) | data[at + 3]
            elif length == SECOND_EXTENDED:
                head = 10
                if at + head > size:
                    break
                length = int.from_bytes(data[at + 2 : at + 10], "big")
            if at + head + length > size:
                break
            if data[at] & 15 == BINARY:
                _, _, flags, index, _, due = HEADER.unpack_from(data, at + head)
                if flags & 1:
                    self.arrived.append(now)
                    self.due.append(due)
                    self.index.append(index)
            at += head + length
        self._rest = data[at:]


def percentiles(values: np.ndarray[tuple[int], np.dtype[np.float64]]) -> dict[str, float]:
    """Median, 99th percentile and maximum, milliseconds."""
    middle, high = np.percentile(values, [50, 99]) * 1e3
    return {"p50": float(middle), "p99": float(high), "max": float(values.max() * 1e3)}


async def run(
    host: str, port: int, path: str, viewers: int, seconds: float, lead_s: float
) -> dict[str, object]:
    """Join, watch for a while, and sum up."""
    loop = asyncio.get_running_loop()
    watching: list[LoadViewer] = []
    for _ in range(viewers):
        key = base64.b64encode(os.urandom(16)).decode()
        request = (
            f"GET {path} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n"
            "Sec-WebSocket-Protocol: reina.v1\r\n\r\n"
        ).encode()
        joined: asyncio.Future[None] = loop.create_future()
        _, viewer = await loop.create_connection(
            lambda request=request, joined=joined: LoadViewer(request, joined), host, port
        )
        await joined
        watching.append(viewer)
    print("joined", flush=True)
    begin = time.monotonic() + 1.0  # after the burst that begins an epoch
    cpu = time.process_time()
    await asyncio.sleep(1.0 + seconds)
    cpu = time.process_time() - cpu
    end = begin + seconds
    intervals: list[np.ndarray[tuple[int], np.dtype[np.float64]]] = []
    delays: list[np.ndarray[tuple[int], np.dtype[np.float64]]] = []
    frames: list[int] = []
    lost = 0
    for viewer in watching:
        arrived, due, index = np.array(viewer.arrived), np.array(viewer.due), np.array(viewer.index)
        inside = (arrived >= begin) & (arrived <= end)
        arrived, due, index = arrived[inside], due[inside], index[inside]
        intervals.append(np.diff(arrived))
        delays.append(arrived - (due - lead_s))
        frames.append(len(arrived))
        lost += int((np.diff(index) != 1).sum())
    return {
        "frames_a_second": min(frames) / seconds,
        "lost": lost,
        "interval": percentiles(np.concatenate(intervals)),
        "delay": percentiles(np.concatenate(delays)),
        "cpu": cpu / (1.0 + seconds),
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("host")
    parser.add_argument("port", type=int)
    parser.add_argument("path")
    parser.add_argument("--viewers", type=int, required=True)
    parser.add_argument("--seconds", type=float, required=True)
    parser.add_argument("--lead", type=float, required=True)
    given = parser.parse_args()
    summary = run(given.host, given.port, given.path, given.viewers, given.seconds, given.lead)
    print(json.dumps(asyncio.run(summary)))
