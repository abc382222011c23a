"""Waiting for a page's own signs, and styles put into it, in ways that its content policy allows.

Playwright's `wait_for_function` has the page evaluate a text, and `add_style_tag` puts a style into the
document: a page that runs nothing but its own files does neither.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from playwright.sync_api import Error
from playwright.sync_api import TimeoutError as LateError

if TYPE_CHECKING:
    from playwright.sync_api import Page

LEFT = "Execution context was destroyed"
"""What is said of a page that has gone elsewhere in the middle of a question; it is asked anew there."""
WAIT = """async ([patience, argument]) => {
  const end = performance.now() + patience;
  for (;;) {
    const sign = (EXPRESSION);
    if (await (typeof sign === "function" ? sign(argument) : sign)) return true;
    if (performance.now() > end) return false;
    await new Promise((done) => setTimeout(done, 50));
  }
}"""
STYLE = """(text) => {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(text);
  document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];
}"""


def wait_until(page: Page, expression: str, argument: Any = None, *, patience_s: float) -> None:
    """Wait for a JavaScript expression of the page, or a function of the argument, to be true.

    Raises:
        LateError: It is not, in all that time.
    """
    end = time.monotonic() + patience_s
    while True:
        try:
            script = WAIT.replace("EXPRESSION", expression)
            if page.evaluate(script, [max(end - time.monotonic(), 0) * 1000, argument]):
                return
        except Error as error:
            if LEFT in error.message:
                continue
            raise
        raise LateError(f"after {patience_s:g} s this is not so: {expression}")


def add_style(page: Page, text: str) -> None:
    """Have the page look otherwise."""
    page.evaluate(STYLE, text)
