"""Have sessions come and go, and see that the server's memory does not grow with them.

Run as ``python tests/soak/churn.py --minutes 60``. Each session has a song of its own, is watched for some
frames and edited; every other one is ended, the rest gives way to what comes after. The status is 1 where a
session that has gone leaves more than `MOST_BYTES` behind, once as many have come as the server keeps.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
import tempfile
import time
from pathlib import Path

import httpx

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from tests.integration.scores import scale, song  # noqa: E402
from tests.integration.server import Owned, Running, serve, upload  # noqa: E402
from tests.integration.watching import watch  # noqa: E402

WARM = 200
"""So many sessions come and go first: all that are kept loaded, and what every cache takes."""
TOLD_EVERY = 100
MOST_BYTES = 50_000
"""Sessions that hold themselves leave some 300,000; what is left of connections waits for the collector."""


async def come_and_go(server: Running, client: httpx.Client, *, is_ended: bool) -> None:
    """One session."""
    session = await asyncio.to_thread(upload, client, scale(200), song=("s.wav", song()))
    async with watch(server, session.id) as watcher:
        state = await asyncio.to_thread(session.control, "play")
        await watcher.frame(3, epoch=state["epoch"])
        await asyncio.to_thread(_edit, session)
    if is_ended:
        ended = await asyncio.to_thread(session.change, "DELETE")
        ended.raise_for_status()


def _edit(session: Owned) -> None:
    edits = [{"edit": "change_show", "changes": {"title": "Another"}}]
    session.change("POST", "/show/edits", json=edits).raise_for_status()


async def churn(server: Running, client: httpx.Client, minutes: float) -> float:
    """Sessions for so long; returns by how many bytes the memory grew for each."""
    until = time.monotonic() + minutes * 60
    gone, base = 0, 0
    while gone < WARM + TOLD_EVERY or time.monotonic() < until:
        await come_and_go(server, client, is_ended=bool(gone % 2))
        gone += 1
        if gone == WARM:
            base = server.memory_bytes()
        if gone % TOLD_EVERY == 0:
            print(f"{gone} sessions, {server.memory_bytes() / 1e6:.1f} MB", flush=True)
    return (server.memory_bytes() - base) / (gone - WARM)


def main() -> int:
    """Churn, and say what each session left behind."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0)
    arguments = parser.parse_args()
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder), "--no-page") as server,
        httpx.Client(base_url=server.address, timeout=60) as client,
    ):
        left = asyncio.run(churn(server, client, arguments.minutes))
    print(f"{left / 1000:.1f} kB for each session that came and went; {MOST_BYTES / 1000:g} at most")
    return 0 if left <= MOST_BYTES else 1


if __name__ == "__main__":
    sys.exit(main())
