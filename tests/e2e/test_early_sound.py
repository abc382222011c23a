"""Sound that is heard while it is rendered, from its first segment and from where one seeks."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

import pytest
from tests.e2e.test_second_visit import PROBES, Traffic
from tests.integration.scores import scale

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from playwright.sync_api import Route
    from tests.e2e.opened import Opened

pytestmark = pytest.mark.browser

NOTES = 1200
BPM = 107.0
MAX_HELD_S = 62.0
"""Six segments of sound, decoded."""
MAX_FIRST_BYTES = 3_000_000


def held_back(route: Route) -> None:
    """Answer that a segment is not rendered yet."""
    href = urlsplit(route.request.url).path.rpartition("/")[0]
    segments = {"href": href, "media_type": "audio/ogg", "count": 9, "segment_s": 10.0, "overlap_s": 0.1}
    song = {"href": "", "status": "rendering", "source": "rendered", "media_type": "audio/flac"}
    route.fulfill(
        status=202, json={**song, "progress": 0.25, "segments": {**segments, "song_s": NOTES * 30 / BPM}}
    )


def test_the_sound_is_heard_from_where_it_is_rendered(
    visit: Callable[..., Opened], client: httpx.Client
) -> None:
    opened = visit()
    page = opened.page
    page.route("**/song/segments/**", held_back)
    opened.open_files(("long.mid", "audio/midi", scale(NOTES, bpm=BPM)))
    page.keyboard.press("Space")
    said = page.get_by_text("Starts with its sound")
    said.wait_for()
    clock = client.get(f"/api/v1/sessions/{opened.session}/transport").json()
    assert not clock["playing"], "Play waits for the sound"
    page.unroute("**/song/segments/**")
    opened.until("window.reina.playing && window.reina.soundLevel > 0.01")
    assert said.count() == 0
    opened.until("Math.abs(window.reina.soundAhead ?? 1) < 0.06")
    # Over a join and to far ahead: what is asked for comes first, and little is kept.
    for place in (9.0, 19.2, 300.0, 60.0):
        answer = client.post(
            f"/api/v1/sessions/{opened.session}/transport",
            json={"action": "seek", "song_time_s": place},
            headers=opened.headers,
        )
        assert answer.status_code == 200
        opened.until(
            "([place, epoch]) => window.reina.epoch >= epoch && window.reina.songTime > place + 1.5"
            " && window.reina.sound === 'ready' && window.reina.soundLevel > 0.01",
            [place, answer.json()["epoch"]],
        )
        assert opened.measure("soundHeld") < MAX_HELD_S
    page.keyboard.press("Space")


def test_a_sound_that_cannot_be_had_is_said_and_the_music_plays_without(visit: Callable[..., Opened]) -> None:
    opened = visit(refusals=("502",))
    page = opened.page
    problem = {
        "type": "no-song",
        "title": "There is no sound",
        "status": 502,
        "detail": "no song could be made",
    }
    page.route(
        "**/song/segments/**",
        lambda route: route.fulfill(
            status=502, content_type="application/problem+json", body=json.dumps(problem)
        ),
    )
    opened.open_files(("short.mid", "audio/midi", scale(40, bpm=131.0)))
    page.keyboard.press("Space")
    page.get_by_text("No sound: see Piece").wait_for()
    opened.until("window.reina.playing")


def test_a_browser_without_opus_takes_the_whole_as_flac(visit: Callable[..., Opened]) -> None:
    opened = visit()
    page = opened.page
    page.route(
        "**/song/segments/**",
        lambda route: route.fulfill(status=200, body=b"no sound", content_type="audio/ogg"),
    )
    with page.expect_response(
        lambda answer: urlsplit(answer.url).path.endswith("/song") and answer.ok
    ) as whole:
        opened.open_files(("short.mid", "audio/midi", scale(40, bpm=127.0)))
    assert whole.value.headers["content-type"] in {"audio/flac", "application/json"}
    page.keyboard.press("Space")
    opened.until("window.reina.playing && window.reina.sound === 'ready' && window.reina.soundLevel > 0.01")


def test_little_is_loaded_before_the_first_picture_and_less_the_second_time(
    visit: Callable[..., Opened],
) -> None:
    opened = visit("/lab")
    opened.page.goto("about:blank")
    traffic = Traffic(opened.page)
    # It is there before the page is loaded, and goes once the stage is seen.
    opened.go("/", wait_until="commit")
    opened.until("document.querySelector('#poster img')?.naturalWidth > 300")
    opened.until_drawn()
    first = sum(traffic.sizes.values())
    assert 300_000 < first < MAX_FIRST_BYTES
    opened.until("window.reina.sound !== 'coming' && window.reina.sound !== 'silent'")
    opened.until("document.querySelector('#poster') === null")
    opened.until("window.reina.soundShare === null")
    address = opened.page.url
    opened.page.goto("about:blank")
    again = Traffic(opened.page)
    opened.page.goto(address, wait_until="commit")
    opened.until("document.querySelector('#poster img')?.src.startsWith('data:image/jpeg')")
    opened.until_drawn()
    opened.until("window.reina.sound !== 'coming' && window.reina.sound !== 'silent'")
    probes = sum(size for _, size in again.of(PROBES))
    assert sum(again.sizes.values()) - probes < 50_000
    assert any("/song/segments/" in path for path in again.paths.values())
