"""200 viewers of one session, with the server on one core and the viewers on another.

Run as ``python tests/benchmarks/bench_stream.py``. The interval is between two frames of a viewer as they
come; the delay is behind the time at which a frame was to be sent, `LEAD_S` before it is due: one that is
later than that comes too late to be shown.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TypedDict

import httpx
from machine import heading, verdict
from tests.integration.scores import scale, song
from tests.integration.server import Running, serve, upload

from reina.sessions.broadcast import LEAD_S

LOAD = Path(__file__).with_name("stream_load.py")


def cpu_seconds(process: int) -> float:
    """Processor time that a process has used."""
    fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def pin(process: int, core: int) -> None:
    """Keep a process and its threads on one core, where the machine has more."""
    cores = sorted(os.sched_getaffinity(0))
    if len(cores) > 1:
        for task in Path(f"/proc/{process}/task").iterdir():
            os.sched_setaffinity(int(task.name), {cores[core % len(cores)]})


class Percentiles(TypedDict):
    """Milliseconds."""

    p50: float
    p99: float
    max: float


class Seen(TypedDict):
    """What the viewers saw; stream_load.py prints it."""

    frames_a_second: float
    lost: int
    interval: Percentiles
    delay: Percentiles
    cpu: float


def measure(server: Running, viewers: int, seconds: float) -> tuple[Seen, float]:
    """What the viewers saw, and the share of a core that the server used meanwhile."""
    with httpx.Client(base_url=server.address, timeout=60) as client:
        session = upload(client, scale(600), song=("s.wav", song()))
        host, port = server.address.removeprefix("http://").split(":")
        pin(server.process.pid, 0)
        command = [sys.executable, str(LOAD), host, port, f"{session.path}/stream"]
        options = [f"--viewers={viewers}", f"--seconds={seconds}", f"--lead={LEAD_S}"]
        load = subprocess.Popen([*command, *options], stdout=subprocess.PIPE, text=True)
        pin(load.pid, 1)
        assert load.stdout is not None
        if load.stdout.readline() != "joined\n":
            raise RuntimeError("the viewers could not join")
        session.control("play")
        used, begun = cpu_seconds(server.process.pid), time.monotonic()
        summary = load.stdout.readline()
        share = (cpu_seconds(server.process.pid) - used) / (time.monotonic() - begun)
        load.wait(10)
        load.stdout.close()
        session.change("DELETE")
    return json.loads(summary), share


def main() -> int:
    """Measure and print; the status is 1 when a bound is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--viewers", type=int, default=200)
    parser.add_argument("--seconds", type=float, default=10.0)
    options = parser.parse_args()
    print(heading(__file__))
    with tempfile.TemporaryDirectory() as folder, serve(Path(folder)) as server:
        seen, share = measure(server, options.viewers, options.seconds)
    interval, delay = seen["interval"], seen["delay"]
    print(f"{options.viewers} viewers of one session for {options.seconds:g} s, frame by frame")
    print(f"the server used {share:.0%} of its core, the viewers {seen['cpu']:.0%} of theirs")
    print(f"frames a second, of the worst viewer {seen['frames_a_second']:17.2f}")
    print(f"frames lost {seen['lost']:42}")
    print(verdict("interval, 99th percentile", interval["p99"], 25, "ms"))
    print(verdict("delay, 99th percentile", delay["p99"], 100, "ms"))
    print(f"interval p50 {interval['p50']:.2f}, max {interval['max']:.2f} ms; ", end="")
    print(f"delay p50 {delay['p50']:.2f}, max {delay['max']:.2f} ms")
    held = seen["frames_a_second"] > 59 and interval["p99"] <= 25 and delay["p99"] <= 100
    return 0 if held else 1


if __name__ == "__main__":
    raise SystemExit(main())
