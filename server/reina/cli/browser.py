"""A Chromium or Chrome of this machine, and what drives it."""

from __future__ import annotations

import os
import shutil
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from reina.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Generator

    from playwright.sync_api import Browser

NAMES = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome", "chrome")
APPLICATIONS = (
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "C:/Program Files/Google/Chrome/Application/chrome.exe",
    "C:/Program Files (x86)/Google/Chrome/Application/chrome.exe",
)
"""Where browsers stand that are on no PATH."""
ARGUMENTS = (
    # A page that nobody looks at is not to be slowed down.
    "--disable-background-timer-throttling",
    "--disable-renderer-backgrounding",
    "--disable-backgrounding-occluded-windows",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
)
STARTING_MS = 60_000
GRAPHICS = (
    # Without a window a browser finds no graphics by itself on Linux. EGL has the card there, or Mesa's
    # drawing in software, three times as fast as the browser's own; that is left where there is no EGL.
    *(("--use-gl=angle", "--use-angle=gl-egl") if sys.platform == "linux" else ()),
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
)
"""What a browser without a window draws with."""
WITHOUT_PLAYWRIGHT = (
    "Playwright, which drives the browser, is not installed: "
    "`make film` installs it, or `pip install playwright` where Reina is installed"
)


def find_browser() -> Path | None:
    """Path of a Chromium or Chrome: REINA_BROWSER, PATH, where they are installed; None without one."""
    named = os.environ.get("REINA_BROWSER")
    if named:
        return Path(named)
    for name in NAMES:
        found = shutil.which(name)
        if found is not None:
            return Path(found)
    return next((path for path in map(Path, APPLICATIONS) if path.is_file()), None)


@contextmanager
def headless_browser() -> Generator[Browser]:
    """A browser without a window.

    Raises:
        InputError: There is none, or nothing to drive it with.
    """
    try:
        from playwright.sync_api import Error, sync_playwright
    except ImportError as error:
        raise InputError(WITHOUT_PLAYWRIGHT) from error
    with sync_playwright() as playwright:
        path = find_browser() or Path(playwright.chromium.executable_path)
        if not path.is_file():
            raise InputError(
                "no Chromium or Chrome is installed: install one, or name its program with REINA_BROWSER"
            )
        try:
            browser = playwright.chromium.launch(
                executable_path=path, args=[*GRAPHICS, *ARGUMENTS, *_sandbox()], timeout=STARTING_MS
            )
        except Error as error:
            raise InputError(f"the browser {path} does not start: {error.message.splitlines()[0]}") from error
        try:
            yield browser
        finally:
            browser.close()


def _sandbox() -> tuple[str, ...]:
    """Chromium's sandbox does not start for root, as in most containers."""
    root = sys.platform != "win32" and os.geteuid() == 0
    return ("--no-sandbox",) if root else ()
