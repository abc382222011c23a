"""Views, lights and quality that are chosen without the editor."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.integration.scores import scale, song

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

MIDI = ("scale.mid", "audio/midi", scale(8))
WAV = ("scale.wav", "audio/wav", song(4.0))
INSET = (slice(68, 188), slice(624, 744))
"""Rows and columns of the small picture in a window of 760 × 430."""


def test_views_lights_and_quality(visit: Visit, client: httpx.Client) -> None:
    opened = visit(files=(MIDI, WAV))
    page = opened.page

    # The keys 3 and 6 go to the valves and to the hall, C back to the show.
    page.keyboard.press("3")
    opened.until("window.reina.drawnFrom[2] < 1.2")
    page.keyboard.press("6")
    opened.until("window.reina.drawnFrom[2] > 5")
    page.keyboard.press("c")

    # A light is the show's own from then on, and can be taken back.
    before = opened.parameter("lights/spots/1/intensity")
    page.keyboard.press("v")
    panel = page.get_by_role("region", name="views and light")
    panel.get_by_role("button", name="One spot").click()
    opened.until("window.reina.parameter('lights/spots/1/intensity')[0] === 7")
    opened.until("window.reina.parameter('lights/key/intensity')[0] === 0")
    tracks = client.get(f"/api/v1/sessions/{opened.session}/show").json()["tracks"]
    lit = {track["parameter"] for track in tracks if track["parameter"].startswith("lights/")}
    (mood,) = [one for one in client.get("/api/v1/moods").json()["moods"] if one["name"] == "one_spot"]
    assert lit == set(mood["values"])
    panel.get_by_role("button", name="Back to the light before").click()
    opened.until("(before) => window.reina.parameter('lights/spots/1/intensity')[0] === before", before[0])

    # Quality by hand: the stage is made anew, in the same session.
    session = opened.session
    panel.get_by_role("button", name="Low", exact=True).click()
    opened.until("window.reina.drawn === true")
    assert opened.session == session
    assert page.evaluate("JSON.parse(localStorage.reina).quality") == "low"
    page.keyboard.press("Escape")

    # The small picture shows other things than the stage has there, and goes again.
    opened.hide_panels()
    plain = opened.picture()[INSET]
    drawn = opened.measure("pictures")
    page.keyboard.press("i")
    opened.until("document.querySelector('.inset') !== null")
    opened.until_redrawn(drawn)
    inset = opened.picture()[INSET]
    assert np.abs(inset - plain).mean() > 8
    drawn = opened.measure("pictures")
    page.keyboard.press("i")
    opened.until("document.querySelector('.inset') === null")
    opened.until_redrawn(drawn)
    assert np.abs(opened.picture()[INSET] - plain).mean() < 3


def test_who_watches_looks_around_and_leaves_the_light(visit: Visit) -> None:
    opened = visit(files=(MIDI, WAV))
    watching = visit(f"/s/{opened.session}")
    watching.until_drawn()
    watching.page.keyboard.press("v")
    panel = watching.page.get_by_role("region", name="views and light")
    assert panel.get_by_role("button", name="Night").is_disabled()
    panel.get_by_role("button", name="Hall").click()
    watching.until("window.reina.drawnFrom[2] > 5")
