"""The place to practise: loops by bars, counted in; note by note; the quiz."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from playwright.sync_api import expect
from tests.integration.scores import scale

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from playwright.sync_api import Locator
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

SAINTS = Path(__file__).parents[2] / "examples" / "scores" / "when-the-saints.mid"
BAR_S = 2.0
SCALE = ("scale.mid", "audio/midi", scale(40))
"""Eighths at 120, in bars of two seconds."""
EXACT_S = 0.01
WHEN = """() => {
  window.clicks = [];
  window.begun = [];
  const kept = (kind, times) => {
    const { start, stop } = kind.prototype;
    kind.prototype.start = function (when, ...rest) {
      times.push((this.begins = when));
      return start.call(this, when, ...rest);
    };
    kind.prototype.stop = function (when) {
      // What is to end before it begins is never heard, as what a voice that is started anew had planned.
      const unheard = (when ?? this.context.currentTime) <= this.begins;
      if (unheard && times.includes(this.begins)) times.splice(times.indexOf(this.begins), 1);
      return stop.call(this, when);
    };
  };
  kept(OscillatorNode, window.clicks);
  kept(AudioBufferSourceNode, window.begun);
}"""
"""When clicks, and parts of the song, are to begin, on the sound's clock; without what was taken back."""


def practice(opened: Opened, tab: str) -> Locator:
    """Open the panel at one of its tabs."""
    opened.page.keyboard.press("x")
    panel = opened.page.get_by_role("region", name="Practice", exact=True)
    panel.get_by_role("tab", name=tab).click()
    return panel


def transport_of(client: httpx.Client, opened: Opened) -> dict[str, Any]:
    """The session's clock."""
    return client.get(f"/api/v1/sessions/{opened.session}/transport").raise_for_status().json()


def told(client: httpx.Client, opened: Opened, **command: Any) -> None:
    """Tell the session's clock, and wait for the page to have heard it."""
    path = f"/api/v1/sessions/{opened.session}/transport"
    answer = client.post(path, json=command, headers=opened.headers).raise_for_status().json()
    opened.until("(epoch) => window.reina.epoch >= epoch", answer["epoch"])


def test_a_loop_by_bars_is_counted_in_on_the_beat_round_for_round(visit: Visit, client: httpx.Client) -> None:
    opened = visit().open_files(SCALE)
    page, panel = opened.page, practice(opened, "Passage")
    opened.until("window.reina.sound === 'ready' || window.reina.sound === 'blocked'")
    panel.get_by_role("button", name="1 bar").click()
    panel.get_by_label("Before each round").check()
    for name, bar in (("Bar", "2"), ("to", "3")):
        panel.get_by_role("spinbutton", name=name, exact=True).fill(bar)
        page.keyboard.press("Enter")
    expect(panel.get_by_role("spinbutton", name="Bar", exact=True)).to_have_value("2")
    opened.until("window.reina.epoch >= 2")
    loop = {"start_s": BAR_S, "end_s": 3 * BAR_S, "count_in_s": BAR_S}
    assert transport_of(client, opened)["loop"] == pytest.approx(loop)

    told(client, opened, action="seek", song_time_s=BAR_S)
    page.evaluate(WHEN)
    page.get_by_role("button", name="Play", exact=True).first.click()
    opened.until("window.clicks.length >= 8 && window.begun.length >= 2")
    clicks, begun = page.evaluate("[window.clicks, window.begun]")
    beat_s = BAR_S / 4
    for round_number in (0, 1):
        due = [begun[round_number] - beat_s * ahead for ahead in (4, 3, 2, 1)]
        assert clicks[4 * round_number : 4 * round_number + 4] == pytest.approx(due, abs=EXACT_S)
    assert begun[1] - begun[0] == pytest.approx(3 * BAR_S, abs=EXACT_S)


def test_note_by_note_the_valves_are_held(visit: Visit, client: httpx.Client) -> None:
    opened = visit(files=(SCALE,))
    page, panel = opened.page, practice(opened, "Note by note")
    score = client.get(f"/api/v1/sessions/{opened.session}/score").json()
    for number, key in ((1, "."), (2, "."), (3, "."), (2, ",")):
        epoch = opened.measure("epoch")
        page.keyboard.press(key)
        opened.until("(epoch) => window.reina.epoch > epoch", epoch)
        opened.until_at_rest(transport_of(client, opened))
        note = score["notes"][number]
        valves = [round(opened.parameter(f"trumpet/valve/{valve}")[0], 2) for valve in (1, 2, 3)]
        assert valves == [float(valve in note["valves"]) for valve in (1, 2, 3)]
        held = panel.get_by_role("status")
        expect(held).to_contain_text(note["written_name"])
        expect(held).to_contain_text("-".join(map(str, note["valves"])) or "open")


def test_a_drummer_has_strokes_note_by_note_and_a_part_of_their_own(visit: Visit) -> None:
    opened = visit(size=(1000, 640), files=(("saints.mid", "audio/midi", SAINTS.read_bytes()),))
    page = opened.page
    page.keyboard.press("t")
    paper = page.get_by_role("region", name="The part on paper")
    paper.get_by_text("B♭ trumpet").wait_for()
    expect(paper.get_by_role("tab", name="Fingering chart")).to_be_visible()
    page.get_by_role("button", name="These are player 1").click()
    paper.get_by_text("drum kit").wait_for()
    paper.get_by_text("Drums").wait_for()
    expect(paper.get_by_role("tab", name="Fingering chart")).to_have_count(0)
    page.keyboard.press("t")
    panel = practice(opened, "Note by note")
    held = panel.get_by_role("status")
    expect(held).to_contain_text("snare")
    expect(held).not_to_contain_text("×")
    expect(held.get_by_role("img")).not_to_have_count(0)
    expect(panel.get_by_role("checkbox", name="Let each note be heard")).to_have_count(0)
    expect(panel.get_by_role("button", name="Fingering chart")).to_have_count(0)
    expect(panel.get_by_role("tab", name="Quiz")).to_have_count(0)
    expect(page.get_by_role("list", name="The next strokes of player 2, with hand or foot")).to_be_visible()
    page.keyboard.press("Escape")

    # What is offered elsewhere fits who strikes: no valves, and nothing that takes pitches another way.
    page.keyboard.press("v")
    views = page.get_by_role("region", name="views and light")
    expect(views.get_by_role("button", name="Overhead")).to_have_attribute("aria-keyshortcuts", "3")
    expect(views.get_by_role("checkbox", name="Feet in a small picture")).to_be_visible()
    expect(views.get_by_text("Valves")).to_have_count(0)
    page.keyboard.press("3")
    opened.until("window.reina.drawnFrom[1] > 2.9 && window.reina.drawnFrom[2] < -1.8")
    page.keyboard.press("v")
    page.keyboard.press("p")
    piece = page.get_by_role("region", name="the piece")
    piece.get_by_text("Band member, B♭ trumpet").wait_for()
    for told in ("Transpose", "Usual fingerings only", "Note names"):
        expect(piece.get_by_text(told)).to_have_count(0)
    piece.get_by_role("button", name="Add a player").click()
    piece.get_by_text("Band member, B♭ trumpet").nth(1).wait_for()
    assert opened.errors == []


def answer(opened: Opened, valves: list[int]) -> None:
    """Hold valves as keys, and say so."""
    for valve in valves:
        opened.page.keyboard.down(str(valve))
    opened.page.keyboard.press("Space")
    for valve in valves:
        opened.page.keyboard.up(str(valve))


def test_the_quiz_hides_what_comes_and_repeats_what_was_wrong(visit: Visit, client: httpx.Client) -> None:
    owner = visit(files=(SCALE,))
    notes = client.get(f"/api/v1/sessions/{owner.session}/score").json()["notes"]
    told(client, owner, action="loop", start_s=0.0, end_s=1.0)
    # Who only watches is asked like anybody else, and moves nothing.
    opened = visit(f"/s/{owner.session}", size=(1100, 620))
    opened.until_drawn()
    panel = practice(opened, "Quiz")
    epoch = owner.measure("epoch")
    panel.get_by_role("button", name="At my own pace").click()
    strip = opened.page.locator(".strip .notes")
    expect(strip).to_contain_text("?")
    assert strip.get_by_role("img").count() == 0
    said = panel.get_by_role("status")
    asked = [0, 1, 2, 3, 1]
    for place, number in enumerate(asked):
        expect(panel.locator(".name")).to_have_text(notes[number]["written_name"])
        wrong = place == 1
        answer(opened, [1, 3] if wrong else notes[number]["usual_valves"])
        if place < len(asked) - 1:
            expect(said).to_have_attribute("data-verdict", "wrong" if wrong else "usual")
        if wrong:
            expect(said).to_contain_text("not 1-3")
            opened.page.keyboard.press("Enter")
    expect(panel.locator(".score")).to_have_text("3 of 4 right at the first try")
    panel.get_by_role("button", name="Repeat 1 note").click()
    expect(panel.locator(".name")).to_have_text(notes[1]["written_name"])
    panel.get_by_role("button", name="Finish").click()
    strip.get_by_role("img").first.wait_for()
    assert owner.measure("epoch") == epoch
    panel.get_by_role("tab", name="Passage").click()
    assert panel.get_by_role("spinbutton").first.is_disabled()
    assert panel.get_by_label("Metronome on").is_enabled()
