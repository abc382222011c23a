"""From an upload to its first frame on a socket.

Run as ``python tests/benchmarks/bench_upload.py``. A score of 3,000 notes without a song, so that its
rendering begins meanwhile, as it does for a person; timed from the request to the first binary message.
"""

from __future__ import annotations

import argparse
import asyncio
import statistics
import tempfile
import time
from pathlib import Path

import httpx
import websockets
from machine import heading, verdict
from tests.integration.scores import scale
from tests.integration.server import Running, serve

from reina.protocol import SUBPROTOCOL


async def upload_and_watch(server: Running, score: bytes) -> tuple[float, float]:
    """Seconds until the upload is answered, and until the first frame is there."""
    async with httpx.AsyncClient(base_url=server.address, timeout=60) as client:
        begin = time.perf_counter()
        answer = await client.post("/api/v1/sessions", files={"score": ("score.mid", score)})
        answered_s = time.perf_counter() - begin
        session = answer.raise_for_status().json()
        async with websockets.connect(
            server.stream(session["id"]), subprotocols=[websockets.Subprotocol(SUBPROTOCOL)]
        ) as socket:
            while isinstance(await socket.recv(), str):
                pass
            first_s = time.perf_counter() - begin
        headers = {"Authorization": f"Bearer {session['control_token']}"}
        (await client.delete(f"/api/v1/sessions/{session['id']}", headers=headers)).raise_for_status()
    return answered_s, first_s


def main() -> int:
    """Measure and print; the status is 1 when the bound is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--notes", type=int, default=3000)
    parser.add_argument("--repetitions", type=int, default=7)
    options = parser.parse_args()
    print(heading(__file__))
    score = scale(options.notes)
    with tempfile.TemporaryDirectory() as folder, serve(Path(folder)) as server:
        times = [asyncio.run(upload_and_watch(server, score)) for _ in range(options.repetitions)]
    answered, first = ([time[column] for time in times] for column in (0, 1))
    print(f"{options.notes} notes, {len(score)} bytes, {options.repetitions} uploads one after another")
    print(f"answered after {statistics.median(answered):.3f} s, the first upload after {answered[0]:.3f} s")
    print(verdict("upload to first frame, median", statistics.median(first), 0.5, "s"))
    print(verdict("upload to first frame, worst", max(first), 0.5, "s"))
    return 0 if statistics.median(first) <= 0.5 else 1


if __name__ == "__main__":
    raise SystemExit(main())
