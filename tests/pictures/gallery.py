"""The development gallery in a browser: a server, Vite before it, and single pictures of any view."""

from __future__ import annotations

import os
import socket
import subprocess
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx

if TYPE_CHECKING:
    from collections.abc import Generator, Sequence

    from playwright.sync_api import Browser, Page

WEB = Path(__file__).parents[2] / "web"
START_S = 60.0
PATIENCE_MS = 240_000
"""Software GL takes seconds for the first picture of the full tier."""


@contextmanager
def vite(server: str) -> Generator[str]:
    """Vite's development server before a Reina server; gives its address."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = int(probe.getsockname()[1])
    address = f"http://127.0.0.1:{port}"
    command = [
        str(WEB / "node_modules/.bin/vite"),
        "--host",
        "127.0.0.1",
        "--port",
        str(port),
        "--strictPort",
    ]
    process = subprocess.Popen(
        command, cwd=WEB, env={**os.environ, "REINA_URL": server}, stdout=subprocess.DEVNULL
    )
    try:
        wait_for(f"{address}/gallery.html")
        yield address
    finally:
        process.terminate()
        process.wait(10)


def wait_for(address: str) -> None:
    """Wait until an address answers.

    Raises:
        TimeoutError: It does not within a minute.
    """
    end = time.monotonic() + START_S
    while time.monotonic() < end:
        try:
            if httpx.get(address).is_success:
                return
        except httpx.TransportError:
            time.sleep(0.2)
    raise TimeoutError(f"{address} does not answer; run `npm run dev` in web/ to see why")


class GalleryPage:
    """A gallery page of one session, without its controls."""

    def __init__(
        self,
        browser: Browser,
        address: str,
        session: str,
        *,
        size: tuple[int, int],
        tier: str,
        rigs: Sequence[str] = (),
    ) -> None:
        """`rigs` stand there alone, as their files have them at rest: `drumkit@0,0.2,-2.15`."""
        self.page: Page = browser.new_page(viewport={"width": size[0], "height": size[1]})
        self.page.set_default_timeout(PATIENCE_MS)
        beside = "&alone" * bool(rigs) + "".join(f"&rig={rig}" for rig in rigs)
        self.page.goto(f"{address}/gallery?bare&session={session}&tier={tier}{beside}")
        self.page.wait_for_function("window.gallery || document.querySelector('#word').textContent")
        word = self.page.locator("#word").inner_text()
        if word:
            raise RuntimeError(f"the gallery shows nothing: {word}")

    @property
    def duration_s(self) -> float:
        return float(self.page.evaluate("gallery.duration"))

    def picture(self, view: dict[str, Any]) -> bytes:
        """A PNG of a view; what it leaves out stays as it was."""
        self.page.evaluate("(view) => gallery.show(view)", view)
        return self.page.screenshot(timeout=PATIENCE_MS)
