"""`reina film SCORE -o FILM`: a film of a score, made by the page in a browser without a window."""

from __future__ import annotations

import argparse
import math
import re
import sys
from contextlib import ExitStack
from pathlib import Path
from urllib.parse import urlsplit

from reina.cli.browser import headless_browser
from reina.cli.film_page import Commission, film_page
from reina.cli.film_progress import FilmProgress
from reina.cli.own_server import own_server
from reina.errors import InputError

CONTAINERS = {".mp4": "mp4", ".webm": "webm"}
"""What a film's file may end with, and what it then is."""
SMALLEST_HEIGHT, LARGEST_HEIGHT = 144, 2160


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("score", type=Path, metavar="SCORE", help="a MIDI, MusicXML or JSON file")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        metavar="FILM",
        help="where to write the film; it ends with .mp4 or .webm",
    )
    parser.add_argument(
        "--song", type=Path, metavar="FILE", help="its recording; without one the score is rendered"
    )
    parser.add_argument(
        "--show", type=Path, metavar="FILE", help="the show; without one it is written from the music"
    )
    parser.add_argument(
        "--aspect", choices=("16:9", "1:1", "9:16"), default="16:9", help="the picture's shape"
    )
    parser.add_argument(
        "--height",
        type=_height,
        default=1080,
        metavar="LINES",
        help="of a 16:9 picture, the shorter side of any: 720, 1080, 1440, 2160 (1080)",
    )
    parser.add_argument("--fps", type=int, choices=(30, 60), default=60, help="frames a second (60)")
    parser.add_argument(
        "--start", type=_seconds, default=0.0, metavar="TIME", help="from here on, as 62.5 or 1:02.5"
    )
    parser.add_argument(
        "--end", type=_seconds, default=None, metavar="TIME", help="up to here; the music's end by default"
    )
    parser.add_argument(
        "--quality", choices=("small", "good", "best"), default="good", help="how many bits it gets (good)"
    )
    parser.add_argument(
        "--detail",
        choices=("full", "medium", "low"),
        default="full",
        help="how finely it is drawn (full); less is quicker where there is no graphics card",
    )
    parser.add_argument("--silent", action="store_true", help="without sound")
    parser.add_argument(
        "--server",
        type=_server,
        metavar="URL",
        help="make it on this server; by default one is started and ended again",
    )


def run(arguments: argparse.Namespace) -> int:
    """Make the film; return 1, with the reason on stderr, if it cannot be made."""
    output: Path = arguments.output
    progress = FilmProgress(sys.stderr)
    try:
        commission = _commission(arguments)
        files = _files(arguments)
        with ExitStack() as opened:
            # Whatever is missing is told before the long work begins.
            browser = opened.enter_context(headless_browser())
            address = arguments.server or opened.enter_context(own_server())
            page = opened.enter_context(film_page(browser, address, files))
            made = page.film(commission, output, progress)
    except InputError as error:
        progress.end()
        print(f"reina film: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        progress.end()
        print("reina film: called off; no film was written", file=sys.stderr)
        return 130
    progress.end()
    print(f"{output}: {made.frames} frames of {made.width} × {made.height}, {made.coding}")
    return 0


def _commission(arguments: argparse.Namespace) -> Commission:
    output: Path = arguments.output
    container = CONTAINERS.get(output.suffix.lower())
    if container is None:
        raise InputError(f"{output}: a film's file ends with {' or '.join(CONTAINERS)}")
    if not output.absolute().parent.is_dir():
        raise InputError(f"{output}: there is no folder {output.absolute().parent}")
    if output.is_dir():
        raise InputError(f"{output} is a folder; name a file in it")
    if arguments.end is not None and arguments.end <= arguments.start:
        raise InputError(
            f"the film ends at {arguments.end:g} s, not after its start at {arguments.start:g} s"
        )
    return Commission(
        start=arguments.start,
        end=arguments.end,
        aspect=arguments.aspect,
        height=arguments.height,
        fps=arguments.fps,
        quality=arguments.quality,
        detail=arguments.detail,
        camera="show",
        sound=not arguments.silent,
        container=container,
    )


def _files(arguments: argparse.Namespace) -> dict[str, tuple[str, bytes]]:
    """What is uploaded: the field's name to the file's name and bytes."""
    files: dict[str, tuple[str, bytes]] = {}
    for field in ("score", "song", "show"):
        path: Path | None = getattr(arguments, field)
        if path is None:
            continue
        try:
            files[field] = (path.name, path.read_bytes())
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}") from error
    return files


def _height(text: str) -> int:
    height = int(text) if text.isdecimal() else 0
    if not SMALLEST_HEIGHT <= height <= LARGEST_HEIGHT or height % 2:
        raise argparse.ArgumentTypeError(
            f"{text!r} is no even number from {SMALLEST_HEIGHT} to {LARGEST_HEIGHT}"
        )
    return height


def _seconds(text: str) -> float:
    found = re.fullmatch(r"(?:(\d{1,4}):)?(\d{1,6}(?:\.\d*)?)", text)
    if found is None:
        raise argparse.ArgumentTypeError(f"{text!r} is no time as 62.5 or 1:02.5")
    seconds = 60 * int(found[1] or 0) + float(found[2])
    if not math.isfinite(seconds):
        raise argparse.ArgumentTypeError(f"{text!r} is no time as 62.5 or 1:02.5")
    return seconds


def _server(text: str) -> str:
    parts = urlsplit(text)
    if parts.scheme not in ("http", "https") or not parts.netloc:
        raise argparse.ArgumentTypeError(f"{text!r} is no address as http://localhost:8000")
    return f"{parts.scheme}://{parts.netloc}"
