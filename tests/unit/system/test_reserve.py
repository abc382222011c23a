"""Room that is set aside, given up when it is needed, and set aside again."""

from __future__ import annotations

import errno
import os
from typing import TYPE_CHECKING

import pytest

from reina.system.reserve import RESERVE, Reserve

if TYPE_CHECKING:
    from pathlib import Path


def test_it_holds_room_and_gives_it_up_while_it_is_needed(tmp_path: Path) -> None:
    reserve, file = Reserve(tmp_path, 100_000), tmp_path / RESERVE
    assert file.stat().st_blocks * 512 >= 100_000
    with reserve.given_up():
        assert not file.exists()
    assert file.stat().st_size == 100_000


def test_it_is_set_aside_again_after_an_error(tmp_path: Path) -> None:
    reserve = Reserve(tmp_path, 1000)
    with pytest.raises(ZeroDivisionError), reserve.given_up():
        raise ZeroDivisionError
    assert (tmp_path / RESERVE).stat().st_size == 1000


def test_on_a_full_disk_there_is_none_until_there_is_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patched:
        patched.setattr(os, "posix_fallocate", full)
        reserve = Reserve(tmp_path, 1000)
        assert list(tmp_path.iterdir()) == []
    with reserve.given_up():
        pass
    assert (tmp_path / RESERVE).stat().st_size == 1000


def test_one_that_is_there_is_taken_over(tmp_path: Path) -> None:
    Reserve(tmp_path, 1000)
    inode = (tmp_path / RESERVE).stat().st_ino
    Reserve(tmp_path, 1000)
    assert (tmp_path / RESERVE).stat().st_ino == inode
    Reserve(tmp_path, 2000)
    assert (tmp_path / RESERVE).stat().st_size == 2000
