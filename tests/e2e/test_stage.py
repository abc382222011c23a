"""The stage: every parameter is seen in the picture, within its budgets, whatever a browser does to it."""

from __future__ import annotations

import gzip
import json
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.e2e.find_browser import browser_path
from tests.e2e.opened import FPS, Opened

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import httpx
    from playwright.sync_api import Browser
    from tests.integration.server import Running

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

DIST = Path(__file__).parents[2] / "web/dist"
TINY = (256, 144)
SCRIPT_BYTES = 300_000
FIRST_VIEW_BYTES = 4_000_000
DRAW_CALLS = {1: 150, 2: 150, 4: 220}
"""By how many play, on the full tier with every light on."""
DUET = Path(__file__).parents[2] / "examples/scores/trumpet-duet.mid"
CAST = [
    {"part": 0},
    {"part": 1, "player": "soloist", "instrument": "cornet"},
    {"part": 2, "octave_fit": True},
    {"part": 3, "player": "soloist", "instrument": "flugelhorn", "octave_fit": True},
]

LIT: dict[str, Any] = {
    "camera/position": [-1.4, 1.55, 2.1],
    "camera/aperture": 0.03,
    "lights/back_wash/intensity": 3.0,
    "lights/haze": 1.0,
    "stage/bloom/strength": 0.8,
    **{f"lights/spots/{number}/intensity": 5.0 for number in (1, 2, 3)},
}
"""Everything on, so that each parameter has something to change."""

OTHER: dict[str, Any] = {
    "camera/position": [-1.2, 1.6, 2.3],
    "camera/target": [0.1, 1.2, 0.3],
    "camera/focus_distance": 0.6,
    "camera/roll": 0.15,
    "lights/key/position": [3.0, 2.2, 2.0],
    "lights/rim/position": [-1.6, 2.6, -2.2],
    "lights/key/softness": 4.0,
    "stage/fog/density": 0.25,
    "stage/bloom/threshold": 0.2,
    "blocks/speed": 0.5,
    **{f"lights/spots/{number}/position": [0.9, 3.4, 1.9] for number in (1, 2, 3)},
    **{f"lights/spots/{number}/target": [0.6, 0.2, 0.6] for number in (1, 2, 3)},
}
"""What a parameter is set to where its other bound would not do."""

FULL_TIER = (
    "camera/aperture",
    "camera/focus_distance",
    "lights/key/softness",
    "stage/bloom/strength",
    "stage/bloom/threshold",
)
"""What lesser tiers do without."""

FEWEST_PIXELS = 25
"""A change that fewer of the picture's 36,864 pixels show is none."""


def other_value(entry: dict[str, Any]) -> Any:
    """Another value of a parameter than the picture with everything on has."""
    path, default = entry["path"], LIT.get(entry["path"], entry["default"])
    if path in OTHER:
        return OTHER[path]
    if entry["type"] == "color":
        return "#20E040"
    if entry["type"] == "choice":
        return next(choice for choice in entry["choices"] if choice != default)
    if entry["type"] == "boolean":
        return not default
    return entry["minimum"] if default - entry["minimum"] > 0.05 else min(entry["maximum"], default + 0.5)


class ShowStage:
    """A page at rest on a sounding note, whose show is set over REST."""

    def __init__(self, opened: Opened, client: httpx.Client) -> None:
        self.opened, self.client = opened, client
        opened.until_drawn()
        opened.hide_panels()
        self.url = f"/api/v1/sessions/{opened.session}"
        body = {"action": "seek", "song_time_s": 4.0}
        client.post(f"{self.url}/transport", headers=opened.headers, json=body).raise_for_status()

    def picture(self, values: dict[str, Any]) -> np.ndarray:
        tracks = [
            {"parameter": path, "keyframes": [{"time": 0, "value": value}]} for path, value in values.items()
        ]
        show = {"version": 1, "time": "seconds", "tracks": tracks}
        self.client.put(f"{self.url}/show", headers=self.opened.headers, json=show).raise_for_status()
        self.opened.until_at_rest(self.client.get(f"{self.url}/transport").raise_for_status().json())
        return self.opened.picture()


@pytest.mark.parametrize("tier", ["low", "full"])
def test_every_parameter_of_the_stage_changes_the_picture(
    visit: Visit, client: httpx.Client, tier: str
) -> None:
    opened = visit(size=TINY)
    opened.until_drawn()
    if tier == "full":
        opened.page.goto(opened.page.url.replace("tier=low", "tier=full"))
    stage = ShowStage(opened, client)
    before = stage.picture(LIT)
    np.testing.assert_array_equal(stage.picture(LIT), before, "the same show gives the same picture")
    listed = client.get("/api/v1/parameters").raise_for_status().json()["parameters"]
    paths = [entry for entry in listed if not entry["path"].startswith(("player/", "players/", "trumpet/"))]
    chosen = [entry for entry in paths if (entry["path"] in FULL_TIER) == (tier == "full")]
    assert len(chosen) >= len(FULL_TIER)
    unseen: list[str] = []
    for entry in chosen:
        after = stage.picture({**LIT, entry["path"]: other_value(entry)})
        if int((np.abs(after - before).max(axis=2) > 3).sum()) < FEWEST_PIXELS:
            unseen.append(entry["path"])
    assert unseen == []
    if tier == "full":
        calls = opened.measure("drawCalls")
        assert 20 < calls <= DRAW_CALLS[1]


@pytest.mark.parametrize("players", [2, 4])
def test_several_players_stay_within_the_draw_calls(visit: Visit, client: httpx.Client, players: int) -> None:
    cast = json.dumps({"castings": CAST[:players]})
    files = {"score": (DUET.name, DUET.read_bytes(), "audio/midi")}
    made = client.post("/api/v1/sessions", files=files, data={"cast": cast}).raise_for_status().json()
    remembers = {"tokens": {made["id"]: made["control_token"]}, "hasPlayed": True}
    opened = visit(f"/s/{made['id']}", size=TINY, remembers=remembers)
    opened.page.goto(opened.page.url.replace("tier=low", "tier=full"))
    stage = ShowStage(opened, client)
    assert len(opened.measure("rigs")) == 2 * players
    # From the front, so that nobody is out of the picture and goes uncounted.
    front = {"camera/position": [0.0, 1.4, 5.6], "camera/target": [0.0, 1.0, 0.0], "camera/fov": 0.6}
    calls: list[int] = []
    for style in ("physical", "toon"):
        stage.picture({**LIT, **front, "look/style": style})
        calls.append(opened.measure("drawCalls"))
    assert 15 * players < calls[0] < calls[1] <= DRAW_CALLS[players]


def test_the_first_view_stays_within_its_budget(visit: Visit) -> None:
    opened = visit(size=TINY)
    opened.until_drawn()
    devtools: Any = opened.page.context.new_cdp_session(opened.page)
    devtools.send("Network.enable")
    devtools.send("Network.setCacheDisabled", {"cacheDisabled": True})
    kinds: dict[str, str] = {}
    received: dict[str, int] = {}

    def arrive(event: dict[str, Any]) -> None:
        # The song is streamed to be heard; it is no part of the view, and comes after it.
        if "/song" not in event["response"]["url"]:
            kinds[event["requestId"]] = event["response"]["url"]

    def count(event: dict[str, Any]) -> None:
        received[event["requestId"]] = int(event["encodedDataLength"])

    devtools.on("Network.responseReceived", arrive)
    devtools.on("Network.loadingFinished", count)
    opened.page.goto(opened.page.url.replace("tier=low", "tier=full"))
    opened.until_drawn()
    sizes = {url: received.get(number, 0) for number, url in kinds.items()}
    assert any(url.endswith(".glb") for url in sizes)
    assert 500_000 < sum(sizes.values()) <= FIRST_VIEW_BYTES, sizes


def test_the_script_stays_within_its_budget() -> None:
    """With three.js in it: all that the page loads before a picture, as it is sent."""
    page = (DIST / "index.html").read_text()
    scripts = re.findall(r'(?:src|href)="(/assets/[^"]+\.js)"', page)
    assert scripts
    sent = sum(len(gzip.compress((DIST / path.lstrip("/")).read_bytes())) for path in scripts)
    assert 50_000 < sent <= SCRIPT_BYTES


def test_a_lost_drawing_context_comes_back(visit: Visit) -> None:
    opened = visit(size=TINY, refusals=("Context Lost", "CONTEXT_LOST", "context lost"))
    opened.until_drawn()
    opened.hide_panels()
    before = opened.picture()
    opened.page.evaluate(
        """() => {
            const context = document.querySelector('canvas').getContext('webgl2');
            window.losing = context.getExtension('WEBGL_lose_context');
            losing.loseContext();
        }"""
    )
    drawn = opened.measure("pictures")
    opened.page.evaluate("losing.restoreContext()")
    opened.until("(drawn) => reina.pictures > drawn", drawn)
    after = opened.picture()
    # The same stage, lit by the same reflections; at most the frame is another by a little.
    assert np.abs(after - before).mean() < 4.0
    assert after.std() > 20


HIDING = """
window.held = null;
const request = requestAnimationFrame.bind(window);
window.requestAnimationFrame = (call) => (window.held === null ? request(call) : window.held.push(call));
window.hide = () => { window.held ??= []; return new Promise((done) => request(() => setTimeout(done))); };
window.show = () => { const calls = held; window.held = null; calls.forEach((call) => request(call)); };
"""
"""Browsers call no animation frame in a hidden page; a driven page is never hidden, so it is done here.

`hide` is done when the calls asked for before it have been made: a browser makes them in their order.
"""


def test_a_hidden_page_draws_nothing_and_comes_back_to_now(browser: Browser, server: Running) -> None:
    context = browser.new_context(viewport={"width": TINY[0], "height": TINY[1]})
    context.add_init_script(HIDING)
    opened = Opened(context.new_page(), server.address)
    opened.go("/")
    opened.until_drawn()
    opened.page.keyboard.press("m")
    opened.page.keyboard.press("Space")
    opened.until("reina.playing && reina.pictures > 5")
    opened.page.evaluate("hide()")
    drawn, before = opened.measure("pictures"), opened.measure("drawnIndex") / FPS
    opened.page.evaluate("new Promise((done) => setTimeout(done, 1000))")
    assert opened.measure("pictures") == drawn
    opened.page.evaluate("show()")
    opened.until("(drawn) => reina.pictures > drawn + 3", drawn)
    # It draws what is heard now, not what it missed.
    assert opened.measure("drawnIndex") / FPS > before + 1.0
    context.close()
    assert opened.errors == []


@pytest.fixture
def plain_browser(browser: Browser) -> Iterator[Browser]:
    """A browser that has no WebGL."""
    found = browser.browser_type.launch(
        executable_path=browser_path(), args=["--no-sandbox", "--disable-3d-apis"]
    )
    yield found
    found.close()


def test_without_webgl_2_the_page_says_what_to_do(plain_browser: Browser, server: Running) -> None:
    page = plain_browser.new_page(viewport={"width": 760, "height": 430})
    page.goto(server.address)
    page.get_by_text("it has no WebGL 2").wait_for()
    page.get_by_text("Switch on hardware acceleration").wait_for()
    # What needs no picture still works.
    page.get_by_role("button", name="Drop your MIDI").wait_for()
