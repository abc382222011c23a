"""Run every benchmark, and write docs/benchmarks.md; the status is 1 when a bound is missed.

Run as ``python tests/benchmarks/run.py``, or with ``--short`` in about five minutes: then only those that
have a peer, with smaller inputs and fewer rounds.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from datetime import UTC, datetime
from pathlib import Path

from machine import about, machine
from table import COLLECTED, PAGE, collected, dump, write

FOLDER = Path(__file__).parent
LONGEST_S = 900
WITH_PEERS = ("stream", "keyframes", "ik", "reader", "alignment")
"""Those that give rows of Reina beside others, in the order of the table."""


def main() -> int:
    """Run them one after another, so that none disturbs another."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--short", action="store_true")
    short: bool = parser.parse_args().short
    first = [FOLDER / f"bench_{name}.py" for name in WITH_PEERS]
    paths = first if short else [*first, *sorted(set(FOLDER.glob("bench_*.py")) - set(first))]
    print(machine())
    missed: list[str] = []
    loads = [os.getloadavg()[0]]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "collected"
        file.touch()
        environment = {**os.environ, COLLECTED: str(file), "REINA_BENCH_SHORT": "1" if short else "0"}
        for path in paths:
            print(f"\n== {path.name}", flush=True)
            try:
                ran = subprocess.run([sys.executable, str(path)], timeout=LONGEST_S, env=environment)
            except subprocess.TimeoutExpired:
                print(f"not at its end after {LONGEST_S} s")
                missed.append(path.name)
            else:
                missed += [path.name] if ran.returncode else []
            loads.append(os.getloadavg()[0])
        rows, bounds = collected(file.read_text())
    taken = {
        **about(),
        "load while it ran": f"{min(loads):.1f} to {max(loads):.1f}",
        "taken": f"{datetime.now(UTC):%Y-%m-%d}",
    }
    # The short form's inputs are smaller than what the bounds are meant for.
    write(dump(rows, [] if short else bounds, taken, short=short))
    print(f"\nwritten: {PAGE}")
    if missed:
        print(f"missed a bound or failed: {', '.join(missed)}")
    return 1 if missed else 0


if __name__ == "__main__":
    raise SystemExit(main())
