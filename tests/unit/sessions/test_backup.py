"""A data directory copied while it is written to, and put back as it was, or refused."""

from __future__ import annotations

import contextlib
import gzip
import hashlib
import io
import json
import sqlite3
import tarfile
import threading
from typing import TYPE_CHECKING

import pytest

from reina.cli import main
from reina.sessions.storage.archive import DATABASE, MANIFEST, ArchiveError, is_kept
from reina.sessions.storage.backup import back_up
from reina.sessions.storage.restore import restore

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path


class DataDirectory:
    """A data directory as the server keeps it: what is large by its content, and a database that names it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        folder.mkdir()
        with self.database() as database:
            database.execute("PRAGMA journal_mode=WAL")
            database.execute("CREATE TABLE session_files (id INTEGER PRIMARY KEY, digest TEXT, text TEXT)")

    @contextlib.contextmanager
    def database(self) -> Generator[sqlite3.Connection]:
        with contextlib.closing(sqlite3.connect(self.folder / DATABASE)) as database, database:
            yield database

    def add(self, number: int) -> str:
        """Keep a file, then a session that names it, as the server does."""
        data = b"%d" % number * 1000
        digest = hashlib.sha256(data).hexdigest()
        path = self.folder / "files" / digest[:2] / digest
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        with self.database() as database:
            database.execute("INSERT INTO session_files VALUES (?, ?, ?)", (number, digest, "é" * number))
        return digest

    def end(self, number: int) -> None:
        """End a session, and remove its file afterwards."""
        with self.database() as database:
            [(digest,)] = database.execute(
                "SELECT digest FROM session_files WHERE id = ?", (number,)
            ).fetchall()
            database.execute("DELETE FROM session_files WHERE id = ?", (number,))
        (self.folder / "files" / digest[:2] / digest).unlink()

    def sessions(self) -> dict[int, tuple[str, str]]:
        with self.database() as database:
            return {
                number: (file, text) for number, file, text in database.execute("SELECT * FROM session_files")
            }

    def file(self, digest: str) -> bytes:
        return (self.folder / "files" / digest[:2] / digest).read_bytes()


@pytest.fixture
def data(tmp_path: Path) -> DataDirectory:
    return DataDirectory(tmp_path / "data")


def archived(folder: Path) -> bytes:
    to = io.BytesIO()
    back_up(folder, to)
    return to.getvalue()


def restored(archive: bytes, folder: Path) -> DataDirectory:
    restore(io.BytesIO(archive), folder)
    made = DataDirectory.__new__(DataDirectory)
    made.folder = folder
    return made


def test_everything_comes_back_byte_for_byte(data: DataDirectory, tmp_path: Path) -> None:
    for number in range(1, 6):
        data.add(number)
    old = data.folder / "sessions" / "q3Zt0bXJ5V2mC9yLk7wH1A" / "session.json"
    old.parent.mkdir(parents=True)
    old.write_bytes(b"{}")
    (data.folder / "songs").mkdir()
    (data.folder / "songs" / "made.flac").write_bytes(b"anew")
    (old.parent / ".session.json.1234").write_bytes(b"half")
    back = restored(archived(data.folder), tmp_path / "back")
    assert back.sessions() == data.sessions()
    for digest, _ in back.sessions().values():
        assert back.file(digest) == data.file(digest)
    assert (back.folder / old.relative_to(data.folder)).read_bytes() == b"{}"
    assert sorted(path.name for path in back.folder.iterdir()) == ["files", DATABASE, "sessions"]
    assert list((data.folder / "staging").iterdir()) == []
    for path in back.folder.rglob("*"):
        assert path.stat().st_mode & 0o077 == 0, path


def test_a_copy_that_is_made_under_writes_has_all_that_its_database_names(
    data: DataDirectory, tmp_path: Path
) -> None:
    for number in range(1, 11):
        data.add(number)
    stop = threading.Event()

    def write() -> None:
        number = 11
        while not stop.is_set():
            data.add(number)
            if number % 2:
                data.end(number - 10)
            number += 1

    writing = threading.Thread(target=write)
    writing.start()
    try:
        archives = [archived(data.folder) for _ in range(8)]
    finally:
        stop.set()
        writing.join()
    newest: list[int] = []
    for count, archive in enumerate(archives):
        back = restored(archive, tmp_path / str(count))
        sessions = back.sessions()
        assert set(range(2, 11, 2)) <= sessions.keys(), "what was there all the time"
        for number, (digest, text) in sessions.items():
            assert back.file(digest) == b"%d" % number * 1000
            assert text == "é" * number
        newest.append(max(sessions))
    assert newest == sorted(newest)
    assert newest[-1] > newest[0], "it was written to meanwhile"


def test_what_is_not_whole_is_refused_and_leaves_nothing(data: DataDirectory, tmp_path: Path) -> None:
    data.add(1)
    archive = archived(data.folder)
    place = tmp_path / "back"
    end = archive.index(b"reina-backup")
    for cut in (0, 100, 512, end // 2, end - 600, end, end + 40):
        with pytest.raises(ArchiveError, match="backup"):
            restore(io.BytesIO(archive[:cut]), place)
        assert not place.exists()
    assert [path.name for path in tmp_path.iterdir()] == ["data"]


def test_no_changed_byte_of_a_file_goes_unseen(data: DataDirectory, tmp_path: Path) -> None:
    digest = data.add(7)
    archive = bytearray(archived(data.folder))
    at = archive.index(b"7" * 100)
    archive[at] ^= 1
    with pytest.raises(ArchiveError, match=f"damaged: files/{digest[:2]}/{digest} is not what it was"):
        restore(io.BytesIO(archive), tmp_path / "back")
    packed = bytearray(gzip.compress(bytes(archive)))
    packed[len(packed) // 2] ^= 0xFF
    with pytest.raises(ArchiveError, match=r"damaged|not whole"):
        restore(io.BytesIO(packed), tmp_path / "back")
    assert not (tmp_path / "back").exists()


@pytest.mark.parametrize(
    "name",
    ["../outside", "/outside", "files/../../outside", "sessions/a/../../x", "elsewhere/x", "files/.hidden/x"],
)
def test_nothing_is_written_outside(tmp_path: Path, name: str) -> None:
    to = io.BytesIO()
    with tarfile.open(fileobj=to, mode="w") as archive:
        info = tarfile.TarInfo(name)
        info.size = 1
        archive.addfile(info, io.BytesIO(b"x"))
    with pytest.raises(ArchiveError, match="does not belong"):
        restore(io.BytesIO(to.getvalue()), tmp_path / "back")
    assert list(tmp_path.iterdir()) == []
    assert not is_kept(name)


def test_links_and_other_versions_are_refused(tmp_path: Path) -> None:
    to = io.BytesIO()
    with tarfile.open(fileobj=to, mode="w") as archive:
        info = tarfile.TarInfo("files/ab/link")
        info.type, info.linkname = tarfile.SYMTYPE, "/etc/passwd"
        archive.addfile(info)
    with pytest.raises(ArchiveError, match="does not belong"):
        restore(io.BytesIO(to.getvalue()), tmp_path / "back")
    other: dict[str, object] = {
        "format": "reina-backup",
        "version": 2,
        "reina": "9",
        "created_at": "x",
        "files": {},
    }
    to = io.BytesIO()
    with tarfile.open(fileobj=to, mode="w") as archive:
        text = json.dumps(other).encode()
        info = tarfile.TarInfo(MANIFEST)
        info.size = len(text)
        archive.addfile(info, io.BytesIO(text))
    with pytest.raises(ArchiveError, match="of version 2"):
        restore(io.BytesIO(to.getvalue()), tmp_path / "back")


def test_a_directory_with_something_in_it_is_left_alone(data: DataDirectory, tmp_path: Path) -> None:
    data.add(1)
    archive = archived(data.folder)
    before = sorted(data.folder.rglob("*"))
    with pytest.raises(ArchiveError, match="not empty"):
        restore(io.BytesIO(archive), data.folder)
    assert sorted(data.folder.rglob("*")) == before
    empty = tmp_path / "mounted"
    empty.mkdir()
    assert restored(archive, empty).sessions() == data.sessions()
    assert sorted(path.name for path in empty.iterdir()) == ["files", DATABASE]


def test_a_damaged_database_is_told(data: DataDirectory) -> None:
    for number in range(200):
        data.add(number)
    with data.database() as database:
        database.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    path = data.folder / DATABASE
    content = bytearray(path.read_bytes())
    content[4096:] = bytes(len(content) - 4096)
    path.write_bytes(content)
    with pytest.raises(ArchiveError, match="database"):
        archived(data.folder)


@pytest.mark.parametrize("name", ["backup.tar", "backup.tar.gz"])
def test_the_commands(
    data: DataDirectory, tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    data.add(3)
    file, back = tmp_path / name, tmp_path / "back"
    assert main(["backup", str(file), "--data-dir", str(data.folder)]) == 0
    assert "2 files" in capsys.readouterr().err
    assert (file.read_bytes()[:2] == b"\x1f\x8b") == name.endswith("gz")
    assert file.stat().st_mode & 0o077 == 0
    assert main(["restore", str(file), "--data-dir", str(back)]) == 0
    assert main(["restore", str(file), "--data-dir", str(back)]) == 1
    assert "is not empty" in capsys.readouterr().err


def test_a_file_that_is_damaged_already_is_told_and_kept(
    data: DataDirectory, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    digest = data.add(3)
    (data.folder / "files" / digest[:2] / digest).write_bytes(b"other")
    file = tmp_path / "backup.tar"
    assert main(["backup", str(file), "--data-dir", str(data.folder)]) == 1
    assert f"files/{digest[:2]}/{digest} is damaged in the data directory" in capsys.readouterr().err
    assert restored(file.read_bytes(), tmp_path / "back").file(digest) == b"other"


def test_a_backup_that_cannot_be_made_leaves_no_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "empty").mkdir()
    for folder, why in (("empty", "keeps nothing yet"), ("none", "there is no data directory")):
        assert main(["backup", str(tmp_path / "x.tar"), "--data-dir", str(tmp_path / folder)]) == 1
        [line] = capsys.readouterr().err.splitlines()
        assert why in line
    assert main(["restore", str(tmp_path / "x.tar"), "--data-dir", str(tmp_path / "none")]) == 1
    assert "x.tar: No such file" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["empty"]
