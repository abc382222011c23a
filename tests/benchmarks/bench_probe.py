"""How long a recording takes to be probed, and how much memory: the whole process, as an upload waits for it.

Run as ``python tests/benchmarks/bench_probe.py``. Four minutes of noise in stereo, in each format. Processor
time counts: a busy machine makes an upload wait longer.
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
import soundfile
from machine import heading, verdict

RATE = 44_100
FORMS = {"WAV": "PCM_16", "FLAC": "PCM_16", "MP3": "MPEG_LAYER_III", "OGG": "VORBIS", "OGG Opus": "OPUS"}
LONGEST_S, MAX_MEMORY_MB = 5.0, 200.0


def write(path: Path, form: str, seconds: int) -> None:
    """Write a recording, a second at a time."""
    rng = np.random.default_rng(5)
    rate = 48_000 if "Opus" in form else RATE
    with soundfile.SoundFile(
        str(path), "w", samplerate=rate, channels=2, subtype=FORMS[form], format=form.split()[0]
    ) as file:
        for second in range(seconds):
            loudness = 0.3 + 0.2 * np.sin(second)
            file.write(loudness * rng.uniform(-1.0, 1.0, (rate, 2)))


def probe(path: Path) -> tuple[float, float, float]:
    """Seconds of processor time, largest memory in MB, and the length that was found."""
    command = [sys.executable, "-m", "reina.sound.recording.worker", str(path), str(path) + ".peaks"]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdout is not None
    told = process.stdout.read()
    _, _, usage = os.wait4(process.pid, 0)
    took_s = usage.ru_utime + usage.ru_stime
    process.returncode = 0
    return took_s, usage.ru_maxrss / 1000, float(json.loads(told)["duration_s"])


def main() -> int:
    """Measure and print; the status is 1 when a bound is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=int, default=240)
    options = parser.parse_args()
    print(heading(__file__))
    slowest = largest = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for form in FORMS:
            path = Path(folder) / "song"
            write(path, form, options.seconds)
            took_s, memory_mb, duration_s = probe(path)
            slowest, largest = max(slowest, took_s), max(largest, memory_mb)
            size_mb = path.stat().st_size / 1e6
            print(
                f"{form}, {duration_s:.0f} s, {size_mb:.1f} MB: {took_s:.2f} s, {memory_mb:.0f} MB of memory"
            )
    print(verdict("slowest", slowest, LONGEST_S, "s"))
    print(verdict("largest", largest, MAX_MEMORY_MB, "MB"))
    return 0 if slowest <= LONGEST_S and largest <= MAX_MEMORY_MB else 1


if __name__ == "__main__":
    raise SystemExit(main())
