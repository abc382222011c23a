"""The folders of `reina bake`: where scores come from, and what is there of each of them already.

A piece's folder is made in `STAGING` and put in its place whole, with its manifest in it: what has a
manifest is all there.
"""

from __future__ import annotations

import os
import secrets
import shutil
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, cast

from reina.cli.bake.work import BLOCKS
from reina.errors import InputError
from reina.sessions.file_role import LOOKED_AT_BYTES, OTHER_JSON, SCORE_SUFFIXES, role_of
from reina.system.json_text import json_text, read_json

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator, Mapping
    from pathlib import Path

MANIFEST = "bake.json"
VERSION = 1
STAGING = ".staging"
"""In the output: what is being made, and what was when a bake ended."""
BY_REVISION = ".blocks"
"""In the output: a link to the blocks of each revision, so that a server of files finds them by it alone."""

Document = dict[str, Any]


def scores_in(folder: Path, output: Path) -> list[Path]:
    """The scores below a folder, sorted; hidden files, the output, and JSON that is no score are left out.

    Args:
        folder: Where to look.
        output: Where what is baked goes.
    """
    found: list[Path] = []
    apart = output.resolve()
    for path, folders, files in os.walk(folder):
        here = folder / os.path.relpath(path, folder)
        folders[:] = [
            name for name in folders if not name.startswith(".") and (here / name).resolve() != apart
        ]
        found += [here / name for name in files if not name.startswith(".") and _is_score(here / name)]
    return sorted(found)


def _is_score(path: Path) -> bool:
    """Whether a file is a score, or is called so: then it is told what is wrong with it."""
    suffix = path.suffix.lower()
    if suffix in SCORE_SUFFIXES and suffix != ".json":
        return True
    try:
        with path.open("rb") as file:
            role = role_of(file.read(LOOKED_AT_BYTES), path.name)
    except OSError:
        return suffix == ".json"
    return role.role == "score" and role is not OTHER_JSON


@dataclass(frozen=True)
class Baked:
    """What there is of a piece.

    Attributes:
        folder: Where.
        document: Its manifest.
    """

    folder: Path
    document: Document

    @classmethod
    def read(cls, folder: Path) -> Baked | None:
        """What is in a folder; None where nothing whole is."""
        try:
            document: object = read_json((folder / MANIFEST).read_bytes())
        except (OSError, ValueError):
            return None
        if not isinstance(document, dict):
            return None
        fields = cast("Document", document)
        return cls(folder, fields) if fields.get("version") == VERSION else None

    def parts_of(self, source: Mapping[str, object], soundfont: str | None) -> dict[str, Document]:
        """The parts that are there as they would be made now.

        Args:
            source: What they would be made of: `made_by`, `score`, `instrument`.
            soundfont: What sound would be made with.
        """
        if any(self.document.get(name) != value for name, value in source.items()):
            return {}
        parts = cast("dict[str, Document]", self.document.get("parts", {}))
        return {
            name: part
            for name, part in parts.items()
            if (name != "sound" or part.get("soundfont") == soundfont) and self._has(part)
        }

    def _has(self, part: Document) -> bool:
        sizes = cast("dict[str, int]", part["files"])
        try:
            return all((self.folder / name).stat().st_size == size for name, size in sizes.items())
        except OSError:
            return False


@dataclass
class Draft:
    """A piece that is being made.

    Attributes:
        folder: Where, in the staging folder.
        sizes: How many bytes each file has that was written.
    """

    folder: Path
    sizes: dict[str, int] = field(default_factory=dict[str, int])

    def add(self, name: str, data: bytes) -> None:
        """Write a file, or the next bytes of it.

        Raises:
            OSError: It cannot be written.
        """
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("ab") as file:
            file.write(data)
        self.sizes[name] = self.sizes.get(name, 0) + len(data)

    def take(self, baked: Baked, part: Document) -> None:
        """Keep a part that is there already."""
        for name in cast("dict[str, int]", part["files"]):
            path = self.folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            os.link(baked.folder / name, path)

    def drop(self) -> None:
        """Let go of it."""
        shutil.rmtree(self.folder, ignore_errors=True)


class Library:
    """What is baked.

    Args:
        output: Where; it is there, and nobody else bakes into it.
    """

    def __init__(self, output: Path) -> None:
        self._output = output
        self._staging = output / STAGING

    @contextmanager
    def open(self) -> Generator[Path]:
        """What an earlier bake left half made is removed; gives a folder for what is kept aside."""
        shutil.rmtree(self._staging, ignore_errors=True)
        scratch = self._staging / "workers"
        try:
            scratch.mkdir(parents=True)
            (self._output / BY_REVISION).mkdir(exist_ok=True)
        except OSError as error:
            raise InputError(f"nothing can be written to {self._output}: {error.strerror}") from error
        try:
            yield scratch
        finally:
            shutil.rmtree(self._staging, ignore_errors=True)
            self._forget_revisions()
            # What a bake that has ended says to be there is there after a power cut, too.
            os.sync()

    def folder(self, name: str) -> Path:
        """Where a piece goes.

        Args:
            name: The score's path in its folder.
        """
        return self._output / name

    def draft(self) -> Draft:
        """Begin a piece."""
        folder = self._staging / secrets.token_hex(8)
        folder.mkdir()
        return Draft(folder)

    def put(self, draft: Draft, name: str, document: Document) -> None:
        """Have a piece in its place, whole, or not at all.

        Nothing is synced: a file that a power cut shortens has not the size that the manifest says, and the
        next bake makes it anew.

        Args:
            draft: What was made.
            name: The score's path in its folder.
            document: Its manifest.

        Raises:
            OSError: It cannot be written.
        """
        draft.add(MANIFEST, json_text(document))
        place = self.folder(name)
        place.parent.mkdir(parents=True, exist_ok=True)
        gone = self._staging / secrets.token_hex(8)
        with suppress(FileNotFoundError):
            place.rename(gone)
        draft.folder.rename(place)
        shutil.rmtree(gone, ignore_errors=True)
        if BLOCKS in document["parts"]:
            self._name_revision(place / BLOCKS / document["parts"][BLOCKS]["revision"])

    def _name_revision(self, blocks: Path) -> None:
        link, draft = self._output / BY_REVISION / blocks.name, self._staging / secrets.token_hex(8)
        draft.symlink_to(os.path.relpath(blocks, link.parent), target_is_directory=True)
        draft.replace(link)

    def _forget_revisions(self) -> None:
        """Remove the links to what is no longer there."""
        for link in self._links():
            if not link.exists():
                link.unlink(missing_ok=True)

    def _links(self) -> Iterator[Path]:
        with suppress(FileNotFoundError):
            yield from (self._output / BY_REVISION).iterdir()
