"""The sound delay of headphones is set by hand, by a click and a flash, and remembered."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.e2e.opened import Opened

pytestmark = pytest.mark.browser


def test_the_delay_is_moved_by_keys_tried_by_ear_and_remembered(visit: Callable[..., Opened]) -> None:
    opened = visit(size=(900, 560))
    opened.until_drawn()
    opened.until("window.reina.soundHeld > 1")
    page = opened.page
    page.get_by_role("button", name="Sound delay of the headphones").click()
    panel = page.get_by_role("dialog", name="Sound delay of the headphones")
    slider = panel.get_by_role("slider")
    assert slider.evaluate("element => element === document.activeElement"), "the keyboard is on the slider"
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    panel.get_by_text("+10 ms").wait_for()
    page.keyboard.press("End")
    panel.get_by_text("+300 ms").wait_for()
    assert panel.get_by_role("button", name="5 ms more").is_disabled()
    page.keyboard.press("Home")
    panel.get_by_role("button", name="5 ms more").click()
    panel.get_by_text("-295 ms").wait_for()
    panel.get_by_role("button", name="Click and flash").click()
    opened.until("document.querySelector('.lamp.lit') !== null")
    opened.until("window.reina.soundLevel > 0.05")
    page.keyboard.press("Escape")
    panel.wait_for(state="hidden")
    # Nothing clicks behind a closed panel.
    opened.until("document.querySelector('.lamp') === null")
    page.reload()
    opened.until_drawn()
    page.get_by_role("button", name="Sound delay of the headphones").click()
    panel.get_by_text("-295 ms").wait_for()
    panel.get_by_role("button", name="Reset").click()
    panel.get_by_text("0 ms", exact=True).wait_for()
    assert page.evaluate("JSON.parse(localStorage.reina).latencies") == {"": 0}
