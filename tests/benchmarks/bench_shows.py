"""Seconds to read a show, beside the reader of another commit.

Run as ``python tests/benchmarks/bench_shows.py [COMMIT]``. A show of numbers, vectors and colours with
several interpolations, from its text to tracks. Both read the same bytes, turn by turn in processes of their
own, and the best of several turns counts; the commit comes from a work tree of its own, so nothing here is
touched.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from machine import heading

REPOSITORY = Path(__file__).parents[2]
BEFORE = "457f115"
"""The last commit that read shows field by field, without declared models."""
TURNS = 9

READER = """
import gc, sys, time
try:
    from reina.keyframes import Show
    from reina.keyframes.stage_parameters import stage_registry
    from json import loads
except ImportError:
    from reina.show import Show
    from reina.stage import stage_registry
    from reina.system.json_text import read_json as loads
data, registry = open(sys.argv[1], "rb").read(), stage_registry()
for _ in sys.stdin:
    gc.collect()
    start = time.perf_counter()
    document = loads(data)
    parsed = time.perf_counter()
    show = Show.from_document(document, registry)
    print(parsed - start, time.perf_counter() - parsed, flush=True)
    del document, show
"""


PARAMETERS = {
    "number": ("camera/fov", "lights/key/intensity", "lights/haze", "blocks/glow"),
    "vector": ("camera/position", "camera/target", "lights/key/position", "lights/rim/position"),
    "color": ("lights/key/color", "lights/fill/color", "lights/rim/color", "blocks/color"),
}
INTERPOLATIONS = ("linear", "step", "cubic_bezier", "sine_in_out", "clamped")


def show(kinds: tuple[str, ...], keyframes: int) -> bytes:
    """A show on parameters of some types, with so many keyframes in all."""
    rng = np.random.default_rng(4)
    tracks: list[dict[str, object]] = []
    paths = [(kind, path) for kind in kinds for path in PARAMETERS[kind]]
    for kind, path in paths:
        entries: list[dict[str, object]] = []
        for place in range(keyframes // len(paths)):
            value: object = round(float(rng.uniform(0.1, 0.9)), 4)
            if kind == "vector":
                value = [round(float(part), 4) for part in rng.random(3)]
            if kind == "color":
                value = f"#{int(rng.integers(1 << 24)):06x}"
            interpolation = INTERPOLATIONS[place % len(INTERPOLATIONS)]
            entry: dict[str, object] = {
                "key": f"k{place}",
                "time": place / 8,
                "value": value,
                "interpolation": interpolation,
            }
            if interpolation == "cubic_bezier":
                entry["handles"] = [0.2, 0.0, 0.4, 1.0]
            entries.append(entry)
        tracks.append({"parameter": path, "keyframes": entries})
    return json.dumps({"version": 1, "tracks": tracks}).encode()


def measure(readers: dict[str, Path], file: Path) -> dict[str, tuple[float, float]]:
    """Best seconds to parse the text and to read what was parsed, by reader."""
    running = {
        name: subprocess.Popen(
            [sys.executable, "-c", READER, str(file)],
            env={**os.environ, "PYTHONPATH": str(tree / "server")},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        for name, tree in readers.items()
    }
    found: dict[str, list[tuple[float, float]]] = {name: [] for name in readers}
    for _ in range(TURNS):
        for name, process in running.items():
            if process.stdin is None or process.stdout is None:
                raise RuntimeError("a reader has no pipes")
            process.stdin.write("\n")
            process.stdin.flush()
            parsed, read = process.stdout.readline().split()
            found[name].append((float(parsed), float(read)))
    for process in running.values():
        process.communicate()
    return {name: (min(p for p, _ in times), min(r for _, r in times)) for name, times in found.items()}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("commit", nargs="?", default=BEFORE)
    parser.add_argument("--keyframes", type=int, default=24_000)
    options = parser.parse_args()
    print(heading(__file__))
    with tempfile.TemporaryDirectory() as folder:
        before = Path(folder) / "before"
        git = ["git", "-C", str(REPOSITORY), "worktree"]
        subprocess.run([*git, "add", "--quiet", "--detach", str(before), options.commit], check=True)
        try:
            print(
                f"{options.keyframes} keyframes     before: parse    read   now: parse    read   times   (ms)"
            )
            for kinds in (("number",), ("vector",), ("color",), tuple(PARAMETERS)):
                file = Path(folder) / "show.json"
                file.write_bytes(show(kinds, options.keyframes))
                times = measure({"before": before, "now": REPOSITORY}, file)
                (parse_b, read_b), (parse, read) = times["before"], times["now"]
                print(
                    f"{' and '.join(kinds):29} {parse_b * 1e3:7.1f} {read_b * 1e3:7.1f}"
                    f" {parse * 1e3:12.1f} {read * 1e3:7.1f} {read_b / read:7.2f}"
                    f"   with parsing {(parse_b + read_b) / (parse + read):.2f}"
                )
        finally:
            subprocess.run([*git, "remove", "--force", str(before)], check=True)


if __name__ == "__main__":
    main()
