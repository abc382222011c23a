"""`reina bake FOLDER`: what a library of scores needs, made beforehand, on all processors or machines."""

from __future__ import annotations

import argparse
import os
import sys
import time
from contextlib import ExitStack
from pathlib import Path

from reina.cli.bake import work
from reina.cli.bake.bakery import PARTS, Bakery, Recipe, Summary
from reina.cli.bake.library import Library, scores_in
from reina.cli.progress_line import ProgressLine, length_of_time
from reina.errors import InputError
from reina.instruments import INSTRUMENTS
from reina.sessions.storage.directory_lock import DirectoryInUseError, locked
from reina.sound.font import SoundError, soundfont_id
from reina.sound.provide_soundfont import own_soundfont
from reina.system.cluster import cluster_at, local_cluster
from reina.system.json_text import json_text

PLACES = 24
"""Of the bar, columns."""
INTERRUPTED = 130


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "folder", type=Path, metavar="FOLDER", help="MIDI, MusicXML and JSON scores, in folders"
    )
    parser.add_argument(
        "--out", type=Path, metavar="OUT", help="where to write, a folder a score (FOLDER-baked, beside it)"
    )
    parser.add_argument(
        "--only",
        type=_parts,
        default=frozenset(PARTS),
        metavar="PARTS",
        help=f"make these alone, of {','.join(PARTS)}; what else is there of a score stays",
    )
    parser.add_argument(
        "--instrument",
        choices=sorted(name for name, one in INSTRUMENTS.items() if one.rig),
        help="what plays the part that suits it best; who plays when a score is opened by default",
    )
    who = parser.add_mutually_exclusive_group()
    who.add_argument(
        "--workers",
        type=_count,
        default=processors(),
        metavar="N",
        help=f"processes on this machine ({processors()})",
    )
    who.add_argument(
        "--scheduler", metavar="URL", help="work on the Dask cluster of this scheduler, tcp://host:8786"
    )
    parser.add_argument(
        "--json", action="store_true", help="print what became of each score as JSON at the end"
    )


def run(arguments: argparse.Namespace) -> int:
    """Bake; returns 1 where a score could not be, or nothing, with the reasons on stderr."""
    folder: Path = arguments.folder
    line = ProgressLine(sys.stdout if not arguments.json else sys.stderr)
    progress = _Progress(line)
    try:
        summary = _bake(folder, arguments, progress)
    except (InputError, SoundError, OSError) as error:
        line.end()
        print(f"reina bake: {_reason(error)}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        line.end()
        print(
            f"reina bake: called off, {progress.done} of {progress.scores} scores are there; "
            "the same command goes on from here",
            file=sys.stderr,
        )
        return INTERRUPTED
    line.end()
    if arguments.json:
        document = {"made": summary.made, "there": summary.there, "failed": summary.failed}
        print(json_text(document).decode())
    else:
        print(
            f"{len(summary.made)} made, {len(summary.there)} there already, {len(summary.failed)} failed, "
            f"in {length_of_time(progress.seconds)}"
        )
    return 1 if summary.failed else 0


def processors() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _bake(folder: Path, arguments: argparse.Namespace, progress: _Progress) -> Summary:
    if not folder.is_dir():
        raise InputError(f"{folder} is no folder; name one with scores in it")
    output: Path = arguments.out or folder.resolve().with_name(f"{folder.resolve().name}-baked")
    scores = scores_in(folder, output)
    if not scores:
        raise InputError(f"there are no scores in {folder}: MIDI, MusicXML or JSON")
    progress.scores = len(scores)
    parts: frozenset[str] = arguments.only
    soundfont = soundfont_id(own_soundfont()) if "sound" in parts else None
    recipe = Recipe(parts, arguments.instrument, work.maker(), soundfont)
    with ExitStack() as held:
        output.mkdir(parents=True, exist_ok=True)
        try:
            held.enter_context(locked(output))
        except DirectoryInUseError as error:
            raise InputError(f"something else is baked into {output}; name another with --out") from error
        library = Library(output)
        scratch = held.enter_context(library.open())
        bakery = Bakery(library, recipe, folder, progress.told)
        left = bakery.missing(scores)
        if left:
            scheduler: str | None = arguments.scheduler
            workers = cluster_at(scheduler) if scheduler else local_cluster(arguments.workers, scratch)
            bakery.bake(held.enter_context(workers), left)
        return bakery.summary


class _Progress:
    """A bar of what is done, how long it takes on, and what failed."""

    def __init__(self, line: ProgressLine) -> None:
        self._line = line
        self._begun = time.monotonic()
        self.scores = 0
        self.done = 0

    @property
    def seconds(self) -> float:
        """How long it has taken."""
        return time.monotonic() - self._begun

    def told(self, summary: Summary, said: str) -> None:
        """A score is done, or something is to be said."""
        if said:
            self._line.end()
            print(f"reina bake: {said}", file=sys.stderr, flush=True)
        self.done = len(summary.made) + len(summary.there)
        share = summary.done / self.scores
        text = f"{summary.done} of {self.scores}"
        if self._line.on_terminal:
            full = int(PLACES * share)
            text = f"[{'#' * full}{'-' * (PLACES - full)}] {text}"
        if summary.failed:
            text += f", {len(summary.failed)} failed"
        worked = len(summary.made) + len(summary.failed)
        if worked and share < 1:
            left_s = self.seconds / worked * (self.scores - summary.done)
            text += f", {length_of_time(left_s)} left"
        self._line.tell(text, share)


def _parts(text: str) -> frozenset[str]:
    named = frozenset(text.split(","))
    if not named <= set(PARTS):
        raise argparse.ArgumentTypeError(f"{text!r} is no list of {','.join(PARTS)}")
    return named


def _count(text: str) -> int:
    if not text.isdecimal() or not int(text):
        raise argparse.ArgumentTypeError(f"{text!r} is no number of processes")
    return int(text)


def _reason(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    return str(error)
