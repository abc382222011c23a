"""The bundled pieces: files of the examples folder, to be posted as sessions of one's own."""

from functools import lru_cache
from pathlib import Path

from fastapi import APIRouter
from fastapi.responses import FileResponse

from reina.api.http.access import ServerSettings
from reina.api.http.files import ServedFile, file_below
from reina.api.http.problems import ProblemError
from reina.music import read_score
from reina.protocol.links import API
from reina.protocol.resources import Example, ExampleList

router = APIRouter(tags=["examples"])

FOLDERS = ("scores", "songs", "shows")
FIRST_VISIT = "prince-of-denmarks-march"
"""The piece that a first visitor is shown."""
SCORES = frozenset({".mid", ".midi", ".json"})


@router.get("/examples")
def list_examples(settings: ServerSettings) -> ExampleList:
    """The bundled pieces: the one for a first visit, then those with a show.

    A piece is a score in `scores`; the song and the show of the same name, if there are any, go with it.
    """
    scores = sorted(path for path in (settings.examples_dir / "scores").glob("*") if path.suffix in SCORES)
    examples: list[Example] = []
    for path in scores:
        files = {
            folder: next(iter(sorted((settings.examples_dir / folder).glob(f"{path.stem}.*"))), None)
            for folder in ("songs", "shows")
        }
        links = {folder: _href(file) if file else None for folder, file in files.items()}
        examples.append(
            Example(
                name=path.stem,
                title=_title(path, path.stat().st_mtime_ns),
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


@lru_cache(maxsize=256)
def _title(path: Path, modified_ns: int) -> str:  # noqa: ARG001 - a file that is written anew is read anew
    return read_score(path.read_bytes(), filename=path.name).title
