"""Files on their way: how far they are, what ends them, and what is left of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from playwright.sync_api import expect
from tests.e2e.test_accessibility import faults
from tests.integration.scores import duet, scale, song

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from playwright.sync_api import Route
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

DUET = (("duet.mid", "audio/midi", duet()), ("duet.wav", "audio/wav", song(4.0)))
LONG = (("long.mid", "audio/midi", scale(32)), ("long.wav", "audio/wav", song(60.0)))
SLOW_BYTES = 20_000
"""Bytes a second: the long recording takes a minute."""
OF_THE_RECORDING = "not this score's music"
"""What the page says of the duet, whose recording is a tone."""
BUSY: dict[str, Any] = {
    "type": "urn:reina:problem:too-many",
    "title": "Too Many Requests",
    "status": 429,
    "detail": "too many uploads at once",
    "errors": [],
}


def throttle(opened: Opened, bytes_per_second: int) -> None:
    """Let everything leave the page as slowly as this."""
    devtools: Any = opened.page.context.new_cdp_session(opened.page)
    devtools.send("Network.enable")
    speed = {"downloadThroughput": -1, "uploadThroughput": bytes_per_second}
    devtools.send("Network.emulateNetworkConditions", {"offline": False, "latency": 0, **speed})


def test_an_upload_says_how_far_it_is_and_leaves_nothing_where_it_is_cancelled(visit: Visit) -> None:
    opened = visit(files=DUET, refusals=("net::ERR_",))
    page, before = opened.page, opened.session
    throttle(opened, SLOW_BYTES)
    opened.choose_files(*LONG)
    bar = page.get_by_role("progressbar", name="Sending long.mid and long.wav")
    bar.wait_for()
    opened.until("Number(document.querySelector('[role=progressbar]')?.getAttribute('aria-valuenow')) > 0")
    page.get_by_text(" % of ").wait_for()
    cancel = page.get_by_role("button", name="Cancel sending long.mid and long.wav")
    cancel.focus()
    with page.expect_event("requestfailed") as broken_off:
        page.keyboard.press("Escape")
    assert broken_off.value.url.endswith("/api/v1/sessions")
    bar.wait_for(state="detached")
    told = page.locator(".notice").filter(has_not_text=OF_THE_RECORDING)
    assert told.count() == 0, "whoever gives it up need not be told"
    assert opened.session == opened.measure("session") == before
    assert page.evaluate("document.activeElement.tagName") == "CANVAS", "the focus is not lost"
    page.keyboard.press("Space")
    opened.until("window.reina.playing && window.reina.drawnIndex > 5")


def test_what_is_cancelled_while_the_server_reads_it_is_taken_back(visit: Visit) -> None:
    opened = visit(files=DUET)
    page, before = opened.page, opened.session
    # The answer is held: of a request that is held nothing leaves.
    held: list[dict[str, Any]] = []
    devtools: Any = page.context.new_cdp_session(page)

    def hold(paused: dict[str, Any]) -> None:
        held.append(paused)

    devtools.on("Fetch.requestPaused", hold)
    answers = {"urlPattern": "*/api/v1/sessions", "requestStage": "Response"}
    devtools.send("Fetch.enable", {"patterns": [answers]})
    opened.choose_files(*LONG)
    page.get_by_text("The server is reading it").first.wait_for()
    assert faults(opened) == []
    page.get_by_role("button", name="Cancel sending").click()
    page.get_by_role("progressbar").wait_for(state="detached")
    with page.expect_response(lambda answer: answer.request.method == "DELETE") as removed:
        while not held:
            page.wait_for_timeout(50)
        devtools.send("Fetch.continueRequest", {"requestId": held[0]["requestId"]})
    assert removed.value.status == 204
    assert opened.session == opened.measure("session") == before


def test_what_did_not_get_there_is_sent_again_without_choosing_it_anew(visit: Visit) -> None:
    opened = visit(files=DUET, refusals=("net::ERR_", "429", "WebSocket connection to"))
    page, before = opened.page, opened.session
    # First nobody answers, then the server is busy.
    page.route("**/api/v1/sessions", lambda route: route.abort("connectionreset"), times=1)
    opened.choose_files(*LONG)
    failed = page.get_by_role("group", name="long.mid and long.wav did not get there")
    failed.wait_for()
    expect(failed).to_contain_text("The server does not answer")
    assert opened.measure("session") == before
    busy = {"Retry-After": "5"}
    page.route(
        "**/api/v1/sessions", lambda route: route.fulfill(status=429, json=BUSY, headers=busy), times=1
    )
    again = failed.get_by_role("button", name="Send again")
    again.press("Enter")
    expect(failed).to_contain_text("The server is busy: too many uploads at once.")
    expect(again, "the focus is not lost").to_be_focused()
    opened.until_nothing_overflows()
    assert faults(opened) == []
    failed.get_by_role("button", name="Send again").click()
    opened.until_another_session(before)
    page.get_by_role("group", name="long.mid").wait_for(state="detached")


def test_a_busy_server_is_asked_again_by_itself(visit: Visit) -> None:
    opened = visit(files=DUET, refusals=("429", "503"))
    page = opened.page
    answers = iter((429, 503))

    def refuse(route: Route) -> None:
        status = next(answers, None)
        if status is None:
            route.continue_()
        else:
            route.fulfill(status=status, json=BUSY | {"status": status}, headers={"Retry-After": "60"})

    page.route("**/api/v1/sessions/*/score", refuse)
    page.reload()
    for _ in range(2):
        page.get_by_text("Trying again in").wait_for()
        expect(page.locator(".notice")).to_contain_text("The server is busy")
        assert faults(opened) == []
        page.get_by_role("button", name="Try now").click()
    opened.until_drawn()
    page.get_by_text("The server is busy").wait_for(state="detached")


def test_a_change_that_did_not_get_there_is_told_and_can_be_sent_again(
    visit: Visit, client: httpx.Client
) -> None:
    opened = visit(size=(1100, 620), files=DUET, refusals=("net::ERR_",))
    page = opened.page
    page.keyboard.press("p")

    def lose_the_change(route: Route) -> None:
        if route.request.method == "PUT" and not lost:
            lost.append(route)
            route.abort("connectionreset")
        else:
            route.continue_()

    lost: list[Route] = []
    page.route(f"**/api/v1/sessions/{opened.session}/cast", lose_the_change)
    parts = page.get_by_role("group", name="Part for the trumpet")
    parts.get_by_role("radio", checked=True).focus()
    page.keyboard.press("ArrowDown")
    page.get_by_text("This was not changed").wait_for()
    assert client.get(f"/api/v1/sessions/{opened.session}").json()["part"] == 1
    with page.expect_response(lambda answer: answer.request.method == "PUT"):
        page.get_by_role("button", name="Send again").click()
    parts.get_by_role("radio", name="Flute", checked=True).wait_for()
    assert client.get(f"/api/v1/sessions/{opened.session}").json()["part"] == 0
