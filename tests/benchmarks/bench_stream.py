"""Reina's stream beside viser, a plain JSON stream and Nchan: what a frame and viewer costs, and its bytes.

Run as ``python tests/benchmarks/bench_stream.py``. Each sends 60 frames a second to the same viewers, who are
in C on another core (viewers.c), turn by turn, and the best turn of each figure counts. Reina evaluates a
player and keeps time meanwhile; viser is told 70 bones' orientations, the JSON stream is given frames, Nchan
bytes. All that the servers' processes use of the processor is divided by the frames that came.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from bench_viewers import FPS, FRAME_BYTES, HERE, Bench, Measured
from machine import PEERS, heading, peers_version, said, version
from nchan_server import PACKAGE, nginx
from table import SHORT, Row, tell, turns

if TYPE_CHECKING:
    from collections.abc import Callable

AREA = "Streaming 60 frames a second"
SECONDS, ROUNDS = (2.0, 3) if SHORT else (3.0, 3)
FEW, MANY = 20, (200,) if SHORT else (200, 500)


@dataclass(frozen=True)
class Server:
    """One of those who send.

    Attributes:
        name: What it is called.
        version: Empty where it is not installed.
        run: Has so many viewers watch it, who get so many frames in a message.
        notes: What is to be known of its figures.
        packs: Whether it sends packed blocks as well as frames.
    """

    name: str
    version: str
    run: Callable[[int, int], Measured]
    notes: str = ""
    packs: bool = False


def frame_us(measured: Measured, frames: int) -> float:
    """Processor time a frame and viewer, of messages of so many frames."""
    return measured.cpu_s * 1e6 / _frames(measured, frames)


def frame_bytes(measured: Measured, frames: int) -> float:
    """Bytes a frame and viewer; with them what is told in text meanwhile."""
    seen = measured.seen
    return seen["bytes"] / (seen["messages"] * frames) + seen["text_bytes"] / _frames(measured, frames)


def _frames(measured: Measured, frames: int) -> float:
    """How many frames came to all viewers together."""
    seen = measured.seen
    # Of what comes once a second a span may have one more or less than its length says.
    return seen["messages"] if frames == 1 else seen["viewers"] * seen["seconds"] * FPS


def interval_ms(measured: Measured, _: int) -> float:
    """Between two frames of a viewer, as they come, the 99th percentile."""
    return measured.seen["interval"]["p99"]


def compare(viewers: int, reina: Server, peers: list[Server]) -> None:
    """Measure everybody with so many viewers, turn by turn, and tell the rows."""
    asked = [(server, 1) for server in (reina, *peers) if server.version]
    asked += [(server, FPS) for server, _ in asked if server.packs]
    rounds = turns(ROUNDS, *(partial(server.run, viewers, frames) for server, frames in asked))
    found = {(server.name, frames): each for (server, frames), each in zip(asked, rounds, strict=True)}
    for way, frames in (("a frame a message", 1), ("packed blocks", FPS)):
        for peer in peers:
            of_peer = frames if peer.packs else 1
            own, theirs = found[reina.name, frames], found.get((peer.name, of_peer))
            figures: list[tuple[str, str, Callable[[Measured, int], float]]]
            figures = [("processor a frame and viewer", "µs", frame_us)]
            if not peer.packs:
                figures.append(("bytes a frame and viewer", "bytes", frame_bytes))
            if frames == 1:
                figures.append(("interval between frames, 99th percentile", "ms", interval_ms))
            for what, unit, figure in figures:
                tell(
                    Row(
                        AREA,
                        f"{what}: {viewers} viewers, {way}",
                        unit,
                        min(figure(each, frames) for each in own),
                        peer.name,
                        peer.version,
                        min(figure(each, of_peer) for each in theirs) if theirs else None,
                        notes=peer.notes if theirs else "not installed",
                    )
                )


def main() -> int:
    """Measure, and tell the rows."""
    print(heading(__file__))
    viser = peers_version("viser")
    packed_bytes: list[int] = []
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(Path(folder), SECONDS)

        def by_reina(viewers: int, frames: int) -> Measured:
            data = Path(tempfile.mkdtemp(dir=folder))
            measured = bench.reina(data, viewers, 1, 1, packed=frames > 1)
            if frames > 1:
                packed_bytes.append(measured.seen["bytes"] // measured.seen["messages"])
            return measured

        def by_viser(viewers: int, _: int) -> Measured:
            command = [str(PEERS), str(HERE / "viser_server.py")]
            return bench.program(command, viewers, subprotocol=f"viser-v{viser}")

        def by_json(viewers: int, _: int) -> Measured:
            return bench.program([sys.executable, str(HERE / "json_server.py")], viewers)

        def by_nchan(viewers: int, frames: int) -> Measured:
            size = FRAME_BYTES if frames == 1 else packed_bytes[-1]
            options = [f"--bytes={size}", f"--rate={FPS / frames}"]
            return bench.program([sys.executable, str(HERE / "nchan_server.py"), *options], viewers)

        reina = Server("Reina", version("reina"), by_reina, packs=True)
        of_json = Server(
            "JSON by FastAPI",
            version("fastapi"),
            by_json,
            "the same frame, evaluated beforehand; names, five places",
        )
        of_viser = Server("viser", viser, by_viser, "70 bones' orientations, flushed each frame")
        nchan = Server(
            "Nchan",
            said("dpkg-query", "-W", "-f", "${Version}", PACKAGE) if nginx() else "",
            by_nchan,
            "the same bytes as often, ready made; with its publisher",
            packs=True,
        )
        compare(FEW, reina, [of_viser, of_json])
        for viewers in MANY:
            compare(viewers, reina, [of_json, nchan])
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
