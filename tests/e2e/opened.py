"""A page that is open in the browser, and what it says of itself (`window.reina`)."""

from __future__ import annotations

import contextlib
import io
from typing import TYPE_CHECKING, Any, Literal
from urllib.parse import urlsplit

import numpy as np
from PIL import Image
from playwright.sync_api import TimeoutError as LateError
from tests.e2e.waiting import add_style, wait_until

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from playwright.sync_api import ConsoleMessage, Locator, Page

FPS = 60
NOWHERE = "/s/no-such-session-0000000"
PATIENCE_S = 60.0
"""Software GL on a busy machine draws a few pictures a second."""

OVERFLOWING = """() => [...document.querySelectorAll("html, .pane, .pane button, .pane select, .pane h2")]
  .filter((element) => {
    const box = element.getBoundingClientRect();
    const wide = element === document.documentElement && element.scrollWidth > innerWidth;
    // A button sticks out of its pane, too, where the pane clips nothing.
    const pane = element.matches(".pane *") ? element.closest(".pane").getBoundingClientRect() : null;
    const [left, right] = [Math.max(0, pane?.left ?? 0), Math.min(innerWidth, pane?.right ?? innerWidth)];
    return wide || (box.width > 0 && (box.left < left - 0.5 || box.right > right + 0.5));
  })
  .map((element) => element.outerHTML.slice(0, 120))"""

STATE = """() => [document.querySelector(".notices")?.innerText, window.reina?.drawn,
  window.reina?.playing, window.reina?.sound, document.activeElement?.outerHTML.slice(0, 120)]"""
STILL = """() => document.getAnimations().every(
  (each) => each.playState !== "running" || each.effect?.getComputedTiming().endTime === Infinity)"""


class Opened:
    """One open page."""

    def __init__(self, page: Page, address: str, refusals: tuple[str, ...] = ()) -> None:
        self.page = page
        self.errors: list[str] = []
        self._refusals = refusals
        self._address = address
        page.set_default_timeout(PATIENCE_S * 1000)
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", self._hear)

    def _hear(self, message: ConsoleMessage) -> None:
        # Asked for in the moment in which sound or frames become others: the page goes over to those.
        changing = any(part in message.location["url"] for part in ("/song/segments/", "/blocks/"))
        overtaken = changing and "410" in message.text
        nowhere = f"/sessions/{NOWHERE.removeprefix('/s/')}" in message.location["url"]
        expected = overtaken or nowhere or any(part in message.text for part in self._refusals)
        if message.type == "error" and not expected:
            self.errors.append(message.text)

    def go(self, path: str, wait_until: Literal["commit", "load"] = "load") -> None:
        """Load an address of the server, drawn with the least effort."""
        self.page.goto(f"{self._address}{path}{'&' if '?' in path else '?'}tier=low", wait_until=wait_until)

    def until_at_rest(self, transport: dict[str, Any]) -> int:
        """Wait until the frame of a paused clock's state, or of a later one, is drawn; returns its index."""
        index = int(transport["song_time_s"] * FPS + 1e-6)
        self.until(
            "([index, epoch]) => window.reina.drawnIndex === index && window.reina.epoch >= epoch"
            " && window.reina.drawnEpoch === window.reina.epoch",
            [index, transport["epoch"]],
        )
        return index

    @property
    def session(self) -> str:
        """Id of the session in the address."""
        return urlsplit(self.page.url).path.removeprefix("/s/")

    def until(self, expression: str, argument: Any = None) -> None:
        """Wait for a JavaScript expression of the page to be true."""
        wait_until(self.page, expression, argument, patience_s=PATIENCE_S)

    def until_drawn(self) -> None:
        """Wait for the page's own sign that it has drawn a picture of its session."""
        self.until("window.reina?.drawn === true")

    def until_another_session(self, first: str) -> None:
        """Wait for a picture of another session than the first."""
        self.until(
            "(first) => window.reina?.session && window.reina.session !== first && window.reina.drawn", first
        )

    @property
    def headers(self) -> dict[str, str]:
        """What controls the page's session over HTTP."""
        tokens = self.page.evaluate("JSON.parse(localStorage.reina).tokens")
        return {"Authorization": f"Bearer {tokens[self.session]}"}

    def picture(self) -> NDArray[np.int16]:
        """The page's pixels, (height, width, 3), once the stage has faded in."""
        self.until("document.querySelector('canvas').getAnimations().length === 0")
        image = Image.open(io.BytesIO(self.page.screenshot(timeout=PATIENCE_S * 1000))).convert("RGB")
        return np.asarray(image).astype(np.int16)

    def until_redrawn(self, pictures: int) -> None:
        """Wait for a picture after so many: what a key has changed is on the stage then."""
        self.until("(pictures) => window.reina.pictures > pictures", pictures)

    def until_still(self) -> None:
        """Wait until nothing fades or moves any more, but for what turns for as long as something is on."""
        self.until(STILL)

    def until_nothing_overflows(self) -> None:
        """Wait until nothing of the panels is beyond the window: what has room is counted after a change."""
        with contextlib.suppress(LateError):
            self.until(f"({OVERFLOWING})().length === 0")
        assert self.page.evaluate(OVERFLOWING) == [], "as HTML; the document itself where it is wider"

    def hide_panels(self) -> None:
        """Leave nothing in the window but the stage."""
        add_style(self.page, ".chrome { display: none }")

    def measure(self, name: str) -> Any:
        """A figure of `window.reina`."""
        return self.page.evaluate("(name) => window.reina[name]", name)

    def parameter(self, path: str) -> list[float]:
        """A parameter's floats in the frame that was drawn last."""
        value = self.page.evaluate("(path) => window.reina.parameter(path)", path)
        assert value is not None, f"the session streams no {path}"
        return value

    def bone_quaternions(self) -> dict[str, list[float]]:
        """Local joint rotations as three.js has them, x y z w."""
        return self.page.evaluate("window.reina.boneQuaternions()")

    def account(self) -> str:
        """What a person would see of the page's state, for the report of a test that failed."""
        if self.page.is_closed():
            return f"{self.page.url}: closed; errors {self.errors}"
        figures = self.page.evaluate(STATE)
        return f"{self.page.url}: notices, drawn, playing, sound, focus {figures}; errors {self.errors}"

    def press_until(self, button: Locator, sign: Locator) -> None:
        """Tap a button; once more, as a person would, where the first tap came while the page changed."""
        button.tap()
        try:
            sign.wait_for(timeout=10_000)
        except LateError:
            if button.is_visible():
                button.tap()
            sign.wait_for()

    def choose_files(self, *files: tuple[str, str, bytes]) -> None:
        """Give files to the page's file input: name, media type, content."""
        self.page.set_input_files(
            "#files", [{"name": name, "mimeType": media, "buffer": data} for name, media, data in files]
        )

    def begin_with(self, *files: tuple[str, str, bytes]) -> Opened:
        """Load the page and choose files of a score at once; no other piece is made and drawn before.

        It begins where no session is, and the browser's word on that is no error.
        """
        self.go(NOWHERE)
        self.page.get_by_role("heading", name="This session is not here").wait_for()
        self.choose_files(*files)
        self.until("window.reina?.session && window.reina.drawn")
        return self

    def open_files(self, *files: tuple[str, str, bytes]) -> Opened:
        """Choose files of a score, and wait for the picture of the session that they make."""
        self.until_drawn()
        first = self.session
        self.choose_files(*files)
        self.until_another_session(first)
        return self
