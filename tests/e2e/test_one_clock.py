"""One clock: picture and sound go with the server's, behind a bad network, and after a page was away."""

from __future__ import annotations

import os
import signal
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.e2e.bad_network import BadNetwork, Weather, bad_network
from tests.e2e.listening import apart, hear, true_offset
from tests.e2e.opened import Opened
from tests.integration.scores import scale
from tests.integration.server import Owned, upload

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx
    from playwright.sync_api import Browser, ViewportSize
    from tests.integration.server import Running

pytestmark = pytest.mark.browser

SIZE = (200, 130)
"""Software GL draws so small a picture often enough."""
KEEPS_CONTEXTS = """
window.contexts = [];
window.AudioContext = class extends AudioContext {
  constructor(...options) { super(...options); window.contexts.push(this); }
};
"""
APART_S = 0.025
EARLY_S = 0.02
PAGES_APART_S = 0.03
CLOCK_S = 0.008
READINGS = 100
"""Pictures in a row that are judged."""
ROUNDS, LISTENINGS = 120, 20
"""How often it is looked and listened again where the machine had something else to do."""
IN_TIME = """(place) => window.reina.playing && window.reina.songTime > place
  && window.reina.sound === 'ready' && window.reina.soundLevel > 0.01
  && Math.abs(window.reina.soundAhead ?? 1) < 0.02
  && Math.abs(window.reina.songTime - window.reina.heard) < 0.25"""
"""Picture and sound go again; what is drawn on a busy machine may be a few pictures old."""


class Pair:
    """One session in two pages: one beside the server, one behind a bad network."""

    def __init__(self, owned: Owned, network: BadNetwork, near: Opened, far: Opened) -> None:
        self.owned = owned
        self.network = network
        self.near = near
        self.far = far

    def play(self, place_s: float) -> dict[str, Any]:
        """Play from a place on, until both pages do."""
        self.owned.control("seek", song_time_s=place_s)
        transport = self.owned.control("play")
        for one in (self.near, self.far):
            one.until(IN_TIME, place_s + 1.0)
        return transport


@pytest.fixture(scope="module")
def pair(browser: Browser, server: Running, client: httpx.Client) -> Iterator[Pair]:
    """Both pages, drawn and with their sound decoded."""
    owned = upload(client, scale(400, bpm=120.0))
    viewport: ViewportSize = {"width": SIZE[0], "height": SIZE[1]}
    with bad_network(server.address, Weather()) as network:
        contexts = [browser.new_context(viewport=viewport) for _ in range(2)]
        for context in contexts:
            context.add_init_script(KEEPS_CONTEXTS)
        near, far = (
            Opened(context.new_page(), address)
            for context, address in zip(contexts, (server.address, network.address), strict=True)
        )
        for one in (far, near):
            one.go(f"/s/{owned.id}")
        for one in (far, near):
            one.until_drawn()
            one.until("window.reina.soundHeld > 5")
        yield Pair(owned, network, near, far)
        for context in contexts:
            context.close()
    assert near.errors == []
    assert [error for error in far.errors if "WebSocket" not in error] == []


def kept_in_time(opened: Opened) -> bool:
    """Whether of the last pictures 95 % are near their sound, and none behind it by more than EARLY_S."""
    distances = apart(opened)[-READINGS:]
    near = np.count_nonzero(np.abs(distances) <= APART_S)
    early = bool(np.any(distances < -EARLY_S))
    return len(distances) == READINGS and int(near) >= 0.95 * READINGS and not early


@dataclass(frozen=True)
class HeardIn:
    """How late a page is heard, and how far its clock is off beyond what the question may be, seconds."""

    late_s: float
    clock_off_s: float


def heard_in(one: Opened, transport: dict[str, Any]) -> HeardIn:
    """Listen to a page, and ask it for the server's clock."""
    offset, unsure = true_offset(one)
    off = abs(one.measure("clockOffset") - offset) - unsure
    return HeardIn(float(np.median(hear(one).late_s(transport))), off)


def test_picture_and_sound_go_with_the_servers_clock_behind_a_bad_network(pair: Pair) -> None:
    transport = pair.play(2.0)
    assert pair.far.measure("ahead") >= 0.6, "frames are here as early as the network needs"
    for one in (pair.near, pair.far):
        for _ in range(ROUNDS):
            if kept_in_time(one):
                break
            one.page.wait_for_timeout(500)
        else:
            pytest.fail(f"picture less sound, ms: {np.round(1000 * apart(one)).tolist()}")
    heard: list[HeardIn] = []
    for _ in range(LISTENINGS):
        heard = [heard_in(one, transport) for one in (pair.near, pair.far)]
        near, far = (each.late_s for each in heard)
        clocks = all(each.clock_off_s < CLOCK_S for each in heard)
        if clocks and max(abs(near), abs(far)) < EARLY_S + CLOCK_S and abs(near - far) < PAGES_APART_S:
            break
    else:
        pytest.fail(f"near and far: {heard}")


def test_a_laptop_that_slept_connects_again_and_plays_on_where_the_others_are(
    browser: Browser, pair: Pair
) -> None:
    pair.play(10.0)
    process = renderer_of(browser, pair.far)
    os.kill(process, signal.SIGSTOP)
    try:
        pair.network.forget_connections()
        time.sleep(3.0)
    finally:
        os.kill(process, signal.SIGCONT)
    pair.far.until(IN_TIME, pair.near.measure("songTime"))
    offset, unsure = true_offset(pair.far)
    assert abs(pair.far.measure("clockOffset") - offset) < 3 * CLOCK_S + unsure


def test_a_tab_that_was_frozen_plays_on_where_the_others_are(pair: Pair) -> None:
    pair.play(20.0)
    lifecycle: Any = pair.near.page.context.new_cdp_session(pair.near.page)
    lifecycle.send("Page.setWebLifecycleState", {"state": "frozen"})
    time.sleep(3.0)
    lifecycle.send("Page.setWebLifecycleState", {"state": "active"})
    pair.near.until(IN_TIME, 23.0)


def test_a_sound_device_that_goes_or_changes_is_followed(pair: Pair) -> None:
    pair.play(30.0)
    page = pair.near.page
    for place, change in enumerate(
        (
            "navigator.mediaDevices.dispatchEvent(new Event('devicechange'))",
            "window.contexts.at(-1).suspend()",
            "window.contexts.at(-1).close()",
        )
    ):
        before = pair.near.measure("songTime")
        page.evaluate(f"() => {{ void {change}; }}")
        pair.near.until(IN_TIME, before + 0.5)
        states = page.evaluate("window.contexts.map((context) => context.state)")
        assert states[-1] == "running", f"{change}: {states}"
        assert len(states) == (2 if place == 2 else 1), (
            "another context where the one before is lost, and no sooner"
        )


def renderer_of(browser: Browser, opened: Opened) -> int:
    """The operating system's number of the process that runs a page: the one that a busy page keeps busy."""
    session: Any = browser.new_browser_cdp_session()

    def spent() -> dict[int, float]:
        processes = session.send("SystemInfo.getProcessInfo")["processInfo"]
        return {each["id"]: each["cpuTime"] for each in processes if each["type"] == "renderer"}

    before = spent()
    opened.page.evaluate("() => { const end = performance.now() + 400; while (performance.now() < end); }")
    after = spent()
    return max(after, key=lambda process: after[process] - before.get(process, after[process]))
