"""A disk of one's own: a file system in a file that can be filled up, and copied as a power cut leaves it."""

from __future__ import annotations

import os
import shutil
import subprocess
from contextlib import contextmanager
from dataclasses import dataclass
from filecmp import cmp
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path

NEVER_BY_ITSELF_S = 300
"""How long the file system keeps to itself what nobody has synced: longer than any test takes, seconds."""
FILLER = "filler"


@dataclass(frozen=True)
class Disk:
    """A file system that is mounted.

    Attributes:
        image: The file that it is in.
        folder: Where it is mounted.
    """

    image: Path
    folder: Path

    def fill(self) -> None:
        """Leave no room at all."""
        with (self.folder / FILLER).open("ab") as filler:
            size = os.fstat(filler.fileno()).st_size
            piece = 1 << 30
            while piece >= 512:
                try:
                    os.posix_fallocate(filler.fileno(), size, piece)
                    size += piece
                except OSError:
                    piece //= 2
        # What the file system still had for itself.
        status = os.statvfs(self.folder)
        assert status.f_bavail * status.f_frsize < 100_000

    def make_room(self) -> None:
        """Take away what `fill` put there."""
        (self.folder / FILLER).unlink()

    def copy_as_it_is(self, image: Path) -> None:
        """Copy what the disk holds now, and not what is still to be written to it.

        Whoever writes must stand still; what the kernel writes meanwhile is waited for.
        """
        shutil.copyfile(self.image, image)
        while not cmp(self.image, image, shallow=False):
            shutil.copyfile(self.image, image)


def needs_own_disk() -> pytest.MarkDecorator:
    """Skips a test where no file system may be mounted."""
    missing = [tool for tool in ("mkfs.ext4", "mount", "umount") if shutil.which(tool) is None]
    why = "needs root" if os.geteuid() != 0 else f"needs {', '.join(missing)}" if missing else _refused()
    return pytest.mark.skipif(bool(why), reason=why or "")


@contextmanager
def new_disk(folder: Path, size_bytes: int) -> Generator[Disk]:
    """Make a file system of so many bytes and mount it; a folder takes the file and the mount."""
    image = folder / "image"
    with image.open("wb") as file:
        file.truncate(size_bytes)
    # No room is kept for root, for whom the tests run.
    subprocess.run(["mkfs.ext4", "-q", "-m", "0", "-E", "lazy_itable_init=0", str(image)], check=True)
    with mounted(image, folder / "disk") as disk:
        yield disk


@contextmanager
def mounted(image: Path, folder: Path) -> Generator[Disk]:
    """Mount a file system, repaired first as at any start after a power cut."""
    folder.mkdir()
    mount = ["mount", "-o", f"loop,commit={NEVER_BY_ITSELF_S}", str(image), str(folder)]
    subprocess.run(mount, check=True, capture_output=True)
    try:
        yield Disk(image, folder)
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def _refused() -> str | None:
    """Why this machine mounts nothing; None where it does."""
    if not os.path.exists("/dev/loop-control"):  # noqa: PTH110
        return "needs loop devices"
    return None
