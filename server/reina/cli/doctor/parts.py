"""What comes with Reina or beside it: packages, the page, rigs, sound, a browser."""

from __future__ import annotations

import importlib.metadata
import os
import re
import sys
from typing import TYPE_CHECKING

from reina.api.settings import require_page
from reina.cli.browser import find_browser
from reina.cli.doctor.finding import fail, ok, warn
from reina.errors import InputError
from reina.sessions.stage import Stage
from reina.sound.font import MissingSoundfontError, find_soundfont

if TYPE_CHECKING:
    from collections.abc import Iterator

    from reina.api.settings import Settings
    from reina.cli.doctor.finding import Finding

OLDEST_PYTHON = (3, 11)
_NAME = re.compile(r"[A-Za-z0-9._-]+")


def parts_checks(settings: Settings) -> Iterator[Finding]:
    """Everything that is installed, built or found."""
    yield python_finding()
    yield packages_finding(importlib.metadata.requires("reina") or [])
    yield _page(settings)
    yield _rigs(settings)
    yield _soundfont(settings)
    yield _browser()
    yield ok("bus", "none is configured: one server has all sessions")


def python_finding() -> Finding:
    """Whether this Python is new enough."""
    version = ".".join(map(str, sys.version_info[:3]))
    if sys.version_info[:2] < OLDEST_PYTHON:
        return fail("Python", version, "Reina needs Python 3.11 or newer")
    return ok("Python", version)


def packages_finding(requirements: list[str]) -> Finding:
    """Whether what Reina cannot do without is installed.

    Args:
        requirements: As in its metadata; those of extras are left out.
    """
    names = [
        named[0]
        for text in requirements
        if "extra ==" not in text and (named := _NAME.match(text)) is not None
    ]
    missing = [name for name in names if not _is_installed(name)]
    if missing:
        return fail(
            "packages",
            f"{', '.join(missing)} missing",
            "`make setup`, or `pip install --force-reinstall reina`",
        )
    return ok("packages", f"all {len(names)} are installed")


def _is_installed(name: str) -> bool:
    try:
        importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return False
    return True


def _page(settings: Settings) -> Finding:
    try:
        require_page(settings)
    except InputError as error:
        return fail("page", str(error), "`make setup` builds it; `reina serve --no-page` does without it")
    return ok("page", f"built, in {settings.page_dir}")


def _rigs(settings: Settings) -> Finding:
    try:
        stage = Stage.load(settings.rigs_dir)
    except InputError as error:
        return fail("rigs", str(error), "they come with Reina; REINA_RIGS names another folder")
    return ok("rigs", f"{len(stage.rigs)}, in {settings.rigs_dir}")


def _soundfont(settings: Settings) -> Finding:
    try:
        return ok("soundfont", str(find_soundfont(settings.data_dir)))
    except MissingSoundfontError as error:
        return fail("soundfont", str(error), "`make setup` makes it; scores without a recording are silent")


def _browser() -> Finding:
    found = find_browser()
    to_do = "install Chromium or Chrome, or name its program with REINA_BROWSER; `reina film` alone needs it"
    if found is None:
        return warn("browser", "no Chromium or Chrome was found", to_do)
    if not os.access(found, os.X_OK):
        return warn("browser", f"{found} is no program", to_do)
    if not _is_installed("playwright"):
        to_do = "`make film`, or `pip install playwright`; `reina film` alone needs it"
        return warn("browser", f"{found}, but nothing to drive it with", to_do)
    return ok("browser", str(found))
