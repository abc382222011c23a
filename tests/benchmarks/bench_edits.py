"""Milliseconds for edits of a large show over REST: 200 tracks of 500 keys.

Run as ``python tests/benchmarks/bench_edits.py``. The server runs within this process, without a socket, on
the player's own stage with as many parameters more as the show needs; every figure is from the request to the
whole answer, when the edit is in the viewers' frames and on disk.
"""

from __future__ import annotations

import asyncio
import dataclasses
import json
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

import httpx
import numpy as np
from machine import ROOT, heading, verdict
from tests.integration.scores import scale, song

from reina.api.app import create_app
from reina.api.settings import Settings
from reina.curves import Parameter
from reina.curves.interpolation import interpolations
from reina.sessions.stage import Stage

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from reina.curves.value_types import TypeName, Value

TRACKS, KEYS, MOVED = 200, 500, 100
SPAN_S = 240.0
BOUND_MS = 150.0
ROUNDS = 9
DEFAULTS: dict[TypeName, Value] = {
    "number": 0.0,
    "vector": (0, 0, 0),
    "color": "#000000",
    "orientation": (0, 0, 0, 1),
}


def parameters() -> list[Parameter]:
    """Numbers for the most part, as in a show, and the other kinds between them."""
    kinds: tuple[TypeName, ...] = ("number", "number", "vector", "number", "color", "number", "orientation")
    return [
        Parameter(f"bench/{number}", kinds[number % len(kinds)], DEFAULTS[kinds[number % len(kinds)]])
        for number in range(TRACKS)
    ]


def document() -> dict[str, Any]:
    """A show of keys at random times, with interpolations of every name."""
    random = np.random.default_rng(1)
    names = list(interpolations())
    tracks: list[dict[str, Any]] = []
    for parameter in parameters():
        keyframes: list[dict[str, Any]] = []
        milliseconds = np.sort(random.choice(int(SPAN_S * 1000), KEYS, replace=False))
        for number, at in enumerate((milliseconds / 1000).tolist(), start=1):
            floats = random.uniform(0.0, 1.0, parameter.length).round(4)
            if parameter.type == "orientation":
                floats = (floats - 0.5) / np.linalg.norm(floats - 0.5)
            value = float(floats[0]) if parameter.length == 1 else floats.tolist()
            name = str(random.choice(names))
            keyframes.append({"key": f"k{number}", "time": at, "value": value, "interpolation": name})
        tracks.append({"parameter": parameter.path, "keyframes": keyframes})
    return {"version": 1, "tracks": tracks}


async def spent_ms(request: Callable[[], Awaitable[httpx.Response]]) -> tuple[float, httpx.Response]:
    """A request's time, and its answer."""
    begun = time.perf_counter()
    answer = await request()
    passed = (time.perf_counter() - begun) * 1e3
    assert answer.is_success, answer.text[:500]
    return passed, answer


def moves(tracks: list[dict[str, Any]], by: float) -> list[dict[str, Any]]:
    """Move 100 keys, as many of each of these tracks, by a little that meets no other."""
    each = MOVED // len(tracks)
    return [
        {
            "edit": "change_keyframe",
            "parameter": track["parameter"],
            "key": key["key"],
            "changes": {"time": key["time"] + by},
        }
        for track in tracks
        for key in track["keyframes"][100 : 100 + each]
    ]


async def measure(folder: Path) -> bool:
    """Print the figures; whether the bounds are met."""
    stage = Stage.load(ROOT / "rigs")
    stage = dataclasses.replace(stage, parameters=(*stage.parameters, *parameters()))
    app = create_app(Settings(data_dir=folder), stage=stage)
    transport = httpx.ASGITransport(app)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=transport, base_url="http://localhost", timeout=120) as client,
    ):
        show = document()
        files = {"score": ("scale.mid", scale()), "song": ("song.wav", song())}
        made = (await client.post("/api/v1/sessions", files=files)).raise_for_status().json()
        url = f"/api/v1/sessions/{made['id']}/show"
        client.headers["Authorization"] = f"Bearer {made['control_token']}"
        text = json.dumps(show)
        print(f"{TRACKS} tracks of {KEYS} keys, {len(text) / 1e6:.1f} MB; median of {ROUNDS}, milliseconds")
        print(f"{'PUT the show':44} {(await spent_ms(lambda: client.put(url, content=text)))[0]:9.2f} ms")
        reads = [(await spent_ms(lambda: client.get(url)))[0] for _ in range(ROUNDS)]
        print(f"{'GET the show':44} {median(reads):9.2f} ms")
        met = True
        for count in (1, 10, 100):
            for minimal in (False, True):
                headers = {"Prefer": "return=minimal"} if minimal else {}
                times: list[float] = []
                told = 0
                for number in range(1, ROUNDS + 1):
                    edits = moves(show["tracks"][:count], 1e-6 * number)
                    passed, answer = await spent_ms(
                        lambda edits=edits, headers=headers: client.post(
                            f"{url}/edits", json=edits, headers=headers
                        )
                    )
                    times.append(passed)
                    told = len(answer.content)
                what = f"move {MOVED} keys of {count} tracks{', told briefly' if minimal else ''}"
                print(verdict(what, median(times), BOUND_MS, "ms").ljust(76), f"{told / 1e3:.0f} kB")
                met &= median(times) <= BOUND_MS or not (minimal or count < 100)
        count = TRACKS // 2
        undone = [(await spent_ms(lambda: client.post(f"{url}/undo")))[0] for _ in range(ROUNDS)]
        print(verdict(f"undo moves of {count} tracks", median(undone), BOUND_MS, "ms"))
        curve = {"parameter": "bench/0", "start_s": 0, "end_s": SPAN_S, "points": 1000}
        drawn = [
            (await spent_ms(lambda: client.get(f"{url}/curves", params=curve)))[0] for _ in range(ROUNDS)
        ]
        print(f"{'a curve of 1,000 points':44} {median(drawn):9.2f} ms")
        preview = {"track": show["tracks"][0]}
        span = {name: value for name, value in curve.items() if name != "parameter"}
        drawn = [
            (await spent_ms(lambda: client.post(f"{url}/curves", json=preview, params=span)))[0]
            for _ in range(ROUNDS)
        ]
        print(f"{'the same of a track that is sent':44} {median(drawn):9.2f} ms")
    return met


def main() -> int:
    """Measure; the status is 1 when a bound is missed."""
    print(heading(__file__))
    with tempfile.TemporaryDirectory() as folder:
        return 0 if asyncio.run(measure(Path(folder))) else 1


if __name__ == "__main__":
    raise SystemExit(main())
