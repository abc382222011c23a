"""Draw the pictures of docs/images anew, or those that are named.

`.venv/bin/python -m tests.pictures.renew [page] [sheet] [players] [kit] [band] [editor]`.

Needs what `make test` sets up: the development packages, the built page and a Chromium.
"""

from __future__ import annotations

import argparse
import io
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
from PIL import Image, ImageDraw, ImageFont
from playwright.sync_api import sync_playwright
from tests.e2e.conftest import storing
from tests.e2e.find_browser import browser_path
from tests.e2e.opened import Opened
from tests.e2e.shows import ShowPage, remembering
from tests.e2e.waiting import wait_until
from tests.integration.server import serve, upload
from tests.pictures.gallery import PATIENCE_MS, GalleryPage, vite

from reina.cli.browser import GRAPHICS

if TYPE_CHECKING:
    from playwright.sync_api import Browser
    from tests.integration.server import Running

ROOT = Path(__file__).parents[2]
IMAGES = ROOT / "docs/images"
PAGE_SIZE = (1280, 720)
PAGE_MOMENT_S = 1.4
PAGE_LATEST_S = 6.0
"""Within the first shot of the bundled show, with the player and the notes in it."""

DRAWN = (640, 360)
SHOWN = (400, 225)
CAMERAS = ("whole_figure", "three_quarter", "valves", "face", "player", "hall")
PIECES = {
    "prince-of-denmarks-march.mid": (
        {"time": 4.2, "light": "as the show has it", "style": "physical", "finish": "lacquer"},
        {"time": 17.9, "light": "concert", "style": "physical", "finish": "lacquer"},
        {"time": 26.3, "light": "as the show has it", "style": "toon", "finish": "lacquer"},
        {"time": 58.0, "light": "last sun", "style": "physical", "finish": "lacquer"},
    ),
    "carnival-of-venice.mid": (
        {"time": 3.1, "light": "as the show has it", "style": "physical", "finish": "silver"},
        {"time": 11.6, "light": "one spot", "style": "physical", "finish": "lacquer"},
        {"time": 21.2, "light": "concert", "style": "toon", "finish": "lacquer"},
        {"time": 27.4, "light": "night", "style": "physical", "finish": "silver"},
    ),
}
PORTRAYED = "prince-of-denmarks-march.mid"
PORTRAIT = (640, 720)
PORTRAIT_VIEW: dict[str, Any] = {
    "time": 4.2,
    "light": "as the show has it",
    "style": "physical",
    "camera": "the show's",
}
View = tuple[list[float], list[float], float, dict[str, Any]]
PORTRAITS: dict[str, tuple[View, ...]] = {
    "trumpeter": (
        ([0.5, 1.6, 1.0], [0.02, 1.43, 0.22], 0.42, {}),
        ([-1.5, 1.3, 2.3], [0.08, 0.98, 0.15], 0.6, {}),
        ([0.75, 1.4, -1.5], [0.02, 1.15, 0.05], 0.55, {}),
        ([0.75, 1.5, 1.3], [0.02, 1.32, 0.15], 0.45, {"style": "toon"}),
    ),
    "soloist": (
        ([0.5, 1.72, 1.0], [0.02, 1.52, 0.22], 0.42, {}),
        ([-1.5, 1.35, 2.4], [0.08, 1.02, 0.15], 0.64, {}),
        ([0.65, 1.4, -1.5], [0.02, 1.2, 0.05], 0.6, {}),
        ([0.85, 1.5, 1.5], [0.05, 1.4, 0.3], 0.45, {"light": "concert", "values": {"trumpet/mute": [1.0]}}),
    ),
}
KIT_AT = (0.0, 0.2, -2.15)
"""On the platform behind the players."""
KIT_SIZE = (640, 420)
KIT_VIEWS: tuple[View, ...] = (
    ([1.5, 1.5, 1.35], [-0.1, 0.78, -1.6], 0.62, {}),
    ([0.0, 1.52, -2.4], [-0.1, 0.8, -1.35], 1.15, {}),
    ([-0.1, 3.1, -1.75], [-0.1, 0.6, -1.6], 0.7, {}),
    ([-0.75, 1.75, -2.3], [-0.7, 1.2, -1.63], 0.5, {}),
    ([-1.0, 0.75, 0.15], [-0.1, 0.75, -1.55], 0.5, {}),
    ([0.9, 1.3, -2.05], [0.38, 1.02, -1.55], 0.45, {}),
    ([1.2, 1.6, 1.6], [-0.1, 0.8, -1.6], 0.6, {"light": "concert"}),
    ([-1.4, 1.5, 1.5], [-0.1, 0.8, -1.6], 0.6, {"style": "toon"}),
)
BAND = "when-the-saints"
BAND_SIZE = (1280, 720)
BAND_MOMENT_S = 46.2
"""In the last chorus, where the show has both in one picture."""
EDITED = "prince-of-denmarks-march"
EDITOR_SIZE = (1440, 900)
EDITOR_MOMENT_S = 30.0
INK, PAPER = (20, 23, 31), (244, 239, 230)
GAP, HEAD, SIDE = 6, 30, 150


def draw_page(browser: Browser, server: Running) -> None:
    """The readme's picture: the page as it plays, with its panels."""
    page = browser.new_page(viewport={"width": PAGE_SIZE[0], "height": PAGE_SIZE[1]})
    page.set_default_timeout(PATIENCE_MS)
    page.goto(f"{server.address}/?tier=full")
    wait_until(page, "window.reina?.drawn", patience_s=PATIENCE_MS / 1000)
    page.keyboard.press("Space")
    wait_until(page, "window.reina.playing", patience_s=PATIENCE_MS / 1000)
    # The panels stay while the pointer is on one.
    page.mouse.move(PAGE_SIZE[0] / 2, PAGE_SIZE[1] - 22)
    png = b""
    for _ in range(6):
        page.keyboard.press("Home")
        page.wait_for_timeout(1000 * PAGE_MOMENT_S)
        png = page.screenshot(timeout=PATIENCE_MS)
        if 0.5 < page.evaluate("window.reina.drawnIndex / 60") < PAGE_LATEST_S:
            break
    Image.open(io.BytesIO(png)).convert("RGB").save(IMAGES / "page.png", optimize=True)
    page.close()


def draw_sheet(browser: Browser, server: Running) -> None:
    """Six cameras, four moments of two pieces: what a critic looks at."""
    rows = sum(len(moments) for moments in PIECES.values())
    width = SIDE + len(CAMERAS) * (SHOWN[0] + GAP)
    sheet = Image.new("RGB", (width, HEAD + rows * (SHOWN[1] + GAP)), INK)
    write = ImageDraw.Draw(sheet)
    font = ImageFont.load_default(size=15)
    for column, camera in enumerate(CAMERAS):
        write.text((SIDE + column * (SHOWN[0] + GAP), 7), camera.replace("_", " "), fill=PAPER, font=font)
    y = HEAD
    with httpx.Client(base_url=server.address, timeout=60.0) as client, vite(server.address) as address:
        for name, moments in PIECES.items():
            session = upload(client, (ROOT / "examples/scores" / name).read_bytes(), name)
            gallery = GalleryPage(browser, address, session.id, size=DRAWN, tier="full")
            for moment in moments:
                label = [Path(name).stem.replace("-", "\n", 1), f"{moment['time']} s"]
                label += [str(moment[key]) for key in ("light", "style", "finish")]
                write.multiline_text((8, y + 8), "\n".join(label), fill=PAPER, font=font, spacing=6)
                for column, camera in enumerate(CAMERAS):
                    png = gallery.picture({**moment, "camera": camera})
                    picture = (
                        Image.open(io.BytesIO(png)).convert("RGB").resize(SHOWN, Image.Resampling.LANCZOS)
                    )
                    sheet.paste(picture, (SIDE + column * (SHOWN[0] + GAP), y))
                y += SHOWN[1] + GAP
            gallery.page.close()
    sheet.save(IMAGES / "contact-sheet.webp", quality=86, method=6)


def draw_players(browser: Browser, server: Running) -> None:
    """Each player from near and from all about, as the rigs' readme shows them."""
    with httpx.Client(base_url=server.address, timeout=60.0) as client, vite(server.address) as address:
        for player, views in PORTRAITS.items():
            score = ROOT / "examples/scores" / PORTRAYED
            session = upload(client, score.read_bytes(), PORTRAYED, player=player)
            gallery = GalleryPage(browser, address, session.id, size=PORTRAIT, tier="full")
            strip = Image.new("RGB", (len(views) * (PORTRAIT[0] + GAP) - GAP, PORTRAIT[1]), INK)
            for column, (position, target, fov, rest) in enumerate(views):
                values = {"camera/position": position, "camera/target": target, "camera/fov": [fov]}
                values |= rest.get("values", {})
                png = gallery.picture({**PORTRAIT_VIEW, **rest, "values": values})
                strip.paste(Image.open(io.BytesIO(png)).convert("RGB"), (column * (PORTRAIT[0] + GAP), 0))
            strip.save(IMAGES / f"{player}.webp", quality=88, method=6)
            gallery.page.close()


def draw_kit(browser: Browser, server: Running) -> None:
    """The drum kit from the hall, from the stool, from above and from near, as the rigs' readme shows it."""
    with httpx.Client(base_url=server.address, timeout=60.0) as client, vite(server.address) as address:
        session = upload(client, (ROOT / "examples/scores" / PORTRAYED).read_bytes(), PORTRAYED)
        stood = f"drumkit@{','.join(str(metres) for metres in KIT_AT)}"
        gallery = GalleryPage(browser, address, session.id, size=KIT_SIZE, tier="full", rigs=[stood])
        columns = len(KIT_VIEWS) // 2
        size = (columns * (KIT_SIZE[0] + GAP) - GAP, 2 * (KIT_SIZE[1] + GAP) - GAP)
        sheet = Image.new("RGB", size, INK)
        for number, (position, target, fov, rest) in enumerate(KIT_VIEWS):
            values = {"camera/position": position, "camera/target": target, "camera/fov": [fov]}
            png = gallery.picture({**PORTRAIT_VIEW, **rest, "values": values})
            row, column = divmod(number, columns)
            place = (column * (KIT_SIZE[0] + GAP), row * (KIT_SIZE[1] + GAP))
            sheet.paste(Image.open(io.BytesIO(png)).convert("RGB"), place)
        sheet.save(IMAGES / "drumkit.webp", quality=86, method=6)
        gallery.page.close()


def draw_band(browser: Browser, server: Running) -> None:
    """Trumpeter and drummer, as their example's own show has them."""
    with httpx.Client(base_url=server.address, timeout=60.0) as client, vite(server.address) as address:
        session = upload(
            client,
            (ROOT / f"examples/scores/{BAND}.mid").read_bytes(),
            f"{BAND}.mid",
            show=("show.json", (ROOT / f"examples/shows/{BAND}.json").read_bytes()),
        )
        gallery = GalleryPage(browser, address, session.id, size=BAND_SIZE, tier="full")
        png = gallery.picture({"time": BAND_MOMENT_S, "camera": "the show's"})
        Image.open(io.BytesIO(png)).convert("RGB").save(IMAGES / "band.webp", quality=86, method=6)
        gallery.page.close()


def draw_editor(browser: Browser, server: Running) -> None:
    """The show's editor over its own example, some of the camera's keyframes chosen."""
    with httpx.Client(base_url=server.address, timeout=60.0) as client:
        session = upload(
            client,
            (ROOT / f"examples/scores/{EDITED}.mid").read_bytes(),
            f"{EDITED}.mid",
            show=("show.json", (ROOT / f"examples/shows/{EDITED}.json").read_bytes()),
        )
        context = browser.new_context(viewport={"width": EDITOR_SIZE[0], "height": EDITOR_SIZE[1]})
        context.add_init_script(storing(remembering(session.body)))
        page = context.new_page()
        page.set_default_timeout(PATIENCE_MS)
        opened = Opened(page, server.address)
        page.goto(f"{server.address}/s/{session.id}?tier=full")
        opened.until_drawn()
        editor = ShowPage(opened, client).open()
        editor.seek(EDITOR_MOMENT_S)
        top, low = editor.key("camera/position", "k2")[1], editor.key("camera/fov", "k2")[1]
        editor.drag((editor.ruler(7.0)[0], top - 9), (editor.ruler(22.0)[0], low + 9))
        opened.until("window.reina.show.chosen.length > 8")
        png = page.screenshot(timeout=PATIENCE_MS)
        context.close()
    Image.open(io.BytesIO(png)).convert("RGB").save(IMAGES / "editor.webp", quality=86, method=6)


PICTURES = {
    "page": draw_page,
    "sheet": draw_sheet,
    "players": draw_players,
    "kit": draw_kit,
    "band": draw_band,
    "editor": draw_editor,
}


def main() -> None:
    """Draw the pictures that are named, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pictures", nargs="*", choices=[*PICTURES, []], help="which to draw; all by default")
    wanted: list[str] = parser.parse_args().pictures or list(PICTURES)
    IMAGES.mkdir(parents=True, exist_ok=True)
    with (
        tempfile.TemporaryDirectory() as data,
        serve(Path(data)) as server,
        sync_playwright() as playwright,
    ):
        browser = playwright.chromium.launch(executable_path=browser_path(), args=["--no-sandbox", *GRAPHICS])
        for name in wanted:
            begun = time.monotonic()
            PICTURES[name](browser, server)
            print(f"{name}: {time.monotonic() - begun:.0f} s")
        browser.close()


if __name__ == "__main__":
    main()
