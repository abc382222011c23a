"""A page whose server is started again goes on where the clock is, without anything being pressed."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import urlsplit

import httpx
import pytest
from tests.e2e.opened import FPS, Opened
from tests.integration.scores import scale, song
from tests.integration.server import serve

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser

pytestmark = pytest.mark.browser

LONG = (("long.mid", "audio/midi", scale(240)), ("long.wav", "audio/wav", song(120.0)))
LOST = ("net::ERR_", "WebSocket connection to", "503")
"""What a browser says of a server that is away, and of one that is being stopped."""
CLOSE_S = 0.06
"""Song and clock are together within this."""


def restarted(tmp_path: Path, browser: Browser, *, goes_on: bool) -> None:
    """Play, start the server again, and see page, sound and clock together.

    With `goes_on` the clock must run after the restart; else what it says is taken as it is.
    """
    with serve(tmp_path) as before:
        port = urlsplit(before.address).port
        context = browser.new_context(viewport={"width": 760, "height": 430})
        opened = Opened(context.new_page(), before.address, LOST)
        opened.begin_with(*LONG)
        page = opened.page
        page.keyboard.press("k")
        opened.until("window.reina.playing && window.reina.soundLevel > 0.01 && window.reina.drawnIndex > 60")
        assert before.stop() == 0
        page.get_by_text("The connection is lost").wait_for()
        reached = opened.measure("songTime")
    with (
        serve(tmp_path, "--port", str(port)) as again,
        httpx.Client(base_url=again.api, timeout=30) as client,
    ):
        page.get_by_text("The connection is lost").wait_for(state="detached")
        clock = client.get(f"/sessions/{opened.session}/transport").json()
        if goes_on:
            assert clock["playing"]
        if clock["playing"]:
            # The song goes on from where the clock is, and no click is asked for.
            opened.until(
                "(frame) => window.reina.playing && window.reina.drawnIndex > frame", reached * FPS + 60
            )
            opened.until("window.reina.sound === 'ready' && window.reina.soundLevel > 0.01")
            opened.until(f"Math.abs(window.reina.soundAhead ?? 1) < {CLOSE_S}")
        else:
            opened.until_at_rest(clock)
            opened.until("!window.reina.playing && window.reina.soundAhead === null")
        assert page.get_by_role("button", name="Turn the sound on").count() == 0
        opened.until("document.querySelector('.notices .notice, .notices .busy') === null")
        context.close()
    assert opened.errors == []


def test_the_page_is_where_the_clock_is_after_a_restart(tmp_path: Path, browser: Browser) -> None:
    restarted(tmp_path, browser, goes_on=False)


def test_the_music_goes_on_after_a_restart(tmp_path: Path, browser: Browser) -> None:
    restarted(tmp_path, browser, goes_on=True)
