"""Menus, double clicks and the search of the show's editor."""

from __future__ import annotations

import pytest
from tests.e2e.shows import COLOR, EXPOSURE, HAZE, ShowPage

pytestmark = pytest.mark.browser

BAR_S = 2.0


def test_menus_of_keyframes_rows_and_the_ruler_by_mouse_and_keyboard(show: ShowPage) -> None:
    page = show.page
    menu = page.get_by_role("menu")

    def choose(says: str) -> None:
        menu.get_by_text(says, exact=True).click()
        menu.wait_for(state="hidden")

    # A keyframe is chosen by it, and what the menu offers is done.
    page.mouse.click(*show.key(EXPOSURE, "k2"), button="right")
    assert show.measure("chosen") == [[EXPOSURE, "k2"]]
    choose("Copy")
    y = show.key(EXPOSURE, "k2")[1]
    page.mouse.click(show.ruler(3 * BAR_S)[0], y, button="right")
    choose("Paste here")
    assert sorted(show.times(EXPOSURE).values()) == [0, 1, 2, 3]
    page.mouse.click(show.ruler(5 * BAR_S)[0], y, button="right")
    choose("Choose all of this track")
    assert len(show.measure("chosen")) == 4
    page.mouse.click(*show.ruler(2.6 * BAR_S), button="right")
    choose("Loop this bar")
    show.opened.until("window.reina.show.looped.join() === '4,6'")
    page.mouse.click(*show.ruler(2.6 * BAR_S), button="right")
    choose("End the loop")
    show.opened.until("window.reina.show.looped.length === 0")

    # The same by keys: a list of its own opens and closes, letters lead, Escape goes back to where one was.
    page.get_by_role("treeitem", name="lights haze").focus()
    page.keyboard.press("Shift+F10")
    menu.get_by_text("Keyframe at the playhead").wait_for()
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Escape")
    show.opened.until("document.activeElement.ariaLabel === 'lights haze, 1 keyframe'")
    page.locator(".lanes").focus()
    page.mouse.click(*show.key(HAZE, "h1"))
    page.keyboard.press("Shift+F10")
    page.keyboard.press("h")
    page.keyboard.press("ArrowRight")
    menu.get_by_role("menuitemcheckbox", name="straight", exact=True).wait_for()
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("Enter")
    page.keyboard.press("b")
    show.opened.until("document.activeElement.dataset.says?.startsWith('b')")
    way = page.evaluate("document.activeElement.dataset.says")
    page.keyboard.press("Enter")
    assert show.keyframe(HAZE, "h1")["interpolation"].replace("_", " ") == way
    assert page.evaluate("document.activeElement.classList.contains('lanes')")


def test_double_clicks_insert_and_open_and_rows_are_found_by_words(show: ShowPage) -> None:
    page = show.page
    # Between 1.0 and 1.4, on the lane and then on the curve, with what the server has there.
    y = show.key(EXPOSURE, "k1")[1]
    page.mouse.dblclick(show.ruler(0.5 * BAR_S)[0], y)
    show.opened.until("window.reina.show.keyframes === 6")
    ((_, added),) = show.measure("chosen")
    assert show.keyframe(EXPOSURE, added)["time"] == 0.5
    assert show.keyframe(EXPOSURE, added)["value"] == pytest.approx(1.2, abs=1e-5)
    page.keyboard.press("v")
    show.opened.until("Number(document.querySelector('[data-curves]')?.dataset.curves) > 0")
    show.opened.until("window.reina.show.curvesSettled()")
    low, high = show.key(EXPOSURE, added), show.key(EXPOSURE, "k2")
    page.mouse.dblclick((low[0] + high[0]) / 2, (low[1] + high[1]) / 2)
    show.opened.until("window.reina.show.keyframes === 7")
    ((_, between),) = show.measure("chosen")
    assert show.keyframe(EXPOSURE, between)["value"] == pytest.approx(1.3, abs=1e-5)
    page.keyboard.press("v")

    # On a keyframe: its value, ready to be typed over.
    page.mouse.dblclick(*show.key(HAZE, "h1"))
    show.opened.until("document.activeElement.matches('[data-value] input')")
    page.keyboard.type("0.45")
    page.keyboard.press("Enter")
    assert show.keyframe(HAZE, "h1")["value"] == 0.45

    # Rows by words that people use; what is hidden is not chosen with all.
    page.locator(".lanes").focus()
    page.keyboard.press("Control+f")
    page.keyboard.type("fog")
    rows = page.get_by_role("treeitem")
    show.opened.until("document.querySelectorAll('[role=treeitem]').length === 2")
    assert rows.nth(1).get_attribute("aria-label") == "lights haze, 1 keyframe"
    page.keyboard.press("Enter")
    show.opened.until("document.activeElement.ariaLabel === 'lights haze, 1 keyframe'")
    page.keyboard.press("Control+a")
    assert show.measure("chosen") == [[HAZE, "h1"]]
    page.keyboard.press("Control+f")
    page.keyboard.press("Escape")
    page.get_by_role("treeitem", name="blocks colour").wait_for()
    assert show.times(COLOR) == {"c1": 0}
