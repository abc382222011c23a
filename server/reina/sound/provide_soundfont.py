"""Sees that there is a soundfont: where none is, the packed one that Reina comes with is unpacked."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from reina.sound.font import (
    FILE_NAME,
    SOUNDFONT_VARIABLE,
    MissingSoundfontError,
    find_soundfont,
    places_of_soundfonts,
)
from reina.system.resources import bundled, default_data_dir

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


def own_soundfont() -> Path:
    """This machine's soundfont, where no server has named its data folder: that of the environment.

    Raises:
        MissingSoundfontError: There is none.
    """
    data_dir = Path(os.environ.get("REINA_DATA_DIR") or default_data_dir())
    try:
        data_dir.mkdir(parents=True, exist_ok=True, mode=0o700)
    except OSError as error:
        raise MissingSoundfontError(f"there is no data folder {data_dir}: {error.strerror}") from error
    return provide_soundfont(data_dir)


def provide_soundfont(
    data_dir: Path,
    *,
    environment: Mapping[str, str] | None = None,
    tell: Callable[[str], None] = lambda _: None,
) -> Path:
    """Return the soundfont that `find_soundfont` finds, unpacked into the data folder where there is none.

    Args:
        data_dir: The server's data folder, which is there.
        environment: Environment variables; the process's own by default.
        tell: Hears in one line what takes some seconds.

    Raises:
        MissingSoundfontError: There is none, and none to unpack or no room for it; or the one that is
            named, or there, cannot be used.
    """
    named = (os.environ if environment is None else environment).get(SOUNDFONT_VARIABLE)
    packed = bundled("soundfont.sf3")
    if named or any(place.is_file() for place in places_of_soundfonts(data_dir)) or not packed.is_file():
        return find_soundfont(data_dir, environment=environment)
    target = data_dir / FILE_NAME
    tell(f"unpacking the soundfont into {target}, once: a few seconds and 104 MB")
    # In a process of its own, which takes its memory along when it ends; -P: not from the current folder.
    command = [sys.executable, "-P", "-m", "reina.sound.unpack_soundfont", str(packed), str(target)]
    unpacking = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603 - our own module
    if unpacking.returncode != 0:
        reason = (unpacking.stderr.strip().splitlines() or ["it said nothing"])[-1]
        raise MissingSoundfontError(f"the soundfont could not be unpacked into {target}: {reason}")
    return find_soundfont(data_dir, environment=environment)
