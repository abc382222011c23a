"""Looking around the stage, with a pointer and with keys, and giving the camera back to the show."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.e2e.conftest import SMALL

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

MAX_STOPS = 40
"""The Tab key has gone round the whole page after so many presses."""
GIVE_BACK = "Give the camera back to the show"
AWAY = """([x, y, z]) => {
  const [a, b, c] = window.reina.drawnFrom;
  return Math.hypot(a - x, b - y, c - z) > 0.1;
}"""
BACK = """([x, y, z]) => {
  const [a, b, c] = window.reina.drawnFrom;
  return Math.hypot(a - x, b - y, c - z) < 1e-6;
}"""


def stood(opened: Opened) -> NDArray[np.float64]:
    """Where the camera stood in the last picture, metres."""
    return np.asarray(opened.measure("drawnFrom"), np.float64)


def changed(before: NDArray[np.int16], after: NDArray[np.int16]) -> float:
    """The share of the stage's pixels, above the panels, that changed beyond what an eye would overlook."""
    stage = slice(SMALL[1] // 6, SMALL[1] * 2 // 3)
    return float((np.abs(after - before)[stage].max(axis=2) > 12).mean())


def test_pointer_and_keys_orbit_the_camera_and_the_show_gets_it_back(visit: Visit) -> None:
    opened = visit()
    opened.until_drawn()
    orbit_by_pointer(opened)
    orbit_by_keys(opened)


def orbit_by_pointer(opened: Opened) -> None:
    """Drag the stage, and give the camera back with its control."""
    page = opened.page
    before, where = opened.picture(), stood(opened)
    target = np.asarray(opened.parameter("camera/target"))
    np.testing.assert_allclose(where, opened.parameter("camera/position"), atol=1e-6)

    page.mouse.move(SMALL[0] / 2, SMALL[1] / 3)
    page.mouse.down()
    page.mouse.move(SMALL[0] / 2 + 90, SMALL[1] / 3 + 10, steps=3)
    page.mouse.up()
    opened.until(AWAY, where.tolist())
    distance = np.linalg.norm(where - target)
    assert np.linalg.norm(stood(opened) - target) == pytest.approx(distance, abs=1e-4), "it orbits"
    assert changed(before, opened.picture()) > 0.1

    page.get_by_role("button", name=GIVE_BACK).click()
    opened.until(BACK, where.tolist())
    page.get_by_role("button", name=GIVE_BACK).wait_for(state="detached")
    assert changed(before, opened.picture()) < 0.001, "the same picture as before"


def orbit_by_keys(opened: Opened) -> None:
    """Go to the stage with Tab and around it with arrows, give the camera back and leave with the pointer."""
    page = opened.page
    where, target = stood(opened), np.asarray(opened.parameter("camera/target"))
    for _ in range(MAX_STOPS):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.tagName") == "CANVAS":
            break
    assert page.evaluate("document.activeElement.tagName") == "CANVAS"

    def height_and_distance() -> tuple[float, float]:
        from_target = stood(opened) - target
        return float(from_target[1]), float(np.linalg.norm(from_target))

    height, distance = height_and_distance()
    page.keyboard.press("ArrowRight")
    opened.until(AWAY, where.tolist())
    assert height_and_distance() == pytest.approx((height, distance), abs=1e-4), "around, at the same height"
    page.keyboard.press("ArrowUp")
    opened.until("(height) => window.reina.drawnFrom[1] > height + 0.05", float(where[1]))
    assert height_and_distance()[1] == pytest.approx(distance, abs=1e-4)
    near = stood(opened)
    page.keyboard.press("+")
    opened.until(AWAY, near.tolist())
    assert height_and_distance()[1] == pytest.approx(0.92 * distance, rel=1e-3)
    assert opened.measure("songTime") == 0, "the arrows did not move the music"

    page.keyboard.press("?")
    page.get_by_text("Around the player to the right").wait_for()
    page.keyboard.press("Escape")
    page.keyboard.press("c")
    opened.until(BACK, where.tolist())
    page.mouse.click(SMALL[0] / 2, SMALL[1] / 3)
    page.keyboard.press("ArrowRight")
    opened.until("window.reina.songTime > 1.9")
