"""axe-core over every panel, wide and on a phone, by WCAG 2.2 AA and good practice; less motion."""

from __future__ import annotations

import math
import re
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from tests.e2e.waiting import add_style

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
PLAIN = "canvas[role=application] { visibility: hidden } * { backdrop-filter: none !important }"
"""Contrast can be reckoned before a plain ground alone: that of the page, which panels let through."""
RUN = """async (tags) => (await axe.run(document, {runOnly: tags})).violations.map(
  ({id, nodes}) => `${id}: ` + nodes.map(({target, any, all, none}) =>
    `${target.join(" ")} (${[...any, ...all, ...none].map((each) => each.message).join("; ")})`
  ).join(" | "))"""


SHOTS = """() => {
  window.shots = [];
  const look = () => {
    const [place, index, show] = [reina.drawnFrom, reina.drawnIndex, reina.parameter("camera/position")];
    const apart = (one, other) => Math.hypot(...one.map((each, axis) => each - other[axis]));
    const last = shots.at(-1);
    if (last === undefined || apart(place, last.place) > 1e-6) {
      shots.push({ place, show, from: index, to: index, moved: 0 });
    } else {
      last.to = index;
      last.moved = Math.max(last.moved, apart(show, last.show));
    }
    requestAnimationFrame(look);
  };
  look();
}"""
"""Notes from where the stage is seen: each place, the frames that were seen from there, and how far its
show camera went meanwhile, metres."""


def faults(opened: Opened) -> list[str]:
    """What axe finds on the page as it is."""
    page = opened.page
    opened.until_still()
    if not page.evaluate("'axe' in window"):
        page.evaluate(AXE.read_text())
        add_style(page, PLAIN)
    return page.evaluate(RUN, TAGS)


@pytest.mark.parametrize("size", [(1440, 900), (390, 844)], ids=["wide", "phone"])
def test_every_panel(visit: Visit, size: tuple[int, int]) -> None:
    narrow = size[0] < 720
    opened = visit(size=size, refusals=("415", "422"))
    opened.until_drawn()
    page = opened.page
    found: dict[str, list[str]] = {}

    def look(panel: str) -> None:
        found[panel] = faults(opened)

    look("welcome")
    page.keyboard.press("l")
    page.get_by_role("slider", name="The loop ends").wait_for()
    page.keyboard.press("z")
    page.get_by_role("button", name="Show the whole piece").wait_for()
    look("a loop, zoomed to")
    page.keyboard.press("z")
    page.keyboard.press("l")
    page.keyboard.press("p")
    page.get_by_role("region", name="the piece").wait_for()
    look("piece")
    page.keyboard.press("n")
    look("sounding names")
    page.keyboard.press("p")
    page.keyboard.press("?")
    page.get_by_role("region", name="Keys").wait_for()
    look("keys")
    page.keyboard.press("?")
    opened.choose_files(("broken.mid", "audio/midi", b"this is no MIDI file"))
    page.get_by_role("alert").wait_for()
    look("notice")
    page.get_by_role("button", name="Put away").click()

    page.keyboard.press("s")
    opened.until("window.reina.show?.keyframes > 0")
    look("show")
    if narrow:
        page.get_by_role("button", name="More").click()
        look("more")
        page.keyboard.press("Escape")
    else:
        page.get_by_role("button", name="What keyframes snap to").click()
        look("snap")
        page.keyboard.press("Escape")
    page.get_by_role("button", name="Add a track").click()
    page.keyboard.type("zoom")
    look("add a track")
    page.keyboard.type(" nothing of that name")
    look("add a track, none found")
    page.keyboard.press("Escape")
    page.get_by_role("button", name=re.compile("the show$")).first.click()
    page.get_by_text("Shows that come with Reina").wait_for()
    look("show's menu")
    page.keyboard.press("Escape")

    tracks = page.get_by_role("tree", name="Tracks")
    tracks.get_by_role("treeitem", name="camera position").click()
    if narrow:
        page.get_by_role("button", name="Values").click()
    look("track")
    page.get_by_role("listbox", name="Keyframes of").get_by_role("option").nth(1).click()
    page.get_by_label("Chosen keyframes").wait_for()
    look("keyframe")
    page.keyboard.press("Shift+F10")
    page.get_by_role("menu").wait_for()
    look("menu of a keyframe")
    page.keyboard.press("Escape")
    if not narrow:
        page.get_by_role("button", name="Where the editor stands").click()
        page.get_by_role("button", name="At the left").click()
        look("the editor aside")
        page.get_by_role("button", name="Where the editor stands").click()
        page.get_by_role("button", name="Below").click()
    page.get_by_role("button", name="the easing").click()
    opened.until("document.querySelectorAll('.grid path[d^=M]').length > 30")
    look("ways")
    page.keyboard.press("Escape")
    if narrow:
        page.get_by_role("button", name="Timeline", exact=True).click()
    page.get_by_role("application", name="Timeline").focus()
    page.keyboard.press("b")
    page.keyboard.press("v")
    look("curves and a marker")
    page.keyboard.press("Delete")
    page.locator(".notices .pane").get_by_text("Marker removed").wait_for()
    look("removed")
    assert {panel: each for panel, each in found.items() if each} == {}


def test_an_absent_session(visit: Visit) -> None:
    opened = visit("/s/no-such-session-0000000", refusals=("404",))
    opened.page.get_by_role("heading", name="This session is not here").wait_for()
    assert faults(opened) == []


def test_less_motion_stills_the_camera_within_a_shot_and_keeps_its_cuts(visit: Visit) -> None:
    opened = visit()
    page = opened.page
    page.emulate_media(reduced_motion="reduce")
    page.reload()
    opened.until_drawn()
    page.evaluate(SHOTS)
    page.keyboard.press("Space")
    opened.until("shots.length > 2")
    shots = page.evaluate("shots")
    for shot, after in pairwise(shots[:3]):
        assert shot["moved"] > 0.1, "the show's camera moves within a shot, and this one does not"
        assert shot["to"] - shot["from"] > 30
        assert math.dist(shot["place"], after["place"]) > 0.1, "a cut takes it elsewhere"
