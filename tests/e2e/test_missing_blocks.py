"""The picture goes on where blocks of frames are late, are lost, or come from elsewhere."""

from __future__ import annotations

import threading
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import TYPE_CHECKING

import httpx
import pytest
from tests.e2e.opened import Opened
from tests.integration.scores import scale
from tests.integration.server import serve, upload

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path

    from playwright.sync_api import Browser
    from tests.integration.server import Owned, Running

pytestmark = pytest.mark.browser

SIZE = (200, 130)
"""Software GL draws so small a picture often enough."""
HELD_MS, GAP_MS = 1800, 4000
LOST_MS = 6000
STANDS_MS = 1000
"""A picture that stands so long has nothing to draw; a busy machine draws sooner."""
BAD_LINE = """
window.line = { held: null, losesBlocks: false };
window.WebSocket = class extends WebSocket {
  set onmessage(listener) {
    super.onmessage = (event) => {
      if (window.line.losesBlocks && typeof event.data !== "string") return;
      if (window.line.held === null) listener(event);
      else window.line.held.push(() => listener(event));
    };
  }
};
"""
HOLD = """(milliseconds) => {
  const held = window.line.held = [];
  setTimeout(() => { window.line.held = null; for (const give of held) give(); }, milliseconds);
}"""
LONGEST_STAND = """(milliseconds) => new Promise((resolve) => {
  const begun = performance.now();
  let [shown, before, stood, longest] = [window.reina.songTime, begun, 0, 0];
  requestAnimationFrame(function look() {
    const now = performance.now();
    // Where the page is not let draw, it is not for want of blocks that the picture stands.
    stood = window.reina.songTime === shown ? stood + Math.min(now - before, 100) : 0;
    longest = Math.max(longest, stood);
    [shown, before] = [window.reina.songTime, now];
    if (now - begun < milliseconds) requestAnimationFrame(look);
    else resolve(longest);
  });
})"""


class Watched:
    """A page that plays, behind a line that can be made bad, and what blocks it fetches."""

    def __init__(self, browser: Browser, address: str, owned: Owned) -> None:
        self._context = browser.new_context(viewport={"width": SIZE[0], "height": SIZE[1]})
        self._context.add_init_script(BAD_LINE)
        self.fetched: list[str] = []
        self.opened = Opened(self._context.new_page(), address)
        self.opened.page.on("request", lambda request: self._note(request.url))
        self.opened.go(f"/s/{owned.id}")
        self.opened.until_drawn()
        owned.control("play")
        self.opened.until("window.reina.playing && window.reina.songTime > 1 && window.reina.ahead > 1.5")

    def _note(self, address: str) -> None:
        if "/blocks/" in address:
            self.fetched.append(address)

    def longest_stand_ms(self, milliseconds: float) -> float:
        """For how long the picture stood at most, of so many milliseconds."""
        return self.opened.page.evaluate(LONGEST_STAND, milliseconds)

    def close(self) -> None:
        """Close the page."""
        self._context.close()


@pytest.fixture
def watched(browser: Browser, server: Running, client: httpx.Client) -> Generator[Watched]:
    """A page of a server that pushes blocks; it says no error."""
    watched = Watched(browser, server.address, upload(client, scale(400, bpm=120.0)))
    yield watched
    watched.close()
    assert watched.opened.errors == []


def test_the_picture_goes_on_over_a_gap_of_the_network(watched: Watched) -> None:
    watched.opened.page.evaluate(HOLD, HELD_MS)
    assert watched.longest_stand_ms(GAP_MS) < STANDS_MS


def test_blocks_that_are_lost_are_fetched(watched: Watched) -> None:
    watched.opened.page.evaluate("window.line.losesBlocks = true")
    assert watched.longest_stand_ms(LOST_MS) < STANDS_MS
    assert len(watched.fetched) == len(set(watched.fetched)) > 0, "each once"


@contextmanager
def caching_origin() -> Generator[Origin]:
    """Another origin that passes requests on to a server, as what caches blocks does."""
    with Origin() as origin:
        thread = threading.Thread(target=origin.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        try:
            yield origin
        finally:
            origin.shutdown()
            thread.join()


class Origin(ThreadingHTTPServer):
    """Passes GET on to `server`, or answers 503 where it is `broken`, and counts how often."""

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), Passing)
        self.server = ""
        self.broken = False
        self.refused = 0
        self.address = f"http://127.0.0.1:{self.server_port}"


class Passing(BaseHTTPRequestHandler):
    """One request to an `Origin`."""

    def do_GET(self) -> None:
        """Pass it on."""
        assert isinstance(self.server, Origin)
        broken = self.server.broken
        self.server.refused += broken
        answer = httpx.get(f"{self.server.server}{self.path}")
        self.send_response(503 if broken else answer.status_code)
        for name in ("Content-Type", "Content-Length", "Access-Control-Allow-Origin"):
            self.send_header(name, answer.headers[name])
        self.end_headers()
        self.wfile.write(answer.content)

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002
        """Say nothing."""


def test_blocks_are_fetched_from_elsewhere_and_where_that_fails_from_the_server(
    browser: Browser, tmp_path: Path
) -> None:
    with (
        caching_origin() as origin,
        serve(tmp_path, settings={"REINA_BLOCKS_ORIGIN": origin.address}) as running,
        httpx.Client(base_url=running.address, timeout=30.0) as client,
    ):
        origin.server = running.address
        watched = Watched(browser, running.address, upload(client, scale(400, bpm=120.0)))
        assert watched.longest_stand_ms(GAP_MS) < STANDS_MS
        assert {address.startswith(origin.address) for address in watched.fetched} == {True}
        before = len(watched.fetched)
        origin.broken = True
        assert watched.longest_stand_ms(LOST_MS) < STANDS_MS
        elsewhere = [address.startswith(origin.address) for address in watched.fetched[before:]]
        assert origin.refused > 0, "it is tried first"
        assert not any(elsewhere[3:]), "no more than those that were on their way"
        assert len(elsewhere) > 3
        watched.close()
        assert [error for error in watched.opened.errors if "503" not in error] == []
