"""The page in German and Japanese: found by the browser's language, chosen by hand, and never too wide."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from tests.e2e.opened import OVERFLOWING

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Locator, ViewportSize
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

PANELS = {
    "de": {
        "g": ("Meine Stücke", "Dieses Stück teilen"),
        "v": ("Ansichten und Licht", "Schräg vorn"),
        "r": ("Film", "Film erstellen"),
        "t": ("Das Notenblatt", "Grifftabelle"),
        "p": (None, "Nur übliche Griffe"),
        "s": ("Die Show", "Kamera"),
        "?": ("Tasten", "Solange die Show offen ist"),
    },
    "ja": {
        "g": ("マイ曲集", "この曲を共有"),
        "v": ("視点と照明", "斜め前"),
        "r": ("動画", "動画を作る"),
        "t": ("パート譜", "運指表"),
        "p": (None, "ふつうの運指だけ"),
        "s": ("演出", "カメラ"),
        "?": ("キー操作", "演出を開いている間"),
    },
    "en": {"g": ("my pieces", "Share this piece")},
}
"""By the key that opens it, each panel's name and a word that stands in it."""
BROWSER_LANGUAGES = (
    """Object.defineProperty(navigator, "languages", { get: () => ["fr-CH", "de-CH", "en"] })"""
)
NAMES = {"de": "Sprache", "ja": "言語", "en": "Language"}
WIDE: ViewportSize = {"width": 1440, "height": 560}
NARROW: ViewportSize = {"width": 390, "height": 640}


def panel(opened: Opened, name: str | None) -> Locator:
    if name is None:
        return opened.page.locator(".pane").filter(has=opened.page.get_by_role("switch"))
    return opened.page.get_by_role("region", name=name, exact=True)


def look_through(opened: Opened, code: str) -> None:
    """Open one panel after another, in the language and no wider than the window."""
    for key, (name, word) in PANELS[code].items():
        opened.page.keyboard.press(key)
        shown = panel(opened, name)
        # On a narrow page the tabs of the part have shorter words.
        if key == "t" and opened.page.viewport_size == NARROW:
            shown.wait_for()
        else:
            shown.get_by_text(word).first.wait_for()
        # The notes that have room are counted anew once the window has another size.
        opened.until(f"({OVERFLOWING})().length === 0")
        opened.page.keyboard.press(key)
        shown.wait_for(state="detached")


def test_the_page_speaks_the_language_that_is_chosen(visit: Visit) -> None:
    opened = visit("/?lang=de", size=(WIDE["width"], WIDE["height"]))
    page = opened.page
    html = page.locator("html")
    assert html.get_attribute("lang") == "de"
    opened.until_drawn()
    before = NAMES["de"]
    for code in ("de", "ja", "en"):
        page.get_by_label(before, exact=True).select_option(code)
        page.get_by_label(NAMES[code], exact=True).wait_for(state="attached")
        before = NAMES[code]
        assert html.get_attribute("lang") == code
        for size in (WIDE, NARROW):
            page.set_viewport_size(size)
            look_through(opened, code)
        page.set_viewport_size(WIDE)

    # What is chosen by hand holds against the address and the browser from then on.
    page.get_by_label("Language", exact=True).select_option("ja")
    page.get_by_label("言語", exact=True).wait_for(state="attached")
    assert "lang=" not in page.url
    assert page.evaluate("JSON.parse(localStorage.reina).language") == "ja"


def test_a_browser_in_german_gets_german_from_the_first_sentence_on(visit: Visit) -> None:
    opened = visit("/?lang=ja")
    page = opened.page
    # The first sentence stands before any script has come.
    page.context.add_init_script(BROWSER_LANGUAGES)
    page.route("**/assets/*.js", lambda route: route.abort())
    opened.go("/")
    page.get_by_text("Dein MIDI, gespielt an Trompete und Schlagzeug, mit echten Griffen").wait_for()
    page.unroute("**/assets/*.js")
    opened.errors.clear()
    opened.go("/")
    opened.until_drawn()
    assert page.locator("html").get_attribute("lang") == "de"
    page.get_by_role("button", name="Das Notenblatt").wait_for()
    page.keyboard.press("t")
    page.get_by_text("E-Dur").first.wait_for()
    # A German player's B is B flat, and H is B natural.
    page.get_by_role("tab", name="Grifftabelle").click()
    shown = page.locator(".chart .names")
    shown.first.wait_for()
    names = shown.all_inner_texts()
    assert "h′" in names
    assert any(name.startswith("b′") or name.endswith("b′") for name in names)
