"""A real server and a real browser for the page's tests."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from playwright.sync_api import Browser, expect, sync_playwright
from tests.e2e.opened import PATIENCE_S, Opened
from tests.e2e.shows import WINDOW, ShowPage, made_session, remembering
from tests.integration.server import Running, serve

from reina.cli.browser import GRAPHICS

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator

    from playwright.sync_api import ViewportSize

FIND_BROWSER = Path(__file__).with_name("find_browser.py")
BROWSER_ARGUMENTS = (
    "--no-sandbox",
    *GRAPHICS,
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
)
SOUND_WAITS = """
let touched = false;
addEventListener("pointerdown", () => { touched = true; }, true);
window.AudioContext = class extends AudioContext {
  constructor(...options) { super(...options); void super.suspend(); }
  resume() { return touched ? super.resume() : new Promise(() => {}); }
};
"""
"""What browsers do outside of tests, where a script that the driver runs counts as its user's own doing."""
EXPECTED = ("409", "412", "ERR_FAILED")
"""What the browser says of a write that came too late, and of one that a test let get lost."""
SMALL = (760, 430)
"""Width and height of the window: software GL draws a picture of this size in about a tenth of a second."""


# What is expected of a page is waited for as long as all else; Playwright's own patience is five seconds.
expect.set_options(timeout=PATIENCE_S * 1000)

FAILED = pytest.StashKey[bool]()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Keep whether a test failed, for the fixtures that end after it."""
    report = yield
    if report.when == "call":
        item.stash[FAILED] = report.failed
    return report


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Running]:
    """A server on a free port, with a data directory of its own."""
    with serve(tmp_path_factory.mktemp("page")) as running:
        yield running


@pytest.fixture(scope="session")
def client(server: Running) -> Iterator[httpx.Client]:
    """A client of that server."""
    with httpx.Client(base_url=server.address, timeout=30.0) as client:
        yield client


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """A Chromium that draws in software."""
    found = subprocess.run([sys.executable, str(FIND_BROWSER)], capture_output=True, text=True, check=True)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=found.stdout.strip(), args=list(BROWSER_ARGUMENTS), timeout=60_000
        )
        yield browser
        browser.close()


def storing(remembers: dict[str, Any]) -> str:
    """A script that puts into the page's storage what it kept from an earlier visit, where it is empty."""
    return f"localStorage.reina ??= {json.dumps(json.dumps(remembers))};"


@pytest.fixture(scope="session")
def one_show(browser: Browser, server: Running, client: httpx.Client) -> Iterator[ShowPage]:
    """A page with the show's editor, for one test after another: to load a stage takes seconds."""
    session = made_session(client)
    context = browser.new_context(viewport={"width": WINDOW[0], "height": WINDOW[1]})
    context.add_init_script(storing(remembering(session)))
    opened = Opened(context.new_page(), server.address)
    opened.go(f"/s/{session['id']}")
    opened.until_drawn()
    yield ShowPage(opened, client).open()
    context.close()


@pytest.fixture
def show(one_show: ShowPage) -> Iterator[ShowPage]:
    """The show's editor over a small show, as it is opened first; the page says no error but EXPECTED."""
    one_show.opened.errors.clear()
    yield one_show.afresh()
    assert [error for error in one_show.opened.errors if not any(code in error for code in EXPECTED)] == []


@pytest.fixture
def visit(
    request: pytest.FixtureRequest, browser: Browser, server: Running
) -> Iterator[Callable[..., Opened]]:
    """Opens pages of the server, each in a browser profile of its own unless `beside` another.

    With `files` (name, media type, content of a score and what goes with it) it is their session that is
    drawn, and none before it: to draw the bundled piece first takes seconds.

    Whatever a page says on its console as an error fails the test at its end, but for the HTTP statuses in
    `refusals`. With `sound_waits` the browser lets no sound out before a click or a key; `remembers` is what
    the page has kept in its storage from an earlier visit. With `touch` it is a phone: fingers, and no mouse.
    """
    opened: list[Opened] = []

    def open_page(
        path: str = "/",
        *,
        files: tuple[tuple[str, str, bytes], ...] = (),
        size: tuple[int, int] = SMALL,
        beside: Opened | None = None,
        refusals: tuple[str, ...] = (),
        sound_waits: bool = False,
        remembers: dict[str, Any] | None = None,
        touch: bool = False,
    ) -> Opened:
        if beside is None:
            viewport: ViewportSize = {"width": size[0], "height": size[1]}
            context = browser.new_context(viewport=viewport, has_touch=touch, is_mobile=touch)
        else:
            context = beside.page.context
        if sound_waits:
            context.add_init_script(SOUND_WAITS)
        if remembers is not None:
            context.add_init_script(storing(remembers))
        one = Opened(context.new_page(), server.address, refusals)
        opened.append(one)
        if files:
            return one.begin_with(*files)
        one.go(path)
        return one

    yield open_page
    for one in opened:
        if request.node.stash.get(FAILED, False):
            print(one.account())
        one.page.context.close()
    assert [error for one in opened for error in one.errors] == []
