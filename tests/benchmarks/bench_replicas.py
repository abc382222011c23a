"""Several servers behind nginx, as deploy/replicas.conf has them, on a real PostgreSQL and a real Redis.

Run as ``python tests/benchmarks/bench_replicas.py``. Three tables: viewers who fetch a packed block a second
through nginx's cache, viewers whom the stream brings one, and a server that is killed while 200 watch. What
nginx and the servers use of the processor is of all their processes; the viewers are in C (viewers.c) and on
the same cores, so that more servers than cores show what several cost, and not what they give.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
from bench_viewers import OPEN, SETTLE_S, Bench, cpu_seconds
from machine import heading
from tests.integration.replicas import Fan, all_have, control, replicas
from tests.integration.scores import scale, song
from tests.integration.server import upload
from tests.servers.postgresql import postgresql
from tests.servers.proxies import replicas_proxy

from reina.protocol import SUBPROTOCOL

if TYPE_CHECKING:
    from collections.abc import Generator

    from tests.integration.replicas import Replicas
    from tests.integration.server import Owned
    from tests.servers.proxies import Proxy

FILES = 20_000
BLOCKS = 60
KILLED_VIEWERS = 200


@dataclass
class House:
    """Servers behind nginx, and a session that plays on them."""

    made: Replicas
    through: Proxy
    owned: Owned

    @property
    def port(self) -> int:
        """Where nginx listens."""
        return int(self.through.address.rpartition(":")[2])

    @property
    def streams(self) -> str:
        """The address of the session's WebSocket, at nginx."""
        return f"{self.through.address.replace('http', 'ws', 1)}{self.owned.path}/stream"

    def used_s(self) -> tuple[float, float]:
        """Processor time of nginx, and of all servers together."""
        main = int((self.through.folder / "pid").read_text())
        children = Path(f"/proc/{main}/task/{main}/children").read_text().split()
        nginx = sum(cpu_seconds(int(each)) for each in (main, *children))
        return nginx, sum(cpu_seconds(server.process.pid) for server in self.made.servers)


@contextmanager
def house(count: int, *, origin: str) -> Generator[House]:
    """Start so many servers, and a session on them.

    Args:
        count: How many.
        origin: Where pages fetch blocks; empty: the stream has them.
    """
    settings: dict[str, Any] = {**OPEN, "REINA_BLOCKS_ORIGIN": origin}
    with tempfile.TemporaryDirectory() as folder, postgresql() as database:
        # nginx's workers are another user's.
        Path(folder).chmod(0o755)
        with replicas(Path(folder), database, count, settings=settings) as made:
            ports = [int(server.address.rpartition(":")[2]) for server in made.servers]
            with (
                replicas_proxy(ports, Path(folder), files=FILES) as through,
                httpx.Client(base_url=through.address, timeout=60) as client,
            ):
                owned = upload(client, scale(600), song=("s.wav", song()), in_time="true")
                owned.control("play")
                yield House(made, through, owned)


def run_viewers(house: House, command: list[str]) -> tuple[dict[str, Any], float, float]:
    """What the viewers saw, and the processor time of nginx and of the servers meanwhile."""
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as viewers:
        assert viewers.stdout is not None
        for word in ("joined\n", "measuring\n"):
            said = viewers.stdout.readline()
            if said != word:
                raise RuntimeError(f"the viewers said {said!r}")
        before = house.used_s()
        seen = json.loads(viewers.stdout.readline())
        after = house.used_s()
    return seen, after[0] - before[0], after[1] - before[1]


def fetching(program: str, counts: list[int], viewers: list[int], seconds: float) -> int:
    """Viewers who fetch; returns how many answers were none."""
    print(f"\nfetched through nginx's cache, {seconds:g} s each")
    print("servers  viewers  answers/s   p50      p99      max ms   nginx        servers     kB/s a viewer")
    wrong = 0
    for count in counts:
        with house(count, origin="self") as made:
            href = blocks_path(made)
            for number in viewers:
                numbers = [str(made.port), str(number), str(seconds), "2", str(BLOCKS), href]
                seen, nginx, servers = run_viewers(made, [program, "fetch", "127.0.0.1", *numbers])
                rate, lasted = seen["answers"] / seen["seconds"], seen["lasted"]
                wrong += seen["other"]
                size = seen["bytes"] / number / seen["seconds"] / 1e3
                notes = [f"  {seen['behind']} were behind"] if seen["behind"] else []
                notes += [f"  {seen['other']} WERE REFUSED"] if seen["other"] else []
                print(
                    f"{count:7} {number:8} {rate:10.0f} "
                    f"{lasted['p50']:7.2f} {lasted['p99']:8.2f} {lasted['max']:8.1f}   "
                    f"{nginx / seen['seconds']:4.0%} {nginx * 1e6 / seen['answers']:5.1f} µs "
                    f"{servers / seen['seconds']:5.0%}       {size:6.2f}",
                    *notes,
                    flush=True,
                )
    return wrong


def streaming(program: str, counts: list[int], viewers: list[int], seconds: float) -> None:
    """Viewers who have packed blocks of the stream."""
    print(f"\nby the stream, a packed block a second, {seconds:g} s each")
    print("servers  viewers  messages/s  nginx              servers            lost  closed")
    for count in counts:
        with house(count, origin="") as made:
            path = f"{made.owned.path}/stream?packed=1&notes=0"
            for number in viewers:
                numbers = [str(made.port), str(number), str(seconds), str(SETTLE_S), "0", "0"]
                command = [program, "watch", "127.0.0.1", *numbers, SUBPROTOCOL, path]
                seen, nginx, servers = run_viewers(made, command)
                messages = max(seen["messages"], 1)
                print(
                    f"{count:7} {number:8} {messages / seen['seconds']:10.0f} "
                    f"{nginx / seen['seconds']:5.0%} {nginx * 1e6 / messages:7.1f} µs "
                    f"{servers / seen['seconds']:7.0%} {servers * 1e6 / messages:7.1f} µs "
                    f"{seen['lost']:7} {seen['closed']:7}",
                    flush=True,
                )


def killing() -> None:
    """A server is killed while many watch: how long it takes until all have frames again."""
    with house(2, origin="") as made:
        address = (
            f"{made.through.address.replace('http', 'ws', 1)}{made.owned.path}/stream?frames_per_message=12"
        )

        async def scenario() -> None:
            fans = [Fan(address) for _ in range(KILLED_VIEWERS)]
            watching = [asyncio.create_task(fan.watch()) for fan in fans]
            await all_have(fans, lambda fan: len(fan.offsets_s) >= 3)
            made.made.servers[0].process.kill()
            killed_s, song_time_s = time.monotonic(), max(fan.song_time_s for fan in fans)
            await all_have(fans, lambda fan: fan.song_time_s > song_time_s)
            gone_s = time.monotonic() - killed_s
            jump_s = max(abs(offset - fans[0].offsets_s[0]) for fan in fans for offset in fan.offsets_s)
            moved = sum(fan.connections > 1 for fan in fans)
            await control(made.owned, "pause")
            for task in watching:
                task.cancel()
            await asyncio.wait(watching)
            print(
                f"\none of two servers is killed while {KILLED_VIEWERS} watch: {moved} go to the other; all "
                f"have frames again after {gone_s:.2f} s; nobody's song moves by over {jump_s * 60:.3f} frame"
            )

        asyncio.run(scenario())


def blocks_path(house: House) -> str:
    """Where the session's packed blocks are."""
    from websockets.sync.client import connect

    with connect(f"{house.streams}?packed=1", subprotocols=[SUBPROTOCOL]) as socket:  # type: ignore[list-item]
        hello = json.loads(socket.recv())
    path: str = hello["blocks"]["href"]
    return path


def main() -> int:
    """Measure and print; the status is 1 when a block was refused."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--servers", type=int, nargs="+", default=[1, 2, 4])
    parser.add_argument("--fetching", type=int, nargs="+", default=[100, 1000, 3000, 10_000])
    parser.add_argument("--streaming", type=int, nargs="+", default=[100, 1000, 2000])
    parser.add_argument("--seconds", type=float, default=5.0)
    options = parser.parse_args()
    print(heading(__file__))
    with tempfile.TemporaryDirectory() as folder:
        program = Bench(Path(folder), options.seconds).viewers_program
        wrong = fetching(program, options.servers, options.fetching, options.seconds)
        streaming(program, options.servers, options.streaming, options.seconds)
    killing()
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
