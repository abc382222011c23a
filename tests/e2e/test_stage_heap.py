"""The page keeps nothing of the frames it has drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Page
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

TINY = (240, 136)
"""Software GL draws a window of this size often enough to count frames."""

ROUNDS = 8
"""What is kept of every frame is kept in every round; what else a page does now and then is not."""

PICTURES_A_ROUND = 240
KEPT_BYTES_A_FRAME = 400
"""Of each frame that came by, drawn or passed over, as a slow machine must. One is 1.5 kB on the wire, more
as objects: who kept them would be far above."""


def heap_used(devtools: Any) -> int:
    """Bytes that are still held after the garbage is collected."""
    for _ in range(2):
        devtools.send("HeapProfiler.collectGarbage")
    return int(devtools.send("Runtime.getHeapUsage")["usedSize"])


def pictures(page: Page) -> int:
    """How many pictures were drawn since they were first counted."""
    return int(page.evaluate("window.pictures"))


def test_nothing_is_retained_per_frame(visit: Visit) -> None:
    opened = visit(size=TINY)
    opened.until_drawn()
    opened.page.keyboard.press("m")
    opened.page.keyboard.press("Space")
    opened.until("window.reina.playing")
    devtools: Any = opened.page.context.new_cdp_session(opened.page)
    opened.page.evaluate(
        """() => {
            window.pictures = 0;
            let last = reina.drawnIndex;
            setInterval(() => {
                if (reina.drawnIndex !== last) { last = reina.drawnIndex; window.pictures++; }
            }, 4);
        }"""
    )

    def draw(count: int) -> None:
        opened.until("(until) => window.pictures >= until", pictures(opened.page) + count)

    draw(PICTURES_A_ROUND)
    kept: list[float] = []
    for _ in range(ROUNDS):
        before, first = heap_used(devtools), opened.measure("drawnIndex")
        draw(PICTURES_A_ROUND)
        came_by = opened.measure("drawnIndex") - first
        assert came_by >= PICTURES_A_ROUND
        kept.append((heap_used(devtools) - before) / came_by)
        if kept[-1] < KEPT_BYTES_A_FRAME:
            break
    assert min(kept) < KEPT_BYTES_A_FRAME, f"bytes kept a frame, round by round: {kept}"
