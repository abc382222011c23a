"""The camera's path in the picture, curves side by side, answers to the music, looks of one's own."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest
from playwright.sync_api import expect
from tests.e2e.shows import COLOR, EXPOSURE, HAZE, ShowPage

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Locator

pytestmark = pytest.mark.browser

POSITION, TARGET, FOV = "camera/position", "camera/target", "camera/fov"
GLOW = "blocks/glow"


def put(path: str, values: list[Any], **more: Any) -> dict[str, Any]:
    """A track of keyframes two bars apart, on a smooth curve where nothing else is said."""
    keyframes = [
        {"key": f"k{number + 1}", "time": 2 * number, "value": value, "interpolation": "linear"} | more
        for number, value in enumerate(values)
    ]
    return {"edit": "put_track", "track": {"parameter": path, "keyframes": keyframes}}


def middle(mark: Locator) -> tuple[float, float]:
    box = mark.bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_the_cameras_path_lies_in_the_picture_with_keys_to_choose_and_drag(show: ShowPage) -> None:
    page = show.page
    show.edit(
        put(POSITION, [[-1.2, 1.5, 2.6], [0.0, 1.7, 3.0], [1.2, 1.4, 2.4]]),
        put(TARGET, [[0, 1.3, 0.2], [0.1, 1.2, 0.2], [0, 1.3, 0.3]]),
    )
    switch = page.get_by_role("button", name="Camera's path")
    path = page.locator("svg.path")
    assert path.count() == 0
    switch.click()
    # It is seen from elsewhere than from itself: the page goes there.
    expect(path).to_have_attribute("data-lines", "2")
    expect(switch).to_have_attribute("aria-pressed", "true")
    marks = path.locator(".mark")
    expect(marks).to_have_count(6)
    mark = path.locator(f'[data-key="{POSITION} k2"]')
    # Once it stands still: the camera is on its way there.
    mark.click()
    begin = middle(mark)
    assert show.measure("chosen") == [[POSITION, "k2"]]
    page.get_by_label("What is chosen").get_by_text("Chosen: a keyframe of camera position").wait_for()

    show.drag(begin, (begin[0] + 40, begin[1] - 25))
    moved = show.keyframe(POSITION, "k2")["value"]
    assert moved != [0.0, 1.7, 3.0]
    assert moved[1] > 1.7
    assert middle(mark) == pytest.approx((begin[0] + 40, begin[1] - 25), abs=1.5)
    # Escape lets go of it where it was.
    begin = middle(mark)
    page.mouse.move(*begin)
    page.mouse.down()
    page.mouse.move(begin[0] - 30, begin[1], steps=3)
    page.keyboard.press("Escape")
    page.mouse.up()
    assert show.keyframe(POSITION, "k2")["value"] == moved
    # With the show's own camera there is nothing to be seen of it.
    page.get_by_role("treeitem", name="stage exposure").click()
    page.keyboard.press("c")
    expect(path).to_have_count(0)
    expect(switch).to_have_attribute("aria-pressed", "false")


def test_curves_of_several_units_and_a_colours_handles(show: ShowPage) -> None:
    page = show.page
    show.edit(
        put(POSITION, [[-2, 1.5, 2.6], [2, 1.7, 3.0]]),
        put(FOV, [0.3, 0.9]),
        put(COLOR, ["#D9A441", "#4C6A9A"], interpolation="cubic_spline"),
    )
    show.opened.until("window.reina.show.keyframes === 10")
    page.get_by_role("button", name="Curves").click()
    page.get_by_role("treeitem", name="blocks colour").click()
    page.get_by_label("Timeline").focus()
    show.opened.until("window.reina.show.curvesSettled()")
    page.keyboard.press("Control+a")
    normalise = page.get_by_role("button", name="Normalise")
    expect(normalise).to_have_attribute("aria-pressed", "true")
    show.opened.until("window.reina.show.curvesSettled()")
    wide = [show.key(FOV, key)[1] for key in ("k1", "k2")]
    assert wide[0] - wide[1] > 60
    normalise.click()
    # 17° and 52° beside a few metres: the metres lie together at the bottom.
    near = [show.key(POSITION, key, 0)[1] for key in ("k1", "k2")]
    assert 0 < near[0] - near[1] < 30
    normalise.click()

    # A colour's spline has a handle at either end for each of its components.
    page.mouse.click(*show.key(COLOR, "k1", 1))
    show.opened.until("window.reina.show.handles().length === 6")
    assert show.measure("active") == COLOR
    handles = page.evaluate("window.reina.show.handles()")
    assert show.keyframe(COLOR, "k1").get("out_tangent") is None
    x, y = handles[0]["x"], handles[0]["y"]
    show.drag((x, y), (x, y - 30))
    bent = show.keyframe(COLOR, "k1")["out_tangent"]
    assert len(bent) == 3
    assert any(abs(slope) > 0.01 for slope in bent)


def test_answers_take_pitches_by_name_and_values_in_turn(show: ShowPage) -> None:
    page = show.page
    swell = {"on": "notes", "decay": 0.25, "amount": 2, "blend": "add"}
    show.edit({"edit": "put_track", "track": {"parameter": GLOW, "keyframes": [], "events": swell}})
    page.get_by_role("treeitem", name="blocks glow").click()
    answer = page.get_by_role("group", name="Reacts to the music")

    # A B♭ trumpet's C5 sounds a tone lower.
    pitch = answer.get_by_label("Pitch")
    pitch.fill("c5 - G5")
    pitch.press("Enter")
    show.until_saved()
    assert show.track(GLOW)["events"]["where"]["pitch"] == [70, 77]
    expect(pitch).to_have_value("C5..G5")
    pitch.fill("H5")
    pitch.press("Enter")
    answer.get_by_role("alert").get_by_text("“H5” is no pitch. Write a letter from A to G").wait_for()
    pitch.fill("")
    pitch.press("Enter")
    show.until_saved()
    assert "where" not in show.track(GLOW)["events"]
    expect(answer.get_by_role("alert")).to_have_count(0)

    answer.get_by_label("What it does at each event").select_option("cycle")
    cycle = answer.get_by_role("group", name="Values that take turns")
    for index, value in enumerate((0.5, 1.5)):
        cycle.get_by_label(f"Value {index + 1}", exact=True).fill(str(value))
        cycle.get_by_label(f"Value {index + 1}", exact=True).press("Enter")
    cycle.get_by_role("button", name="Add value").click()
    third = cycle.get_by_label("Value 3", exact=True)
    third.fill("3")
    third.press("Enter")
    cycle.get_by_role("button", name="Value 3 earlier").click()
    expect(cycle.get_by_role("button", name="Value 2 earlier")).to_be_focused()
    show.until_saved()
    assert show.track(GLOW)["events"] == {"on": "notes", "cycle": [0.5, 3, 1.5]}
    cycle.get_by_role("button", name="Remove value 1").click()
    show.until_saved()
    assert show.track(GLOW)["events"]["cycle"] == [3, 1.5]


def test_looks_are_kept_and_put_at_the_playhead(show: ShowPage, tmp_path: Path) -> None:
    page = show.page
    page.evaluate("localStorage.removeItem('reina.looks')")
    open_looks = page.get_by_role("button", name="Looks", exact=True)
    looks = page.get_by_role("dialog", name="Looks")
    show.seek(4.0)
    open_looks.click()
    looks.get_by_role("button", name="One spot").click()
    show.until_saved()
    haze = show.track(HAZE)["keyframes"]
    assert [(key["time"], key["value"]) for key in haze][-1] == (2, 1)
    assert show.keyframe(HAZE, "h1")["value"] == 0.2
    show.opened.until("window.reina.parameter('lights/haze')[0] === 1")

    looks.get_by_label("Name of the look").fill("Blue hour")
    looks.get_by_role("button", name="Save", exact=True).click()
    (kept,) = page.evaluate("JSON.parse(localStorage['reina.looks'])")
    assert kept["values"]["lights/haze"] == 1
    assert EXPOSURE not in kept["values"]
    looks.get_by_role("button", name="Rename Blue hour").click()
    name = looks.get_by_label("New name of Blue hour")
    name.fill("Night")
    name.press("Enter")
    with page.expect_download() as download:
        looks.get_by_role("button", name="Export").click()
    file = tmp_path / "looks.json"
    download.value.save_as(file)
    assert json.loads(file.read_text())["looks"][0]["title"] == "Night"

    looks.get_by_role("button", name="Remove Night").click()
    expect(looks.get_by_role("button", name="Night", exact=True)).to_have_count(1)  # the server's own
    page.keyboard.press("Escape")
    notice = page.locator(".notices .pane")
    notice.get_by_text("Look removed: Night").wait_for()
    notice.get_by_role("button", name="Undo").click()

    open_looks.click()
    looks.get_by_label("over the whole piece").check()
    looks.get_by_role("list").get_by_role("button", name="Night", exact=True).click()
    show.until_saved()
    assert [key["value"] for key in show.track(HAZE)["keyframes"]] == [1]
    looks.locator("input[type=file]").set_input_files(file)
    looks.get_by_role("list").get_by_role("button", name="Night 2", exact=True).wait_for()
    page.keyboard.press("Escape")
    # One step took it all.
    page.keyboard.press("Control+z")
    assert len(show.times(HAZE)) > 1
