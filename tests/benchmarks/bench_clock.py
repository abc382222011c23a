"""How far a page's clock, picture and sound are from the server's, beside it and behind a bad network.

python tests/benchmarks/bench_clock.py

The bad network delays by 150 ms ± 50 ms each way and loses 2 % of the packets; the drawing is software's,
so the distance of picture and sound is given as it is, and with what a picture took longer than 1/60 s
taken off.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import httpx
import numpy as np
from machine import machine
from playwright.sync_api import Browser, sync_playwright
from tests.e2e.bad_network import Weather, bad_network
from tests.e2e.conftest import BROWSER_ARGUMENTS, FIND_BROWSER
from tests.e2e.listening import apart, hear, true_offset
from tests.e2e.opened import Opened
from tests.integration.scores import scale
from tests.integration.server import serve, upload

PLAYED_S = 15.0


def measured(browser: Browser, name: str, address: str, client: httpx.Client) -> None:
    """Play for a while in one page, and print its figures."""
    owned = upload(client, scale(300, bpm=120.0))
    context = browser.new_context(viewport={"width": 200, "height": 130})
    opened = Opened(context.new_page(), address)
    opened.go(f"/s/{owned.id}")
    opened.until_drawn()
    opened.until("window.reina.soundHeld > 5")
    transport = owned.control("play")
    opened.until("window.reina.soundAhead !== null")
    clock: list[float] = []
    late: list[float] = []
    raw: list[float] = []
    taken_off: list[float] = []
    end = time.monotonic() + PLAYED_S
    while time.monotonic() < end:
        offset, _ = true_offset(opened)
        clock.append(abs(opened.measure("clockOffset") - offset))
        late.extend(hear(opened).late_s(transport))
        raw.extend(abs(reading[0]) for reading in opened.measure("sync")["recent"][-100:])
        taken_off.extend(apart(opened)[-100:])
    owned.control("pause")
    ms = 1000.0
    print(
        f"{name}: clock off by at most {max(clock) * ms:.1f} ms, at the end {clock[-1] * ms:.1f}; "
        f"heard late by {np.percentile(late, 5) * ms:.1f} to {np.percentile(late, 95) * ms:.1f} ms; "
        f"picture and sound apart p95 {np.percentile(raw, 95) * ms:.0f} ms as drawn, "
        f"{np.percentile(np.abs(taken_off), 95) * ms:.0f} ms but for the drawing; "
        f"sound early by over 20 ms in {np.mean(np.array(taken_off) < -0.02) * 100:.1f} % of the pictures; "
        f"pictures here for {opened.measure('ahead'):.1f} s to come"
    )
    context.close()


def main() -> None:
    """Both pages, one after the other."""
    print(machine())
    found = subprocess.run([sys.executable, str(FIND_BROWSER)], capture_output=True, text=True, check=True)
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder)) as server,
        bad_network(server.address, Weather()) as network,
        httpx.Client(base_url=server.address, timeout=30.0) as client,
        sync_playwright() as playwright,
    ):
        browser = playwright.chromium.launch(
            executable_path=found.stdout.strip(), args=list(BROWSER_ARGUMENTS), timeout=60_000
        )
        for name, address in (("beside the server", server.address), ("bad network", network.address)):
            measured(browser, name, address, client)
        browser.close()


if __name__ == "__main__":
    main()
