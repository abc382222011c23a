"""The page's choice of sequence and joined parts, and the switches for written parts and for octaves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.e2e.waiting import add_style
from tests.integration.scores import collection, relay, song

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from numpy.typing import NDArray
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

COLLECTION = (("pieces.mid", "audio/midi", collection()), ("pieces.wav", "audio/wav", song(0.5)))
VALVES = "() => [1, 2, 3].filter((valve) => window.reina.parameter(`trumpet/valve/${valve}`)[0] > 0.5)"


def test_sequence_written_pitch_and_octaves_are_chosen_in_the_page(
    visit: Visit, client: httpx.Client
) -> None:
    opened = visit(size=(1100, 620), files=COLLECTION)
    page, path = opened.page, f"/api/v1/sessions/{opened.session}"

    def session() -> dict[str, Any]:
        return client.get(path).json()

    def seek(song_time_s: float) -> None:
        body = {"action": "seek", "song_time_s": song_time_s}
        opened.until_at_rest(client.post(f"{path}/transport", json=body, headers=opened.headers).json())

    options = page.get_by_role("group", name="How the file is taken")
    page.keyboard.press("p")
    page.get_by_text("The file holds 3 pieces").first.wait_for()
    lasts = session()["duration_s"]
    page.get_by_role("combobox", name="Piece").select_option(label="2 of 3")
    page.get_by_text("8 notes").wait_for()
    page.get_by_text("The file holds 3 pieces").first.wait_for(state="detached")
    page.get_by_role("heading", name="Walk", level=2).wait_for()
    assert session()["sequence"] == 1
    assert session()["duration_s"] > lasts
    opened.until("(end) => Number(document.querySelector('[role=slider]').ariaValueMax) >= end", lasts)

    seek(0.25)
    assert page.evaluate(VALVES) == [1, 3], "C4, D4 on paper"
    written = page.get_by_role("switch", name="Written for B♭ trumpet")
    written.check()
    options.get_by_text("Read as written for the trumpet").wait_for()
    assert session()["written"] is True
    seek(0.25)
    assert page.evaluate(VALVES) == [], "B♭3, C4 on paper"

    client.patch(path, json={"transposition": -20}, headers=opened.headers).raise_for_status()
    options.get_by_text("lie outside the trumpet's range").wait_for()
    page.get_by_role("switch", name="Fit the octave").check()
    options.get_by_text("into the trumpet's range").wait_for()
    assert (session()["octave_fit"], session()["sounding_transposition"]) == (True, 2)
    written.uncheck()
    options.get_by_text("Read as written for the trumpet").wait_for(state="detached")
    assert session()["written"] is False
    beside = visit(f"/s/{opened.session}")
    beside.until_drawn()
    beside.page.keyboard.press("p")
    assert beside.page.get_by_role("switch", name="Fit the octave").is_disabled()
    assert beside.page.get_by_role("switch", name="Fit the octave").is_checked()


def test_another_player_is_chosen_in_the_page(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=(1100, 620), files=COLLECTION)
    path = f"/api/v1/sessions/{opened.session}"
    opened.page.keyboard.press("p")
    drawn = opened.measure("pictures")
    opened.page.get_by_role("combobox", name="Figure").select_option(label="Soloist")
    opened.until("(drawn) => reina.pictures > drawn && reina.rigs[0] === 'soloist'", drawn)
    assert client.get(path).json()["player"] == "soloist"


def test_parts_are_joined_in_the_page(visit: Visit, client: httpx.Client) -> None:
    opened = visit(
        size=(1100, 620),
        files=(("relay.mid", "audio/midi", relay()), ("relay.wav", "audio/wav", song(0.5))),
    )
    page, path = opened.page, f"/api/v1/sessions/{opened.session}"

    def next_notes() -> list[str]:
        return page.locator(".notes .name").all_inner_texts()

    def blocks() -> float:
        """Which share of the picture are note blocks, where joined notes sound and the others are past."""
        pictures: list[NDArray[np.int16]] = []
        for visible in (True, False):
            keyframe = {"key": "k", "time": 0, "value": visible, "interpolation": "step"}
            track = f"{path}/show/tracks/blocks/visible"
            answer = client.put(track, json={"keyframes": [keyframe]}, headers=opened.headers)
            answer.raise_for_status()
            seek = {"action": "seek", "song_time_s": 1.25}
            answer = client.post(f"{path}/transport", json=seek, headers=opened.headers)
            opened.until_at_rest(answer.json())
            pictures.append(opened.picture())
        return float((np.abs(pictures[0] - pictures[1]).max(axis=2) > 40).mean())

    # What is said over the stage comes and goes.
    add_style(page, ".notices { visibility: hidden }")
    page.keyboard.press("p")
    assert next_notes() == ["G4", "A4"]
    without = blocks()
    summary = page.locator("summary", has_text="Play other parts too")
    summary.focus()
    page.keyboard.press("Enter")
    offered = page.get_by_role("group", name="Trumpet also plays").get_by_role("checkbox")
    assert offered.count() == 2, "the drums are not offered"
    page.keyboard.press("Tab")
    with page.expect_response(lambda answer: answer.request.method == "PUT"):
        page.keyboard.press("Space")
    page.get_by_text("Trumpet + Trumpet (muted)").wait_for()
    assert client.get(path).json()["joined_parts"] == [1]
    assert not client.get(f"{path}/transport").json()["playing"], "the key is the box's alone"
    # The notes come by another way than the choice of parts.
    joined = [note for note in client.get(f"{path}/score").json()["notes"] if note["player"] == 0]
    opened.until("(count) => window.reina.laneNotes[0] === count", len(joined))
    assert blocks() > without + 0.002, "the blocks of the joined notes are in the picture"
    client.post(f"{path}/transport", json={"action": "seek", "song_time_s": 0.0}, headers=opened.headers)
    # The drummer's part has a player too: whose notes these are takes the room of one.
    opened.until("() => document.querySelectorAll('.notes .name').length === 3")
    assert next_notes() == ["G4", "A4", "B4"]

    page.reload()
    opened.until_drawn()
    if not page.get_by_role("region", name="the piece").is_visible():
        page.keyboard.press("p")
    closed = page.locator("summary", has_text="Trumpet + Trumpet (muted)")
    closed.click()
    box = page.get_by_role("checkbox", name="Trumpet (muted)")
    assert box.is_checked()
    box.uncheck()
    page.locator("summary", has_text="Play other parts too").wait_for()
    assert client.get(path).json()["joined_parts"] == []
    opened.until("() => document.querySelectorAll('.notes .name').length === 2")
