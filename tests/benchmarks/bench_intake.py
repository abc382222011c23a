"""How late a viewer's frames are while the largest files come in.

Run as ``python tests/benchmarks/bench_intake.py``; ``--source`` measures another work tree's server. A frame
is late by how long after the time at which it was to be sent (0.1 s before it is due) it comes to the viewer,
who watches from another process.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

import httpx
from machine import heading
from tests.integration.intake import (
    LATE_S,
    frame_times,
    large_batch,
    large_score,
    large_show,
    large_song,
    now,
)
from tests.integration.scores import scale, song
from tests.integration.server import serve, upload

if TYPE_CHECKING:
    from collections.abc import Callable

IDLE_S = 5.0
REST_S = 0.5


def main() -> int:
    """Measure and print; the status is 1 when a frame is later than the bound while something comes in."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--source", type=Path, default=None, help="the work tree of another server")
    options = parser.parse_args()
    print(heading(__file__))
    score, show, batch, recording = (
        large_score(240_000),
        large_show(330_000),
        large_batch(60_000),
        large_song(190),
    )
    stranger = b"[" + b"0," * 4_000_000 + b"0]"
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder), "--no-page", source=options.source) as server,
        httpx.Client(base_url=server.address, timeout=300) as client,
    ):
        watched = upload(client, scale(600), song=("s.wav", song()))
        other = upload(client, scale(16), song=("s.wav", song()))
        watched.control("loop", start_s=0.0, end_s=140.0)
        json = {**other.headers, "Content-Type": "application/json"}
        work: dict[str, Callable[[], httpx.Response | None]] = {
            "nothing comes in": lambda: time.sleep(IDLE_S),
            f"a stranger's body of {_size(stranger)}": lambda: client.patch(
                other.path, content=stranger, headers={"Content-Type": "application/json"}
            ),
            f"a score of 240,000 notes, {_size(score)}": lambda: client.post(
                "/api/v1/sessions", files={"score": ("s.json", score), "song": ("s.wav", song())}
            ),
            f"a show of 330,000 keyframes, {_size(show)}": lambda: client.put(
                f"{other.path}/show", content=show, headers=json
            ),
            f"a batch of edits, {_size(batch)}": lambda: client.post(
                f"{other.path}/show/edits", content=batch, headers={**json, "Prefer": "return=minimal"}
            ),
            f"a song of {_size(recording)}": lambda: client.post(
                "/api/v1/sessions", files={"score": ("s.mid", scale(16)), "song": ("s.wav", recording)}
            ),
            "that show read again, whole": lambda: client.get(f"{other.path}/show"),
        }
        spans: list[tuple[str, float, float, int | None]] = []
        with frame_times(server, watched.id) as times:
            watched.control("play")
            time.sleep(1.0)
            for what, doing in work.items():
                begin = now()
                answer = doing()
                status = None if answer is None else answer.status_code
                spans.append((what, begin, now(), status))
                time.sleep(REST_S)
    print(f"{'while':50} took, s  status  frames  late by over {LATE_S * 1e3:g} ms  the latest, ms")
    missed = 0
    for what, begin, end, status in spans:
        late = times.late_s(begin, end + REST_S / 2)
        over = sum(value > LATE_S for value in late)
        missed += over
        print(
            f"{what:50} {end - begin:7.2f} {status or '':>7} {len(late):7} {over:21} "
            f"{max(late, default=0) * 1e3:15.1f}"
        )
    return 1 if missed else 0


def _size(data: bytes) -> str:
    return f"{len(data) / 1e6:.1f} MB"


if __name__ == "__main__":
    raise SystemExit(main())
