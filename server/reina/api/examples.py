"""The bundled pieces: files of the examples folder, to be posted as sessions of one's own."""

import logging
from functools import lru_cache
from pathlib import Path

from fastapi import APIRouter
from fastapi.responses import FileResponse

from reina.api.http.access import ServerSettings
from reina.api.http.files import ServedFile, file_below
from reina.api.http.problems import ProblemError
from reina.errors import InputError
from reina.music import read_score
from reina.protocol.links import API
from reina.protocol.resources import Example, ExampleList

router = APIRouter(tags=["examples"])

FOLDERS = ("scores", "songs", "shows")
FIRST_VISIT = "prince-of-denmarks-march"
"""The piece that a first visitor is shown."""
SCORES = frozenset({".mid", ".midi", ".json"})

_log = logging.getLogger(__name__)


@router.get("/examples")
def list_examples(settings: ServerSettings) -> ExampleList:
    """The bundled pieces: the one for a first visit, then those with a show.

    A piece is a score in `scores`; the song and the show of the same name, if there are any, go with it.
    """
    scores = sorted(path for path in (settings.examples_dir / "scores").glob("*") if path.suffix in SCORES)
    examples: list[Example] = []
    for path in scores:
        title = _title(path, modified_ns(path))
        if title is None:
            continue
        files = {
            folder: next(iter(sorted((settings.examples_dir / folder).glob(f"{path.stem}.*"))), None)
            for folder in ("songs", "shows")
        }
        links = {folder: _href(file) if file else None for folder, file in files.items()}
        examples.append(
            Example(
                name=path.stem,
                title=title,
                score=_href(path),
                song=links["songs"],
                show=links["shows"],
            )
        )
    examples.sort(key=lambda example: (example.name != FIRST_VISIT, example.show is None))
    return ExampleList(examples=examples)


@router.get("/examples/{folder}/{name}", response_class=FileResponse)
def get_example_file(folder: str, name: str, settings: ServerSettings) -> ServedFile:
    """One file of a bundled piece."""
    path = file_below(settings.examples_dir / folder, name) if folder in FOLDERS else None
    if path is None:
        raise ProblemError(
            404, "unknown-example", "There is no such example", f"the examples have no file {folder}/{name}"
        )
    return ServedFile(path)


def _href(path: Path) -> str:
    return f"{API}/examples/{path.parent.name}/{path.name}"


def modified_ns(path: Path) -> int:
    """When a file was written last, for what is kept of it; 0 where it cannot be told."""
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return 0


@lru_cache(maxsize=256)
def _title(path: Path, modified_ns: int) -> str | None:  # noqa: ARG001 - a file that is written anew is read anew
    """A score's title; None, and a line in the log, where it cannot be read: the others are there."""
    try:
        return read_score(path.read_bytes(), filename=path.name).title
    except (InputError, OSError) as error:
        _log.warning("the example %s is left out: %s", path.name, error)
        return None
