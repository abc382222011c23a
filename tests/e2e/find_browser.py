"""Find a Chromium for the browser tests, and with --install make sure that there is one."""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from ctypes.util import find_library
from pathlib import Path
from typing import TYPE_CHECKING

from reina.cli.browser import find_browser as installed_browser

if TYPE_CHECKING:
    from collections.abc import Callable

MESA = ("libegl1", "libgl1-mesa-dri")
"""What draws in software by EGL."""


class BrowserNotFoundError(RuntimeError):
    """No Chromium is there and none could be installed."""


def find_browser() -> Path | None:
    """Path of a Chromium or Chrome: what `reina film` takes, or Playwright's own; None without one."""
    return installed_browser() or _playwright_browser()


def browser_path() -> Path:
    """Path of a Chromium.

    Raises:
        BrowserNotFoundError: there is none.
    """
    found = find_browser()
    if found is None:
        raise BrowserNotFoundError(
            "no Chromium found on PATH; run `make .venv/.browser`, install Chromium, "
            "or set REINA_BROWSER to the path of one"
        )
    return found


def install_browser() -> Path:
    """Path of a Chromium, which is installed first where there is none.

    Raises:
        BrowserNotFoundError: none is there and neither apt nor Playwright could install one.
    """
    found = find_browser()
    if found is not None:
        _install_graphics()
        return found
    for install in _ways_to_install():
        install()
        found = find_browser()
        if found is not None:
            return found
    return browser_path()


def _ways_to_install() -> list[Callable[[], None]]:
    playwright = [_install_with_playwright]
    if _has_apt():
        return [_install_with_apt, *playwright]
    return playwright


def _install_graphics() -> None:
    """Mesa, where there is no EGL: the browser's own drawing in software is slower."""
    if sys.platform == "linux" and find_library("EGL") is None and _has_apt():
        _apt_install(*MESA)


def _has_apt() -> bool:
    return shutil.which("apt-get") is not None and os.geteuid() == 0


def _install_with_apt() -> None:
    _apt_install("chromium", *MESA)


def _apt_install(*packages: str) -> None:
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for command in (["apt-get", "update"], ["apt-get", "install", "-y", *packages]):
        if subprocess.run(command, env=environment, check=False).returncode != 0:
            return


def _install_with_playwright() -> None:
    subprocess.run([sys.executable, "-m", "playwright", "install", "chromium"], check=False)


def _playwright_browser() -> Path | None:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        path = Path(playwright.chromium.executable_path)
    return path if path.exists() else None


def main() -> int:
    """Print the browser's path; 1 when there is none."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--install", action="store_true", help="install a Chromium when there is none")
    arguments = parser.parse_args()
    try:
        print(install_browser() if arguments.install else browser_path())
    except BrowserNotFoundError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
