"""The page: the files that `npm run build` made."""

from pathlib import Path

from fastapi import APIRouter
from fastapi.responses import FileResponse
from starlette.convertors import PathConvertor, register_url_convertor

from reina.api.access import ServerSettings
from reina.api.files import file_below
from reina.api.problems import ProblemError
from reina.api.settings import Settings

router = APIRouter(include_in_schema=False)

READING = ["GET", "HEAD"]
HASHED = "assets"
"""Files in this folder have their content's hash in their name: they never change."""


class PageFileConvertor(PathConvertor):
    """Any path but the API's, whose own errors are not to be taken for missing files."""

    regex = "(?!api/).+"


register_url_convertor("page_file", PageFileConvertor())


@router.api_route("/", methods=READING)
@router.api_route("/s/{session_id}", methods=READING)
def get_page(settings: ServerSettings) -> FileResponse:
    """The page; which session it shows it reads from its own address."""
    return _document(settings, "index.html")


@router.api_route("/lab", methods=READING)
def get_lab(settings: ServerSettings) -> FileResponse:
    """The laboratory: a page of its own."""
    return _document(settings, "lab.html")


def _document(settings: Settings, name: str) -> FileResponse:
    path = settings.page_dir / name
    if not path.is_file():
        raise ProblemError(
            503,
            "no-page",
            "The page has not been built",
            "`make setup` builds it; the API answers without it",
        )
    return FileResponse(path, headers={"Cache-Control": "no-cache"})


@router.api_route("/{file:page_file}", methods=READING)
def get_file(file: str, settings: ServerSettings) -> FileResponse:
    """A file of the page."""
    path = file_below(settings.page_dir, file)
    if path is None:
        raise ProblemError(
            404,
            "unknown-address",
            "Not Found",
            f"there is nothing at /{file}; the API stands under /api/v1, see /docs",
        )
    lasting = Path(file).parts[0] == HASHED
    caching = "public, max-age=31536000, immutable" if lasting else "no-cache"
    return FileResponse(path, headers={"Cache-Control": caching})
