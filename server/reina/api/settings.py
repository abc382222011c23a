"""Where the server finds and keeps its files, and whom it answers."""

from __future__ import annotations

import math
import os
import re
import tempfile
from dataclasses import dataclass, field, replace
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from reina.api.accounts import Accounts
from reina.api.signing_key import signing_key
from reina.errors import InputError
from reina.sessions.bus.redis_bus import RedisBus
from reina.sessions.memory_bound import MEMORY_BYTES
from reina.sessions.session import OWN_ORIGIN
from reina.sessions.sightings import DAY_S
from reina.sessions.staging import STAGING_BYTES
from reina.sessions.usage import DiskBound
from reina.sound.song_cache import SONG_CACHE_BYTES
from reina.system.cluster import HOW_TO_INSTALL
from reina.system.resources import bundled, default_data_dir

if TYPE_CHECKING:
    from collections.abc import Callable

LOCAL_HOSTS = frozenset({"localhost", "127.0.0.1", "::1"})


MEGABYTE = 1_000_000
_SCHEDULER = re.compile(r"(tcp|tls)://([A-Za-z0-9._-]+|\[[0-9A-Fa-f:.]+\]):\d{1,5}")
_ORIGIN = re.compile(r"https?://([A-Za-z0-9.-]+|\[[0-9A-Fa-f:.]+\])(:\d{1,5})?")


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


def _database() -> str:
    return os.environ.get("REINA_DATABASE_URL") or os.environ.get("REINA_DATABASE", "")


def _file(variable: str) -> Path | None:
    named = os.environ.get(variable)
    return Path(named) if named else None


def _folder(variable: str, default: Callable[[], Path]) -> Path:
    named = os.environ.get(variable)
    return Path(named) if named else default()


@dataclass(frozen=True)
class Settings:
    """Everything that a server is started with; each has a default that works in a checkout and installed.

    Attributes:
        database: The address of the database that sessions are kept in; one in the data directory when empty.
        bus: The address of what connects the servers that serve the same sessions, ``redis://…``; empty: this
            is the only one.
        files: What keeps the large files: ``s3://…`` or a folder; a folder of the data directory when None.
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
        trusted_proxies: Addresses and networks of proxies that are believed who asks.
        rates: How many requests of a kind one address has in a minute, as `REINA_RATES` says it.
        lab: Whether the laboratory is there.
        page: Whether the page is to be there.
        log_requests: Whether each request is a line in the log.
        upload_password_file: Holds the passwords of those who may upload; None: everybody may.
        signing_key_file: Holds a secret of all servers that serve the same sessions: whoever is signed in at
            one is at the others; None: a server has its own.
        user_header: What a trusted proxy tells in who is signed in there; empty: nothing.
        blocks_origin: Where pages fetch packed blocks, as `Session` has it; empty: the stream has them.
        scheduler: Of a Dask cluster that songs are rendered and put in time on; empty: this machine does it.
    """

    database: str = field(default_factory=_database)
    bus: str = field(default_factory=lambda: os.environ.get("REINA_BUS_URL", ""))
    files: str | None = field(default_factory=lambda: os.environ.get("REINA_FILES") or None)
    data_dir: Path = field(default_factory=lambda: _folder("REINA_DATA_DIR", default_data_dir))
    rigs_dir: Path = field(default_factory=lambda: _folder("REINA_RIGS", lambda: bundled("rigs")))
    examples_dir: Path = field(default_factory=lambda: _folder("REINA_EXAMPLES", lambda: bundled("examples")))
    page_dir: Path = field(default_factory=lambda: _folder("REINA_PAGE", lambda: bundled("page")))
    song_cache_bytes: int = field(default_factory=_bytes("REINA_SONG_CACHE_MB", SONG_CACHE_BYTES))
    memory_bytes: int = field(default_factory=_bytes("REINA_MEMORY_MB", MEMORY_BYTES))
    staging_bytes: int = field(default_factory=_bytes("REINA_STAGING_MB", STAGING_BYTES))
    disk: DiskBound = field(default_factory=_disk)
    end_unseen_s: float = field(default_factory=_end_unseen_s)
    allowed_hosts: frozenset[str] = LOCAL_HOSTS
    allowed_origins: frozenset[str] = frozenset()
    trusted_proxies: tuple[str, ...] = ()
    rates: str = field(default_factory=lambda: os.environ.get("REINA_RATES", ""))
    lab: bool = True
    page: bool = True
    log_requests: bool = False
    upload_password_file: Path | None = field(default_factory=lambda: _file("REINA_UPLOAD_PASSWORD_FILE"))
    signing_key_file: Path | None = field(default_factory=lambda: _file("REINA_SIGNING_KEY_FILE"))
    user_header: str = field(default_factory=lambda: os.environ.get("REINA_USER_HEADER", ""))
    blocks_origin: str = field(default_factory=lambda: os.environ.get("REINA_BLOCKS_ORIGIN", ""))
    scheduler: str = field(default_factory=lambda: os.environ.get("REINA_SCHEDULER", ""))


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


def require_sign_in(settings: Settings) -> None:
    """See that what is said of signing in can be used.

    Raises:
        InputError: A person's header that nobody may send, or one that is no header.
    """
    header = settings.user_header
    if header and not settings.trusted_proxies:
        raise InputError(
            f"REINA_USER_HEADER={header} needs REINA_TRUSTED_PROXY, the address of the proxy that sends it: "
            "from anybody else it means nothing"
        )
    if header and not re.fullmatch(r"[A-Za-z0-9-]+", header):
        raise InputError(f"REINA_USER_HEADER is the name of a header, X-Forwarded-User say, not {header!r}")
    if settings.upload_password_file is not None:
        Accounts.read(settings.upload_password_file)
        signing_key(settings.data_dir, settings.signing_key_file)


def require_blocks_origin(settings: Settings) -> None:
    """See that pages can be told where to fetch packed blocks.

    Raises:
        InputError: It is no origin.
    """
    origin = settings.blocks_origin
    if origin and origin != OWN_ORIGIN and not _ORIGIN.fullmatch(origin):
        raise InputError(
            f"REINA_BLOCKS_ORIGIN is an origin, https://blocks.example.org, or {OWN_ORIGIN!r} for the "
            f"server's own, not {origin!r}"
        )


def require_shared(settings: Settings) -> None:
    """See that what servers share that a bus connects is shared.

    Raises:
        InputError: A server of its own has a bus, or one cannot be had.
    """
    if not settings.bus:
        return
    if not settings.database:
        raise InputError(
            "servers that a bus connects keep their sessions in one database: name PostgreSQL with "
            "--database or REINA_DATABASE_URL"
        )
    if settings.files is None:
        raise InputError(
            "servers that a bus connects keep large files in one place: name a folder that all of them "
            "have, or s3://bucket/prefix, with REINA_FILES"
        )
    RedisBus(settings.bus)


def require_scheduler(settings: Settings) -> None:
    """See that a cluster can be worked on, whether it is there or not.

    Raises:
        InputError: What is named is no scheduler's address, or what speaks to one is not installed.
    """
    if not settings.scheduler:
        return
    if not _SCHEDULER.fullmatch(settings.scheduler):
        raise InputError(
            f"a Dask scheduler's address is tcp://host:8786 or tls://host:8786, not {settings.scheduler!r}"
        )
    if find_spec("distributed") is None:
        raise InputError(f"work on {settings.scheduler} needs dask.distributed: {HOW_TO_INSTALL}")


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
