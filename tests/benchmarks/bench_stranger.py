"""What one stranger does to a viewer of another session, and to the server's memory.

Run as ``python tests/benchmarks/bench_stranger.py [all]``; ``--source`` measures another work tree's server,
and words on the command line choose lines by their names.

The viewer watches from a process of its own. A gap is the time between two frames' coming; what lies over
115 ms is seen to stand still. A frame is lost where the next one that came was not the next on the grid.
Memory is that of the server's process; what its workers take, which are bounded each, stands beside it.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING

import httpx
from machine import heading
from tests.integration.intake import (
    frame_times,
    large_score,
    large_show,
    memory_peak,
    now,
    unknown_fields,
    unknown_track,
)
from tests.integration.scores import scale, song
from tests.integration.server import Owned, serve, upload

if TYPE_CHECKING:
    from collections.abc import Callable

GAP_S = 0.06
"""The longest gap that is meant to be."""
IDLE_S = 5.0
REST_S = 1.0
JSON = {"Content-Type": "application/json"}
MEGABYTE = 1_000_000
ROUTES = (
    ("PATCH", ""),
    ("PUT", "/show"),
    ("POST", "/show/edits"),
    ("POST", "/transport"),
    ("PUT", "/cast"),
    ("POST", "/show/curves?start_s=0&end_s=1"),
)
NOBODY = "/api/v1/sessions/nobody"


class Stranger:
    """Does what strangers do; each method is a line of the table."""

    def __init__(self, client: httpx.Client, own: Owned, long: Owned) -> None:
        self._client = client
        self._own = own
        self._long = long

    def nothing(self) -> None:
        """Goes away."""
        time.sleep(IDLE_S)

    def lists_of_2_to_32_megabytes(self) -> None:
        """To every route that takes JSON, of a session and of none, without a token."""
        for megabytes in (2, 8, 32):
            for body in (b"[" + b"[]," * (megabytes * MEGABYTE // 3) + b"0]", _numbers(megabytes)):
                for method, below in ROUTES:
                    self._send(method, f"{NOBODY}{below}", body)
                self._send("PATCH", self._own.path, body)
                self._send("POST", "/api/v1/lab/forward", body)

    def lists_of_1_megabyte(self) -> None:
        """One after another, to a lab's route and to one that is not there."""
        body = _numbers(1)
        for _ in range(30):
            self._send("POST", "/api/v1/lab/forward", body)
            self._send("PATCH", NOBODY, body)

    def unknown_fields(self) -> None:
        """As many as fit, wherever fields are read; with a token of its own."""
        for count in (1_500, 80_000):
            body = unknown_fields(count)
            for method, below in (*ROUTES, ("PUT", "/show/tracks/camera/fov")):
                self._send(method, f"{self._own.path}{below}", body, own=True)
            self._send("POST", "/api/v1/lab/forward", body)

    def edits_of_unknown_fields(self) -> None:
        """Four megabytes of them in one batch."""
        body = b'[{"edit":"change_show","changes":' + unknown_fields(320_000) + b"}]"
        self._send("POST", f"{self._own.path}/show/edits", body, own=True)
        self._send("POST", f"{self._own.path}/show/edits", _numbers(3.9), own=True)

    def show_of_100_000_keys(self) -> None:
        """Its own."""
        self._put_show(large_show(100_000))

    def show_of_480_000_keys(self) -> None:
        """Its own, about the most that 20 MB hold."""
        self._put_show(large_show(480_000).replace(b", ", b",").replace(b": ", b":"))

    def unknown_track_of_19_megabytes(self) -> None:
        """Its own."""
        self._put_show(unknown_track(19 * MEGABYTE))

    def unknown_tracks_of_3_megabytes(self) -> None:
        """46 of them, each another step of the history."""
        for number in range(46):
            self._put_show(unknown_track(3 * MEGABYTE, number))

    def scores_of_249_000_notes(self) -> None:
        """Four at once."""
        score = large_score(249_000)
        files = {"score": ("s.json", score), "song": ("s.wav", song())}
        made = self._at_once(4, lambda _: self._client.post("/api/v1/sessions", files=files))
        for answer in made:
            if answer.is_success:
                Owned(self._client, answer.json()).change("DELETE")

    def reads_of_a_long_score(self) -> None:
        """Ten at once."""
        self._at_once(10, lambda _: self._client.get(f"{self._long.path}/score"))

    def rates_of_frames(self) -> None:
        """Forty at once."""
        self._at_once(
            40, lambda n: self._client.get(f"{self._long.path}/frames?start_s=0&end_s=1&fps={n + 61}")
        )

    def reads_of_time_and_curves(self) -> None:
        """Forty at once."""
        paths = "&".join(f"parameter=lights/{light}/intensity" for light in ("ambient", "key", "fill", "rim"))
        ways = ("time", f"show/curves?start_s=0&end_s=2000&points=2000&{paths}")
        self._at_once(40, lambda n: self._client.get(f"{self._long.path}/{ways[n % 2]}"))

    def clips_of_20_megabytes(self) -> None:
        """To the lab."""
        clip = _clip(19)
        self._at_once(2, lambda _: self._client.post("/api/v1/lab/bvh", content=clip))

    def everything_at_once(self) -> None:
        """All lines, each by a stranger of its own."""
        lines = [getattr(self, name) for name in LINES[1 : LINES.index("everything_at_once")]]
        with ThreadPoolExecutor(len(lines)) as threads:
            for done in [threads.submit(line) for line in lines]:
                done.result()

    def sessions_set_playing_175(self) -> None:
        """Of a score of 20,000 notes each, 0.9 MB, with nobody watching."""
        files = {"score": ("s.json", large_score(20_000)), "song": ("s.wav", song())}
        for _ in range(175):
            answer = self._client.post("/api/v1/sessions", files=files)
            if answer.is_success:
                made = Owned(self._client, answer.json())
                made.change("POST", "/transport", json={"action": "play"})

    def scores_of_an_hour_without_a_song_40(self) -> None:
        """And then an honest song of three minutes: the line takes as long as that waits."""
        for number in range(40):
            upload(self._client, scale(3590, beats=2.0, bpm=120 + number / 4))
        honest = upload(self._client, scale(180, beats=2.0))
        while self._client.get(f"{honest.path}/song/state").json()["status"] == "rendering":
            time.sleep(0.5)

    def sessions_308(self) -> None:
        """As many as one likes."""
        files = {"score": ("s.mid", scale(16)), "song": ("s.wav", song())}
        for _ in range(308):
            self._client.post("/api/v1/sessions", files=files)

    def _put_show(self, body: bytes) -> None:
        self._send("PUT", f"{self._own.path}/show", body, own=True)

    def _send(self, method: str, path: str, body: bytes, *, own: bool = False) -> None:
        headers = JSON | (self._own.headers if own else {})
        self._client.request(method, path, content=body, headers=headers)

    def _at_once(self, count: int, ask: Callable[[int], httpx.Response]) -> list[httpx.Response]:
        with ThreadPoolExecutor(count) as threads:
            return list(threads.map(ask, range(count)))


QUICK = ("nothing", "lists", "edits", "100_000", "reads_of_a_long")
"""What takes a minute or two together; all takes a quarter of an hour."""
LINES = [name for name in vars(Stranger) if not name.startswith("_")]


def main() -> int:
    """Measure and print; the status is 1 where a line is beyond its bounds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("lines", nargs="*", help="parts of lines' names, or `all`; the quick ones by default")
    parser.add_argument("--source", type=Path, default=None, help="the work tree of another server")
    options = parser.parse_args()
    words = [""] if options.lines == ["all"] else options.lines or QUICK
    chosen = [name for name in LINES if any(word in name for word in words)]
    print(heading(__file__))
    print(
        f"{'while a stranger sends or asks for':36} took, s  longest gap, ms  p99, ms  frames  lost  "
        "server, MB above  workers, MB  answers"
    )
    missed = 0
    for name in chosen:
        missed += _measure(name, options.source)
    return 1 if missed else 0


def _measure(name: str, source: Path | None) -> bool:
    """One line on a server of its own, so that it is charged with nothing of the others."""
    answers: dict[int, int] = {}

    def noted(answer: httpx.Response) -> None:
        answers[answer.status_code] = answers.get(answer.status_code, 0) + 1

    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder), "--no-page", source=source) as server,
        httpx.Client(
            base_url=server.address,
            timeout=900,
            event_hooks={"response": [noted]},
            limits=httpx.Limits(max_connections=200),
        ) as client,
    ):
        watched = upload(client, scale(600), song=("s.wav", song()))
        own = upload(client, scale(16), song=("s.wav", song()))
        long = own
        if any(word in name for word in ("long", "rates", "reads", "everything")):
            long = upload(client, large_score(249_000), "s.json", song=("s.wav", song()))
        watched.control("loop", start_s=0.0, end_s=140.0)
        stranger = Stranger(client, own, long)
        answers.clear()
        with frame_times(server, watched.id) as times:
            watched.control("play")
            time.sleep(1.0)
            answers.clear()
            with memory_peak(server) as memory:
                begin = now()
                getattr(stranger, name)()
                took = now() - begin
                time.sleep(REST_S)
            end = now()
    gaps = sorted(times.gaps_s(begin, end))
    longest, p99 = gaps[-1], gaps[int(len(gaps) * 0.99)]
    lost = times.lost(begin, end)
    most = 1000 if name == "everything_at_once" else 300
    above = memory.server_above / MEGABYTE
    told = " ".join(f"{count}×{status}" for status, count in sorted(answers.items()))
    print(
        f"{name.replace('_', ' '):36} {took:7.1f} {longest * 1e3:16.0f} {p99 * 1e3:8.0f} {len(gaps):7} "
        f"{lost:5} {above:17.0f} {memory.workers / MEGABYTE:12.0f}  {told}",
        flush=True,
    )
    return longest > GAP_S or lost > 0 or above > most


def _numbers(megabytes: float) -> bytes:
    return b"[" + b"1," * int(megabytes * MEGABYTE / 2) + b"1]"


def _clip(megabytes: int) -> bytes:
    """A motion file of one joint and very many frames."""
    row = b"0.000 1.000 0.000 10.00 20.00 30.00\n"
    frames = megabytes * MEGABYTE // len(row)
    head = (
        b"HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\n"
        b"CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
        b"End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\n"
    )
    return head + b"Frames: %d\nFrame Time: 0.01\n" % frames + row * frames


if __name__ == "__main__":
    raise SystemExit(main())
