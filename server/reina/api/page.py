"""The page: the files that `npm run build` made."""

from pathlib import Path

from fastapi import APIRouter, Request, WebSocket
from starlette.convertors import PathConvertor, register_url_convertor

from reina.api.http.access import ServerSettings
from reina.api.http.content_policy import page_policy
from reina.api.http.files import IMMUTABLE, REVALIDATED, ServedFile, file_below
from reina.api.http.problems import ProblemError
from reina.api.settings import Settings
from reina.sessions.session import OWN_ORIGIN

router = APIRouter(include_in_schema=False)

HASHED = "assets"
"""Files in this folder have their content's hash in their name: they never change."""


class PageFileConvertor(PathConvertor):
    """Any path but the API's, whose own errors are not to be taken for missing files."""

    regex = "(?!api/).+"


register_url_convertor("page_file", PageFileConvertor())


@router.get("/")
def get_page(request: Request, settings: ServerSettings) -> ServedFile:
    """The page; which session it shows it reads from its own address."""
    return _document(request, settings, "index.html")


@router.get("/s/{session_id}")
def get_session_page(request: Request, settings: ServerSettings) -> ServedFile:
    """The same; what it offers to be put into other pages, the stage without controls, may be framed."""
    return _document(request, settings, "index.html", framed=request.query_params.get("clean") == "1")


@router.get("/docs")
def get_docs(request: Request, settings: ServerSettings) -> ServedFile:
    """The description of the API, to be read."""
    return _document(request, settings, "docs/index.html")


@router.get("/lab")
def get_lab(request: Request, settings: ServerSettings) -> ServedFile:
    """The laboratory: a page of its own."""
    if not settings.lab:
        raise ProblemError(
            404,
            "no-lab",
            "There is no laboratory here",
            "the server listens to other machines too and was not started with --lab",
        )
    return _document(request, settings, "lab.html")


def _document(request: Request, settings: Settings, name: str, *, framed: bool = False) -> ServedFile:
    path = settings.page_dir / name
    if not path.is_file():
        raise ProblemError(
            503,
            "no-page",
            "The page has not been built",
            "`make setup` builds it; the API answers without it",
        )
    origin = settings.blocks_origin
    fetched = [origin] if origin and origin != OWN_ORIGIN else []
    policy = page_policy(path, request.headers.get("host", ""), framed=framed, fetched=fetched)
    shared = {"Cross-Origin-Resource-Policy": "cross-origin"} if framed else {}
    return ServedFile(path, headers={"Content-Security-Policy": policy, **shared})


@router.get("/{file:page_file}")
def get_file(file: str, request: Request, settings: ServerSettings) -> ServedFile:
    """A file of the page."""
    path = file_below(settings.page_dir, file)
    if path is None:
        raise ProblemError(
            404,
            "unknown-address",
            "Not Found",
            f"there is nothing at /{file}; the API stands under /api/v1, see /docs",
        )
    if path.suffix == ".html":
        return _document(request, settings, str(path.relative_to(settings.page_dir.resolve())))
    return ServedFile(path, caching=IMMUTABLE if Path(file).parts[0] == HASHED else REVALIDATED)


@router.websocket("/{path:path}")
async def refuse_stream(socket: WebSocket, path: str) -> None:
    """No other address has a stream."""
    detail = f"there is no stream at /{path}; /api/v1/sessions/{{id}}/stream has one"
    await socket.send_denial_response(ProblemError(404, "not-found", "Not Found", detail).response())
