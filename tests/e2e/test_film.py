"""Films and stills that the page makes: decoded, and held against the page's own drawing."""

from __future__ import annotations

import base64
import contextlib
import io
import json
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from PIL import Image
from tests.e2e.films import Decoded, decode, difference, film
from tests.e2e.opened import FPS, Opened
from tests.integration.scores import clap, scale, song
from tests.integration.server import Owned, Running, upload

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator

    import httpx
    from playwright.sync_api import Browser, Page

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
"""How far a coded picture may be from the one that went in: 7 to 9 in fact, and 66 to the next frame."""
WITHOUT_PICKER = "() => { delete window.showSaveFilePicker; }"
"""Nobody is there to answer the browser's own dialog."""
TO_KEPT_FILE = """() => {
  window.showSaveFilePicker = async ({ suggestedName }) => {
    window.picked = suggestedName;
    return (await navigator.storage.getDirectory()).getFileHandle("film", { create: true });
  };
}"""
"""A file as the dialog gives it, in the browser's own storage."""
KEPT_FILES = "async () => Array.fromAsync((await navigator.storage.getDirectory()).keys())"
WATCHED = """
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


@contextlib.contextmanager
def opened(
    browser: Browser, server: Running, path: str, size: tuple[int, int], script: str = ""
) -> Generator[Opened]:
    """A page for several tests, once it is drawn: to load a stage takes seconds. It says no error."""
    context = browser.new_context(viewport={"width": size[0], "height": size[1]})
    context.add_init_script(script)
    one = Opened(context.new_page(), server.address)
    one.go(path)
    one.until_drawn()
    yield one
    context.close()
    assert one.errors == []


@pytest.fixture(scope="module")
def session(client: httpx.Client) -> Owned:
    """A scale with a recording of its own."""
    return upload(client, scale(8), "Étude: 1?.mid", song=("song.wav", song(4.0)))


@pytest.fixture(scope="module")
def clean(browser: Browser, server: Running, session: Owned) -> Iterator[Opened]:
    """The session's stage alone."""
    with opened(browser, server, f"/s/{session.id}?clean=1", (640, 360)) as one:
        yield one


@pytest.fixture(scope="module")
def one_panel(browser: Browser, server: Running, session: Owned) -> Iterator[Page]:
    """The session with the film's panel."""
    with opened(browser, server, f"/s/{session.id}", (1000, 700), WATCHED) as one:
        one.page.keyboard.press("r")
        yield one.page


@pytest.fixture
def panel(one_panel: Page) -> Page:
    """The film's panel, set to a short film that is quickly drawn."""
    page = one_panel
    page.get_by_label("Span").select_option("From … to …")
    choose(page, "From", "0:01")
    choose(page, "To", "1.1")
    page.get_by_text("16:9").click()
    page.get_by_label("Size").select_option(index=0)
    page.get_by_label("Frames a second").select_option("30")
    page.get_by_label("Detail").select_option("Low")
    page.get_by_text("H.264").wait_for()
    return page


def choose(page: Page, name: str, time: str) -> None:
    """Write the beginning or the end of the film."""
    field = page.get_by_label(name, exact=True)
    field.fill(time)
    field.press("Tab")


def make(page: Page) -> None:
    page.get_by_role("button", name="Make the film").click()


def at_rest_at(opened: Opened, session: Owned, index: int) -> None:
    """Have the session stand at a frame, and the page have drawn it."""
    assert opened.until_at_rest(session.control("seek", song_time_s=index / FPS)) == index


def test_a_film_is_as_long_as_its_span_and_is_heard_when_it_is_seen(
    browser: Browser, server: Running, client: httpx.Client
) -> None:
    session = upload(client, clap(at_s=CLAP_S), show=("show.json", json.dumps(FLASH).encode()))
    with opened(browser, server, f"/s/{session.id}?clean=1", (256, 144)) as one:
        for container in ("mp4", "webm"):
            made, data = film(one.page, start=0.5, end=1.5, container=container)
            decoded = decode(data)
            assert container in decoded.container
            assert made["frames"] == len(decoded.pictures) == FPS, "a second"
            assert decoded.size == (made["width"], made["height"]) == (256, 144)
            # WebM counts in milliseconds.
            np.testing.assert_allclose(decoded.times_s, np.arange(FPS) / FPS, atol=6e-4)
            assert_seen_and_heard(decoded, CLAP_S - 0.5)


def assert_seen_and_heard(film: Decoded, at_s: float) -> None:
    """The light goes on with the frame of a time, and the clap is heard then."""
    light = film.pictures.mean(axis=(1, 2, 3))
    seen = int(np.argmax(np.diff(light))) + 1
    assert light[seen : seen + 10].min() > 2 * light[:seen].max(), "the light goes on"
    assert seen == round(at_s * FPS), "on the frame of the note"
    loud = np.abs(film.sound)
    heard = int(np.argmax(loud > 0.1 * loud.max()))
    heard_s = film.sound_from_s + heard / film.rate
    assert abs(heard_s - film.times_s[seen]) < 0.01, f"seen at {film.times_s[seen]}, heard at {heard_s}"
    assert loud[: heard - film.rate // 50].max() < 0.02 * loud.max(), "silence before it"
    sounds_s = film.sound_from_s + len(film.sound) / film.rate
    assert abs(sounds_s - len(film.pictures) / FPS) < 0.021, (
        "the sound is as long as the picture, to a packet"
    )


@pytest.mark.parametrize(
    ("aspect", "size"),
    [("16:9", (640, 360)), ("9:16", (360, 640)), ("1:1", (360, 360))],
    ids=["wide", "tall", "square"],
)
def test_frame_k_is_the_pages_picture_of_frame_k(
    clean: Opened, session: Owned, aspect: str, size: tuple[int, int]
) -> None:
    clean.page.set_viewport_size({"width": size[0], "height": size[1]})
    k = 71
    at_rest_at(clean, session, k)
    page = clean.picture()
    at_rest_at(clean, session, k + 1)
    after = clean.picture()
    _, data = film(clean.page, start=(k - 2) / FPS, end=(k + 2) / FPS, aspect=aspect, height=360, sound=False)
    decoded = decode(data)
    assert decoded.size == size
    assert len(decoded.pictures) == 4
    assert difference(decoded.pictures[2], page) < CODING
    assert difference(decoded.pictures[2], after) > 2 * CODING, "not of the next"
    assert difference(decoded.pictures[3], after) < CODING


def test_a_view_of_ones_own_is_held_through_the_film(clean: Opened, session: Owned) -> None:
    clean.page.set_viewport_size({"width": 640, "height": 360})
    at_rest_at(clean, session, 60)
    shows = clean.picture()
    clean.page.get_by_role("application").focus()
    for _ in range(6):
        clean.page.keyboard.press("ArrowRight")
    drawn = clean.measure("pictures")
    clean.page.keyboard.press("+")
    clean.page.evaluate("document.activeElement.blur()")
    clean.until_redrawn(drawn)
    own = clean.picture()
    assert difference(own, shows) > 2 * CODING
    for camera, seen in (("mine", own), ("show", shows)):
        _, data = film(clean.page, start=58 / FPS, end=61 / FPS, height=360, camera=camera, sound=False)
        assert difference(decode(data).pictures[2], seen) < CODING, camera


def test_a_clean_view_shows_the_stage_alone(clean: Opened) -> None:
    page = clean.page
    page.set_viewport_size({"width": 640, "height": 360})
    assert page.locator(".pane:visible, button:visible, header:visible").count() == 0
    stage = page.get_by_role("application")
    assert stage.bounding_box() == {"x": 0, "y": 0, "width": 640, "height": 360}
    assert stage.evaluate("(element) => getComputedStyle(element).cursor") == "none"


def test_the_panel_makes_an_upright_film_and_names_it_for_the_piece(panel: Page) -> None:
    panel.evaluate(WITHOUT_PICKER)
    choose(panel, "To", "0:00.5")
    panel.get_by_text("The film must end after it begins").wait_for()
    assert panel.get_by_role("button", name="Make the film").is_disabled()
    choose(panel, "To", "1.1")
    panel.get_by_text("9:16").click()
    with panel.expect_download() as download:
        make(panel)
    panel.get_by_text("is ready").wait_for()
    assert download.value.suggested_filename == "Étude 1.mp4"
    decoded = decode(Path(download.value.path()).read_bytes())
    assert decoded.size == (720, 1280)
    assert len(decoded.pictures) == 3, "a tenth of a second"
    assert decoded.codecs == ("h264", "opus"), "what this browser encodes; others have AAC too"


def test_a_film_that_is_called_off_leaves_nothing_behind(panel: Page) -> None:
    panel.evaluate(TO_KEPT_FILE)
    choose(panel, "To", "3.5")
    panel.evaluate("window.encoders.length = 0")
    make(panel)
    panel.get_by_text(re.compile(r"Frame \d+ of 75")).wait_for()
    assert "film" in panel.evaluate(KEPT_FILES)
    panel.get_by_role("button", name="Cancel").click()
    panel.get_by_role("button", name="Make the film").wait_for()
    assert panel.evaluate("window.encoders.map(({ state }) => state)") == ["closed"]
    lost: list[bool] = panel.evaluate("[...window.contexts].map((context) => context.isContextLost())")
    assert lost.count(False) == 1, "the page's own stays"
    assert len(lost) > 1
    assert panel.evaluate(KEPT_FILES) == []
    assert panel.get_by_role("alert").count() == 0


def test_a_film_is_written_to_the_disk_whether_its_panel_is_open_or_not(panel: Page) -> None:
    panel.evaluate(TO_KEPT_FILE)
    make(panel)
    panel.get_by_role("button", name="Cancel").wait_for()
    panel.keyboard.press("Escape")
    panel.get_by_text("The film is ready").wait_for()
    panel.keyboard.press("r")
    panel.get_by_text("Étude 1.mp4 is ready").wait_for()
    assert panel.evaluate("window.picked") == "Étude 1.mp4"
    assert panel.get_by_role("button", name="Save it again").count() == 0
    text = panel.evaluate(
        """async () => {
          const file = await (await (await navigator.storage.getDirectory()).getFileHandle("film")).getFile();
          const bytes = new Uint8Array(await file.arrayBuffer());
          return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
        }"""
    )
    decoded = decode(base64.b64decode(text))
    assert len(decoded.pictures) == 3
    assert decoded.size == (1280, 720)


def test_stills(panel: Page) -> None:
    panel.get_by_text("1:1").click()
    pictures: list[Image.Image] = []
    for transparent in (False, True):
        panel.get_by_label("Transparent background").set_checked(transparent)
        with panel.expect_download() as download:
            panel.get_by_role("button", name="Save a PNG").click()
        assert download.value.suggested_filename == "Étude 1.png"
        pictures.append(Image.open(io.BytesIO(Path(download.value.path()).read_bytes())))
    whole, alone = (np.asarray(picture.convert("RGBA")).astype(np.int16) for picture in pictures)
    assert whole.shape == alone.shape == (720, 720, 4)
    assert (whole[..., 3] == 255).all()
    assert (alone[:40, :40, 3] == 0).all()
    solid = alone[..., 3] == 255
    assert 0.02 < solid.mean() < 0.5, "the player alone"
    # In the whole picture a little of the notes and of the air lies before the player.
    assert np.median(np.abs(whole - alone)[solid]) < 2


def test_a_browser_without_encoders_says_so(panel: Page) -> None:
    panel.evaluate("() => { window.kept = window.VideoEncoder; delete window.VideoEncoder; }")
    panel.get_by_label("Frames a second").select_option("60")
    panel.get_by_text("it has no WebCodecs").wait_for()
    assert panel.get_by_role("button", name="Make the film").is_disabled()
    assert panel.get_by_role("button", name="Save a PNG").is_enabled()
    panel.evaluate("() => { window.VideoEncoder = window.kept; }")
