"""Whether there is room, and which errors say that there is none."""

from __future__ import annotations

import errno
import os
from types import SimpleNamespace
from typing import TYPE_CHECKING

import pytest

from reina.system.disk_room import LEAST_BYTES, has_room, is_disk_full

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.parametrize(
    ("error", "is_full"),
    [
        (OSError(errno.ENOSPC, "no"), True),
        (OSError(errno.EDQUOT, "no"), True),
        (OSError(errno.EIO, "no"), False),
        (FileNotFoundError(), False),
        (ValueError(errno.ENOSPC), False),
    ],
)
def test_only_lack_of_room_is_a_full_disk(error: Exception, is_full: bool) -> None:
    assert is_disk_full(error) is is_full


@pytest.mark.parametrize(("free", "room"), [(0, False), (LEAST_BYTES - 1, False), (LEAST_BYTES, True)])
def test_what_is_reserved_for_others_is_no_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, free: int, room: bool
) -> None:
    def told(_: object) -> SimpleNamespace:
        return SimpleNamespace(f_bavail=free, f_bfree=10**9, f_frsize=1)

    monkeypatch.setattr(os, "statvfs", told)
    assert has_room(tmp_path) is room
