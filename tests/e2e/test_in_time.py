"""A recording and a score of another tempo, dropped together: found by itself, and put right by hand."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import pytest
import soundfile
from tests.e2e.test_accessibility import faults
from tests.unit.sound.alignment.renditions import RATE, SCORES, Rendition, record
from tests.unit.sound.recording.coded import as_coded

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

SCORE = "ode-to-joy.json"
LEAD_IN_S, SLOWER = 2.0, 1.2
SIZE = (800, 600)


def recording() -> bytes:
    """The piece, slower, after silence, as FLAC."""
    made = record(Rendition(SCORE.removesuffix(".json"), tempo=(SLOWER, 0.0), lead_in_s=LEAD_IN_S))
    file = io.BytesIO()
    with soundfile.SoundFile(file, "w", samplerate=RATE, channels=1, format="FLAC", subtype="PCM_16") as flac:
        flac.write(made.samples[:, None])
    return file.getvalue()


def test_a_dropped_recording_is_found_and_put_right_by_hand(visit: Visit, client: httpx.Client) -> None:
    score = (SCORES / SCORE).read_bytes()
    files = ((SCORE, "application/json", score), ("ode.flac", "audio/flac", recording()))
    opened = visit(files=files, size=SIZE, refusals=("404", "422"))
    page = opened.page
    page.get_by_text("In time with the recording · ").first.wait_for()

    def kept() -> dict[str, Any]:
        return client.get(f"/api/v1/sessions/{opened.session}/alignment").json()

    bars = kept()["bars"]
    page.keyboard.press("h")
    panel = page.get_by_role("region", name="score and recording")
    status = panel.get_by_role("status").first
    status.get_by_text("In time with the recording · ").wait_for()
    panel.get_by_text("The music begins at 0:0").wait_for()
    first = bars[0]["beats"][0]["song_s"]
    assert first == pytest.approx(LEAD_IN_S, abs=0.1)

    # What the transport says follows the score as it is heard now.
    at = bars[4]["beats"][0]["song_s"] + 0.05
    answer = client.post(
        f"/api/v1/sessions/{opened.session}/transport",
        json={"action": "seek", "song_time_s": at},
        headers=opened.headers,
    )
    opened.until_at_rest(answer.json())
    place = page.get_by_title("Bar and beat")
    place.get_by_text("5·1").wait_for()

    offset = panel.get_by_role("spinbutton", name="Move everything")
    panel.get_by_role("button", name="10 ms later").click()
    page.locator("section[data-offset='0.01']").wait_for()
    assert kept()["alignment"]["offset_s"] == 0.01
    offset.fill("9999")
    offset.press("Enter")
    panel.get_by_role("alert").get_by_text("out of the song").wait_for()
    beat = bars[4]["beats"][1]["song_s"] - bars[4]["beats"][0]["song_s"]
    offset.fill(f"{beat:.3f}")
    offset.press("Enter")
    place.get_by_text("4·4").wait_for()
    assert faults(opened) == []
    undo = panel.get_by_role("button", name="Undo")
    undo.click()
    undo.click()
    page.locator("section[data-offset='0']").wait_for()
    place.get_by_text("5·1").wait_for()

    # A bar line is dragged; those beside it stay.
    line = panel.get_by_role("slider")
    box = line.bounding_box()
    assert box is not None
    song_s = kept()["song_duration_s"]
    x = box["x"] + box["width"] * bars[8]["beats"][0]["song_s"] / song_s
    y = box["y"] + box["height"] - 10
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 6, y, steps=3)
    page.mouse.up()
    page.locator("section[data-anchors='3']").wait_for()
    now = kept()["bars"]
    moved = [
        bar["number"]
        for bar, before in zip(now, bars, strict=True)
        if abs(bar["beats"][0]["song_s"] - before["beats"][0]["song_s"]) > 0.005
    ]
    assert moved == [bars[8]["number"]]
    by = 6 * song_s / box["width"]
    assert now[8]["beats"][0]["song_s"] - bars[8]["beats"][0]["song_s"] == pytest.approx(by, rel=0.2)
    undo.click()
    page.locator("section[data-anchors='0']").wait_for()
    assert kept()["alignment"]["anchors"] == []


def test_what_the_server_does_not_decode_is_decoded_here(visit: Visit, client: httpx.Client) -> None:
    """A WebM in another key, which the players then follow."""
    made = record(
        Rendition(SCORE.removesuffix(".json"), (SLOWER, 0.0), lead_in_s=LEAD_IN_S, transposition=-2)
    )
    song = as_coded(made.samples, RATE, "webm")
    score = (SCORES / SCORE).read_bytes()
    files = ((SCORE, "application/json", score), ("ode.webm", "audio/webm", song))
    opened = visit(files=files, size=SIZE, refusals=("404",))
    page = opened.page
    page.get_by_text("In time with the recording · ").first.wait_for()
    page.keyboard.press("h")
    panel = page.get_by_role("region", name="score and recording")
    panel.get_by_role("button", name="Look again").wait_for()
    told = client.get(f"/api/v1/sessions/{opened.session}/alignment").json()
    assert (told["status"], told["is_searchable"]) == ("found", True)
    assert told["bars"][0]["beats"][0]["song_s"] == pytest.approx(LEAD_IN_S, abs=0.1)
    assert told["song_duration_s"] == pytest.approx(len(made.samples) / RATE, abs=0.1)
    assert client.get(f"/api/v1/sessions/{opened.session}/song").content == song

    def first_pitch() -> int:
        score = client.get(f"/api/v1/sessions/{opened.session}/score").json()
        return score["notes"][0]["sounding_pitch"]

    written = first_pitch()
    panel.get_by_text("The recording sounds 2 semitones lower.").wait_for()
    fingered = panel.get_by_role("combobox", name="Notes and fingering")
    fingered.select_option("as the recording sounds: 2 semitones lower")
    page.locator("section[data-key='recording']").wait_for()
    assert first_pitch() == written - 2
    assert faults(opened) == []
    panel.get_by_role("button", name="Undo").click()
    page.locator("section[data-key='score']").wait_for()
    assert first_pitch() == written
