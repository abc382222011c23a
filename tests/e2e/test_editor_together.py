"""The show's editor with others: two browsers, an edit that came first, a server that is away; by touch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from tests.e2e.shows import COLOR, EXPOSURE, HAZE, ShowPage, made_session, open_show

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from playwright.sync_api import Route
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

BAR_S = 2.0
BESIDE = (740, 560)
"""A second window: the smaller, the sooner it is drawn."""


def nudge(show: ShowPage, path: str, key: str, press: str = "Shift+ArrowRight") -> None:
    """Choose a keyframe and move it with a key."""
    show.page.mouse.click(*show.key(path, key))
    show.page.keyboard.press(press)


def drawn_at(show: ShowPage, path: str, key: str, song_time_s: float) -> None:
    """Wait until a page draws a keyframe at a song time."""
    show.opened.until(
        "([path, key, time]) => { const { show } = window.reina; const at = show.key(path, key, 0);"
        " return at !== null && Math.abs(at.x - show.time(time).x) < 0.5; }",
        [path, key, song_time_s],
    )


def test_two_browsers_see_each_others_edits_and_who_watches_only_sees(
    show: ShowPage, visit: Visit, client: httpx.Client
) -> None:
    one, session = show, show.session
    other = open_show(visit, client, session, size=BESIDE)
    nudge(one, EXPOSURE, "k3")
    drawn_at(other, EXPOSURE, "k3", 3 * BAR_S)
    nudge(other, HAZE, "h1")
    drawn_at(one, HAZE, "h1", 2 * BAR_S)
    assert one.times(EXPOSURE)["k3"] == 3
    # The step back is the session's, whoever made the step.
    other.page.keyboard.press("Control+z")
    other.until_saved()
    other.page.keyboard.press("Control+z")
    drawn_at(one, EXPOSURE, "k3", 2 * BAR_S)
    other.opened.page.close()

    watching = open_show(visit, client, session, size=BESIDE, token=False)
    assert watching.page.get_by_text("You are watching: only whoever opened this session").is_visible()
    before = one.times(EXPOSURE)
    x, y = watching.key(EXPOSURE, "k2")
    watching.drag((x, y), (x + 60, y))
    watching.page.keyboard.press("Delete")
    watching.page.get_by_text("Only whoever opened this session can change its show.", exact=True).wait_for()
    assert watching.page.get_by_label("Value", exact=True).is_disabled()
    nudge(one, EXPOSURE, "k2", "ArrowRight")
    drawn_at(watching, EXPOSURE, "k2", 1.25 * BAR_S)
    assert one.times(EXPOSURE) == {**before, "k2": 1.25}


def test_nothing_is_lost_to_an_edit_that_came_first_or_to_a_server_that_is_away(
    show: ShowPage,
) -> None:

    # While the page's edit is on its way, somebody else's arrives.
    def overtaken(route: Route) -> None:
        show.edit({"edit": "change_keyframe", "parameter": EXPOSURE, "key": "k1", "changes": {"value": 3}})
        route.continue_()

    show.page.route("**/show/edits", overtaken, times=1)
    nudge(show, EXPOSURE, "k3")
    show.page.get_by_text("Somebody else edited the show").wait_for()
    assert show.times(EXPOSURE)["k3"] == 3
    assert show.keyframe(EXPOSURE, "k1")["value"] == 3

    # What was removed meanwhile cannot be moved: the page says so, and shows what there is.
    def removed(route: Route) -> None:
        show.edit({"edit": "remove_keyframe", "parameter": EXPOSURE, "key": "k3"})
        route.continue_()

    show.page.route("**/show/edits", removed, times=1)
    nudge(show, EXPOSURE, "k3")
    show.page.get_by_text("There is no such track or keyframe").wait_for()
    show.until_saved()
    assert show.measure("keyframes") == 4

    show.page.route("**/show/edits", lambda route: route.abort())
    nudge(show, HAZE, "h1")
    show.page.get_by_text("Could not save").wait_for()
    show.page.keyboard.press("Shift+ArrowRight")
    assert show.track(HAZE)["keyframes"][0]["time"] == 1
    show.page.unroute("**/show/edits")
    # It tries again by itself as well, and then the button is gone.
    show.page.evaluate("document.querySelector('[data-saving=failed] button')?.click()")
    assert show.times(HAZE) == {"h1": 3}


def test_fingers_drag_pan_and_zoom(visit: Visit, client: httpx.Client) -> None:
    show = open_show(visit, client, made_session(client), size=(390, 700))
    device: Any = show.page.context.new_cdp_session(show.page)
    device.send("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 2})

    def touch(kind: str, *points: tuple[float, float]) -> None:
        given: list[dict[str, Any]] = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(points)]
        device.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": given})

    x, y = show.key(EXPOSURE, "k2")
    pixels_a_second = show.ruler(1.0)[0] - show.ruler(0.0)[0]
    touch("touchStart", (x, y))
    for part in (0.5, 0.9, 1.0):
        touch("touchMove", (x + part * BAR_S * 3 * pixels_a_second, y))
    touch("touchEnd")
    assert show.times(EXPOSURE)["k2"] == 4

    # A finger that rests begins a box.
    below = show.key(COLOR, "c1")[1] + 25
    edge = show.ruler(9.0)[0]
    touch("touchStart", (edge, below))
    show.page.wait_for_selector(".lanes[data-boxing=true]")
    touch("touchMove", (edge - 20, below - 60))
    touch("touchMove", (show.ruler(0.5)[0], show.key(EXPOSURE, "k2")[1] - 12))
    touch("touchEnd")
    assert sorted(show.measure("chosen")) == [[HAZE, "h1"], [EXPOSURE, "k2"], [EXPOSURE, "k3"]]

    # One that rests on a keyframe and is lifted asks for its menu.
    menu = show.page.get_by_role("menu")
    touch("touchStart", show.key(EXPOSURE, "k1"))
    show.page.wait_for_selector(".lanes[data-rested=true]")
    touch("touchEnd")
    menu.get_by_text("Remove", exact=True).wait_for()
    assert show.measure("chosen") == [[EXPOSURE, "k1"]]
    touch("touchStart", (edge, below))
    touch("touchEnd")
    menu.wait_for(state="hidden")

    # A finger along the bar numbers draws a loop, and a tap on it ends it.
    loop = "(time) => window.reina.show.loop(time)"
    (x0, y0), (x1, y1) = [tuple(show.page.evaluate(loop, time).values()) for time in (4.3, 9.6)]
    touch("touchStart", (x0, y0))
    touch("touchMove", ((x0 + x1) / 2, y1))
    touch("touchMove", (x1, y1))
    touch("touchEnd")
    show.opened.until("window.reina.show.looped.join() === '4,10'")
    touch("touchStart", ((x0 + x1) / 2, y1))
    touch("touchEnd")
    show.opened.until("window.reina.show.looped.length === 0")

    begin, end = show.measure("window")
    middle = (show.ruler(begin)[0] + show.ruler(end)[0]) / 2
    held = (begin + end) / 2
    touch("touchStart", (middle - 40, y + 40), (middle + 40, y + 40))
    touch("touchMove", (middle - 80, y + 40), (middle + 80, y + 40))
    touch("touchEnd")
    show.opened.until(
        "(span) => window.reina.show.window[1] - window.reina.show.window[0] < 0.6 * span", end - begin
    )
    assert sum(show.measure("window")) / 2 == pytest.approx(held, abs=0.1)

    before = show.measure("window")[0]
    touch("touchStart", (middle + 60, y + 45))
    touch("touchMove", (middle, y + 45))
    touch("touchMove", (middle - 60, y + 45))
    touch("touchEnd")
    assert show.measure("window")[0] > before
    assert show.times(EXPOSURE)["k2"] == 4
