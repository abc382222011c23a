"""What people do with files and keys: nothing is taken for something else, and nothing is lost."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.integration.scores import scale, show, song

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

WIDE = (1100, 620)
TONE = json.dumps(
    {
        "tracks": [
            {"name": "Trumpet", "notes": [{"midi": 60, "time": 0.5 * n, "duration": 0.4} for n in range(8)]}
        ]
    }
).encode()
CHORD = json.dumps(
    {
        "tracks": [
            {
                "name": "Trumpet",
                "notes": [
                    {"midi": 72, "time": 0, "duration": 0.5},
                    {"midi": 60, "time": 0, "duration": 2},
                    {"midi": 70, "time": 3, "duration": 0.5},
                ],
            }
        ]
    }
).encode()
"""The lower note of a chord is held on after the one that is played: for a while it would sound alone."""
SILENT_S = 1.0
SCALE = ("scale.mid", "audio/midi", scale(64))
"""Sixteen seconds."""


def session_of(opened: Opened, client: httpx.Client) -> dict[str, Any]:
    return client.get(f"/api/v1/sessions/{opened.session}").json()


def test_the_server_says_what_a_dropped_file_is(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=WIDE)
    page = opened.page
    opened.open_files(("tune.json", "application/json", TONE))
    assert session_of(opened, client)["notes"] == 8

    # A MIDI file that is called a song, and a show that is called a score.
    opened.open_files(("scale.wav", "audio/wav", scale(16)))
    assert session_of(opened, client)["notes"] == 16
    session = opened.session
    opened.choose_files(("score.mid", "audio/midi", show(3.0)))
    page.get_by_text("The show score.mid is on").wait_for()
    assert opened.session == session
    assert client.get(f"/api/v1/sessions/{session}/show").json()["title"] == "One light"

    opened.choose_files(("cover.json", "application/json", b"\x89PNG"))
    page.get_by_role("alert").get_by_text("cover.json cannot be used: it is a PNG picture").wait_for()
    page.get_by_role("alert").get_by_text("export MusicXML (.musicxml) or MIDI").wait_for()
    assert opened.session == session


def test_of_two_scores_one_is_opened_by_name_and_the_other_offered(
    visit: Visit, client: httpx.Client
) -> None:
    opened = visit(size=WIDE, files=(("first.mid", "audio/midi", scale(8)), SCALE))
    assert session_of(opened, client)["notes"] == 8
    opened.page.get_by_text("This is first.mid").wait_for()
    opened.page.get_by_text("scale.mid came with it").wait_for()
    first = opened.session
    opened.page.get_by_role("button", name="Open scale.mid").click()
    opened.until_another_session(first)
    assert session_of(opened, client)["notes"] == 64
    opened.page.get_by_text("This is first.mid").wait_for(state="detached")


def test_what_a_recording_is_of_is_asked_and_it_is_kept(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=WIDE, files=(SCALE,))
    page, first = opened.page, opened.session
    title = "Slow scale"
    path = f"/api/v1/sessions/{first}"
    client.patch(path, json={"title": title, "transposition": 2}, headers=opened.headers).raise_for_status()
    page.reload()
    opened.until_drawn()

    def asked(name: str, seconds: float) -> str:
        opened.choose_files((name, "audio/wav", song(seconds)))
        page.get_by_text(f"What is {name} a recording of?").wait_for()
        return page.locator(".notices .pane").inner_text()

    assert f"It lasts 0:01, {title} 0:20: hardly the same music." in asked("take 3.wav", 1.4)
    assert session_of(opened, client)["song"]["source"] == "rendered"
    page.get_by_role("button", name="Put away").click()

    assert f"It lasts 0:15, {title} 0:20." in asked("take 4.wav", 15.4)
    page.get_by_role("button", name=f"Play it with {title}").click()
    opened.until_another_session(first)
    told = session_of(opened, client)
    assert (told["song"]["source"], told["title"], told["transposition"]) == ("uploaded", title, 2)

    # One that is of another piece waits for its score.
    second = opened.session
    asked("take 5.wav", 2.0)
    page.get_by_role("button", name="Keep it for the next score").click()
    page.get_by_text("take 5.wav is kept").wait_for()
    opened.choose_files(("short.mid", "audio/midi", scale(8)))
    opened.until_another_session(second)
    told = session_of(opened, client)
    assert (told["song"]["source"], told["notes"]) == ("uploaded", 8)


def test_one_notice_at_a_time_beside_the_player_until_its_cause_is_past(visit: Visit) -> None:
    opened = visit(size=WIDE, files=(SCALE,), refusals=("ERR_FAILED", "ERR_CONNECTION", "ERR_INTERNET"))
    page = opened.page
    notices = page.locator(".notices .pane")

    page.keyboard.press("[")
    notices.get_by_text("The loop begins here").wait_for()
    page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("]")
    page.wait_for_selector(".loop")
    notices.get_by_text("The loop begins here").wait_for(state="detached")

    # What could not be done is said until the server answers again.
    page.route("**/transport", lambda route: route.abort())
    for key in ("Home", "l", "End"):
        # What is asked while the one before is on its way is dropped with it.
        with page.expect_event("requestfailed"):
            page.keyboard.press(key)
        opened.until("!window.reina.asking")
    notices.get_by_text("The server does not answer").wait_for()
    assert notices.count() == 1
    box, (width, height) = notices.bounding_box(), WIDE
    assert box is not None
    assert box["y"] > 0.4 * height
    assert box["x"] > 0.5 * width
    page.unroute("**/transport")
    page.keyboard.press("Home")
    notices.first.wait_for(state="detached")


def test_keys_act_wherever_the_pointer_was_and_add_up(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=(1300, 620), files=(SCALE,))
    page, path = opened.page, f"/api/v1/sessions/{opened.session}/transport"

    def until(expression: str, argument: object = None) -> None:
        opened.until(expression, argument)

    # Four at once are four steps, in time, in bars, in rate, in semitones.
    press = "([key, times]) => { for (let n = 0; n < times; n += 1) document.body.dispatchEvent("
    press += "new KeyboardEvent('keydown', {key, bubbles: true, cancelable: true})) }"
    page.evaluate(press, ["ArrowRight", 4])
    until("Math.abs(window.reina.songTime - 8) < 0.02")
    page.evaluate(press, ["ArrowLeft", 3])
    until("Math.abs(window.reina.songTime - 2) < 0.02")
    page.evaluate(press, ["-", 4])
    page.get_by_role("button", name="Speed 80 %").wait_for()
    page.get_by_role("button", name="Speed 80 %").click()
    page.evaluate(press, [" ", 2])
    until("async (path) => !(await (await fetch(path)).json()).playing", path)
    page.keyboard.press("p")
    higher = page.get_by_role("button", name="A semitone higher")
    higher.evaluate("(button) => { for (let n = 0; n < 4; n += 1) button.click() }")
    page.locator(".stepper").get_by_text("+4").wait_for()
    assert session_of(opened, client)["transposition"] == 4

    # After a click on the slider of the volume, arrows seek.
    slider = page.get_by_role("slider", name="Volume")
    slider.click()
    volume = slider.input_value()
    page.keyboard.press("Home")
    until("window.reina.songTime === 0")
    page.keyboard.press("ArrowRight")
    until("Math.abs(window.reina.songTime - 2) < 0.02")
    assert slider.input_value() == volume

    # After a click on Loop, Space plays, and the loop stays.
    page.get_by_role("button", name="Loop this phrase").click()
    page.wait_for_selector(".loop")
    page.keyboard.press("Space")
    until("window.reina.playing")
    assert page.locator(".loop").count() == 1
    page.keyboard.press("Space")
    until("!window.reina.playing")

    # After a choice in a menu, keys are the page's.
    player = page.get_by_role("combobox", name="Figure")
    player.scroll_into_view_if_needed()
    player.click()
    player.select_option(label="Soloist")
    until("reina.rigs[0] === 'soloist'")
    player.evaluate("(menu) => menu.blur()")
    page.mouse.click(*centre(player))
    page.keyboard.press("Escape")
    page.keyboard.press("m")
    page.get_by_role("button", name="Sound off", pressed=True).wait_for()

    # Who comes with Tab means the control.
    slider.focus()
    page.keyboard.press("Tab")
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("m")
    page.keyboard.press("ArrowLeft")
    assert float(slider.input_value()) < float(volume)


def centre(locator: Any) -> tuple[float, float]:
    box = locator.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_of_chords_what_is_played_is_listed_and_lit_and_the_rest_is_faint(
    visit: Visit, client: httpx.Client
) -> None:
    opened = visit(size=WIDE, files=(("chord.json", "application/json", CHORD),))
    page, path = opened.page, f"/api/v1/sessions/{opened.session}"
    notes = client.get(f"{path}/score").json()["notes"]
    played = [note for note in notes if note["valves"] is not None]
    assert [note["sounding_pitch"] for note in played] == [72, 70]
    assert len(notes) == 3
    assert page.locator(".notes li .name").count() == len(played)
    opened.hide_panels()

    def light(track: str, value: float | str, song_time_s: float) -> float:
        """How bright the blocks make the picture beyond the room: with them, less without them."""
        pictures: list[Any] = []
        for visible in (True, False):
            for name, at in ((track, value), ("blocks/visible", visible)):
                keyframe = {"key": "k", "time": 0, "value": at, "interpolation": "step"}
                address = f"{path}/show/tracks/{name}"
                client.put(address, json={"keyframes": [keyframe]}, headers=opened.headers).raise_for_status()
            seek = {"action": "seek", "song_time_s": song_time_s}
            opened.until_at_rest(client.post(f"{path}/transport", json=seek, headers=opened.headers).json())
            pictures.append(opened.picture().astype(float))
        return float(np.clip(pictures[0] - pictures[1], 0, None).max(axis=2).sum())

    # Where only notes sound that are not played, however much sounding notes glow, nothing does.
    glows = {
        at: [light("blocks/glow", glow, at) for glow in (0.0, 4.0)]
        for at in (played[0]["onset_s"] + 0.1, SILENT_S)
    }
    sounds, silent = glows.values()
    assert sounds[1] > 1.1 * sounds[0]
    assert silent[1] == pytest.approx(silent[0], rel=1e-3)


@pytest.mark.parametrize("size", [(820, 1180), (390, 844)], ids=["tablet", "phone"])
def test_the_next_notes_are_there_on_narrow_windows(visit: Visit, size: tuple[int, int]) -> None:
    opened = visit(size=size)
    opened.until_drawn()
    names = opened.page.locator(".notes li")
    assert names.count() >= 4
    for box in (names.first.bounding_box(), names.last.bounding_box()):
        assert box is not None
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= size[0]


def test_close_is_on_screen_on_a_phone_that_lies(visit: Visit) -> None:
    opened = visit(size=(844, 390))
    opened.until_drawn()
    opened.page.keyboard.press("s")
    opened.until("window.reina.show?.keyframes > 0")
    close = opened.page.get_by_role("button", name="Close the show")
    box = close.bounding_box()
    assert box is not None
    assert box["x"] + box["width"] <= 844
    close.click()
    opened.until("window.reina.show === undefined")


def test_nothing_shows_through_where_files_are_let_go(visit: Visit) -> None:
    opened = visit()
    opened.until_drawn()
    page = opened.page
    welcome = page.get_by_role("region", name="Welcome")
    welcome.wait_for()
    held = "(type) => document.body.dispatchEvent(Object.assign(new DragEvent(type, {bubbles: true,"
    held += " cancelable: true, dataTransfer: (() => { const data = new DataTransfer();"
    held += " data.items.add(new File(['x'], 'x.mid')); return data; })()})))"
    page.evaluate(held, "dragover")
    page.get_by_text("Let go").wait_for()
    welcome.wait_for(state="detached")
    page.evaluate(held, "dragleave")
    page.get_by_text("Let go").wait_for(state="detached")
    welcome.wait_for()
    assert re.search("Play", welcome.inner_text())
