"""What a browser that has been here before is sent: what it has is not sent again."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

import pytest
from tests.integration.scores import scale, song

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Page
    from tests.e2e.opened import Opened

pytestmark = pytest.mark.browser

NOT_MODIFIED = 304
WAV = song(12.0, rate=44_100)
PROBES = "/api/v1/health"
"""What is asked of the server's clock, the more the slower the way to it is: no part of what is shown."""
FILES = (".glb", ".woff2", ".js", ".css", "/song", "/score")
MAX_BYTES = 10_000
"""Headers of what is asked for, and the transport's state; the song alone has a megabyte."""


@dataclass
class Traffic:
    """What a page is sent over HTTP from now on, by request."""

    page: Page
    paths: dict[str, str] = field(default_factory=dict[str, str])
    statuses: dict[str, int] = field(default_factory=dict[str, int])
    """As they came over the wire; what the cache gave without asking has none."""
    sizes: dict[str, int] = field(default_factory=dict[str, int])
    """Bytes, headers included, of what is complete."""

    def __post_init__(self) -> None:
        devtools: Any = self.page.context.new_cdp_session(self.page)
        devtools.on("Network.requestWillBeSent", self._asked)
        devtools.on("Network.responseReceivedExtraInfo", self._answered)
        devtools.on("Network.loadingFinished", self._complete)
        devtools.send("Network.enable")

    def _asked(self, event: dict[str, Any]) -> None:
        self.paths[event["requestId"]] = urlsplit(str(event["request"]["url"])).path

    def _answered(self, event: dict[str, Any]) -> None:
        self.statuses[event["requestId"]] = event["statusCode"]

    def _complete(self, event: dict[str, Any]) -> None:
        self.sizes[event["requestId"]] = int(event["encodedDataLength"])

    def of(self, path: str) -> list[tuple[int | None, int]]:
        """Status on the wire and size of each complete answer of an address."""
        return [
            (self.statuses.get(request), size)
            for request, size in self.sizes.items()
            if self.paths.get(request) == path
        ]


def until_heard(opened: Opened) -> None:
    """Wait until the stage is drawn and the song is decoded, which a key sets off."""
    opened.until_drawn()
    opened.page.keyboard.press("Space")
    opened.until("window.reina.sound === 'ready'")


def test_a_second_visit_is_sent_no_file_again(visit: Callable[..., Opened]) -> None:
    opened = visit().open_files(("scale.mid", "audio/midi", scale(32)), ("scale.wav", "audio/wav", WAV))
    until_heard(opened)
    address = f"/s/{opened.session}"
    opened.page.goto("about:blank")
    traffic = Traffic(opened.page)
    opened.go(address)
    until_heard(opened)
    files = {path for path in traffic.paths.values() if path.endswith(FILES)}
    assert {ending for ending in FILES if any(path.endswith(ending) for path in files)} == set(FILES)
    for path in files:
        for status, _ in traffic.of(path):
            assert status in {None, NOT_MODIFIED}, path
    asked = set(traffic.paths.values()) - {PROBES}
    assert sum(size for path in asked for _, size in traffic.of(path)) < MAX_BYTES
