"""Where the server finds and keeps its files, and whom it answers."""

from __future__ import annotations

import math
import os
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.sessions.memory_bound import MEMORY_BYTES
from reina.sessions.sightings import DAY_S
from reina.sessions.staging import STAGING_BYTES
from reina.sessions.usage import DiskBound
from reina.sound.song_cache import SONG_CACHE_BYTES

if TYPE_CHECKING:
    from collections.abc import Callable

REPOSITORY = Path(__file__).parents[3]
LOCAL_HOSTS = frozenset({"localhost", "127.0.0.1", "::1"})


MEGABYTE = 1_000_000


def _count(variable: str, default: int, what: str) -> int:
    given = os.environ.get(variable, "")
    if not given:
        return default
    if not given.isdecimal():
        raise InputError(f"{variable} is a whole number of {what}, not {given!r}")
    return int(given)


def _bytes(variable: str, default: int) -> Callable[[], int]:
    return lambda: _count(variable, default // MEGABYTE, "megabytes") * MEGABYTE


def _disk() -> DiskBound:
    bound = DiskBound()
    return DiskBound(
        _bytes("REINA_DISK_MB", bound.most_bytes)(),
        _bytes("REINA_DISK_PER_SENDER_MB", bound.most_bytes_of_sender)(),
        _count("REINA_SESSIONS_PER_SENDER", bound.most_sessions_of_sender, "sessions"),
    )


def days(text: str, name: str = "--end-unseen") -> float:
    """A number of days, 0 for never.

    Raises:
        InputError: It is none.
    """
    try:
        number = float(text or 0)
    except ValueError:
        number = math.nan
    if not 0 <= number < math.inf:
        raise InputError(f"{name} is a number of days, 0 for never, not {text!r}")
    return number


def _end_unseen_s() -> float:
    return days(os.environ.get("REINA_END_UNSEEN_DAYS", ""), "REINA_END_UNSEEN_DAYS") * DAY_S


def _folder(variable: str, default: str) -> Path:
    return Path(os.environ.get(variable) or REPOSITORY / default)


@dataclass(frozen=True)
class Settings:
    """Everything that a server is started with; each has a default that works in the repository.

    Attributes:
        data_dir: Sessions and rendered songs.
        rigs_dir: One folder a rig.
        examples_dir: The bundled pieces.
        page_dir: The built page.
        song_cache_bytes: How large the songs that were rendered may be together.
        memory_bytes: How many bytes the sessions in memory may weigh together.
        staging_bytes: How large what is being sent may be together.
        disk: How much may be kept.
        end_unseen_s: How long after it was seen last a session is ended, seconds; 0 for never.
        allowed_hosts: Host names that the server answers to, without ports.
        allowed_origins: Origins beside the server's own that may write and open streams
            (``http://localhost:5173``, where the page is being developed).
        lab: Whether the laboratory is there.
    """

    data_dir: Path = field(default_factory=lambda: _folder("REINA_DATA_DIR", "data"))
    rigs_dir: Path = field(default_factory=lambda: _folder("REINA_RIGS", "rigs"))
    examples_dir: Path = field(default_factory=lambda: _folder("REINA_EXAMPLES", "examples"))
    page_dir: Path = field(default_factory=lambda: _folder("REINA_PAGE", "web/dist"))
    song_cache_bytes: int = field(default_factory=_bytes("REINA_SONG_CACHE_MB", SONG_CACHE_BYTES))
    memory_bytes: int = field(default_factory=_bytes("REINA_MEMORY_MB", MEMORY_BYTES))
    staging_bytes: int = field(default_factory=_bytes("REINA_STAGING_MB", STAGING_BYTES))
    disk: DiskBound = field(default_factory=_disk)
    end_unseen_s: float = field(default_factory=_end_unseen_s)
    allowed_hosts: frozenset[str] = LOCAL_HOSTS
    allowed_origins: frozenset[str] = frozenset()
    lab: bool = True


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
        data_dir.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=data_dir):
            pass
    except OSError as error:
        raise InputError(
            f"nothing can be kept in the data directory {data_dir}: {error.strerror}; "
            "name one that is yours with --data-dir or REINA_DATA_DIR"
        ) from error
