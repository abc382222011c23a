"""An open page outlives what happens to its server and its session."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import urlsplit

import pytest
from tests.e2e.opened import Opened
from tests.integration.scores import duet, song
from tests.integration.server import serve

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    import httpx
    from playwright.sync_api import Browser

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

DUET = (("duet.mid", "audio/midi", duet()), ("duet.wav", "audio/wav", song(4.0)))
LOST = ("ERR_CONNECTION_REFUSED", "WebSocket connection to")


def test_a_restarted_server_is_found_again(tmp_path: Path, browser: Browser) -> None:
    with serve(tmp_path) as before:
        port = urlsplit(before.address).port
        context = browser.new_context(viewport={"width": 760, "height": 430})
        opened = Opened(context.new_page(), before.address, LOST)
        opened.begin_with(*DUET)
        assert before.stop() == 0
        opened.page.get_by_text("The connection is lost").wait_for()
    with serve(tmp_path, "--port", str(port)):
        opened.page.get_by_text("The connection is lost").wait_for(state="detached")
        opened.page.keyboard.press("k")
        opened.until("window.reina.playing && window.reina.drawnIndex > 20")
        context.close()
    assert opened.errors == []


def test_a_session_that_ends_says_so_and_offers_a_way_on(visit: Visit, client: httpx.Client) -> None:
    opened = visit(files=DUET, refusals=("404", *LOST))
    assert client.delete(f"/api/v1/sessions/{opened.session}", headers=opened.headers).status_code == 204
    opened.page.get_by_role("heading", name="This session is not here").wait_for()
    opened.page.get_by_role("link", name="Open Reina's piece").click()
    opened.until_drawn()


def test_the_keyboard_chooses_a_part(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=(1100, 620), files=DUET)
    opened.page.keyboard.press("p")
    parts = opened.page.get_by_role("group", name="Part the trumpet plays")
    chosen = parts.get_by_role("radio", checked=True)
    chosen.focus()
    assert client.get(f"/api/v1/sessions/{opened.session}").json()["part"] == 1
    opened.page.keyboard.press("ArrowDown")
    opened.page.get_by_role("radio", name="Flute", checked=True).wait_for()
    parts.and_(opened.page.locator("[aria-busy=false]")).wait_for()
    assert client.get(f"/api/v1/sessions/{opened.session}").json()["part"] == 0
    assert opened.page.evaluate("document.activeElement.type") == "radio", "the keyboard keeps its place"
