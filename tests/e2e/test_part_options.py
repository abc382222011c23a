"""The page's choice of a file's sequence, and the switches for written parts and for octaves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from tests.integration.scores import collection, song

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

COLLECTION = (("pieces.mid", "audio/midi", collection()), ("pieces.wav", "audio/wav", song(0.5)))
VALVES = "() => [1, 2, 3].filter((valve) => window.reina.parameter(`trumpet/valve/${valve}`)[0] > 0.5)"


def test_sequence_written_pitch_and_octaves_are_chosen_in_the_page(
    visit: Visit, client: httpx.Client
) -> None:
    opened = visit(size=(1100, 620)).open_files(*COLLECTION)
    page, path = opened.page, f"/api/v1/sessions/{opened.session}"

    def session() -> dict[str, Any]:
        return client.get(path).json()

    def seek(song_time_s: float) -> None:
        body = {"action": "seek", "song_time_s": song_time_s}
        opened.until_at_rest(client.post(f"{path}/transport", json=body, headers=opened.headers).json())

    options = page.get_by_role("group", name="How the file is taken")
    page.keyboard.press("p")
    page.get_by_text("the file holds 3 sequences").wait_for()
    lasts = session()["duration_s"]
    page.get_by_role("combobox", name="Sequence").select_option(label="2 of 3")
    page.get_by_text("8 notes").wait_for()
    page.get_by_text("the file holds 3 sequences").wait_for(state="detached")
    page.get_by_role("heading", name="Walk").wait_for()
    assert session()["sequence"] == 1
    assert session()["duration_s"] > lasts
    opened.until("(end) => Number(document.querySelector('[role=slider]').ariaValueMax) >= end", lasts)

    seek(0.25)
    assert page.evaluate(VALVES) == [1, 3], "C4, D4 on paper"
    written = page.get_by_role("switch", name="Written for B♭ trumpet")
    written.check()
    options.get_by_text("read as written for B♭ trumpet").wait_for()
    assert session()["written"] is True
    seek(0.25)
    assert page.evaluate(VALVES) == [], "B♭3, C4 on paper"

    client.patch(path, json={"transposition": -20}, headers=opened.headers).raise_for_status()
    options.get_by_text("more of its notes would be in range").wait_for()
    page.get_by_role("switch", name="Fit the octave").check()
    options.get_by_text("to come into range").wait_for()
    assert (session()["octave_fit"], session()["sounding_transposition"]) == (True, 2)
    written.uncheck()
    options.get_by_text("read as written for B♭ trumpet").wait_for(state="detached")
    assert session()["written"] is False
    beside = visit(f"/s/{opened.session}")
    beside.until_drawn()
    beside.page.keyboard.press("p")
    assert beside.page.get_by_role("switch", name="Fit the octave").is_disabled()
    assert beside.page.get_by_role("switch", name="Fit the octave").is_checked()


def test_another_player_is_chosen_in_the_page(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=(1100, 620)).open_files(*COLLECTION)
    path = f"/api/v1/sessions/{opened.session}"
    opened.page.keyboard.press("p")
    drawn = opened.measure("pictures")
    opened.page.get_by_role("combobox", name="Player").select_option(label="Soloist")
    opened.until("(drawn) => reina.pictures > drawn && reina.rigs[0] === 'soloist'", drawn)
    assert client.get(path).json()["player"] == "soloist"
