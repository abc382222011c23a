"""A page behind nginx goes on with sound and picture where the server that it watches is killed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import httpx
import pytest
from tests.e2e.test_missing_blocks import STANDS_MS, Watched
from tests.integration.replicas import replicas
from tests.integration.scores import scale, song
from tests.integration.server import upload
from tests.servers.proxies import replicas_proxy

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser
    from tests.servers.postgresql import PostgreSQL

pytestmark = pytest.mark.browser

WATCHED_MS = 6000


@pytest.mark.parametrize("origin", ["", "self"])
def test_the_picture_goes_on_where_a_server_is_killed(
    browser: Browser, tmp_path: Path, postgresql_server: PostgreSQL, origin: str
) -> None:
    with replicas(tmp_path, postgresql_server, page=True, settings={"REINA_BLOCKS_ORIGIN": origin}) as made:
        ports = [int(server.address.rpartition(":")[2]) for server in made.servers]
        with (
            replicas_proxy(ports, tmp_path) as through,
            httpx.Client(base_url=through.address, timeout=30.0) as client,
        ):
            sent = {"song": ("s.wav", song(60.0))}
            owned = upload(client, scale(400, bpm=120.0), "scale.mid", **sent, in_time="true")
            watched = Watched(browser, through.address, owned)
            streams: list[str] = []
            watched.opened.page.on("websocket", lambda opened: streams.append(opened.url))
            # Of streams, nginx gives the first to the first.
            made.servers[0].process.kill()
            assert watched.longest_stand_ms(WATCHED_MS) < STANDS_MS
            assert len(streams) >= 1, "it was this server's"
            state = client.get(f"{owned.path}/transport").json()
            shown = watched.opened.page.evaluate("window.reina.songTime")
            assert abs(shown - state["song_time_s"]) < 1.0
            watched.opened.until("window.reina.playing && window.reina.ahead > 1.5")
            owned.control("pause")
            watched.opened.until("!window.reina.playing")
            watched.close()
            # What was under way when the server died is told by the browser itself.
            told = [error for error in watched.opened.errors if "WebSocket" not in error]
            assert [error for error in told if "502" not in error] == []
