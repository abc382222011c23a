"""A server that asks who uploads: the page asks for the password; a person's pieces are found anywhere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect
from tests.e2e.conftest import SMALL
from tests.e2e.opened import NOWHERE, Opened
from tests.e2e.test_accessibility import faults
from tests.integration.scores import scale, song
from tests.integration.server import serve

from reina.system.passwords import hash_password

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser

pytestmark = pytest.mark.browser

PASSWORD = "correct horse"
MIDI = ("scale.mid", "audio/midi", scale(8))
WAV = ("scale.wav", "audio/wav", song(4.0))


def opened_in(browser: Browser, address: str) -> Opened:
    """The page in a browser that has never been here, where no session is."""
    context = browser.new_context(viewport={"width": SMALL[0], "height": SMALL[1]})
    # The browser says of each refusal that it was one.
    opened = Opened(context.new_page(), address, refusals=("401",))
    opened.go(NOWHERE)
    opened.page.get_by_role("heading", name="This session is not here").wait_for()
    return opened


def sign_in(opened: Opened, password: str) -> None:
    dialog = opened.page.get_by_role("dialog", name="Sign in")
    dialog.get_by_role("textbox", name="Name").fill("ada")
    dialog.get_by_role("textbox", name="Password").fill(password)
    dialog.get_by_role("button", name="Sign in").click()


def test_uploads_wait_for_the_password_and_pieces_follow_a_person(browser: Browser, tmp_path: Path) -> None:
    file = tmp_path / "people"
    file.write_text(f"ada:{hash_password(PASSWORD)}\n")
    with serve(tmp_path / "data", settings={"REINA_UPLOAD_PASSWORD_FILE": file}) as running:
        first = opened_in(browser, running.address)
        first.choose_files(MIDI, WAV)
        sign_in(first, "wrong password")
        dialog = first.page.get_by_role("dialog", name="Sign in")
        expect(dialog.get_by_role("alert")).to_contain_text("do not match")
        expect(dialog.get_by_role("textbox", name="Password")).to_be_focused()
        assert faults(first) == []
        sign_in(first, PASSWORD)
        first.until("window.reina?.session && window.reina.drawn")
        expect(dialog).to_have_count(0)
        assert first.page.evaluate("document.cookie") == "", "no script can read it"

        # Elsewhere, where no token ever was.
        second = opened_in(browser, running.address)
        given = {"name": "ada", "password": PASSWORD}
        own = {"Origin": running.address}
        answer = second.page.request.post(f"{running.api}/sign-in", data=given, headers=own)
        assert answer.ok
        second.go(f"/s/{first.session}")
        second.until_drawn()
        assert not second.page.get_by_text("Watching", exact=True).is_visible()
        second.page.keyboard.press(" ")
        first.until("window.reina.playing === true")
        second.page.keyboard.press("g")
        panel = second.page.get_by_role("region", name="my pieces")
        expect(panel.get_by_role("listitem")).to_have_count(1)
        expect(panel.get_by_text("Signed in as ada")).to_be_visible()
        panel.get_by_role("button", name="Sign out").click()
        expect(panel.get_by_text("Signed in as ada")).to_have_count(0)
        assert second.page.request.get(f"{running.api}/sign-in").json()["signed_in"] is False

        # Whoever would rather not is told what the server wants, and nothing besides.
        second.go("/")
        second.page.get_by_role("dialog", name="Sign in").wait_for()
        second.page.keyboard.press("Escape")
        second.page.get_by_role("heading", name="Sign in to play here").wait_for()
        expect(second.page.locator("#poster")).to_have_count(0)
        expect(second.page.locator(".notices .pane")).to_have_count(0)
        assert faults(second) == []
        for one in (first, second):
            one.page.context.close()
            assert one.errors == []
