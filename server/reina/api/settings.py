"""Where the server finds and keeps its files, and whom it answers."""

from __future__ import annotations

import os
import re
import tempfile
from dataclasses import dataclass, field
from ipaddress import IPv4Network, IPv6Network, ip_network
from pathlib import Path

from reina.api.accounts import Accounts
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


Networks = tuple[IPv4Network | IPv6Network, ...]


def networks(named: list[str]) -> Networks:
    """Addresses and networks as they are written: ``10.0.0.1``, ``10.0.0.0/8``.

    Raises:
        InputError: One is none.
    """
    try:
        return tuple(ip_network(name, strict=False) for name in named)
    except ValueError as error:
        raise InputError(
            f"a trusted proxy is named by its address or network, 10.0.0.1 or 10.0.0.0/8: {error}"
        ) from error


def _trusted_proxies() -> Networks:
    return networks(os.environ.get("REINA_TRUSTED_PROXY", "").split())


def _upload_password_file() -> Path | None:
    named = os.environ.get("REINA_UPLOAD_PASSWORD_FILE")
    return Path(named) if named else None


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
        allowed_hosts: Host names that the server answers to, without ports.
        allowed_origins: Origins beside the server's own that may write and open streams
            (``http://localhost:5173``, where the page is being developed).
        lab: Whether the laboratory is there.
        trusted_proxies: Whose headers are believed that tell who asks, and from where.
        upload_password_file: Holds the passwords of those who may upload; None: everybody may.
        user_header: What a trusted proxy tells in who is signed in there; empty: nothing.
    """

    data_dir: Path = field(default_factory=lambda: _folder("REINA_DATA_DIR", "data"))
    rigs_dir: Path = field(default_factory=lambda: _folder("REINA_RIGS", "rigs"))
    examples_dir: Path = field(default_factory=lambda: _folder("REINA_EXAMPLES", "examples"))
    page_dir: Path = field(default_factory=lambda: _folder("REINA_PAGE", "web/dist"))
    song_cache_bytes: int = field(default_factory=_song_cache_bytes)
    allowed_hosts: frozenset[str] = LOCAL_HOSTS
    allowed_origins: frozenset[str] = frozenset()
    lab: bool = True
    trusted_proxies: Networks = field(default_factory=_trusted_proxies)
    upload_password_file: Path | None = field(default_factory=_upload_password_file)
    user_header: str = field(default_factory=lambda: os.environ.get("REINA_USER_HEADER", ""))


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
