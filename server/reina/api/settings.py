"""Where the server finds and keeps its files, and whom it answers."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path

from reina.errors import InputError
from reina.sessions.store import SONG_CACHE_BYTES

REPOSITORY = Path(__file__).parents[3]
LOCAL_HOSTS = frozenset({"localhost", "127.0.0.1", "::1"})


MEGABYTE = 1_000_000


def _song_cache_bytes() -> int:
    given = os.environ.get("REINA_SONG_CACHE_MB", "")
    if not given:
        return SONG_CACHE_BYTES
    if not given.isdecimal():
        raise InputError(f"REINA_SONG_CACHE_MB is a whole number of megabytes, not {given!r}")
    return int(given) * MEGABYTE


def _folder(variable: str, default: str) -> Path:
    return Path(os.environ.get(variable) or REPOSITORY / default)


@dataclass(frozen=True)
class Settings:
    """Everything that a server is started with; each has a default that works in the repository.

    Attributes:
        database: The address of the database that sessions are kept in; one in the data directory when empty.
        data_dir: Sessions and rendered songs.
        rigs_dir: One folder a rig.
        examples_dir: The bundled pieces.
        page_dir: The built page.
        song_cache_bytes: How large the songs that were rendered may be together.
        allowed_hosts: Host names that the server answers to, without ports.
        allowed_origins: Origins beside the server's own that may write and open streams
            (``http://localhost:5173``, where the page is being developed).
        lab: Whether the laboratory is there.
    """

    database: str = field(default_factory=lambda: os.environ.get("REINA_DATABASE", ""))
    data_dir: Path = field(default_factory=lambda: _folder("REINA_DATA_DIR", "data"))
    rigs_dir: Path = field(default_factory=lambda: _folder("REINA_RIGS", "rigs"))
    examples_dir: Path = field(default_factory=lambda: _folder("REINA_EXAMPLES", "examples"))
    page_dir: Path = field(default_factory=lambda: _folder("REINA_PAGE", "web/dist"))
    song_cache_bytes: int = field(default_factory=_song_cache_bytes)
    allowed_hosts: frozenset[str] = LOCAL_HOSTS
    allowed_origins: frozenset[str] = frozenset()
    lab: bool = True


def settings_of(data_dir: Path | None, database: str | None) -> Settings:
    """The settings with what a command names; None leaves as it is."""
    named = {"data_dir": data_dir, "database": database}
    return replace(Settings(), **{name: value for name, value in named.items() if value is not None})


def require_page(settings: Settings) -> None:
    """See that the page is built.

    Raises:
        InputError: It is not.
    """
    if not (settings.page_dir / "index.html").is_file():
        raise InputError(
            f"the page is not built: {settings.page_dir} has no index.html; `make setup` builds it, "
            "--no-page serves the API alone"
        )


def require_writable(data_dir: Path) -> None:
    """Make the data directory, and see that files can be made in it.

    Raises:
        InputError: They cannot.
    """
    try:
        data_dir.mkdir(parents=True, exist_ok=True, mode=0o700)
        with tempfile.TemporaryFile(dir=data_dir):
            pass
    except OSError as error:
        raise InputError(
            f"nothing can be kept in the data directory {data_dir}: {error.strerror}; "
            "name one that is yours with --data-dir or REINA_DATA_DIR"
        ) from error
