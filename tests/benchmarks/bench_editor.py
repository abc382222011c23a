"""What the show's editor costs a frame while keys are dragged, in a show of 200 tracks of 500 keys.

Run as ``python tests/benchmarks/bench_editor.py`` after ``make setup``. Chromium's own trace says how long
scripts ran on the page's main thread, everything counted: the pointer's events, the page's loop, garbage
collection.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import numpy as np
from machine import ROOT, heading, verdict
from playwright.sync_api import sync_playwright
from tests.e2e.conftest import BROWSER_ARGUMENTS, storing
from tests.e2e.opened import Opened
from tests.e2e.shows import ROOM_MADE
from tests.integration.scores import scale
from tests.integration.server import Running, serve

if TYPE_CHECKING:
    from numpy.typing import NDArray

TRACKS, KEYS = 200, 500
MOVES = 90
BOUND_MS = 8.0
SCRIPT = frozenset(
    (
        "EventDispatch",
        "FireAnimationFrame",
        "RunMicrotasks",
        "FunctionCall",
        "TimerFire",
        "MinorGC",
        "MajorGC",
    )
)


def show(parameters: list[dict[str, Any]]) -> dict[str, Any]:
    """200 tracks: all numbers that there are, the rest of parameters that nobody knows, which are kept."""
    known = [parameter["path"] for parameter in parameters if parameter["type"] == "number"]
    paths = [*known, *(f"bench/track_{number}" for number in range(TRACKS - len(known)))]
    defaults = {parameter["path"]: parameter["default"] for parameter in parameters}
    keyframes = [
        {"key": f"k{number}", "time": number * 0.25, "interpolation": "linear"} for number in range(KEYS)
    ]
    tracks = [
        {
            "parameter": path,
            "keyframes": [{**keyframe, "value": defaults.get(path, 0.0)} for keyframe in keyframes],
        }
        for path in paths[:TRACKS]
    ]
    return {"version": 1, "title": "Large", "time": "beats", "tracks": tracks}


def script_ms(trace: dict[str, Any]) -> NDArray[np.float64]:
    """Script time of each frame, from one of the page's animation frames to the next.

    It is the thread's own time, so that other programs do not count; of nested events the outer one.
    """
    frames = [event for event in trace["traceEvents"] if event["name"] == "FireAnimationFrame"]
    thread = (frames[0]["pid"], frames[0]["tid"])
    events: list[tuple[float, float, float]] = sorted(
        (event["ts"], event["ts"] + event.get("dur", 0), event["tdur"])
        for event in trace["traceEvents"]
        if event["name"] in SCRIPT and "tdur" in event and (event["pid"], event["tid"]) == thread
    )
    starts = np.array(sorted(event["ts"] for event in frames))
    spent = np.zeros(starts.size)
    done = 0.0
    for begin, end, thread_time in events:
        if begin < done:
            continue
        frame = max(int(np.searchsorted(starts, begin, "right")) - 1, 0)
        spent[frame] += thread_time
        done = end
    return spent / 1000.0


def dragged(opened: Opened, *, all_keys: bool) -> NDArray[np.float64]:
    """Drag keyframes to and fro; script time of each frame, milliseconds."""
    page = opened.page
    point = page.evaluate("window.reina.show.key(...['camera/fov', 'k40', 0])")
    page.mouse.click(point["x"], point["y"])
    if all_keys:
        page.keyboard.press("Control+a")
    browser = page.context.browser
    assert browser is not None
    page.mouse.move(point["x"], point["y"])
    page.mouse.down()
    browser.start_tracing(page=page, categories=["devtools.timeline", "v8"])
    for number in range(MOVES):
        page.mouse.move(point["x"] + 60 * np.sin(number / 12), point["y"])
    trace = json.loads(browser.stop_tracing())
    page.keyboard.press("Escape")
    page.mouse.up()
    return script_ms(trace)


def measured(server: Running) -> bool:
    """Print the figures; returns whether they keep to their bound."""
    with httpx.Client(base_url=server.address, timeout=60.0) as client:
        made = (
            client.post("/api/v1/sessions", files={"score": ("scale.mid", scale(260))})
            .raise_for_status()
            .json()
        )
        parameters = client.get("/api/v1/parameters").json()["parameters"]
        token = {"Authorization": f"Bearer {made['control_token']}"}
        client.put(
            f"/api/v1/sessions/{made['id']}/show", json=show(parameters), headers=token
        ).raise_for_status()
    found = subprocess.run(
        [sys.executable, str(ROOT / "tests/e2e/find_browser.py")], capture_output=True, text=True, check=True
    )
    kept = True
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=found.stdout.strip(), args=list(BROWSER_ARGUMENTS)
        )
        context = browser.new_context(viewport={"width": 1440, "height": 900})
        remembers = {"tokens": {made["id"]: made["control_token"]}, "hasPlayed": True, "editorHeight": 640}
        context.add_init_script(storing(remembers))
        opened = Opened(context.new_page(), server.address)
        opened.go(f"/s/{made['id']}")
        opened.until_drawn()
        opened.page.keyboard.press("s")
        opened.until(f"window.reina.show?.keyframes === {TRACKS * KEYS}")
        opened.until(ROOM_MADE)
        for all_keys in (False, True):
            frames = dragged(opened, all_keys=all_keys)
            chosen = opened.page.evaluate("window.reina.show.chosen.length")
            what = f"script a frame, dragging {chosen} of {TRACKS * KEYS} keys"
            p95 = float(np.percentile(frames, 95))
            middle, most = np.median(frames), frames.max()
            print(f"{what}: {frames.size} frames, median {middle:.2f} ms, longest {most:.2f} ms")
            print(verdict("its 95th percentile", p95, BOUND_MS, "ms"))
            kept &= p95 <= BOUND_MS
        browser.close()
    return kept


def main() -> int:
    """Start a server, measure, stop it."""
    print(heading(__file__))
    with tempfile.TemporaryDirectory() as folder, serve(Path(folder)) as server:
        return 0 if measured(server) else 1


if __name__ == "__main__":
    raise SystemExit(main())
