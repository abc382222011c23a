"""The list of pieces, what is deleted and brought back, and the links to a session."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect
from tests.integration.scores import scale, song

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from playwright.sync_api import Locator
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

MIDI = ("scale.mid", "audio/midi", scale(8))
WAV = ("scale.wav", "audio/wav", song(4.0))


BRIGHTNESS = """(images) => images.map((image) => {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 1;
  const context = canvas.getContext("2d");
  context.imageSmoothingQuality = "high";
  context.drawImage(image, 0, 0, 1, 1);
  const [red, green, blue] = context.getImageData(0, 0, 1, 1).data;
  return (red + green + blue) / 3;
})"""
"""How bright pictures are on the whole, 0 to 255."""


def pieces(opened: Opened) -> Locator:
    """The panel, opened."""
    panel = opened.page.get_by_role("region", name="my pieces")
    if not panel.is_visible():
        opened.page.keyboard.press("g")
    return panel


def test_pieces_are_listed_with_pictures_deleted_and_brought_back(visit: Visit, client: httpx.Client) -> None:
    opened = visit()
    opened.until_drawn()
    home = opened.session
    opened.open_files(MIDI, WAV)
    own = opened.session
    panel = pieces(opened)
    items = panel.get_by_role("listitem")
    items.nth(1).wait_for()
    assert items.count() == 2
    assert items.nth(0).get_by_role("button").first.get_attribute("aria-current") == "page"
    pictures = panel.locator("img")
    widths = "(images) => Promise.all(images.map((image) => image.decode().then(() => image.naturalWidth)))"
    assert pictures.evaluate_all(widths) == [640, 640]
    assert all(brightness > 20 for brightness in pictures.evaluate_all(BRIGHTNESS))

    # What is open and deleted is left for the other; Undo brings it back, and the server has it still.
    title = client.get(f"/api/v1/sessions/{own}").json()["title"]
    panel.get_by_role("button", name=f"Delete {title}").click()
    expect(items).to_have_count(1)
    panel.get_by_role("button", name="Undo").click()
    expect(items).to_have_count(2)
    opened.until("(home) => window.reina.session === home && window.reina.drawn", home)
    assert client.get(f"/api/v1/sessions/{own}").status_code == 200

    # Without Undo it is ended, at the latest when the panel is closed.
    panel.get_by_role("button", name=f"Delete {title}").click()
    with opened.page.expect_response(lambda answer: answer.request.method == "DELETE") as ended:
        panel.get_by_role("button", name="Close my pieces").click()
    assert ended.value.status == 204
    assert client.get(f"/api/v1/sessions/{own}").status_code == 404
    opened.until("(own) => !(own in JSON.parse(localStorage.reina).tokens)", own)


def test_links_to_watch_and_to_control(visit: Visit) -> None:
    opened = visit(files=(MIDI, WAV))
    panel = pieces(opened)
    address = panel.get_by_role("textbox", name="Address")
    watch = address.input_value()
    assert watch.endswith(f"/s/{opened.session}")
    assert panel.get_by_role("img", name=re.compile("QR code of the address to watch")).is_visible()
    panel.get_by_role("button", name="To control").click()
    control = address.input_value()
    assert control.startswith(f"{watch}#control=")
    panel.get_by_role("button", name="In a page").click()
    assert f'src="{watch}?clean=1"' in panel.get_by_role("textbox", name="HTML").input_value()

    watching = visit(watch.removeprefix(opened.page.url.split("/s/")[0]))
    watching.until_drawn()
    assert watching.page.get_by_text("Watching", exact=True).is_visible()
    watching.page.keyboard.press("g")
    assert watching.page.get_by_role("button", name="To control").count() == 0

    # As whoever scans the code does: a browser that has never been here.
    other = visit("/lab")
    other.page.goto(control.replace("#", "?tier=low#"))
    other.until_drawn()
    assert other.page.url == f"{watch}?tier=low"
    assert not other.page.get_by_text("Watching", exact=True).is_visible()
    other.page.keyboard.press(" ")
    opened.until("window.reina.playing === true")


def test_a_control_link_made_anew_ends_the_one_before(visit: Visit, client: httpx.Client) -> None:
    opened = visit(files=(MIDI, WAV))
    before, path = opened.headers, f"/api/v1/sessions/{opened.session}/transport"
    beside = visit(f"/s/{opened.session}", beside=opened)
    beside.until_drawn()
    panel = pieces(opened)
    panel.get_by_role("button", name="To control").click()
    address = panel.get_by_role("textbox", name="Address")
    first = address.input_value()
    panel.get_by_role("button", name="Make the control link anew").click()
    expect(address).not_to_have_value(first)
    expect(panel.get_by_role("button", name="Make the control link anew")).to_be_focused()
    assert client.post(path, json={"action": "pause"}, headers=before).status_code == 403
    assert address.input_value().endswith(
        f"#control={opened.headers['Authorization'].removeprefix('Bearer ')}"
    )
    # This page, and another tab of it, go on with the new one.
    for one in (opened, beside):
        one.until_drawn()
        assert client.post(path, json={"action": "pause"}, headers=one.headers).status_code == 200
    beside.until("document.querySelector('main').dataset.phase === 'open' && window.reina.drawn")
    beside.page.keyboard.press(" ")
    opened.until("window.reina.playing === true")
