"""Many viewers, with the server on one core and the viewers, in C, on another.

Run as ``python tests/benchmarks/bench_viewers.py``. What the server's process uses of the processor is
divided by the messages that came, and set beside a loop of send() in C that sends as many bytes to as many
viewers in the same run. The interval is between two frames of a viewer as they come; late is what comes after
the time at which it was to be sent, `LEAD_S` before it is due.

``--stacks all`` measures small servers of other stacks instead (stream_stacks.py); ``--python`` names the
Python to run them by, one that has uvloop and picows.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict

import httpx
from machine import heading, verdict
from stream_stacks import STACKS
from tests.integration.scores import scale, song
from tests.integration.server import serve, upload

from reina.performance import BLOCK_FRAMES
from reina.protocol import SUBPROTOCOL
from reina.sessions.broadcast import LEAD_S

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator

HERE = Path(__file__).parent
SETTLE_S = 1.0
"""After the burst that begins an epoch."""
BEGINNING_S = 0.03
"""For each session more: they are set playing one after another."""
FRAME_BYTES = 1536
FPS = 60
ENDS_WITHIN_S = 3.0
ANYTHING = -1
"""For `frames`: what comes is no frame of Reina's, and text counts too."""
UVLOOP = "+uvloop"
OPEN = {"REINA_MOST_CONNECTIONS": 20_000, "REINA_MOST_CONNECTIONS_AN_ADDRESS": 20_000}


class Percentiles(TypedDict):
    """Milliseconds."""

    p50: float
    p99: float
    max: float


class Seen(TypedDict):
    """What the viewers saw; viewers.c prints it."""

    viewers: int
    seconds: float
    messages: int
    bytes: int
    fewest_a_second: float
    interval: Percentiles
    late: Percentiles | None
    texts: int
    text_bytes: int
    pings: int
    lost: int
    closed: int
    cpu: float


@dataclass(frozen=True)
class Measured:
    """What the viewers saw, and what the server's process used meanwhile.

    Attributes:
        seen: Of the viewers.
        cpu_s: Processor time.
        memory: What its memory grew by for a viewer, bytes.
    """

    seen: Seen
    cpu_s: float
    memory: float

    @property
    def message_us(self) -> float:
        """Processor time for a message and viewer."""
        return self.cpu_s * 1e6 / (self.seen["messages"] + self.seen["texts"])

    def line(self, name: str, kernel: Measured) -> str:
        """A row of the table."""
        seen, times = self.seen, self.message_us / kernel.message_us
        late = f"late p99 {seen['late']['p99']:6.1f} ms; " if seen["late"] else ""
        return (
            f"{name:28} {self.message_us:6.2f} µs, {times:5.2f} times; "
            f"{self.cpu_s / seen['seconds']:4.0%} of the core; "
            f"fewest {seen['fewest_a_second']:5.1f}/s, lost {seen['lost']}; "
            f"interval p99 {seen['interval']['p99']:6.1f}, max {seen['interval']['max']:6.1f} ms; {late}"
            f"{self.memory / 1000:5.1f} kB a viewer; viewers {seen['cpu']:4.0%} of theirs"
        )


def tasks(process: int) -> Iterator[Path]:
    """The threads of a process, and of those that it started."""
    for task in Path(f"/proc/{process}/task").iterdir():
        yield task
        for child in (task / "children").read_text().split():
            yield from tasks(int(child))


def cpu_seconds(process: int) -> float:
    """Processor time that the threads of a process, and of those that it started, have used."""
    return sum(int((task / "schedstat").read_text().split()[0]) for task in tasks(process)) / 1e9


def memory_bytes(process: int) -> int:
    """Resident memory of a process."""
    return int(Path(f"/proc/{process}/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE")


def pin(process: int, core: int) -> None:
    """Keep a process, its threads and what it started on one core, where the machine has more."""
    cores = sorted(os.sched_getaffinity(0))
    if len(cores) > 1:
        for task in tasks(process):
            os.sched_setaffinity(int(task.name), {cores[core % len(cores)]})


class Bench:
    """The viewers, compiled, and how long they watch.

    Args:
        folder: Where they are compiled to.
        seconds: How long they watch.
    """

    def __init__(self, folder: Path, seconds: float) -> None:
        self.viewers_program = str(folder / "viewers")
        self._seconds = seconds
        compiler = shutil.which("cc")
        if compiler is None:
            raise SystemExit("the viewers are in C: a compiler named cc is needed")
        source = str(HERE / "viewers.c")
        subprocess.run(
            [compiler, "-std=c11", "-Wall", "-O2", "-o", self.viewers_program, source, "-lm"], check=True
        )

    def kernel(self, viewers: int, size: int, rate: float) -> Measured:
        """A loop of send() in C; a rate of 0 sends as fast as it is read."""
        with _started([self.viewers_program, "send", str(viewers), str(size), str(rate)]) as (process, port):
            return self._watch(process.pid, port, viewers, ["/"], frames=1, lead_s=0.0)

    def stack(self, name: str, python: str, viewers: int, size: int, rate: float) -> Measured:
        """One of stream_stacks.py, under uvloop where the name ends so."""
        command = [python, str(HERE / "stream_stacks.py"), name.removesuffix(UVLOOP)]
        options = [f"--bytes={size}", f"--rate={rate}", *(["--uvloop"] if name.endswith(UVLOOP) else [])]
        return self.program([*command, *options], viewers, frames=1)

    def program(
        self, command: list[str], viewers: int, *, frames: int = ANYTHING, subprotocol: str = SUBPROTOCOL
    ) -> Measured:
        """A server that says its port, and sends from the first line of its input on."""
        with _started(command) as (process, port):

            def begin() -> None:
                pin(process.pid, 0)
                assert process.stdin is not None
                process.stdin.write("go\n")
                process.stdin.flush()

            return self._watch(
                process.pid,
                port,
                viewers,
                ["/"],
                frames=frames,
                lead_s=0.0,
                begin=begin,
                subprotocol=subprotocol,
            )

    def reina(
        self, folder: Path, viewers: int, sessions: int, frames: int, *, packed: bool = False
    ) -> Measured:
        """The server itself, with the viewers spread over so many sessions; frames, or packed blocks."""
        query = "packed=1&notes=0" if packed else f"frames_per_message={frames}"
        with (
            serve(folder, settings=OPEN) as server,
            httpx.Client(base_url=server.address, timeout=60) as client,
        ):
            sent: dict[str, Any] = {"song": ("s.wav", song()), "in_time": "true"}
            owned = [upload(client, scale(600), **sent) for _ in range(sessions)]
            pin(server.process.pid, 0)
            port = int(server.address.rsplit(":", 1)[1])
            return self._watch(
                server.process.pid,
                port,
                viewers,
                [f"{session.path}/stream?{query}" for session in owned],
                frames=0 if packed else frames,
                lead_s=LEAD_S,
                begin=lambda: [session.control("play") for session in owned],
            )

    def _watch(
        self,
        process: int,
        port: int,
        viewers: int,
        paths: list[str],
        *,
        frames: int,
        lead_s: float,
        begin: Callable[[], object] = lambda: None,
        subprotocol: str = SUBPROTOCOL,
    ) -> Measured:
        memory = memory_bytes(process)
        settle_s = SETTLE_S + BEGINNING_S * (len(paths) - 1)
        numbers = [str(port), str(viewers), str(self._seconds), str(settle_s), str(lead_s), str(frames)]
        command = [self.viewers_program, "watch", "127.0.0.1", *numbers, subprotocol, *paths]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as watching:
            pin(watching.pid, 1)
            assert watching.stdout is not None
            try:
                _expect(watching.stdout.readline(), "joined")
                begin()
                _expect(watching.stdout.readline(), "measuring")
                used = cpu_seconds(process)
                summary = watching.stdout.readline()
                used = cpu_seconds(process) - used
                grown = memory_bytes(process) - memory
            finally:
                watching.kill()
        return Measured(json.loads(summary), used, grown / viewers)


def _expect(line: str, word: str) -> None:
    if line != f"{word}\n":
        raise RuntimeError(f"the viewers said {line!r}, not {word}")


@contextmanager
def _started(command: list[str]) -> Generator[tuple[subprocess.Popen[str], int]]:
    """A server that says its port."""
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        pin(process.pid, 0)
        assert process.stdout is not None
        try:
            word, _, port = process.stdout.readline().partition(" ")
            if word != "port":
                raise RuntimeError(f"{command} did not start")
            yield process, int(port)
        finally:
            # They end with their input, and with what they started.
            assert process.stdin is not None
            process.stdin.close()
            try:
                process.wait(ENDS_WITHIN_S)
            except subprocess.TimeoutExpired:
                process.kill()


def main() -> int:
    """Measure and print; the status is 1 when a bound is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--viewers", type=int, nargs="+", default=[500, 1000, 2000])
    parser.add_argument("--sessions", type=int, default=1, help="how many sessions they are spread over")
    parser.add_argument("--frames", type=int, default=1, help="how many frames are in a message")
    parser.add_argument(
        "--packed", action="store_true", help="packed blocks in place of frames, one a second"
    )
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--stacks", nargs="+", help=f"of {', '.join(STACKS)}, each with {UVLOOP} or not; all")
    parser.add_argument("--bytes", type=int, default=FRAME_BYTES, help="of a message of the stacks")
    parser.add_argument("--rate", type=float, default=FPS, help="messages a second of the stacks")
    parser.add_argument("--python", default=sys.executable, help="what runs the stacks")
    options = parser.parse_args()
    print(heading(__file__))
    held = True
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(Path(folder), options.seconds)
        for viewers in options.viewers:
            if options.stacks:
                names = [*STACKS, *(name + UVLOOP for name in STACKS)]
                chosen = names if options.stacks == ["all"] else options.stacks
                compare(bench, chosen, options.python, viewers, options.bytes, options.rate)
                continue
            data_dir = Path(folder) / f"data-{viewers}"
            frames = BLOCK_FRAMES if options.packed else options.frames
            measured = bench.reina(data_dir, viewers, options.sessions, frames, packed=options.packed)
            seen = measured.seen
            rate = FPS / frames
            kernel = bench.kernel(viewers, seen["bytes"] // seen["messages"], rate)
            print(f"{viewers} viewers of {options.sessions} sessions, {frames} frames a message")
            print(kernel.line("send() in C", kernel))
            print(measured.line("Reina", kernel), flush=True)
            bounds = [
                ("of the kernel's cost of a message", measured.message_us / kernel.message_us, 1.4, "×"),
                ("interval, 99th percentile", seen["interval"]["p99"], 25.0 * frames, "ms"),
                ("late, 99th percentile", (seen["late"] or seen["interval"])["p99"], 100.0, "ms"),
            ]
            if options.packed:
                # A block has no time of its own to be late by, and so few cost the kernel next to nothing.
                bounds = bounds[1:2]
            elif options.sessions > 1:
                bounds = bounds[1:]
            for bound in bounds:
                print(verdict(*bound))
            held &= all(value <= most for _, value, most, _ in bounds)
            held &= seen["fewest_a_second"] > 0.98 * rate
        if not options.stacks:
            ceiling = bench.kernel(max(options.viewers), FRAME_BYTES, 0).seen
            rate = ceiling["messages"] / ceiling["seconds"]
            print(f"the viewers take {rate:,.0f} messages a second ({ceiling['cpu']:.0%} of their core)")
    return 0 if held else 1


def compare(bench: Bench, names: list[str], python: str, viewers: int, size: int, rate: float) -> None:
    """Print a table of stacks."""
    print(f"{viewers} viewers, {size} bytes {rate:g} times a second")
    kernel = bench.kernel(viewers, size, rate)
    print(kernel.line("send() in C", kernel), flush=True)
    for name in names:
        try:
            measured = bench.stack(name, python, viewers, size, rate)
        except RuntimeError as error:
            print(f"{name:28} {error}")
        else:
            print(measured.line(name, kernel), flush=True)


if __name__ == "__main__":
    raise SystemExit(main())
