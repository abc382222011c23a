"""Film a phrase from the page itself, one picture every 50 ms: docs/images/film-*.webp.

Run as ``python docs/plots/film_strip.py`` (a Chromium is found as the browser tests find theirs; it takes
some minutes where OpenGL is drawn in software). Of the trumpeter it is a breath and the quick variation of
the carnival of Venice; of the drummer a fill over the toms, and swung eighths on the hi-hat, of the saints.
"""

from __future__ import annotations

import argparse
import io
import math
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import numpy as np
from PIL import Image, ImageDraw
from playwright.sync_api import sync_playwright

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from tests.e2e.conftest import BROWSER_ARGUMENTS  # noqa: E402
from tests.e2e.find_browser import find_browser  # noqa: E402
from tests.e2e.opened import Opened  # noqa: E402
from tests.integration.server import serve  # noqa: E402
from tests.integration.stranger import button, take  # noqa: E402

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

SCORES = ROOT / "examples" / "scores"
CARNIVAL, SAINTS = "carnival-of-venice.mid", "when-the-saints.mid"
STEP_S = 0.05
FPS = 60
WINDOW = (800, 450)
"""Wide enough that the page frames the show's picture in the whole of it."""


@dataclass(frozen=True)
class View:
    """Where the camera stands, metres, and which part of its 16:9 picture is kept.

    One that follows the hand stands and looks relative to the top of the second valve's button.
    """

    name: str
    score: str
    start_s: float
    position: tuple[float, float, float]
    target: tuple[float, float, float]
    fov_rad: float
    kept: tuple[int, int]
    """Width and height about the middle, pixels."""
    columns: int
    rows: int
    follows_hand: bool = False

    def times_s(self) -> list[float]:
        """When each picture is taken, on the grid of frames."""
        return [round((self.start_s + n * STEP_S) * FPS) / FPS for n in range(self.columns * self.rows)]

    def show(self, hand: NDArray[np.float64]) -> dict[str, Any]:
        """A show with nothing but this camera; the hand's places are those of `times_s`, ``(N, 3)``."""
        places = hand if self.follows_hand else np.zeros_like(hand)
        values: dict[str, list[Any]] = {
            "camera/position": (places + self.position).tolist(),
            "camera/target": (places + self.target).tolist(),
            "camera/fov": [self.fov_rad] * len(places),
        }
        tracks = [
            {
                "parameter": path,
                "keyframes": [
                    {"time": time_s, "value": value, "interpolation": "linear"}
                    for time_s, value in zip(self.times_s(), found, strict=True)
                ],
            }
            for path, found in values.items()
        ]
        return {"version": 1, "tracks": tracks}


VIEWS = (
    View(
        "hand",
        CARNIVAL,
        14.55,
        (0.34, 0.22, 0.32),
        (-0.025, -0.01, 0.0),
        0.30,
        (520, 450),
        8,
        4,
        follows_hand=True,
    ),
    View("body", CARNIVAL, 14.55, (-1.75, 1.25, 2.75), (0.06, 0.85, 0.14), 0.55, (270, 450), 12, 4),
    View("fill", SAINTS, 13.75, (0.15, 2.55, -2.75), (-0.1, 0.98, -1.7), 0.58, (530, 420), 6, 4),
    View("hats", SAINTS, 24.65, (1.35, 2.05, -2.15), (0.12, 1.1, -1.82), 0.56, (530, 420), 6, 4),
)


def film(view: View, opened: Opened, client: httpx.Client, session: str) -> Iterator[Image.Image]:
    """Pictures of a view, `STEP_S` apart."""
    path = f"/api/v1/sessions/{session}"
    times_s = view.times_s()
    hand = np.zeros((len(times_s), 3))
    if view.follows_hand:
        frames = take(client, session, times_s[0], times_s[-1] + 1.0 / FPS)
        frames.parameters["trumpet/valve/2"][:] = 0.0  # where the button is when it is up
        chosen = [int(np.argmin(np.abs(frames.song_time_s - time_s))) for time_s in times_s]
        hand = button(frames.skeleton("trumpet"), frames, 2)[chosen]
    client.put(f"{path}/show", headers=opened.headers, json=view.show(hand)).raise_for_status()
    width, height = view.kept
    left, top = (WINDOW[0] - width) // 2, (WINDOW[1] - height) // 2
    for song_time_s in times_s:
        state = client.post(
            f"{path}/transport",
            headers=opened.headers,
            json={"action": "seek", "song_time_s": song_time_s},
        )
        opened.until_at_rest(state.raise_for_status().json())
        picture = Image.open(io.BytesIO(opened.page.screenshot())).convert("RGB")
        yield picture.crop((left, top, left + width, top + height))


def strip(view: View, pictures: list[Image.Image], width: int) -> Image.Image:
    """Pictures in rows, each with its time from the first, milliseconds."""
    height = round(width * view.kept[1] / view.kept[0])
    sheet = Image.new("RGB", (view.columns * width, view.rows * height))
    for number, picture in enumerate(pictures):
        small = picture.resize((width, height), Image.Resampling.LANCZOS)
        ImageDraw.Draw(small).text((4, 2), f"{number * round(STEP_S * 1000)}", fill=(255, 255, 255))
        sheet.paste(small, ((number % view.columns) * width, number // view.columns * height))
    return sheet


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--images", type=Path, default=ROOT / "docs" / "images", help="where to write")
    parser.add_argument("--views", nargs="*", default=[view.name for view in VIEWS])
    options = parser.parse_args()
    browser = find_browser()
    if browser is None:
        parser.error("there is no Chromium: make test sets one up, or name one in REINA_BROWSER")
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder)) as running,
        httpx.Client(base_url=running.address, timeout=60.0) as client,
        sync_playwright() as playwright,
    ):
        chromium = playwright.chromium.launch(executable_path=str(browser), args=list(BROWSER_ARGUMENTS))
        page = chromium.new_page(viewport={"width": WINDOW[0], "height": WINDOW[1]})
        opened = Opened(page, running.address)
        wanted = [view for view in VIEWS if view.name in options.views]
        for score in dict.fromkeys(view.score for view in wanted):
            opened.go("/")
            opened.open_files((score, "audio/midi", (SCORES / score).read_bytes()))
            page.goto(f"{running.address}/s/{opened.session}?tier=medium")
            opened.until_drawn()
            opened.hide_panels()
            for view in (view for view in wanted if view.score == score):
                pictures = list(film(view, opened, client, opened.session))
                width = math.floor(1920 / view.columns)
                strip(view, pictures, width).save(options.images / f"film-{view.name}.webp", quality=82)
        chromium.close()


if __name__ == "__main__":
    main()
