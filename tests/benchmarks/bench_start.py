"""From the start of `reina serve` to its first answer, and what it holds in memory then.

Run as ``python tests/benchmarks/bench_start.py``; ``--source`` measures another work tree's server. Timed
from before the process begins to the answer of ``GET /api/v1/health``, several times over one data directory,
after a start that is not counted: files are cached, compiled modules are kept and the database is there, as
at every start but the first. Memory at rest is read when the server has answered and has nothing to do:
resident, and the part of it that is the process's own (what is mapped from libraries' files can be dropped).
The processor's time is that of the server until then, which another program's load does not change as much.
"""

from __future__ import annotations

import argparse
import os
import statistics
import tempfile
import time
from pathlib import Path

import httpx
from machine import heading, verdict
from tests.integration.server import serve

START_S = 1.2
BASE_MB = 80.0


def main() -> int:
    """Measure and print; the status is 1 when a bound is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--starts", type=int, default=9)
    parser.add_argument("--source", type=Path, default=None, help="the work tree of another server")
    options = parser.parse_args()
    # Else each start would compile what is not installed anew.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    print(heading(__file__))
    took_s: list[float] = []
    busy_s: list[float] = []
    resident, own, workers = 0.0, 0.0, list[int]()
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(1 + options.starts):
            begin = time.perf_counter()
            with serve(Path(folder), source=options.source) as server:
                httpx.get(f"{server.api}/health").raise_for_status()
                took_s.append(time.perf_counter() - begin)
                busy_s.append(server.processor_s())
                resident, own = server.memory_bytes() / 1e6, server.own_memory_bytes() / 1e6
                workers = server.children()
    first, *later = took_s
    print(f"the first start {first:.2f} s, {busy_s[0]:.2f} s of the processor")
    print(f"{len(later)} later starts: {min(later):.2f} to {max(later):.2f} s")
    print(f"processor until the first answer, median {statistics.median(busy_s[1:]):.2f} s")
    print(verdict("from the start to the first answer, median", statistics.median(later), START_S, "s"))
    print(verdict("memory at rest", resident, BASE_MB, "MB"))
    print(f"of it the process's own {own:.0f} MB; processes beside it: {len(workers)}")
    return 0 if statistics.median(later) <= START_S and resident <= BASE_MB else 1


if __name__ == "__main__":
    raise SystemExit(main())
