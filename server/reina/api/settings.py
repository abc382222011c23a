"""Where the server finds and keeps its files, and whom it answers."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

REPOSITORY = Path(__file__).parents[3]
LOCAL_HOSTS = frozenset({"localhost", "127.0.0.1", "::1"})


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
        allowed_hosts: Host names that the server answers to, without ports.
        allowed_origins: Origins beside the server's own that may write and open streams
            (``http://localhost:5173``, where the page is being developed).
    """

    data_dir: Path = field(default_factory=lambda: _folder("REINA_DATA_DIR", "data"))
    rigs_dir: Path = field(default_factory=lambda: _folder("REINA_RIGS", "rigs"))
    examples_dir: Path = field(default_factory=lambda: _folder("REINA_EXAMPLES", "examples"))
    page_dir: Path = field(default_factory=lambda: _folder("REINA_PAGE", "web/dist"))
    allowed_hosts: frozenset[str] = LOCAL_HOSTS
    allowed_origins: frozenset[str] = frozenset()
