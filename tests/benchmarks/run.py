"""Run every benchmark and print its figures; the status is 1 when a bound is missed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from machine import machine

FOLDER = Path(__file__).parent
LONGEST_S = 300


def main() -> int:
    """Run them one after another, so that none disturbs another."""
    print(machine())
    missed: list[str] = []
    for path in sorted(FOLDER.glob("bench_*.py")):
        print(f"\n== {path.name}", flush=True)
        if subprocess.run([sys.executable, str(path)], timeout=LONGEST_S).returncode:
            missed.append(path.name)
    if missed:
        print(f"\nmissed a bound or failed: {', '.join(missed)}")
    return 1 if missed else 0


if __name__ == "__main__":
    raise SystemExit(main())
