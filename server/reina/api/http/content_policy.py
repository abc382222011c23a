"""What a browser may do with an answer (Content Security Policy, level 3): by what kind of answer it is."""

from __future__ import annotations

import base64
import hashlib
from functools import lru_cache
from html.parser import HTMLParser
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

DATA_POLICY = "default-src 'none'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'; sandbox"
"""Of everything that is no page: opened by itself, it runs and loads nothing, and has no origin."""


class _Inline(HTMLParser):
    """Collects the texts of a document's scripts and styles that stand in it."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=False)
        self.texts: dict[str, list[str]] = {"script": [], "style": []}
        self._open: list[str] | None = None

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag in self.texts and not any(name == "src" for name, _ in attrs):
            self._open = self.texts[tag]
            self._open.append("")

    def handle_endtag(self, tag: str) -> None:
        if tag in self.texts:
            self._open = None

    def handle_data(self, data: str) -> None:
        if self._open is not None:
            self._open[-1] += data


def inline_hashes(document: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The sources that admit a document's own inline scripts, and its inline styles, and no others.

    Args:
        document: HTML.

    Returns:
        ``'sha256-...'`` of each script, and of each style.
    """
    parser = _Inline()
    parser.feed(document)
    parser.close()
    scripts, styles = (tuple(_source(text) for text in parser.texts[tag]) for tag in ("script", "style"))
    return scripts, styles


def _source(text: str) -> str:
    digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
    return f"'sha256-{digest}'"


@lru_cache(maxsize=32)
def _hashes_of(path: Path, modified_ns: int) -> tuple[tuple[str, ...], tuple[str, ...]]:  # noqa: ARG001 - a page that is built anew is read anew
    return inline_hashes(path.read_text("utf-8"))


def page_policy(path: Path, host: str, *, framed: bool = False, fetched: Sequence[str] = ()) -> str:
    """The policy of a page.

    Args:
        path: The page's document; read, so not for the event loop.
        host: The server's own name with its port, as the page asked for it; already known to be allowed.
        framed: Whether other sites may show it in a frame.
        fetched: Origins beside the server's own that it fetches from.
    """
    scripts, styles = _hashes_of(path, path.stat().st_mtime_ns)
    directives = {
        "default-src": ("'self'",),
        # Sound is stretched, and models are unpacked, by WebAssembly.
        "script-src": ("'self'", "'wasm-unsafe-eval'", *scripts),
        "style-src": ("'self'", *styles),
        # Attributes alone: sheet music and the API's viewer write some. They reach no other element.
        "style-src-attr": ("'unsafe-inline'",),
        "img-src": ("'self'", "data:", "blob:"),
        "media-src": ("'self'", "blob:"),
        # What engraves sheet music brings its signs so.
        "font-src": ("'self'", "data:"),
        "worker-src": ("'self'", "blob:"),
        # Not every browser takes the stream's scheme for the page's own; a model's pictures are blobs.
        "connect-src": ("'self'", f"ws://{host}", f"wss://{host}", "blob:", "data:", *fetched),
        "frame-src": ("'none'",),
        "object-src": ("'none'",),
        "base-uri": ("'none'",),
        "form-action": ("'self'",),
        "frame-ancestors": ("*",) if framed else ("'none'",),
    }
    return "; ".join(f"{name} {' '.join(sources)}" for name, sources in directives.items())
