"""The part on paper: engraved, followed, tapped and printed; and fingerings that are not the usual ones."""

from __future__ import annotations

import re
import zlib
from typing import TYPE_CHECKING, Any

import pytest
from playwright.sync_api import expect

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser


def entries_of(part: dict[str, Any]) -> list[dict[str, Any]]:
    """The notes that are written, each once, whatever it is tied to."""
    return [
        entry
        for measure in part["measures"]
        for entry in measure["entries"]
        if entry["note"] is not None and not entry["tied_from"]
    ]


def shown(valves: list[int] | None) -> str:
    """A fingering as it stands under a note."""
    return "×" if valves is None else "-".join(map(str, valves)) or "0"


def is_alternate(note: dict[str, Any]) -> bool:
    """Whether a note is not fingered as usual."""
    return note["valves"] != note["usual_valves"]


def opened_part(opened: Opened, client: httpx.Client) -> dict[str, Any]:
    """Open the part on paper; returns what the server says of it."""
    opened.until_drawn()
    opened.page.keyboard.press("t")
    opened.page.get_by_role("region", name="The part on paper").locator(".system svg").first.wait_for()
    return client.get(f"/api/v1/sessions/{opened.session}/part").raise_for_status().json()


def test_the_part_is_engraved_followed_and_tapped(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=(1000, 640))
    page, part = opened.page, opened_part(opened, client)
    paper = page.get_by_role("region", name="The part on paper")
    systems = paper.locator(".system")
    for at in range(systems.count()):
        systems.nth(at).scroll_into_view_if_needed()
        systems.nth(at).locator("svg").wait_for()
    fingerings = paper.locator(".system text.fingering:not(.second)")
    written = entries_of(part)
    assert fingerings.all_text_contents() == [shown(part["notes"][one["note"]]["valves"]) for one in written]
    assert paper.locator(".system .vf-stavenote[data-note]").count() == sum(
        entry["note"] is not None for measure in part["measures"] for entry in measure["entries"]
    )
    alternate = [one for one in written if is_alternate(part["notes"][one["note"]])]
    assert paper.locator("text.alternate").count() == len(alternate) > 0

    target = written[12]["note"]
    paper.locator(f"rect.target[data-note='{target}']").click()
    onset = part["notes"][target]["onset_s"]
    opened.until("(note) => document.querySelector('.vf-stavenote.lit')?.dataset.note === note", f"{target}")
    transport = client.get(f"/api/v1/sessions/{opened.session}/transport").json()
    assert onset <= transport["song_time_s"] + 1e-6 < onset + 1 / 60
    expect(paper).to_contain_text(part["notes"][target]["reason"])

    late = written[-1]["note"]
    body = {"action": "seek", "song_time_s": part["notes"][late]["onset_s"] + 0.05}
    client.post(f"/api/v1/sessions/{opened.session}/transport", json=body, headers=opened.headers)
    opened.until("() => [...document.querySelectorAll('.system')].at(-1).matches('.current')")
    opened.until(
        "() => { const box = document.querySelector('.system.current').getBoundingClientRect();"
        " const body = document.querySelector('.paper .body').getBoundingClientRect();"
        " return box.top >= body.top - 1 && box.bottom <= body.bottom + 1; }"
    )
    page.get_by_role("button", name="Note names as written").click()
    page.get_by_text("as it sounds · D major").wait_for()
    page.keyboard.press("Escape")
    paper.wait_for(state="detached")


def test_part_and_chart_are_printed(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=(1000, 640))
    page, part = opened.page, opened_part(opened, client)
    paper = page.get_by_role("region", name="The part on paper")
    paper.get_by_role("combobox").select_option("A4")
    pages, size, texts = read_pdf(page.pdf(prefer_css_page_size=True))
    assert pages == 2
    assert size == (595, 842)
    assert texts > len(entries_of(part)), "notes and fingerings are text, not pictures"
    page.locator(".print-sheet").wait_for(state="detached")
    paper.get_by_role("combobox").select_option("letter")
    assert read_pdf(page.pdf(prefer_css_page_size=True))[1] == (612, 792)
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    sheet = page.locator(".print-sheet")
    assert sheet.locator("text.fingering:not(.second)").count() == len(entries_of(part))
    told = sheet.evaluate("(element) => element.textContent")
    assert part["title"] in told
    assert "B♭ trumpet" in told
    assert "= 112" in told
    page.evaluate("window.dispatchEvent(new Event('afterprint'))")

    paper.get_by_role("tab", name="Fingering chart").click()
    chart = client.get("/api/v1/instruments").json()["instruments"]
    lines = next(one for one in chart if one["name"] == "trumpet")["chart"]
    paper.get_by_text("C♯5 / D♭5").wait_for()
    assert paper.locator(".chart li").count() == len(lines)
    assert paper.locator(".chart .fingering").count() == sum(len(line["fingerings"]) for line in lines)
    assert read_pdf(page.pdf(prefer_css_page_size=True))[0] == 1


def read_pdf(data: bytes) -> tuple[int, tuple[int, int], int]:
    """How many pages a PDF has, their width and height in points, and how many pieces of text it shows."""
    boxes = re.findall(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", data)
    streams = re.findall(rb"stream\r?\n(.*?)endstream", data, re.DOTALL)
    texts = 0
    for stream in streams:
        try:
            content = zlib.decompress(stream)
        except zlib.error:
            continue
        texts += len(re.findall(rb"\bT[jJ]\b", content))
    width, height = (round(float(number)) for number in boxes[0])
    return len(boxes), (width, height), texts


def test_alternate_fingerings_are_marked_explained_and_left_out(visit: Visit, client: httpx.Client) -> None:
    opened = visit(size=(1100, 620))
    opened.until_drawn()
    page, path = opened.page, f"/api/v1/sessions/{opened.session}"
    marked = page.locator(".notes button.alternate")
    first = marked.first
    first.wait_for()
    assert first.locator(".name").inner_text() == "F♯5"
    first.click()
    page.get_by_role("status").get_by_text("1-2-3 in place of 2 beside G♯5").wait_for()
    page.get_by_role("switch", name="Usual fingerings only").check()
    opened.until("() => document.querySelectorAll('.notes button.alternate').length === 0")
    page.get_by_role("status").get_by_text("2: usual for written F♯5").wait_for()
    assert client.get(path).json()["usual_fingerings"] is True
    page.reload()
    opened.until_drawn()
    assert marked.count() == 0
    page.keyboard.press("p")
    assert page.get_by_role("switch", name="Usual fingerings only").is_checked()
