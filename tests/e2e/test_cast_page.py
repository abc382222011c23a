"""Several players in the page: a lane each, strips that follow one, a panel that says who plays what."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

DUET = Path(__file__).parents[2] / "examples/scores/trumpet-duet.mid"
WIDE = (1100, 620)
ALONE: list[dict[str, Any]] = [{"part": 0}]
PAIR: list[dict[str, Any]] = [{"part": 0}, {"part": 1, "player": "soloist"}]
SHOWN_VALVES = """() => [...document.querySelectorAll(".notes li")].map((note) =>
  [...note.querySelectorAll(".valve.down")].map((valve) => Number(valve.textContent)))"""


class Duet:
    """A session of the duet, and pages that show it."""

    def __init__(self, visit: Visit, client: httpx.Client, castings: list[dict[str, Any]]) -> None:
        files = {"score": (DUET.name, DUET.read_bytes(), "audio/midi")}
        data = {"cast": json.dumps({"castings": castings})}
        made = client.post("/api/v1/sessions", files=files, data=data).raise_for_status().json()
        self.id, self.token = made["id"], made["control_token"]
        self.path = f"/api/v1/sessions/{self.id}"
        self.headers = {"Authorization": f"Bearer {self.token}"}
        self._visit, self._client = visit, client

    def open(self, size: tuple[int, int], **options: Any) -> Opened:
        """The page of who made the session."""
        remembers = {"tokens": {self.id: self.token}, "hasPlayed": True}
        opened = self._visit(f"/s/{self.id}", size=size, remembers=remembers, **options)
        opened.until_drawn()
        return opened

    def notes(self, player: int) -> list[dict[str, Any]]:
        """What the server says that a player plays."""
        notes = self._client.get(f"{self.path}/score").raise_for_status().json()["notes"]
        return [note for note in notes if note["player"] == player]

    def castings(self) -> list[dict[str, Any]]:
        return self._client.get(f"{self.path}/cast").raise_for_status().json()["castings"]


def test_each_player_has_a_lane_and_strips_and_camera_follow_whom_one_chooses(
    visit: Visit, client: httpx.Client
) -> None:
    duet = Duet(visit, client, PAIR)
    opened = duet.open(WIDE)
    page = opened.page
    lines = [duet.notes(player) for player in (0, 1)]
    assert min(map(len, lines)) > 50
    assert opened.measure("laneNotes") == [len(line) for line in lines]

    def follows(player: int) -> None:
        opened.until("(player) => window.reina.followed === player", player)
        shown = page.evaluate(SHOWN_VALVES)
        assert len(shown) >= 3
        assert shown == [note["valves"] for note in lines[player][: len(shown)]]
        label = page.locator(".notes").get_attribute("aria-label")
        assert label is not None
        assert label.startswith(f"The next notes of player {player + 1} ")

    follows(0)
    assert [note["valves"] for note in lines[0][:4]] != [note["valves"] for note in lines[1][:4]]
    page.keyboard.press("j")
    follows(1)
    page.get_by_role("button", name="These are player 2’s notes").click()
    follows(0)
    page.keyboard.press("p")
    page.locator("label", has_text="Soloist, B♭ trumpet").click()
    follows(1)

    page.get_by_text("Save the motion").click()
    with page.expect_download() as downloading:
        page.get_by_role("link", name="Soloist, BVH").click()
    text = downloading.value.path().read_bytes()
    named = client.get(f"{duet.path}/export.bvh", params={"skeleton": "players/2/player"})
    assert text == named.content
    assert text != client.get(f"{duet.path}/export.bvh").content
    page.keyboard.press("p")

    def stands(condition: str) -> None:
        opened.until(f"() => {{ const [x, y, z] = window.reina.drawnFrom; return {condition}; }}")

    # From the front the first player stands on the left, the second on the right.
    page.keyboard.press("a")
    stands("z > 4.5")
    for player, x in ((0, 0.36), (1, 0.64)):
        page.mouse.click(x * WIDE[0], 0.4 * WIDE[1])
        follows(player)
    page.mouse.click(0.02 * WIDE[0], 0.4 * WIDE[1])
    follows(1)
    stands("z > 4.5")
    page.keyboard.press("w")
    stands("z < 3 && x > -1.1")
    page.keyboard.press("j")
    stands("z < 3 && x < -1.2")
    page.keyboard.press("c")
    opened.until("document.querySelector('[aria-label^=\"Give the camera\"]')?.ariaPressed !== 'true'")


def test_who_plays_what_is_changed_in_the_panel_and_reaches_who_watches(
    visit: Visit, client: httpx.Client
) -> None:
    duet = Duet(visit, client, ALONE)
    owner = duet.open((1100, 800), refusals=("422",))
    watcher = visit(f"/s/{duet.id}", size=(760, 430))
    watcher.until_drawn()
    assert watcher.measure("laneNotes") == [len(duet.notes(0))]
    page = owner.page
    page.keyboard.press("p")
    cast = page.get_by_role("group", name="Who plays")

    cast.get_by_role("button", name="Add a player").click()
    for opened in (owner, watcher):
        opened.until("window.reina.laneNotes.length === 2 && window.reina.rigs.includes('soloist')")
    assert [one["part"] for one in duet.castings()] == [0, 1]
    assert watcher.measure("laneNotes") == [len(duet.notes(0)), len(duet.notes(1))]
    assert owner.measure("followed") == 1, "who was added"
    cast.get_by_text("Nobody on the stage plays Organ, Basses").wait_for()

    own = page.get_by_role("group", name="Soloist, player 2")
    with page.expect_response(lambda answer: answer.request.method == "PUT"):
        own.get_by_role("combobox", name="Instrument").select_option("flugelhorn")
    watcher.until("window.reina.rigs.includes('flugelhorn')")
    with page.expect_response(lambda answer: answer.request.method == "PUT"):
        own.get_by_role("combobox", name="Place").select_option("far left")
    cast.get_by_text("Soloist, flugelhorn").wait_for()
    assert [(one["instrument"], one["seat"]) for one in duet.castings()] == [
        ("trumpet", "right"),
        ("flugelhorn", "far left"),
    ]
    own.get_by_role("combobox", name="Figure").select_option("trumpeter")
    watcher.until("window.reina.rigs.filter((rig) => rig === 'trumpeter').length === 2")
    page.get_by_role("group", name="Band member, player 2").get_by_role(
        "button", name="A semitone lower"
    ).click()
    cast.get_by_text("Band member, flugelhorn").wait_for()
    page.get_by_text("−1", exact=True).wait_for()
    assert duet.castings()[1]["transposition"] == -1

    parts = page.get_by_role("group", name="Part for the flugelhorn")
    parts.locator("label:has(input[type=radio])", has_text="Trumpet 1").click()
    refused = parts.get_by_role("alert")
    refused.wait_for()
    assert "part 0 is played by another player already" in refused.inner_text()
    assert parts.get_by_role("radio", name="Trumpet 2").is_checked(), "as it was"
    assert duet.castings()[1]["part"] == 1
    with page.expect_response(lambda answer: answer.request.method == "PUT"):
        parts.locator("label:has(input[type=radio])", has_text="Organ").click()
    cast.get_by_text("plays Organ", exact=True).wait_for()
    assert page.get_by_role("alert").count() == 0
    organ = len(duet.notes(1))
    watcher.until("(organ) => window.reina.laneNotes[1] === organ", organ)

    watcher.page.keyboard.press("p")
    watched = watcher.page.get_by_role("group", name="Who plays")
    watched.get_by_text("Band member, flugelhorn").wait_for()
    for name in ("Add a player", "Leave player 1 out", "Leave player 2 out"):
        assert watched.get_by_role("button", name=name).is_disabled(), "who watches changes nothing"
    watched.locator("label", has_text="Band member, flugelhorn").click()
    watcher.until("window.reina.followed === 1")

    cast.get_by_role("button", name="Leave player 1 out").click()
    for opened in (owner, watcher):
        # The notes that are left come by another way than who is left.
        opened.until("([organ]) => window.reina.laneNotes.join() === `${organ}`", [organ])
        opened.until("window.reina.rigs.length === 2")
        assert opened.measure("followed") == 0
    assert [one["part"] for one in duet.castings()] == [2]


def test_nothing_of_a_cast_overflows_the_window(visit: Visit, client: httpx.Client) -> None:
    opened = Duet(visit, client, PAIR).open((390, 844))
    page = opened.page
    page.keyboard.press("a")
    opened.until("document.querySelector('[aria-label^=\"Give the camera\"]')?.ariaPressed === 'true'")
    content = page.get_by_role("region", name="the piece").locator(".content")
    for width, height in ((390, 844), (1440, 900)):
        page.set_viewport_size({"width": width, "height": height})
        opened.until("(width) => innerWidth === width", width)
        opened.until_nothing_overflows()
        page.keyboard.press("p")
        content.wait_for()
        page.keyboard.press("j")
        page.get_by_text("Save the motion").click()
        opened.until_nothing_overflows()
        assert content.evaluate("(element) => element.scrollWidth <= element.clientWidth")
        page.keyboard.press("p")
        content.wait_for(state="detached")
