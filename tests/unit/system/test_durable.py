"""What is said to be kept is synced first: bytes before their name, names before what relies on them."""

from __future__ import annotations

import errno
import os
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from reina.system import durable
from reina.system.durable import make_folder, put_in_place, write_durably

if TYPE_CHECKING:
    from collections.abc import Callable

Journal = list[tuple[str, str]]


@pytest.fixture
def journal(monkeypatch: pytest.MonkeyPatch) -> Journal:
    """What is synced, renamed and made, in its order."""
    done: Journal = []
    sync, replace, mkdir = os.fsync, Path.replace, Path.mkdir

    def synced(descriptor: int) -> None:
        sync(descriptor)
        done.append(("sync", Path(f"/proc/self/fd/{descriptor}").readlink().name))

    def replaced(draft: Path, path: Path) -> Path:
        done.append(("name", path.name))
        return replace(draft, path)

    def made(folder: Path, mode: int = 0o777, parents: bool = False, exist_ok: bool = False) -> None:
        mkdir(folder, mode, parents, exist_ok)
        done.append(("make", folder.name))

    monkeypatch.setattr(durable.os, "fsync", synced)
    monkeypatch.setattr(Path, "replace", replaced)
    monkeypatch.setattr(Path, "mkdir", made)
    return done


def test_bytes_are_synced_before_they_have_their_name(tmp_path: Path, journal: Journal) -> None:
    write_durably(tmp_path / "file", b"new")
    (draft, what), *rest = journal
    assert draft == "sync"
    assert what.startswith(".file.")
    assert rest == [("name", "file"), ("sync", tmp_path.name)]
    assert (tmp_path / "file").read_bytes() == b"new"


def test_what_is_written_is_for_its_owner_alone(tmp_path: Path) -> None:
    make_folder(tmp_path / "folder")
    write_durably(tmp_path / "folder" / "file", b"new")
    assert (tmp_path / "folder").stat().st_mode & 0o777 == 0o700
    assert (tmp_path / "folder" / "file").stat().st_mode & 0o777 == 0o600


def test_every_folder_above_is_synced(tmp_path: Path, journal: Journal) -> None:
    make_folder(tmp_path / "a" / "b")
    assert journal == [("make", "a"), ("sync", tmp_path.name), ("make", "b"), ("sync", "a")]


def test_a_folder_that_is_there_is_synced_again(tmp_path: Path, journal: Journal) -> None:
    (tmp_path / "a").mkdir()
    journal.clear()
    make_folder(tmp_path / "a")
    assert journal == [("make", "a"), ("sync", tmp_path.name)]


def refuse(number: int) -> Callable[..., None]:
    def refused(*_: object) -> None:
        raise OSError(number, os.strerror(number))

    return refused


@pytest.mark.parametrize("step", ["sync", "name"])
def test_a_write_that_fails_leaves_the_file_as_it_was(
    tmp_path: Path, step: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "file"
    write_durably(file, b"old")
    if step == "sync":
        monkeypatch.setattr(durable.os, "fsync", refuse(errno.ENOSPC))
    else:
        monkeypatch.setattr(Path, "replace", refuse(errno.ENOSPC))
    with pytest.raises(OSError, match="No space left"):
        write_durably(file, b"new")
    assert [each.name for each in tmp_path.iterdir()] == ["file"]
    assert file.read_bytes() == b"old"


def test_a_file_that_cannot_take_its_place_stays_where_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "draft").write_bytes(b"new")
    monkeypatch.setattr(Path, "replace", refuse(errno.EXDEV))
    with pytest.raises(OSError, match="cross-device"):
        put_in_place(tmp_path / "draft", tmp_path / "file")
    assert (tmp_path / "draft").read_bytes() == b"new"
    assert not (tmp_path / "file").exists()
