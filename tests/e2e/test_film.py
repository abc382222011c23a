"""Films and stills that the page makes: decoded, and held against the page's own drawing."""

from __future__ import annotations

import base64
import io
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from PIL import Image
from tests.e2e.films import decode, difference, film
from tests.e2e.opened import FPS, Opened
from tests.integration.scores import clap, scale, song
from tests.integration.server import Owned, upload

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from playwright.sync_api import Page

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

CLAP_S = 1.0
FLASH: dict[str, Any] = {
    "version": 1,
    "title": "Flash",
    "time": "seconds",
    "tracks": [
        {
            "parameter": "stage/exposure",
            "keyframes": [{"key": "k1", "time": 0, "value": 0.2}],
            "events": {
                "on": "notes",
                "amount": 1.2,
                "blend": "replace",
                "attack": 0,
                "hold": 0.3,
                "decay": 0.1,
            },
        }
    ],
}
"""The light goes on with a note, at once."""
CODING = 14
"""How far a coded picture may be from the one that went in: 7 to 9 in fact, where the next frame is 66 away."""
WITHOUT_PICKER = "delete window.showSaveFilePicker;"
"""Nobody is there to answer the browser's own dialog."""
TO_KEPT_FILE = """
window.showSaveFilePicker = async ({ suggestedName }) => {
  window.picked = suggestedName;
  return (await navigator.storage.getDirectory()).getFileHandle("film", { create: true });
};
"""
"""A file as the dialog gives it, in the browser's own storage."""
WATCH_CODERS = """
window.encoders = [];
window.VideoEncoder = class extends VideoEncoder {
  constructor(...given) { super(...given); window.encoders.push(this); }
};
window.contexts = new Set();
const get = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (...given) {
  const context = get.apply(this, given);
  if (given[0] === "webgl2") window.contexts.add(context);
  return context;
};
"""


def opened_clean(visit: Visit, session: Owned, size: tuple[int, int]) -> Opened:
    """A page of a session, with the stage alone, once it is drawn."""
    opened = visit(f"/s/{session.id}?clean=1", size=size)
    opened.until_drawn()
    return opened


def at_rest_at(opened: Opened, session: Owned, index: int) -> None:
    """Have the session stand at a frame, and the page have drawn it."""
    assert opened.until_at_rest(session.control("seek", song_time_s=index / FPS)) == index


def with_panel(visit: Visit, client: httpx.Client, *scripts: str) -> Opened:
    """A page with a scale, a recording of its own, and the film's panel set to a short span."""
    session = upload(client, scale(8), "Étude: 1?.mid", song=("song.wav", song(4.0)))
    opened = visit(f"/s/{session.id}", size=(1000, 700), scripts=scripts)
    opened.until_drawn()
    page = opened.page
    page.keyboard.press("r")
    page.get_by_label("Span").select_option("From … to …")
    page.get_by_label("From", exact=True).fill("0:01")
    page.get_by_label("Size").select_option(index=0)
    page.get_by_label("Frames a second").select_option("30")
    page.get_by_label("Detail").select_option("Low")
    return opened


def until_seconds(page: Page, to: str) -> None:
    page.get_by_label("To", exact=True).fill(to)
    page.get_by_label("To", exact=True).press("Tab")


def make(page: Page) -> None:
    page.get_by_role("button", name="Make the film").click()


@pytest.mark.parametrize("container", ["mp4", "webm"])
def test_a_film_is_as_long_as_its_span_and_is_heard_when_it_is_seen(
    visit: Visit, client: httpx.Client, container: str
) -> None:
    session = upload(client, clap(at_s=CLAP_S), show=("show.json", json.dumps(FLASH).encode()))
    opened = opened_clean(visit, session, (320, 180))
    made, data = film(opened.page, start=0.5, end=1.5, container=container)
    decoded = decode(data)
    assert container in decoded.container
    assert made["frames"] == len(decoded.pictures) == FPS, "a second"
    assert decoded.size == (made["width"], made["height"]) == (256, 144)
    # WebM counts in milliseconds.
    np.testing.assert_allclose(decoded.times_s, np.arange(FPS) / FPS, atol=6e-4)
    light = decoded.pictures.mean(axis=(1, 2, 3))
    seen = int(np.argmax(np.diff(light))) + 1
    assert light[seen : seen + 10].min() > 2 * light[:seen].max(), "the light goes on"
    assert seen == round((CLAP_S - 0.5) * FPS), "on the frame of the note"
    loud = np.abs(decoded.sound)
    heard = int(np.argmax(loud > 0.1 * loud.max()))
    heard_s = decoded.sound_from_s + heard / decoded.rate
    assert abs(heard_s - decoded.times_s[seen]) < 0.01, f"seen at {decoded.times_s[seen]}, heard at {heard_s}"
    assert loud[: heard - decoded.rate // 50].max() < 0.02 * loud.max(), "silence before it"
    sounds_s = decoded.sound_from_s + len(decoded.sound) / decoded.rate
    assert abs(sounds_s - 1.0) < 0.021, "the sound is as long as the picture, to a packet"


@pytest.mark.parametrize(
    ("aspect", "size"),
    [("16:9", (640, 360)), ("9:16", (360, 640)), ("1:1", (360, 360))],
    ids=["wide", "tall", "square"],
)
def test_frame_k_is_the_pages_picture_of_frame_k(
    visit: Visit, client: httpx.Client, aspect: str, size: tuple[int, int]
) -> None:
    session = upload(client, scale(8), song=("song.wav", song(4.0)))
    opened = opened_clean(visit, session, size)
    k = 71
    at_rest_at(opened, session, k)
    page = opened.picture()
    at_rest_at(opened, session, k + 1)
    after = opened.picture()
    _, data = film(
        opened.page, start=(k - 2) / FPS, end=(k + 2) / FPS, aspect=aspect, height=360, sound=False
    )
    decoded = decode(data)
    assert decoded.size == size
    assert len(decoded.pictures) == 4
    assert difference(decoded.pictures[2], page) < CODING
    assert difference(decoded.pictures[2], after) > 2 * CODING, "not of the next"
    assert difference(decoded.pictures[3], after) < CODING


def test_a_view_of_ones_own_is_held_through_the_film(visit: Visit, client: httpx.Client) -> None:
    session = upload(client, scale(8), song=("song.wav", song(4.0)))
    opened = opened_clean(visit, session, (640, 360))
    at_rest_at(opened, session, 60)
    shows = opened.picture()
    opened.page.get_by_role("application").focus()
    for _ in range(6):
        opened.page.keyboard.press("ArrowRight")
    opened.page.keyboard.press("+")
    opened.page.evaluate("document.activeElement.blur()")
    own = opened.picture()
    assert difference(own, shows) > 2 * CODING
    for camera, seen in (("mine", own), ("show", shows)):
        _, data = film(opened.page, start=58 / FPS, end=61 / FPS, height=360, camera=camera, sound=False)
        assert difference(decode(data).pictures[2], seen) < CODING, camera


def test_the_panel_makes_an_upright_film_and_names_it_for_the_piece(
    visit: Visit, client: httpx.Client
) -> None:
    opened = with_panel(visit, client, WITHOUT_PICKER)
    page = opened.page
    until_seconds(page, "0:00.5")
    page.get_by_text("The film must end after it begins").wait_for()
    assert page.get_by_role("button", name="Make the film").is_disabled()
    until_seconds(page, "1.1")
    page.get_by_text("9:16").click()
    with page.expect_download() as download:
        make(page)
    page.get_by_text("is ready").wait_for()
    assert download.value.suggested_filename == "Étude 1.mp4"
    decoded = decode(Path(download.value.path()).read_bytes())
    assert decoded.size == (720, 1280)
    assert len(decoded.pictures) == 3, "a tenth of a second"
    assert decoded.codecs == ("h264", "opus"), "what this browser encodes; others have AAC too"


def test_a_film_is_written_to_the_disk_whether_its_panel_is_open_or_not(
    visit: Visit, client: httpx.Client
) -> None:
    opened = with_panel(visit, client, TO_KEPT_FILE)
    page = opened.page
    until_seconds(page, "1.2")
    make(page)
    page.get_by_text("Frame 1 of 6").wait_for()
    page.keyboard.press("Escape")
    page.get_by_text("The film is ready").wait_for()
    page.keyboard.press("r")
    page.get_by_text("Étude 1.mp4 is ready").wait_for()
    assert page.evaluate("window.picked") == "Étude 1.mp4"
    assert page.get_by_role("button", name="Save it again").count() == 0
    text = page.evaluate(
        """async () => {
          const file = await (await (await navigator.storage.getDirectory()).getFileHandle("film")).getFile();
          const bytes = new Uint8Array(await file.arrayBuffer());
          return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
        }"""
    )
    decoded = decode(base64.b64decode(text))
    assert len(decoded.pictures) == 6
    assert decoded.size == (1280, 720)


def test_a_film_that_is_called_off_leaves_nothing_behind(visit: Visit, client: httpx.Client) -> None:
    opened = with_panel(visit, client, TO_KEPT_FILE, WATCH_CODERS)
    page = opened.page
    until_seconds(page, "3.5")
    make(page)
    page.get_by_text("Frame 3 of 75").wait_for()
    page.get_by_role("button", name="Cancel").click()
    page.get_by_role("button", name="Make the film").wait_for()
    assert page.evaluate("window.encoders.map(({ state }) => state)") == ["closed"]
    lost = "[...window.contexts].map((context) => context.isContextLost())"
    assert sorted(page.evaluate(lost)) == [False, True], "the page's own stays"
    files = "async () => Array.fromAsync((await navigator.storage.getDirectory()).keys())"
    assert page.evaluate(files) == []
    assert page.get_by_role("alert").count() == 0
    # And another can be made.
    until_seconds(page, "1.03")
    make(page)
    page.get_by_text("is ready").wait_for()


def test_stills(visit: Visit, client: httpx.Client) -> None:
    opened = with_panel(visit, client)
    page = opened.page
    page.get_by_text("1:1").click()
    pictures: list[Image.Image] = []
    for transparent in (False, True):
        page.get_by_label("Transparent background").set_checked(transparent)
        with page.expect_download() as download:
            page.get_by_role("button", name="Save a PNG").click()
        assert download.value.suggested_filename == "Étude 1.png"
        pictures.append(Image.open(io.BytesIO(Path(download.value.path()).read_bytes())))
    whole, alone = (np.asarray(picture.convert("RGBA")).astype(np.int16) for picture in pictures)
    assert whole.shape == alone.shape == (720, 720, 4)
    assert (whole[..., 3] == 255).all()
    assert (alone[:40, :40, 3] == 0).all()
    solid = alone[..., 3] == 255
    assert 0.02 < solid.mean() < 0.5, "the player alone"
    # In the whole picture a little of the notes and of the air lies before the player.
    np.testing.assert_array_less(np.median(np.abs(whole - alone)[solid]), 2)


def test_a_clean_view_shows_the_stage_alone(visit: Visit) -> None:
    opened = visit("/?clean=1", size=(640, 360))
    opened.until_drawn()
    page = opened.page
    assert page.locator(".pane:visible, button:visible, header:visible").count() == 0
    assert page.get_by_role("application").bounding_box() == {"x": 0, "y": 0, "width": 640, "height": 360}
    page.keyboard.press("Space")
    opened.until("window.reina.playing")
    assert "clean=1" in page.url


def test_a_browser_without_encoders_says_so(visit: Visit, client: httpx.Client) -> None:
    opened = with_panel(visit, client, "delete window.VideoEncoder;")
    opened.page.get_by_text("it has no WebCodecs").wait_for()
    assert opened.page.get_by_role("button", name="Make the film").is_disabled()
    assert opened.page.get_by_role("button", name="Save a PNG").is_enabled()


@pytest.mark.parametrize("size", [(390, 844), (1440, 900)], ids=["phone", "wide"])
def test_the_panel_fits_the_window(visit: Visit, size: tuple[int, int]) -> None:
    opened = visit(size=size)
    opened.until_drawn()
    page = opened.page
    page.get_by_role("button", name="Film").click()
    page.get_by_label("Span").select_option("From … to …")
    panel = page.get_by_role("region", name="the film")
    boxes = [element.bounding_box() for element in panel.locator("button, select, input, p").all()]
    assert len(boxes) > 10
    for box in boxes:
        assert box is None or (box["x"] >= 0 and box["x"] + box["width"] <= size[0])
    assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
