"""Loops and zoom on the two timelines: the transport's, and the ruler of the show's editor."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from tests.e2e.shows import EXPOSURE, ShowPage

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = pytest.mark.browser

STRIP_Y = 12
"""Bar numbers of the transport's timeline, pixels below its upper edge."""


@pytest.fixture
def free(show: ShowPage) -> Iterator[ShowPage]:
    """The show's page, and no loop before or after."""
    yield show
    address = f"{show.path.removesuffix('/show')}/transport"
    end = {"action": "loop", "start_s": None, "end_s": None}
    show.client.post(address, json=end, headers=show.headers).raise_for_status()


class Overview:
    """The transport's timeline."""

    def __init__(self, show: ShowPage) -> None:
        self.show = show
        show.page.keyboard.press("s")
        self.slider = show.page.get_by_role("slider", name="Position in the piece")
        self.slider.wait_for()
        show.opened.until("Number(document.querySelector('.timeline')?.dataset.to) > 0")

    def span(self) -> tuple[float, float]:
        """Song time at its edges, seconds."""
        begin, end = self.show.page.evaluate(
            "(({ from, to }) => [Number(from), Number(to)])(document.querySelector('.timeline').dataset)"
        )
        return begin, end

    def at(self, song_time_s: float, below: float = STRIP_Y) -> tuple[float, float]:
        """A song time's place in the window."""
        box = self.slider.bounding_box()
        assert box is not None
        begin, end = self.span()
        return box["x"] + (song_time_s - begin) / (end - begin) * box["width"], box["y"] + below

    def until_loop(self, *ends: float) -> None:
        """Wait for the server's word on the loop."""
        loops = "(ends) => JSON.stringify(document.querySelector('.timeline').dataset.loop.split(' ')"
        self.show.opened.until(f"{loops}.filter(Boolean).map(Number)) === JSON.stringify(ends)", list(ends))


def test_loops_are_dragged_on_the_transport_which_zooms(free: ShowPage) -> None:
    page, overview = free.page, Overview(free)
    # Along the bar numbers, to whole bars; its end and all of it are taken.
    free.drag(overview.at(2.3), overview.at(5.8))
    overview.until_loop(2, 6)
    end = page.get_by_role("slider", name="The loop ends")
    assert end.get_attribute("aria-valuetext") == "Bar 4, beat 1"
    grip = overview.at(6)
    free.drag((grip[0] + 4, grip[1]), (overview.at(8.2)[0] + 4, grip[1]))
    overview.until_loop(2, 8)
    free.drag(overview.at(5), overview.at(7.1))
    overview.until_loop(4, 10)
    page.mouse.click(*overview.at(7))
    overview.until_loop()

    # With Shift anywhere; Alt leaves it free of the bars. Escape lets go, and ends the loop that there is.
    page.keyboard.down("Shift")
    free.drag(overview.at(3.3, 40), overview.at(7.6, 40))
    page.keyboard.up("Shift")
    overview.until_loop(4, 8)
    page.mouse.move(*overview.at(11))
    page.mouse.down()
    page.mouse.move(*overview.at(14), steps=3)
    page.keyboard.press("Escape")
    page.mouse.up()
    overview.until_loop(4, 8)
    page.get_by_role("slider", name="The loop begins").focus()
    page.keyboard.press("ArrowLeft")
    overview.until_loop(2, 8)

    # To the loop by Z, nearer by the wheel, and to all again; the playhead is followed.
    page.keyboard.press("z")
    begin, finish = overview.span()
    assert 0 < begin < 2
    assert 8 < finish < 10
    page.mouse.move(*overview.at(4))
    page.mouse.wheel(0, -400)
    free.opened.until("(to) => Number(document.querySelector('.timeline').dataset.to) < to - 1", finish)
    assert overview.span()[0] < 4 < overview.span()[1]
    free.seek(14.0)
    free.opened.until("Number(document.querySelector('.timeline').dataset.from) > 10")
    page.get_by_role("button", name="Show the whole piece").click()
    assert overview.span()[0] == 0
    end.focus()
    page.keyboard.press("Escape")
    overview.until_loop()


def test_loops_are_dragged_on_the_editors_ruler_and_its_place_is_chosen(free: ShowPage) -> None:
    page = free.page

    def strip(song_time_s: float) -> tuple[float, float]:
        point = page.evaluate("(time) => window.reina.show.loop(time)", song_time_s)
        return point["x"], point["y"]

    def until_loop(*ends: float) -> None:
        free.opened.until(
            "(ends) => JSON.stringify(window.reina.show.looped) === JSON.stringify(ends)", list(ends)
        )

    free.drag(strip(2.2), strip(7.8))
    until_loop(2, 8)
    free.drag(strip(8.0), strip(10.1))
    until_loop(2, 10)
    page.mouse.click(*strip(5))
    until_loop()
    free.drag(free.ruler(4.0), free.ruler(6.0))
    until_loop()

    # Aside, the stage keeps its whole height; its edge is dragged, and the transport has its timeline again.
    editor = page.get_by_role("region", name="The show", exact=True)
    page.get_by_role("button", name="Where the editor stands").click()
    page.get_by_role("button", name="At the right").click()
    page.get_by_role("slider", name="Position in the piece").wait_for()
    before = editor.bounding_box()
    assert before is not None
    assert before["x"] > 400
    edge = page.get_by_role("separator", name="Width of the show").bounding_box()
    assert edge is not None
    x, y = edge["x"] + 3, edge["y"] + 150
    free.drag((x, y), (x - 60, y))
    after = editor.bounding_box()
    assert after is not None
    assert after["width"] == pytest.approx(before["width"] + 60, abs=1)
    # What lies there is drawn and taken as below.
    free.until_laid_out()
    page.mouse.click(*free.key(EXPOSURE, "k2"))
    assert free.measure("chosen") == [[EXPOSURE, "k2"]]
    assert page.evaluate("JSON.parse(localStorage.reina).editorDock") == "right"
    page.get_by_role("button", name="Where the editor stands").click()
    page.get_by_role("button", name="Below").click()
    page.get_by_role("separator", name="Height of the show").wait_for()
