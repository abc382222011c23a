"""Finds the soundfont that scores are rendered with."""

import hashlib
import os
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from reina.errors import ReinaError
from reina.system.resources import default_data_dir

SOUNDFONT_VARIABLE = "REINA_SOUNDFONT"
FILE_NAME = "soundfont.sf2"


class SoundError(ReinaError):
    """Sound could not be made; the message says why and what would help."""


class MissingSoundfontError(SoundError):
    """There is no soundfont to render with."""


def find_soundfont(data_dir: Path, *, environment: Mapping[str, str] | None = None) -> Path:
    """Return the soundfont that REINA_SOUNDFONT names, else the data folder's, else the usual data folder's.

    Args:
        data_dir: The server's data folder.
        environment: Environment variables; the process's own by default.

    Raises:
        MissingSoundfontError: There is none of them, or the variable names no SF2 file.
    """
    named = (os.environ if environment is None else environment).get(SOUNDFONT_VARIABLE)
    if named:
        check_soundfont(Path(named))
        return Path(named)
    candidates = places_of_soundfonts(data_dir)
    for candidate in candidates:
        if candidate.is_file():
            check_soundfont(candidate)
            return candidate
    places = " and ".join(map(str, candidates))
    raise MissingSoundfontError(
        f"there is no soundfont to make sound with (looked for {places}): "
        f"`reina serve` unpacks the one that it comes with, in a checkout after `make setup`; "
        f"or set {SOUNDFONT_VARIABLE} to an SF2 file"
    )


def places_of_soundfonts(data_dir: Path) -> tuple[Path, ...]:
    """Where a soundfont is looked for, the first place first."""
    return tuple(dict.fromkeys((data_dir / FILE_NAME, default_data_dir() / FILE_NAME)))


def check_soundfont(path: Path) -> None:
    """Refuse what is no SF2 file.

    Raises:
        MissingSoundfontError: The file cannot be read or is of another format.
    """
    try:
        with path.open("rb") as file:
            head = file.read(12)
    except OSError as error:
        raise MissingSoundfontError(f"the soundfont {path} cannot be read: {error.strerror}") from error
    if head[:4] != b"RIFF" or head[8:12] != b"sfbk":
        raise MissingSoundfontError(
            f"{path} is no SF2 soundfont: remove it, so that `reina serve` unpacks another, "
            f"or set {SOUNDFONT_VARIABLE} to one"
        )


def soundfont_id(path: Path) -> str:
    """Return the SHA-256 of a soundfont's content, in hexadecimal; worked out once until the file changes.

    Raises:
        MissingSoundfontError: The file cannot be read.
    """
    try:
        stat = path.stat()
        return _content_digest(path, stat.st_mtime_ns, stat.st_size)
    except OSError as error:
        raise MissingSoundfontError(f"the soundfont {path} cannot be read: {error.strerror}") from error


@lru_cache(maxsize=8)
def _content_digest(path: Path, _modified_ns: int, _size: int) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
