"""Rigs: their descriptions and their files."""

import json
from pathlib import Path
from typing import Any

from fastapi import APIRouter
from fastapi.responses import FileResponse

from reina.api.http.access import ServerSettings
from reina.api.http.files import ServedFile, file_below
from reina.api.http.problems import ProblemError
from reina.protocol.links import rig_href
from reina.protocol.resources import RigList, RigSummary

router = APIRouter(tags=["rigs"])

DESCRIPTION = "rig.json"
MEDIA_TYPES = {
    ".glb": "model/gltf-binary",
    ".bvh": "text/plain",
    ".json": "application/json",
    ".md": "text/markdown",
}


@router.get("/rigs")
def list_rigs(settings: ServerSettings) -> RigList:
    """The rigs that this server has."""
    names = sorted(path.parent.name for path in settings.rigs_dir.glob(f"*/{DESCRIPTION}"))
    return RigList(rigs=[RigSummary(name=name, href=rig_href(name)) for name in names])


@router.get("/rigs/{name}")
def get_rig(name: str, settings: ServerSettings) -> dict[str, Any]:
    """A rig: joints at rest, effectors, contacts, what moves, and links to its models."""
    rig: dict[str, Any] = json.loads(rig_description(settings.rigs_dir, name).read_bytes())
    rig["models"] = {tier: f"{rig_href(name)}/{file}" for tier, file in rig.get("models", {}).items()}
    return rig


@router.get("/rigs/{name}/{file:path}", response_class=FileResponse)
def get_rig_file(name: str, file: str, settings: ServerSettings) -> ServedFile:
    """One of a rig's files: a model, a clip, its licence."""
    path = _file(settings.rigs_dir, name, file)
    # A model that is built anew keeps its name.
    return ServedFile(path, media_type=MEDIA_TYPES.get(path.suffix))


def rig_description(rigs_dir: Path, name: str) -> Path:
    """A rig's `rig.json`.

    Raises:
        ProblemError: 404, no rig has that name, which may be anything that came in a request.
    """
    description = file_below(rigs_dir, f"{name}/{DESCRIPTION}")
    if description is None or description.parent != rigs_dir.resolve() / name:
        raise ProblemError(404, "unknown-rig", "There is no such rig", f"no rig has the name {name!r}")
    return description


def _file(rigs_dir: Path, name: str, file: str) -> Path:
    path = file_below(rig_description(rigs_dir, name).parent, file)
    if path is None:
        raise ProblemError(404, "unknown-file", "The rig has no such file", f"{name} has no file {file!r}")
    return path
