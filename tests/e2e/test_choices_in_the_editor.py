"""What is chosen in the editor is one thing, seen in one place; cuts stay whole; what is sought is found."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from tests.e2e.shows import EXPOSURE, HAZE, ShowPage

if TYPE_CHECKING:
    from playwright.sync_api import Locator

pytestmark = pytest.mark.browser

BAR_S, BEAT_S = 2.0, 0.5
POSITION, TARGET, FOV = "camera/position", "camera/target", "camera/fov"


def notice(show: ShowPage) -> Locator:
    return show.page.locator(".notices .pane")


def test_delete_takes_what_is_chosen_says_so_and_offers_undo(show: ShowPage) -> None:
    page = show.page
    chosen = page.get_by_label("What is chosen")
    page.mouse.click(*show.key(EXPOSURE, "k2"))
    chosen.get_by_text("Chosen: a keyframe of stage exposure").wait_for()
    # The keyboard's focus on another track's row chooses nothing.
    page.get_by_role("treeitem", name="lights haze").focus()
    page.keyboard.press("Delete")
    assert show.times(EXPOSURE) == {"k1": 0, "k3": 2}
    assert show.times(HAZE) == {"h1": 1}
    notice(show).get_by_text("Keyframe removed: stage exposure").wait_for()
    notice(show).get_by_role("button", name="Undo").click()
    assert show.times(EXPOSURE) == {"k1": 0, "k2": 1, "k3": 2}
    assert notice(show).count() == 0

    # A track that is chosen as a whole takes the place of its and others' keyframes.
    page.mouse.click(*show.key(EXPOSURE, "k2"))
    page.get_by_role("treeitem", name="lights haze").click()
    chosen.get_by_text("Chosen: the whole track lights haze").wait_for()
    assert show.measure("chosen") == []
    page.keyboard.press("Delete")
    notice(show).get_by_text("Track removed: lights haze, 1 keyframe").wait_for()
    page.keyboard.press("Delete")
    show.until_saved()
    assert show.client.get(f"{show.path}/tracks/{HAZE}").status_code == 404
    assert show.times(EXPOSURE) == {"k1": 0, "k2": 1, "k3": 2}
    notice(show).get_by_role("button", name="Undo").click()
    assert show.times(HAZE) == {"h1": 1}

    # What was removed can be offered back only until the next step.
    page.mouse.click(*show.key(EXPOSURE, "k3"))
    page.keyboard.press("Delete")
    notice(show).wait_for()
    page.get_by_role("button", name="Marker here").click()
    notice(show).wait_for(state="detached")
    chosen.get_by_text("Chosen: the marker").wait_for()
    assert show.measure("chosen") == []


def shots(path: str, values: list[Any]) -> dict[str, Any]:
    """A track of two shots that move and one that holds; each ends a fiftieth of a bar before the cut."""
    times = (0, 1.98, 2, 3.98, 4)
    ways = ("step", "sine_in_out", "step", "sine_in_out", "step")
    keyframes = [
        {"key": f"k{number + 1}", "time": time, "value": value, "interpolation": way}
        for number, (time, value, way) in enumerate(zip(times, values, ways, strict=True))
    ]
    return {"edit": "put_track", "track": {"parameter": path, "keyframes": keyframes}}


def test_cuts_move_whole_and_shots_as_blocks(show: ShowPage) -> None:
    still = [
        {"key": f"k{number + 1}", "time": time, "value": 0.5, "interpolation": "step"}
        for number, time in enumerate((0, 2, 4))
    ]
    show.edit(
        shots(POSITION, [[0.2 * number, 1.4, 3] for number in range(5)]),
        shots(TARGET, [[0, 1.2, 0.01 * number] for number in range(5)]),
        {"edit": "put_track", "track": {"parameter": FOV, "keyframes": still}},
    )
    show.opened.until("window.reina.show.keyframes === 18 && window.reina.show.shot(2) !== null")
    beat = (show.ruler(8.0)[0] - show.ruler(0.0)[0]) / 8.0 * BEAT_S

    # The beginning of the second shot, a beat later; the end of the first and the other tracks come along.
    x, y = show.key(POSITION, "k3")
    show.drag((x + 3, y), (x + 3 + beat, y))
    moved = {"k1": 0, "k2": 2.23, "k3": 2.25, "k4": 3.98, "k5": 4}
    for path in (POSITION, TARGET):
        assert show.times(path) == pytest.approx(moved, abs=1e-5)
    assert show.times(FOV) == pytest.approx({"k1": 0, "k2": 2.25, "k3": 4})
    assert show.measure("chosen") == [[POSITION, "k3"]]

    # The second shot as a block: the first becomes longer for it, and the third begins later.
    point = show.page.evaluate("window.reina.show.shot(1)")
    show.drag((point["x"], point["y"]), (point["x"] + beat, point["y"]))
    moved = {"k1": 0, "k2": 2.48, "k3": 2.5, "k4": 4.23, "k5": 4.25}
    for path in (POSITION, TARGET):
        assert show.times(path) == pytest.approx(moved, abs=1e-5)
    assert show.times(FOV) == pytest.approx({"k1": 0, "k2": 2.5, "k3": 4.25})
    assert sorted(key for path, key in show.measure("chosen") if path == POSITION) == ["k3", "k4"]


def test_what_enter_takes_is_on_top_and_its_row_is_scrolled_to(show: ShowPage) -> None:
    page = show.page
    rows = page.get_by_role("tree", name="Tracks")
    for word, path, row in (
        ("zoom", "camera/fov", "camera angle of view"),
        ("blur", "camera/aperture", "camera aperture"),
        ("toon", "look/style", "look style"),
        ("rim intens", "lights/rim/intensity", "lights rim intensity"),
    ):
        page.get_by_role("button", name="Add a track").click()
        page.keyboard.type(word)
        top = page.locator("#free-parameters [role=option]").first
        assert top.get_attribute("aria-selected") == "true"
        page.keyboard.press("Enter")
        show.opened.until("(path) => window.reina.show.active === path", path)
        item = page.get_by_role("treeitem", name=row)
        item.wait_for()
        show.until_saved()
        within, box = rows.bounding_box(), item.bounding_box()
        assert within is not None
        assert box is not None
        assert within["y"] - 0.5 <= box["y"]
        assert box["y"] + box["height"] <= within["y"] + within["height"] + 0.5

    # What has a track already is gone to, not called unknown.
    page.get_by_role("button", name="Add a track").click()
    page.keyboard.type("zoom")
    page.locator("#free-parameters").get_by_text("has a track").wait_for()
    page.keyboard.press("Enter")
    page.get_by_label("What is chosen").get_by_text("Chosen: the whole track camera angle of view").wait_for()
