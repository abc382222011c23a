"""What the page tells of a score: the next notes and their fingerings, what was repaired, why a part."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from tests.integration.scores import duet, song, sung
from tests.unit.music.musicxml import musicxml_text as xml

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

PHONE = (390, 700)
NARROW = (420, 500)
"""The strip of next notes has its own line in a narrow window."""
REPAIRED = ("repaired.mid", "audio/midi", b"junk" + duet()[:-3])
SONG = xml.document(
    xml.measures(
        xml.attributes(extra=xml.B_FLAT) + xml.words("softly")
        + xml.note("C5", 2, inner=xml.lyric("begin", "Hal"))
        + xml.note("D5", 2, inner=xml.lyric("end", "lo,")),
        xml.note("E5", 4, inner=xml.lyric("single", "you", "<end-line/>")),
        xml.direction("<rehearsal>Refrain</rehearsal>") + xml.note("F5", 4, inner=xml.lyric("single", "la")),
        xml.note("G5", 4),
    )
)  # fmt: skip
WRITTEN = [("G4", "open"), ("A4", "1 and 2"), ("B4", "2"), ("C5", "open")]
SOUNDING = ["F4", "G4", "A4", "B♭4"]
STRIP = """() => [...document.querySelectorAll("ol.notes li")].map((note) => [
  note.querySelector(".name").textContent,
  note.querySelector(".valves").ariaLabel.replace("valves: ", ""),
  note.classList.contains("sounding"),
])"""


def test_the_page_tells_how_it_read_a_score(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=NARROW, files=(REPAIRED,))
    page = opened.page
    path = f"/api/v1/sessions/{opened.session}"

    def strip() -> list[tuple[str, str, bool]]:
        return [tuple(note) for note in page.evaluate(STRIP)]

    def seek(song_time_s: float) -> None:
        body = {"action": "seek", "song_time_s": song_time_s}
        opened.until_at_rest(client.post(f"{path}/transport", json=body, headers=opened.headers).json())

    assert strip() == [(*note, place == 0) for place, note in enumerate(WRITTEN)]
    seek(1.2)
    assert strip() == [(*WRITTEN[2], True), (*WRITTEN[3], False)]
    page.keyboard.press("n")
    page.get_by_role("list", name="as they sound").wait_for()
    assert [name for name, _, _ in strip()] == SOUNDING[2:]
    assert [valves for _, valves, _ in strip()] == ["2", "open"], "the fingering stays"
    page.keyboard.press("End")
    page.get_by_role("listitem").filter(has_text="The end").wait_for()
    page.keyboard.press("n")
    page.get_by_role("list", name="as written for the trumpet").wait_for()

    page.keyboard.press("p")
    warnings = client.get(f"{path}/score").json()["warnings"]
    assert {warning["kind"] for warning in warnings} >= {"leading_bytes", "truncated_track"}
    findings = [one for one in client.get(path).json()["findings"] if one["about"] != "choice"]
    assert {warning["kind"] for one in findings for warning in one["details"]} >= {
        warning["kind"] for warning in warnings
    }
    page.get_by_text(f"{len(findings)} things to know").wait_for()
    cut = page.locator(".findings summary", has_text="The file is cut short")
    assert page.locator(".findings li > details > summary").all_inner_texts() == [
        one["text"] for one in findings
    ]
    cut.click()
    detail = next(one for one in warnings if one["kind"] == "truncated_track")
    page.locator(".findings li", has_text=f"{detail['place']} {detail['message']}").first.wait_for()
    session = client.get(path).json()
    rows = page.get_by_role("group", name="Part for the trumpet").locator("label:has([type=radio])")
    assert rows.count() == len(session["choices"]) == 2
    assert [row.locator(".name").inner_text() for row in rows.all()] == ["Trumpet", "Flute"], "the best first"
    for row, choice in zip(rows.all(), session["choices"], strict=True):
        said = row.locator(".why").inner_text().split("; ")
        assert len(said) == len(choice["reasons"]) > 0
        assert all(reason.startswith(text) for text, reason in zip(said, choice["reasons"], strict=True))


def test_the_stage_says_who_plays_what_and_offers_the_octave(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=PHONE, touch=True)
    opened.until_drawn()
    page = opened.page
    notice = page.locator(".notice")

    def arrive() -> None:
        first = opened.session
        opened.choose_files(("sung.mid", "audio/midi", sung()))
        # While the keyboard is on it, it stays, however long a busy machine takes for its first picture.
        notice.get_by_role("button", name="Change the part").focus()
        opened.until_another_session(first)

    arrive()
    path = f"/api/v1/sessions/{opened.session}"
    notice.get_by_text("No trumpet in this file: the player plays Vocals").wait_for()
    told = {one["kind"]: one["text"] for one in client.get(path).json()["findings"]}
    assert told["chord_note_dropped"] == "Plays the top note of 3 chords"
    assert told["not_playable"] == "Leaves out 2 notes below the trumpet's range"
    assert set(told.values()) <= {
        notice.locator("strong").inner_text(),
        *notice.locator("li").all_inner_texts(),
    }
    opened.until_nothing_overflows()

    notice.get_by_role("button", name="Change the part").tap()
    chosen = page.get_by_role("group", name="Part for the trumpet").get_by_role("radio", checked=True)
    opened.until("() => document.activeElement?.matches('input[name=part]:checked')")
    assert chosen.input_value() == "0"
    page.keyboard.press("Escape")

    arrive()
    path = f"/api/v1/sessions/{opened.session}"
    offer = notice.get_by_role("button", name="Move an octave up")
    opened.press_until(offer, notice.get_by_text("Moved an octave up"))
    assert client.get(path).json()["octave_fit"] is True
    with page.expect_response(lambda answer: answer.request.method == "PUT"):
        notice.get_by_role("button", name="Undo").tap()
    assert client.get(path).json()["octave_fit"] is False

    page.get_by_role("button", name="Help").tap()
    touches = page.get_by_role("region", name="Touches")
    touches.get_by_text("Look around the player").wait_for()
    assert touches.locator("kbd").count() == 0, "a phone has no keys"


def test_the_words_of_musicxml_stand_at_the_timeline(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=NARROW, files=(("song.mxl", "", xml.compressed(SONG)),))
    page = opened.page
    lyrics = page.get_by_label("Lyrics", exact=True)

    def seek(song_time_s: float) -> None:
        path = f"/api/v1/sessions/{opened.session}/transport"
        body = {"action": "seek", "song_time_s": song_time_s}
        opened.until_at_rest(client.post(path, json=body, headers=opened.headers).json())

    assert [note[0] for note in page.evaluate(STRIP)][:2] == ["C5", "D5"], "as written for a B♭ trumpet"
    seek(1.1)
    assert lyrics.inner_text() == "Hallo, you"
    assert lyrics.locator(".sung").all_inner_texts() == ["Hal"]
    assert lyrics.locator(".now").inner_text().strip() == "lo,"
    page.get_by_role("button", name="Refrain, bar 3").click()
    opened.until("Math.abs(window.reina.songTime - 4) < 0.01")
    assert lyrics.inner_text() == "la"
    marks = page.get_by_role("group", name="Marks in the piece")
    assert [text for text in marks.locator(".word").all_inner_texts() if text] == ["softly", "Refrain"]


def test_the_page_tells_what_is_amiss_with_a_song_and_a_show(visit: Visit, client: httpx.Client) -> None:
    cut = ("cut.wav", "audio/wav", song(12.0)[:20_044])
    opened = visit(size=NARROW, files=(("scale.mid", "audio/midi", duet()), cut))
    path = f"/api/v1/sessions/{opened.session}"
    opened.page.keyboard.press("p")
    opened.page.get_by_text("The recording says a wrong length of itself").first.wait_for()
    late: dict[str, Any] = {"version": 1, "title": "Late", "time": "seconds", "tracks": []}
    late["markers"] = [{"time": 1000.0, "name": "too late"}]
    answer = client.put(f"{path}/show", json=late, headers=opened.headers)
    assert answer.status_code == 200, answer.text
    opened.page.get_by_text("One marker of the show stands after the end of the piece").wait_for()
    findings = client.get(path).json()["findings"]
    listed = opened.page.locator(".findings li > details > summary").all_inner_texts()
    assert listed == [one["text"] for one in findings if one["about"] != "choice"]
    marker = next(one for one in findings if one["about"] == "show")
    assert "too late" in marker["details"][0]["message"]
