"""The laboratory's page in a real Chromium: controls set, targets dragged, numbers read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

WIDE = (980, 520)
BROKEN = b"HIERARCHY\nROOT hips\n{\n\tOFFSET 0 nine 0\n}\n"


def open_lab(visit: Visit, table: str, **options: Any) -> Opened:
    """The lab with one of its tables open and drawn."""
    opened = visit("/lab", **{"size": WIDE} | options)
    opened.page.get_by_role("tab", name=table).click()
    opened.until("window.lab?.drawn > 0")
    return opened


def reading(opened: Opened) -> dict[str, Any]:
    return opened.page.evaluate("window.lab.kinematics")


def settled(opened: Opened, status: str) -> dict[str, Any]:
    """Wait until everything asked is answered, with a status."""
    opened.until("(status) => !window.lab.kinematics.busy && window.lab.kinematics.status === status", status)
    return reading(opened)


def posed(opened: Opened) -> None:
    """Wait for the first pose."""
    opened.until("window.lab.kinematics.end.length === 3 && !window.lab.kinematics.busy")
    opened.until("window.labTarget?.() != null")


def test_four_ways_are_drawn_and_measured(visit: Visit) -> None:
    opened = open_lab(visit, "Rotations", refusals=("422",))
    page = opened.page
    slerp = page.locator("tr[data-way=slerp]")
    slerp.wait_for()
    assert slerp.locator("td").all_inner_texts()[:2] == ["141.1°", "1.00"]
    assert float(page.locator("tr[data-way=matrix] td").nth(1).inner_text()) > 5
    page.get_by_label("To: turn 1 about z").fill("80")
    page.get_by_label("To: turn 2 about y").fill("-20")
    page.get_by_label("To: turn 3 about x").fill("40")
    opened.until("document.querySelector('tr[data-way=slerp] td').innerText === '90.0°'")
    page.get_by_label("To: set by").select_option("axis_angle")
    page.get_by_label("To: axis x").fill("0")
    page.get_by_label("To: axis y").fill("0")
    page.get_by_label("To: axis z").fill("0")
    page.get_by_role("alert").wait_for(state="visible")
    assert "end/axis" in page.get_by_role("alert").inner_text()


def test_rotations_play_there_and_back(visit: Visit) -> None:
    opened = open_lab(visit, "Rotations")
    way = "document.querySelector('input[type=range]').valueAsNumber"
    opened.page.get_by_role("button", name="Play").click()
    opened.until(f"{way} > 100")
    opened.until(f"{way} < 20")
    opened.page.get_by_role("button", name="Pause").click()
    opened.until("window.lab.drawn > 0")
    stands = opened.page.evaluate(way)
    opened.until(
        "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))"
    )
    assert opened.page.evaluate(way) == stands


def test_a_dragged_target_is_followed_by_the_finger(visit: Visit) -> None:
    opened = open_lab(visit, "Kinematics")
    posed(opened)
    before = reading(opened)
    place = opened.page.evaluate("window.labTarget()")
    mouse = opened.page.mouse
    mouse.move(place["x"], place["y"])
    mouse.down()
    mouse.move(place["x"] - 30, place["y"] + 35, steps=4)
    mouse.up()
    after = settled(opened, "reached")
    assert np.linalg.norm(np.subtract(after["target"], before["target"])) > 0.005
    np.testing.assert_allclose(after["end"], after["target"], atol=1e-6)
    opened.until("document.querySelector('[role=status]').innerText.startsWith('Reached, 0 mm')")
    moved = opened.page.evaluate("window.labTarget()")
    assert abs(moved["x"] - place["x"] + 30) < 2
    assert abs(moved["y"] - place["y"] - 35) < 2


def test_a_target_set_by_numbers_and_keys(visit: Visit, client: httpx.Client) -> None:
    opened = open_lab(visit, "Kinematics")
    posed(opened)
    page = opened.page
    page.get_by_label("Chain", exact=True).select_option("rightArm")
    page.get_by_label("Solver", exact=True).select_option("damped_least_squares")
    for axis, millimetres in (("x", -300), ("y", 50), ("z", 200)):
        page.get_by_label(f"Target {axis}, mm").fill(str(millimetres))
    shown = settled(opened, "reached")
    assert shown["target"] == pytest.approx([-0.3, 0.05, 0.2])
    asked = {"chain": "rightArm", "target": shown["target"], "choice": {"solver": "damped_least_squares"}}
    told = client.post("/api/v1/lab/inverse", json=asked).json()
    np.testing.assert_allclose(shown["end"], told["pose"]["positions"][-1], atol=1e-9)
    assert f"{told['iterations']} rounds" in page.get_by_role("status").inner_text()
    page.get_by_role("slider", name="Round of the solver").press("Home")
    page.get_by_text(f"round 0 of {told['iterations']}").wait_for()
    page.get_by_role("application").focus()
    page.keyboard.press("ArrowRight")
    opened.until("window.lab.kinematics.target[0] > -0.2999 && !window.lab.kinematics.busy")
    page.get_by_label("Target x, mm").fill("-900")
    settled(opened, "out_of_reach")
    assert "Out of reach" in page.get_by_role("status").inner_text()


def test_a_joint_is_moved_by_its_slider(visit: Visit) -> None:
    opened = open_lab(visit, "Kinematics")
    posed(opened)
    slider = opened.page.get_by_role("slider", name="right index intermediate, z")
    before, angle = reading(opened)["end"], float(slider.input_value())
    slider.focus()
    for _ in range(5):
        slider.press("ArrowLeft")
    assert float(slider.input_value()) == pytest.approx(angle - 5), "a degree a key, however slow the server"
    opened.until("!window.lab.kinematics.busy")
    after = reading(opened)
    assert after["status"] is None
    assert np.linalg.norm(np.subtract(after["end"], before)) > 0.001
    assert after["target"] == pytest.approx(after["end"]), "the target waits at the end"


def test_clips_play_and_a_broken_file_is_told_with_its_line(visit: Visit) -> None:
    opened = open_lab(visit, "Motion clips", refusals=("422",))
    page = opened.page
    page.get_by_role("heading", name="breathing.bvh").wait_for()
    frame = page.get_by_role("slider", name="Frame")
    page.get_by_role("button", name="Play", exact=True).click()
    opened.until("document.querySelector('input[type=range]').valueAsNumber > 3")
    page.get_by_role("button", name="Pause", exact=True).click()
    frame.press("Home")
    page.get_by_role("button", name="hips").click()
    page.get_by_text("hips, in the file's unit").wait_for()
    page.set_input_files("#clip-file", [{"name": "bad.bvh", "mimeType": "text/plain", "buffer": BROKEN}])
    alert = page.get_by_role("alert")
    alert.wait_for()
    told = alert.inner_text()
    assert "bad.bvh" in told
    assert "line 4" in told
    assert "OFFSET 0 nine 0" in told
    assert page.get_by_role("heading", name="breathing.bvh").is_visible(), "what was open stays"


ODD = """HIERARCHY
ROOT Hips {
  OFFSET 0 9 0 CHANNELS 3 Xposition Yposition Zposition
  JOINT Nub { OFFSET 0 10 0 }
  JOINT Nub { OFFSET 5 10 0 }
}
"""


def size_of(opened: Opened) -> str:
    return opened.page.locator("tr", has_text="Size, in the file's unit").locator("td").inner_text()


def test_a_clips_warnings_are_told_and_positions_taken_as_chosen(visit: Visit) -> None:
    opened = open_lab(visit, "Motion clips")
    page = opened.page
    page.get_by_role("heading", name="breathing.bvh").wait_for()

    def put(name: str, text: str) -> None:
        page.set_input_files(
            "#clip-file", [{"name": name, "mimeType": "text/plain", "buffer": text.encode()}]
        )
        page.get_by_role("heading", name=name).wait_for()

    put("odd.bvh", ODD + "MOTION\nFrames: 5\nFrame Time: 0.5\n0 1 0\n0 4 0\n")
    told = page.locator("details", has_text="2 things to know").inner_text()
    assert "line 5\n2 joints are called 'Nub'; the later ones are now 'Nub.001'" in told
    assert "line 8\n5 frames are announced, 2 are there, which are read" in told
    assert page.get_by_role("button", name="Nub.001").is_visible()
    assert size_of(opened) == "5.0 × 13.0 × 0.0"
    page.get_by_role("slider", name="Frame").press("End")
    page.get_by_role("button", name="Hips").click()
    place = page.locator(".place td").nth(1)
    assert place.inner_text() == "4.000"
    page.get_by_label("Position channels").select_option("add")
    opened.until("document.querySelectorAll('.place td')[1]?.innerText === '13.000'")
    put("still.bvh", ODD)
    assert page.get_by_label("Position channels").input_value() == "add", "it stays while the page is open"
    assert "the file has no motion" in page.locator("details").inner_text()
    assert page.get_by_text("none: a skeleton at rest").is_visible()
    assert size_of(opened) == "5.0 × 10.0 × 0.0"
    assert page.get_by_role("button", name="Play", exact=True).is_disabled()


@pytest.mark.parametrize("size", [(390, 844), (1440, 900)], ids=["phone", "wide"])
def test_nothing_overflows_the_window(visit: Visit, size: tuple[int, int]) -> None:
    opened = open_lab(visit, "Rotations", size=size)
    for table, shown in (
        ("Rotations", "tr[data-way=slerp]"),
        ("Kinematics", "[role=status]"),
        ("Motion clips", "h2.file"),
    ):
        opened.page.get_by_role("tab", name=table).click()
        opened.page.locator(shown).first.wait_for()
        opened.until("(width) => document.querySelector('main').scrollWidth <= width", size[0])
        nameless = opened.page.evaluate(
            """() => [...document.querySelectorAll("button, input, select, a")]
              .filter((one) => !(one.labels?.length || one.ariaLabel || one.textContent.trim()))
              .map((one) => one.outerHTML.slice(0, 120))"""
        )
        assert nameless == []
