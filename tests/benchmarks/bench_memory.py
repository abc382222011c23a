"""Memory of sessions: loaded and watched by nobody, and playing with a viewer each.

Run as ``python tests/benchmarks/bench_memory.py``; ``--source`` measures another work tree's server. The
base is the server after its first sessions have come and gone. Then sessions are made, each is watched for a
moment and paused, and the memory is read: that of idle ones. Then all play, a viewer each, for some seconds
of frames, and it is read again. A session's share is the difference over their number, of the server's
resident memory. A piece of 150 notes is half a minute of music, one of 3,000 a long one.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import httpx
from machine import heading, verdict
from tests.integration.scores import scale, song
from tests.integration.server import Owned, Running, serve, upload
from tests.integration.watching import watch

if TYPE_CHECKING:
    from collections.abc import Sequence

LENGTHS = (150, 3000)
IDLE_MB, PLAYING_MB = 0.5, 5.0
WATCHED_FRAMES = 180
"""Of each session that plays: three seconds."""


async def play_a_moment(server: Running, session: Owned) -> None:
    """Watch some frames, then pause and go."""
    async with watch(server, session.id) as watcher:
        state = await asyncio.to_thread(session.control, "play")
        await watcher.frame(3, epoch=state["epoch"])
        await asyncio.to_thread(session.control, "pause")


async def memory_while_all_play(server: Running, sessions: Sequence[Owned]) -> int:
    """Resident memory when each has played for a while, watched."""
    async with contextlib.AsyncExitStack() as watched:
        watchers = [await watched.enter_async_context(watch(server, session.id)) for session in sessions]
        states = [await asyncio.to_thread(session.control, "play") for session in sessions]
        for watcher, state in zip(watchers, states, strict=True):
            await watcher.frame(WATCHED_FRAMES, epoch=state["epoch"])
        return server.memory_bytes()


def measure(notes: int, count: int, source: Path | None) -> tuple[float, float, float]:
    """The base, and what an idle and a playing session of so many notes takes above it, MB."""
    score, sound = scale(notes), song()
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder), source=source) as server,
        httpx.Client(base_url=server.address, timeout=60) as client,
    ):

        def make() -> Owned:
            session = upload(client, score, song=("s.wav", sound))
            asyncio.run(play_a_moment(server, session))
            return session

        for session in [make() for _ in range(3)]:
            session.change("DELETE").raise_for_status()
        base = server.memory_bytes()
        sessions = [make() for _ in range(count)]
        idle = (server.memory_bytes() - base) / count
        playing = (asyncio.run(memory_while_all_play(server, sessions)) - base) / count
    return base / 1e6, idle / 1e6, playing / 1e6


def main() -> int:
    """Measure and print; the status is 1 when a bound is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sessions", type=int, default=20)
    parser.add_argument("--notes", type=int, nargs="+", default=LENGTHS)
    parser.add_argument("--source", type=Path, default=None, help="the work tree of another server")
    options = parser.parse_args()
    print(heading(__file__))
    missed = False
    for notes in options.notes:
        base, idle, playing = measure(notes, options.sessions, options.source)
        missed = missed or idle > IDLE_MB or playing > PLAYING_MB
        print(f"{options.sessions} sessions of {notes} notes; base {base:.0f} MB")
        print(verdict("an idle session above the base", idle, IDLE_MB, "MB"))
        print(verdict("one that plays, with a viewer", playing, PLAYING_MB, "MB"))
    return int(missed)


if __name__ == "__main__":
    raise SystemExit(main())
