"""Memory of an idle session: loaded, played once for a moment, watched by nobody.

Run as ``python tests/benchmarks/bench_memory.py``. The base is the server after its first sessions have come
and gone; then sessions of 3,000 notes are made, each is watched for a moment, and the memory is read.
"""

from __future__ import annotations

import argparse
import asyncio
import tempfile
from pathlib import Path

import httpx
from machine import heading, verdict
from tests.integration.scores import scale, song
from tests.integration.server import Owned, Running, serve, upload
from tests.integration.watching import watch


async def play_a_moment(server: Running, session: Owned) -> None:
    """Watch some frames, then pause and go."""
    async with watch(server, session.id) as watcher:
        state = await asyncio.to_thread(session.control, "play")
        await watcher.frame(3, epoch=state["epoch"])
        await asyncio.to_thread(session.control, "pause")


def main() -> int:
    """Measure and print; the status is 1 when the bound is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sessions", type=int, default=20)
    parser.add_argument("--notes", type=int, default=3000)
    options = parser.parse_args()
    print(heading(__file__))
    score, sound = scale(options.notes), song()
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder)) as server,
        httpx.Client(base_url=server.address, timeout=60) as client,
    ):

        def make() -> Owned:
            session = upload(client, score, song=("s.wav", sound))
            asyncio.run(play_a_moment(server, session))
            return session

        for session in [make() for _ in range(3)]:
            session.change("DELETE").raise_for_status()
        base = server.memory_bytes()
        sessions = [make() for _ in range(options.sessions)]
        each = (server.memory_bytes() - base) / len(sessions)
    print(f"{options.sessions} sessions of {options.notes} notes; base {base / 1e6:.0f} MB")
    print(verdict("an idle session above the base", each / 1e6, 5, "MB"))
    return 0 if each <= 5e6 else 1


if __name__ == "__main__":
    raise SystemExit(main())
