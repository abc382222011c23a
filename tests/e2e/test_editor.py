"""The show's editor by mouse and keyboard: what the page does to the show, as the server has it."""

from __future__ import annotations

from typing import Any

import pytest
from tests.e2e.shows import COLOR, EXPOSURE, HAZE, ShowPage

pytestmark = pytest.mark.browser

BAR_S, BEAT_S = 2.0, 0.5


def test_the_mouse_chooses_moves_stretches_and_removes_and_undo_walks_back(show: ShowPage) -> None:
    first, steps = show.times(EXPOSURE), show.measure("undoSteps")
    pixels_a_second = (show.ruler(8.0)[0] - show.ruler(0.0)[0]) / 8.0

    # A keyframe is drawn to the beat that it comes near.
    x, y = show.key(EXPOSURE, "k2")
    show.drag((x, y), (x + (BEAT_S - 0.04) * pixels_a_second, y))
    assert show.times(EXPOSURE) == {**first, "k2": 1.25}
    assert show.measure("chosen") == [[EXPOSURE, "k2"]]

    # A box takes keyframes of several tracks; a drag takes them all along.
    box_end = show.key(COLOR, "c1")
    show.drag((show.ruler(1.5)[0], y - 9), (show.ruler(5.5)[0], box_end[1] + 9))
    assert sorted(show.measure("chosen")) == sorted([[EXPOSURE, "k2"], [EXPOSURE, "k3"], [HAZE, "h1"]])
    x, y = show.key(HAZE, "h1")
    show.drag((x, y), (x + 2 * BAR_S * pixels_a_second, y))
    assert show.times(EXPOSURE) == {"k1": 0, "k2": 3.25, "k3": 4}
    assert show.times(HAZE) == {"h1": 3}

    # The bar over the rows stretches them about its other end.
    _, (end) = show.page.evaluate("window.reina.show.grips()")
    show.drag((end["x"], end["y"]), (show.ruler(5 * BAR_S)[0], end["y"]))
    assert show.times(EXPOSURE) == {"k1": 0, "k2": 3.5, "k3": 5}
    assert show.times(HAZE) == {"h1": 3}

    show.page.keyboard.press("Delete")
    assert show.times(EXPOSURE) == {"k1": 0}
    assert show.client.get(f"{show.path}/tracks/{HAZE}").status_code == 404
    for _ in range(4):
        show.page.locator("button[title='Undo (Ctrl Z)']").click()
    assert show.times(EXPOSURE) == first
    assert show.times(HAZE) == {"h1": 1}
    assert show.measure("undoSteps") == steps
    show.page.keyboard.press("Control+Shift+z")
    assert show.times(EXPOSURE)["k2"] == 1.25


def test_the_ruler_seeks_and_the_wheel_zooms_at_the_pointer_and_pans(show: ShowPage) -> None:
    page = show.page
    show.drag(show.ruler(1.0), show.ruler(5.95))
    # Drawn to the bar line that it came near.
    show.opened.until("Math.abs(window.reina.songTime - 6) < 0.02")
    x, y = show.ruler(6.0)
    begin, end = show.measure("window")
    page.mouse.move(x, y + 120)
    page.keyboard.down("Control")
    page.mouse.wheel(0, -300)
    page.keyboard.up("Control")
    nearer = "(span) => { const [from, to] = window.reina.show.window; return to - from < 0.5 * span; }"
    show.opened.until(nearer, end - begin)
    assert show.ruler(6.0)[0] == pytest.approx(x, abs=0.5)
    before = show.measure("window")[0]
    page.keyboard.down("Shift")
    page.mouse.wheel(0, 80)
    page.keyboard.up("Shift")
    show.opened.until("(from) => window.reina.show.window[0] > from + 0.1", before)
    page.keyboard.press("0")
    assert show.measure("window") == pytest.approx([begin, end], abs=1e-3)


def test_everything_goes_by_keyboard(show: ShowPage) -> None:
    page = show.page
    show.seek(3 * BAR_S)
    page.get_by_role("treeitem", name="stage, 1 track").focus()
    page.keyboard.press("ArrowDown")
    show.opened.until("document.activeElement.ariaLabel === 'stage exposure, 3 keyframes'")
    assert show.measure("active") == EXPOSURE

    # Enter: the value on screen, where the playhead stands.
    page.keyboard.press("Enter")
    show.opened.until("window.reina.show.keyframes === 6")
    ((_, added),) = show.measure("chosen")
    assert show.keyframe(EXPOSURE, added)["time"] == 3
    assert show.keyframe(EXPOSURE, added)["value"] == pytest.approx(0.8, abs=1e-4)

    page.locator(".lanes").focus()
    page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Alt+ArrowLeft")
    assert show.times(EXPOSURE)[added] == pytest.approx(4.25 - 1 / 60 / BAR_S, abs=1e-5)

    # To the keyframe before, said aloud; then copied to the playhead, and once more a bar later.
    page.keyboard.press(",")
    show.opened.until("window.reina.show.chosen[0]?.[1] === 'k3'")
    assert "keyframe 3 of 4" in page.locator("[aria-live]").last.inner_text()
    page.keyboard.press("Control+c")
    show.seek(6 * BAR_S)
    page.keyboard.press("Control+v")
    page.keyboard.press("Control+d")
    times = sorted(show.times(EXPOSURE).values())
    assert times == pytest.approx([0, 1, 2, 4.25 - 1 / 60 / BAR_S, 6, 7], abs=1e-5)
    page.keyboard.press("Control+x")
    page.keyboard.press("Control+a")
    assert len(show.measure("chosen")) == show.measure("keyframes") == 7
    page.keyboard.press("Escape")
    assert show.measure("chosen") == []
    page.keyboard.press("Control+z")
    assert max(show.times(EXPOSURE).values()) == 7

    page.keyboard.press("?")
    keys = page.get_by_label("Keys", exact=True)
    keys.get_by_text("Camera keyframe from this view").wait_for()
    page.keyboard.press("Escape")
    unnamed = page.evaluate(
        "[...document.querySelectorAll('.editor :is(button, input, select):not([aria-hidden])')]"
        ".filter((each) => !(each.ariaLabel || each.textContent.trim() || each.labels?.length))"
        ".map((each) => each.outerHTML)"
    )
    assert unnamed == []


def test_values_and_ways_are_set_by_their_fields(show: ShowPage) -> None:
    page = show.page
    page.mouse.click(*show.key(EXPOSURE, "k2"))
    fields = page.get_by_label("Chosen keyframes")
    fill(show, fields.get_by_label("Value", exact=True), "2.5")
    assert show.keyframe(EXPOSURE, "k2")["value"] == 2.5
    fill(show, fields.get_by_label("Time, bar and beat"), "2.3")
    assert show.times(EXPOSURE)["k2"] == 1.5
    fill(show, fields.get_by_label("Time, seconds"), "2.5")
    assert show.times(EXPOSURE)["k2"] == 1.25

    # The presets are drawn as the server samples them, and one is set on all that are chosen.
    page.locator(".lanes").focus()
    page.keyboard.press("Control+a")
    page.get_by_role("button", name="the easing").click()
    show.opened.until("document.querySelectorAll('.grid path[d^=M]').length > 30")
    page.get_by_role("button", name="bounce out", exact=True).click()
    for path, key in ((EXPOSURE, "k3"), (HAZE, "h1"), (COLOR, "c1")):
        assert show.keyframe(path, key)["interpolation"] == "bounce_out"

    page.mouse.click(*show.key(COLOR, "c1"))
    fill(show, fields.get_by_label("Value", exact=True), "#4c6a9a")
    assert show.keyframe(COLOR, "c1")["value"] == "#4C6A9A"
    settings = page.get_by_label("The track blocks colour")
    settings.get_by_label("After").select_option("loop")
    settings.get_by_label("Counts in").select_option("seconds")
    settings.get_by_role("combobox", name="Reacts to").select_option("notes")
    show.until_saved()
    settings.get_by_label("Valves").select_option("1 3")
    show.until_saved()
    track = show.track(COLOR)
    assert (track["after"], track["time"]) == ("loop", "seconds")
    assert track["events"]["on"] == "notes"
    assert track["events"]["where"] == {"valves": [1, 3]}

    # Muted, it is out of the picture; alone, all others are.
    page.get_by_role("button", name="Mute stage exposure").click()
    show.until_saved()
    assert show.track(EXPOSURE)["muted"] is True
    page.get_by_role("button", name="Solo blocks colour").click()
    show.until_saved()
    assert show.track(COLOR)["solo"] is True

    page.get_by_role("button", name="Add a track").click()
    page.keyboard.type("rim intens")
    page.keyboard.press("Enter")
    show.opened.until("window.reina.show.active === 'lights/rim/intensity'")
    (added,) = show.times("lights/rim/intensity")
    fill(show, fields.get_by_label("Value", exact=True), "0.25")
    assert show.keyframe("lights/rim/intensity", added)["value"] == 0.25

    page.get_by_role("button", name="Marker here").click()
    fill(show, page.get_by_label("Marker's name"), "Entry")
    show.until_saved()
    assert {marker["name"] for marker in show.client.get(show.path).json()["markers"]} == {"Theme", "Entry"}
    page.get_by_role("button", name="Evening, the show").click()
    fill(show, page.get_by_label("Title"), "Dawn")
    assert show.client.get(show.path).json()["title"] == "Dawn"


def fill(show: ShowPage, field: Any, text: str) -> None:
    """Type into a field, and wait for the server to have it."""
    field.fill(text)
    field.press("Enter")
    show.until_saved()


def test_curves_bend_by_their_handles_and_the_camera_takes_this_view(show: ShowPage) -> None:
    page = show.page
    page.mouse.click(*show.key(EXPOSURE, "k3"))
    page.keyboard.press("v")
    show.opened.until("Number(document.querySelector('[data-curves]')?.dataset.curves) > 0")
    show.opened.until("window.reina.show.curvesSettled()")

    # A keyframe is taken in time and in value.
    x, y = show.key(EXPOSURE, "k2")
    show.drag((x, y), (show.ruler(1.5 * BAR_S)[0], y + 40))
    keyframe = show.keyframe(EXPOSURE, "k2")
    assert keyframe["time"] == 1.5
    assert keyframe["value"] < 1.39

    page.mouse.click(*show.key(EXPOSURE, "k3"))
    show.opened.until("window.reina.show.curvesSettled()")
    start, _ = page.evaluate("window.reina.show.handles()")
    show.drag((start["x"], start["y"]), (start["x"] + 12, start["y"] - 18))
    handles = show.keyframe(EXPOSURE, "k3")["handles"]
    assert handles[0] > 0.25
    assert handles[1] != 0.1
    assert handles[2:] == [0.25, 1]

    # The camera is taken from a view of one's own into its four tracks, as one step.
    page.keyboard.press("v")
    before = show.measure("undoSteps")
    show.seek(2 * BAR_S)
    page.locator("canvas[role=application]").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowUp")
    at = show.opened.parameter("camera/position")
    show.opened.until("([x]) => Math.abs(window.reina.drawnFrom[0] - x) > 0.05", at)
    page.keyboard.press("Shift+C")
    show.opened.until("window.reina.show.active === 'camera/position'")
    show.until_saved()
    assert show.measure("undoSteps") == before + 1
    (position,) = show.track("camera/position")["keyframes"]
    assert position["time"] == 2
    # The show has the camera again, and it stands where it stood.
    assert position["value"] != pytest.approx(at, abs=0.05)
    page.get_by_role("button", name="Give the camera back to the show").wait_for(state="detached")
    arrived = "(at) => Math.hypot(...window.reina.drawnFrom.map((each, axis) => each - at[axis])) < 2e-3"
    show.opened.until(arrived, position["value"])
    for path in ("camera/target", "camera/fov", "camera/roll"):
        assert [keyframe["time"] for keyframe in show.track(path)["keyframes"]] == [2]
