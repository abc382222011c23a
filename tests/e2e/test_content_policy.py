"""Under the content policy every page works as ever, and nothing runs that is not the server's own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from tests.integration.scores import scale, song

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

MIDI = ("scale.mid", "audio/midi", scale(8))
WAV = ("scale.wav", "audio/wav", song(4.0))
LISTEN = """
window.violations = [];
addEventListener("securitypolicyviolation", ({ effectiveDirective, blockedURI, sourceFile, lineNumber }) => {
  window.violations.push([effectiveDirective, blockedURI, sourceFile, lineNumber].join(" "));
});
"""
INJECT = """() => {
  const script = document.createElement("script");
  script.textContent = "window.injected = true";
  document.body.append(script);
  const image = document.createElement("div");
  image.innerHTML = '<img src="data:," onerror="window.injected = true">';
  document.body.append(image);
  setTimeout("window.injected = true");
}"""
"""A script, an event handler and a text that is evaluated: three ways in."""


def listened(visit: Visit) -> Opened:
    """A page whose violations are kept from the first moment of what it goes to next."""
    opened = visit("/icon.svg")
    opened.page.add_init_script(LISTEN)
    return opened


def test_the_page_and_its_panels_break_no_rule(visit: Visit) -> None:
    opened = listened(visit).begin_with(MIDI, WAV)
    page = opened.page
    for key, panel in (
        ("g", "my pieces"),
        ("x", "practice"),
        ("t", "part"),
        ("r", "film"),
        ("v", "views"),
        ("s", "show"),
    ):
        page.keyboard.press(key)
        page.wait_for_load_state("networkidle")
        assert page.evaluate("window.violations") == [], panel
        page.keyboard.press(key)
    page.keyboard.press(" ")
    opened.until("window.reina.playing && window.reina.songTime > 0.2")
    page.keyboard.press(" ")
    assert page.evaluate("window.violations") == []


@pytest.mark.parametrize(
    ("path", "sign"), [("/lab", "[role=tab]"), ("/docs", ".opblock-tag"), ("/", "canvas")]
)
def test_other_pages_break_none_and_run_nothing_that_is_put_in(visit: Visit, path: str, sign: str) -> None:
    opened = listened(visit)
    opened.go(path)
    opened.page.locator(sign).first.wait_for()
    assert opened.page.evaluate("window.violations") == []
    opened.page.evaluate(INJECT)
    opened.until("window.violations.length >= 3")
    assert opened.page.evaluate("window.injected") is None
    assert all("the following Content Security Policy" in error for error in opened.errors), opened.errors
    opened.errors.clear()
