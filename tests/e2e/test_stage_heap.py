"""The page keeps nothing of the frames it has drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from playwright.sync_api import Page
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

TINY = (240, 136)
"""Software GL draws a window of this size often enough to count frames."""

ROUNDS = 8
"""What is kept of every frame is kept in every round; what else a page does now and then is not."""

PICTURES_A_ROUND = 240
STEP = 24
"""So many pictures come in time on any machine; all of a round may take a slow one minutes."""
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


def test_nothing_is_retained_per_frame(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=TINY)
    opened.until_drawn()
    # The music must not end before enough of it is drawn.
    path = f"/api/v1/sessions/{opened.session}"
    loop = {"action": "loop", "start_s": 0.0, "end_s": client.get(path).json()["duration_s"]}
    client.post(f"{path}/transport", json=loop, headers=opened.headers).raise_for_status()
    opened.page.keyboard.press("m")
    opened.page.keyboard.press("Space")
    opened.until("window.reina.playing")
    devtools: Any = opened.page.context.new_cdp_session(opened.page)
    opened.page.evaluate(
        """() => {
            window.pictures = window.cameBy = 0;
            let last = reina.drawnIndex;
            setInterval(() => {
                if (reina.drawnIndex === last) return;
                window.cameBy += Math.max(reina.drawnIndex - last, 1);
                window.pictures += 1;
                last = reina.drawnIndex;
            }, 4);
        }"""
    )

    def draw(count: int) -> None:
        goal = pictures(opened.page) + count
        while (drawn := pictures(opened.page)) < goal:
            opened.until("(until) => window.pictures >= until", min(drawn + STEP, goal))

    draw(PICTURES_A_ROUND)
    kept: list[float] = []
    for _ in range(ROUNDS):
        before, first = heap_used(devtools), opened.page.evaluate("window.cameBy")
        draw(PICTURES_A_ROUND)
        came_by = opened.page.evaluate("window.cameBy") - first
        assert came_by >= PICTURES_A_ROUND
        kept.append((heap_used(devtools) - before) / came_by)
        if kept[-1] < KEPT_BYTES_A_FRAME:
            break
    assert min(kept) < KEPT_BYTES_A_FRAME, f"bytes kept a frame, round by round: {kept}"
