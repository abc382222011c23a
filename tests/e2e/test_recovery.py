"""An open page outlives what happens to its server and its session."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import expect
from tests.e2e.opened import Opened
from tests.integration.scores import duet, song
from tests.integration.server import serve

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    import httpx
    from playwright.sync_api import Browser, WebSocketRoute

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

DUET = (("duet.mid", "audio/midi", duet()), ("duet.wav", "audio/wav", song(4.0)))
LOST = ("net::ERR_", "WebSocket connection to")
"""What a browser says of a server that is away, and of one that goes in the middle of an answer."""


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
        opened.until("window.reina.playing")
        opened.until("window.reina.drawnIndex > 20")
        context.close()
    assert opened.errors == []


def test_a_session_that_ends_says_so_and_offers_a_way_on(visit: Visit, client: httpx.Client) -> None:
    opened = visit(files=DUET, refusals=("404", *LOST))
    assert client.delete(f"/api/v1/sessions/{opened.session}", headers=opened.headers).status_code == 204
    opened.page.get_by_role("heading", name="This session has ended").wait_for()
    opened.page.get_by_role("link", name="Open Reina's piece").click()
    opened.until_drawn()


def test_what_changed_before_the_stream_began_is_seen(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=(1100, 620)).open_files(*DUET)
    path, headers = f"/api/v1/sessions/{opened.session}", opened.headers
    first = opened.page.locator(".notes .name").first
    expect(first).to_have_text("G4")

    # The page has read the score by then, and hears of no change yet.
    def change_first(stream: WebSocketRoute) -> None:
        client.patch(path, json={"transposition": 2}, headers=headers).raise_for_status()
        stream.connect_to_server()

    opened.page.route_web_socket(re.compile("/stream"), change_first)
    opened.page.reload()
    opened.until_drawn()
    expect(first).to_have_text("A4")


def test_the_keyboard_chooses_a_part(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=(1100, 620), files=DUET)
    opened.page.keyboard.press("p")
    parts = opened.page.get_by_role("group", name="Part for the trumpet")
    chosen = parts.get_by_role("radio", checked=True)
    chosen.focus()
    assert client.get(f"/api/v1/sessions/{opened.session}").json()["part"] == 1
    opened.page.keyboard.press("ArrowDown")
    opened.page.get_by_role("radio", name="Flute", checked=True).wait_for()
    parts.and_(opened.page.locator("[aria-busy=false]")).wait_for()
    assert client.get(f"/api/v1/sessions/{opened.session}").json()["part"] == 0
    assert opened.page.evaluate("document.activeElement.type") == "radio", "the keyboard keeps its place"
