"""The page that makes a film: opened in a browser without a window, and driven."""

from __future__ import annotations

import base64
import contextlib
import json
import mimetypes
import time
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from reina.errors import InputError
from reina.sessions.record import UNDECODED

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path

    from playwright.sync_api import APIResponse, Browser, FilePayload

    from reina.cli.film_progress import FilmProgress

WINDOW_WIDTH, WINDOW_HEIGHT = 320, 180
"""Of the page itself, which nobody sees: the film is drawn beside it."""
OPENING_MS = 120_000
UPLOAD_MS = 600_000
DECODING_S, LOOK_EVERY_MS = 60.0, 200
"""How long the page may take to decode a recording that the server does not."""
OPEN = """
async (patience) => {
  const end = performance.now() + patience;
  while (!window.reina?.session && document.querySelector("[role=alert]") === null) {
    if (performance.now() > end) throw new Error("it says nothing");
    await new Promise((done) => setTimeout(done, 100));
  }
}
"""
"""Is over once a session is open, or the page has said why none is. It waits in the page, which may not be
made to evaluate a text again and again."""
FILM = """
async (commission) => {
  const toText = (bytes) => new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(reader.result.slice(reader.result.indexOf(",") + 1));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(new Blob([bytes]));
  });
  const client = {
    write: async ({ data, position }) => {
      const fault = await window.reinaWrites(position, await toText(data));
      if (fault !== null) throw new Error(fault);
    },
    tell: (progress) => void window.reinaTells(progress),
  };
  try {
    return { made: await window.reina.film(commission, client, new AbortController().signal) };
  } catch (error) {
    return { fault: error instanceof Error ? error.message : String(error) };
  }
}
"""
"""Has the page make a film and hand over its bytes; a piece is awaited, so that none heap up."""


@dataclass(frozen=True)
class Commission:
    """What is asked for, as `Commission` of web/src/film reads it."""

    start: float
    end: float | None
    aspect: str
    height: int
    fps: int
    quality: str
    detail: str
    camera: str
    sound: bool
    container: str


@dataclass(frozen=True)
class Made:
    """What was made."""

    frames: int
    width: int
    height: int
    coding: str


@contextlib.contextmanager
def film_page(browser: Browser, address: str, files: dict[str, tuple[str, bytes]]) -> Generator[FilmPage]:
    """A session of some files on a server, open in a page; gone from the server at the end.

    Args:
        browser: Where the page is opened.
        address: The server's, without a path.
        files: `score`, `song` and `show`: the file's name and bytes.

    Raises:
        InputError: The server is not there or refuses the files, or the page cannot be drawn.
    """
    page = FilmPage(browser, address, files)
    try:
        page.open()
        yield page
    finally:
        page.close()


class FilmPage:
    """A page of a session of its own, which makes films of it.

    Raises:
        InputError: The server is not there or refuses the files.
    """

    def __init__(self, browser: Browser, address: str, files: dict[str, tuple[str, bytes]]) -> None:
        self._address = address
        self._context = browser.new_context(viewport={"width": WINDOW_WIDTH, "height": WINDOW_HEIGHT})
        self._session = self._upload(files)
        self._page = self._context.new_page()

    def open(self) -> None:
        """Open the session in the page.

        Raises:
            InputError: The page does not open, or says why it cannot.
        """
        from playwright.sync_api import Error

        try:
            # What the server does not decode, a page that controls the session decodes for it.
            control = f"#control={self._session['control_token']}" if self._is_decoded_here else ""
            address = f"{self._address}/s/{self._session['id']}?clean=1&tier=low{control}"
            self._page.goto(address, timeout=OPENING_MS)
            self._page.evaluate(OPEN, OPENING_MS)
        except Error as error:
            raise InputError(
                f"the page at {self._address} does not open: {error.message.splitlines()[0]}"
            ) from error
        if not self._page.evaluate("() => Boolean(window.reina?.session)"):
            raise InputError(" ".join(self._page.get_by_role("alert").first.inner_text().split()))

    def close(self) -> None:
        """Remove the session from the server and close the page."""
        from playwright.sync_api import Error

        with contextlib.suppress(Error):
            token = self._session["control_token"]
            self._context.request.delete(
                f"{self._address}/api/v1/sessions/{self._session['id']}",
                headers={"Authorization": f"Bearer {token}"},
            )
            self._context.close()

    def film(self, commission: Commission, output: Path, progress: FilmProgress) -> Made:
        """Make the film; its file appears when it is whole.

        Raises:
            InputError: It cannot be made, in the page's words, or not be written.
        """
        from playwright.sync_api import Error

        part = output.with_name(f".{output.name}.part")
        try:
            self._wait_for_alignment(progress)
            with part.open("wb") as file:

                def write(position: int, text: str) -> str | None:
                    try:
                        file.seek(position)
                        file.write(base64.b64decode(text))
                    except OSError as error:
                        return f"{output} cannot be written: {error.strerror}"
                    return None

                def tell(told: dict[str, Any]) -> None:
                    progress.tell(told["phase"], told["done"], told["of"], told["secondsLeft"])

                self._page.expose_function("reinaWrites", write)  # pyright: ignore[reportUnknownMemberType]
                self._page.expose_function("reinaTells", tell)  # pyright: ignore[reportUnknownMemberType]
                answer: dict[str, Any] = self._page.evaluate(FILM, asdict(commission))
            if "fault" in answer:
                raise InputError(answer["fault"])
            part.replace(output)
        except OSError as error:
            raise InputError(f"{output} cannot be written: {error.strerror}") from error
        except Error as error:
            raise InputError(f"the browser gave up: {error.message.splitlines()[0]}") from error
        finally:
            part.unlink(missing_ok=True)
        return Made(**answer["made"])

    @property
    def _is_decoded_here(self) -> bool:
        return self._session["song"]["media_type"] in UNDECODED

    def _wait_for_alignment(self, progress: FilmProgress) -> None:
        """Wait until the score is in time with a recording, or known not to be: it moves everything."""
        until = time.monotonic() + DECODING_S
        path = f"{self._address}/api/v1/sessions/{self._session['id']}"
        while True:
            status = self._context.request.get(path).json()["alignment"]["status"]
            is_coming = status == "none" and self._is_decoded_here and time.monotonic() < until
            if status != "searching" and not is_coming:
                return
            progress.tell("recording", 0, 1, None)
            self._page.wait_for_timeout(LOOK_EVERY_MS)

    def _upload(self, files: dict[str, tuple[str, bytes]]) -> dict[str, Any]:
        from playwright.sync_api import Error

        form: dict[str, str | float | bool | bytes | FilePayload] = {
            field: {
                "name": name,
                "mimeType": mimetypes.guess_type(name)[0] or "application/octet-stream",
                "buffer": data,
            }
            for field, (name, data) in files.items()
        }
        try:
            answer = self._context.request.post(
                f"{self._address}/api/v1/sessions", multipart=form, timeout=UPLOAD_MS
            )
        except Error as error:
            raise InputError(f"no server answers at {self._address}") from error
        if answer.status != 201:
            raise InputError(_refusal(answer))
        return answer.json()


def _refusal(answer: APIResponse) -> str:
    """What a server's problem details say."""
    try:
        problem: dict[str, Any] = answer.json()
        faults = [
            f"{fault['location']}: {fault['detail']}" if fault.get("location") else fault["detail"]
            for fault in problem.get("errors", [])
        ]
        return "; ".join([f"{problem['title']}: {problem['detail']}", *faults])
    except (json.JSONDecodeError, UnicodeDecodeError, KeyError, TypeError, AttributeError):
        return f"the server answers {answer.status}, which Reina's does not: is its address right?"
