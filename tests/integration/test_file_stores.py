"""What keeps large files keeps its word, on this machine's disk and in a real store that speaks S3."""

from __future__ import annotations

import errno
import hashlib
import os
import random
import subprocess
import sys
import threading
from typing import TYPE_CHECKING, Protocol

import pytest
from tests.servers.seaweed import BUCKET, Seaweed, seaweed

from reina.errors import InputError
from reina.sessions.storage import local_files
from reina.sessions.storage.file_store import (
    FileStore,
    StoreAwayError,
    StoredFile,
    StoredFileLostError,
    StoreFullError,
)
from reina.sessions.storage.local_files import LocalFiles
from reina.sessions.storage.open_files import files_at
from reina.sessions.storage.s3_files import PIECE, S3Files

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

NO_DIGEST = "0" * 64
LARGE = 2 * PIECE + 12_345
"""Bytes of a file that is sent in three pieces."""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Seaweed]:
    with seaweed(tmp_path_factory.mktemp("seaweed")) as running:
        yield running


class Place(Protocol):
    """Where files are kept, which any number of stores can have open."""

    def open(self) -> FileStore:
        """A store as another start of the server has it: it knows nothing but the place."""
        ...

    def spoil(self, digest: str, data: bytes | None) -> None:
        """Put something else in the place of a file, or nothing."""
        ...


class OnDisk:
    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def open(self) -> FileStore:
        return files_at(str(self.folder), self.folder / "unused")

    def spoil(self, digest: str, data: bytes | None) -> None:
        file = self.folder / digest[:2] / digest
        file.unlink() if data is None else file.write_bytes(data)


class InS3:
    def __init__(self, folder: Path, server: Seaweed) -> None:
        self.folder, self.url, self.endpoint = folder, server.url(folder.name), server.endpoint
        self.opened = 0

    def open(self) -> FileStore:
        self.opened += 1
        return files_at(self.url, self.folder / str(self.opened))

    def spoil(self, digest: str, data: bytes | None) -> None:
        import obstore
        from obstore.store import S3Store

        store = S3Store(BUCKET, endpoint=self.endpoint, client_options={"allow_http": True})
        key = f"{self.folder.name}/{digest[:2]}/{digest}"
        if data is None:
            obstore.delete(store, key)
        else:
            obstore.put(store, key, data)


@pytest.fixture(params=["disk", "s3"])
def place(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> Place:
    folder = tmp_path_factory.mktemp("place")
    if request.param == "disk":
        return OnDisk(folder)
    server: Seaweed = request.getfixturevalue("server")
    for name, value in server.environment.items():
        monkeypatch.setenv(name, value)
    return InS3(folder, server)


def staged(folder: Path, data: bytes, name: str = "staged") -> Path:
    (folder / name).write_bytes(data)
    return folder / name


def digest_of(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


class TestAnyStore:
    """What holds wherever the files are."""

    @pytest.mark.parametrize("size", [0, 1, 100_000, LARGE])
    def test_what_is_kept_is_read_by_this_start_and_the_next(
        self, place: Place, tmp_path: Path, size: int
    ) -> None:
        data = random.Random(size).randbytes(size)
        store = place.open()
        kept = store.keep(staged(tmp_path, data))
        assert kept == StoredFile(digest_of(data), size)
        assert store.path(kept.digest).read_bytes() == data
        again = place.open()
        assert again.path(kept.digest).read_bytes() == data
        assert list(again.files()) == [kept]

    def test_the_same_content_stands_once(self, place: Place, tmp_path: Path) -> None:
        store = place.open()
        first, second = (store.keep(staged(tmp_path, b"same", name)) for name in ("one", "two"))
        assert first == second
        assert list(store.files()) == [first]

    def test_what_is_removed_is_gone_and_nothing_else(self, place: Place, tmp_path: Path) -> None:
        store = place.open()
        one, two = (store.keep(staged(tmp_path, data)) for data in (b"one", b"two"))
        store.remove(one.digest)
        store.remove(one.digest)
        store.remove("../../etc/passwd")
        assert list(store.files()) == [two]
        for opened in (store, place.open()):
            with pytest.raises(StoredFileLostError):
                opened.path(one.digest)

    @pytest.mark.parametrize("digest", [NO_DIGEST, "", "..", "../" * 21 + "x", "A" * 64, "é" * 64])
    def test_what_was_never_kept_is_lost(self, place: Place, digest: str) -> None:
        with pytest.raises(StoredFileLostError):
            place.open().path(digest)

    @pytest.mark.parametrize("instead", [b"", b"shor", b"other", None], ids=["empty", "cut", "other", "gone"])
    def test_damage_is_told_and_healed_by_the_same_file(
        self, place: Place, tmp_path: Path, instead: bytes | None
    ) -> None:
        kept = place.open().keep(staged(tmp_path, b"right"))
        place.spoil(kept.digest, instead)
        store = place.open()
        with pytest.raises(StoredFileLostError, match="restore it from a backup"):
            store.path(kept.digest)
        store.keep(staged(tmp_path, b"right"))
        assert place.open().path(kept.digest).read_bytes() == b"right"

    def test_threads_keep_and_read_at_once(self, place: Place, tmp_path: Path) -> None:
        store = place.open()
        wrong: list[object] = []

        def work(number: int) -> None:
            data = bytes([number % 3]) * 50_000
            try:
                for turn in range(4):
                    kept = store.keep(staged(tmp_path, data, f"{number}-{turn}"))
                    if store.path(kept.digest).read_bytes() != data:
                        wrong.append(number)
            except BaseException as error:
                wrong.append(error)

        threads = [threading.Thread(target=work, args=(number,)) for number in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert wrong == []
        assert len(list(store.files())) == 3


class TestOnDisk:
    """What holds of a folder alone."""

    def test_only_the_owner_may_read(self, tmp_path: Path) -> None:
        store = LocalFiles(tmp_path / "files")
        path = store.path(store.keep(staged(tmp_path, b"x")).digest)
        modes = [each.stat().st_mode & 0o777 for each in (path, path.parent, path.parent.parent)]
        assert modes == [0o600, 0o700, 0o700]

    def test_a_staged_file_is_taken_as_it_is(self, tmp_path: Path) -> None:
        store = LocalFiles(tmp_path / "files")
        file = staged(tmp_path, b"x")
        inode = file.stat().st_ino
        assert store.path(store.keep(file).digest).stat().st_ino == inode
        assert not file.exists()

    def test_a_file_of_another_file_system_is_copied(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        store = LocalFiles(tmp_path / "files")
        real = local_files.put_in_place
        refused: list[Path] = []

        def only_from_within(draft: Path, path: Path) -> None:
            if draft.parent == tmp_path:
                refused.append(draft)
                raise OSError(errno.EXDEV, os.strerror(errno.EXDEV))
            real(draft, path)

        monkeypatch.setattr(local_files, "put_in_place", only_from_within)
        kept = store.keep(staged(tmp_path, b"x" * 3_000_000))
        assert refused
        assert store.path(kept.digest).stat().st_size == kept.size == 3_000_000
        assert (tmp_path / "staged").exists()

    @pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT])
    @pytest.mark.parametrize("step", ["make_folder", "put_in_place"])
    def test_a_full_disk_leaves_nothing_behind(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, step: str, number: int
    ) -> None:
        store = LocalFiles(tmp_path / "files")
        file = staged(tmp_path, b"x")

        def full(*_: object) -> None:
            raise OSError(number, os.strerror(number))

        monkeypatch.setattr(local_files, step, full)
        with pytest.raises(StoreFullError, match="make room"):
            store.keep(file)
        assert file.read_bytes() == b"x"
        assert list((tmp_path / "files").iterdir()) == []

    def test_what_a_killed_server_began_is_removed_in_time(self, tmp_path: Path) -> None:
        LocalFiles(tmp_path)
        old, new = staged(tmp_path, b"x", ".draft-old"), staged(tmp_path, b"x", ".draft-new")
        os.utime(old, (0, 0))
        assert list(LocalFiles(tmp_path).files()) == []
        assert not old.exists()
        assert new.exists()


class TestInS3:
    """What holds of a store elsewhere alone."""

    @pytest.fixture
    def there(self, server: Seaweed, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> InS3:
        for name, value in server.environment.items():
            monkeypatch.setenv(name, value)
        return InS3(tmp_path, server)

    def test_what_was_asked_for_the_longest_ago_makes_room(self, there: InS3, tmp_path: Path) -> None:
        cache = tmp_path / "cache"
        store = files_at(there.url, tmp_path, cache_bytes=2500)
        one, two = (store.keep(staged(tmp_path, data * 1000)).digest for data in (b"1", b"2"))
        cached = LocalFiles(cache / "files")
        store.path(one)
        three = store.keep(staged(tmp_path, b"3" * 1000)).digest
        assert {file.digest for file in cached.files()} == {one, three}
        assert store.path(two).read_bytes() == b"2" * 1000
        assert {file.digest for file in cached.files()} == {two, three}
        assert {file.digest for file in store.files()} == {one, two, three}

    def test_a_file_larger_than_the_cache_is_read_all_the_same(self, there: InS3, tmp_path: Path) -> None:
        store = files_at(there.url, tmp_path, cache_bytes=10)
        kept = store.keep(staged(tmp_path, b"1" * 1000))
        assert store.path(kept.digest).read_bytes() == b"1" * 1000

    def test_no_room_for_a_copy_here_is_no_reason_to_refuse(
        self, there: InS3, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        store = there.open()

        def full(*_: object) -> None:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        with monkeypatch.context() as patched:
            patched.setattr(local_files, "put_in_place", full)
            kept = store.keep(staged(tmp_path, b"x"))
            with pytest.raises(StoreFullError, match="make room"):
                store.path(kept.digest)
        assert store.path(kept.digest).read_bytes() == b"x"

    def test_a_damaged_copy_is_fetched_anew(self, there: InS3, tmp_path: Path) -> None:
        store = files_at(there.url, tmp_path)
        kept = store.keep(staged(tmp_path, b"right"))
        store.path(kept.digest).write_bytes(b"wrong")
        assert files_at(there.url, tmp_path).path(kept.digest).read_bytes() == b"right"

    def test_who_is_not_let_in_is_told_so(
        self, there: InS3, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setenv("AWS_SECRET_ACCESS_KEY", "another")
        store = there.open()
        with pytest.raises(StoreAwayError, match="AWS_SECRET_ACCESS_KEY"):
            store.keep(staged(tmp_path, b"x"))
        with pytest.raises(StoreAwayError, match="AWS_SECRET_ACCESS_KEY"):
            store.path(NO_DIGEST)

    def test_a_store_that_is_away_is_told_and_what_is_here_is_read(
        self, tmp_path: Path, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        with seaweed(tmp_path_factory.mktemp("away")) as server:
            for name, value in server.environment.items():
                monkeypatch.setenv(name, value)
            store = S3Files(server.url("x"), tmp_path / "cache", most_tries=2)
            kept = store.keep(staged(tmp_path, b"here"))
        file = staged(tmp_path, b"late")
        with pytest.raises(
            StoreAwayError, match=f"s3://{BUCKET}, where the large files are, does not answer"
        ):
            store.keep(file)
        assert file.read_bytes() == b"late"
        for ask in (
            lambda: store.path(NO_DIGEST),
            lambda: list(store.files()),
            lambda: store.remove(NO_DIGEST),
        ):
            with pytest.raises(StoreAwayError):
                ask()
        assert store.path(kept.digest).read_bytes() == b"here"


@pytest.mark.parametrize(
    ("url", "told"),
    [
        ("s3://", "s3://bucket/prefix"),
        ("s3://key:secret@bucket/x", "credentials are in the environment"),
        ("s3://bucket?endpont=http://x", "no option 'endpont'"),
        ("gs://bucket", "no kind of file store"),
    ],
)
def test_an_address_that_is_none_is_refused(tmp_path: Path, url: str, told: str) -> None:
    with pytest.raises(InputError, match=told) as refused:
        files_at(url, tmp_path)
    assert "secret" not in str(refused.value)


def test_without_the_client_it_is_said_what_to_install(tmp_path: Path) -> None:
    program = (
        "import sys; from pathlib import Path; sys.modules['obstore'] = None\n"
        "from reina.sessions.storage.open_files import files_at\n"
        f"files_at(None, Path({str(tmp_path)!r}))\n"
        f"files_at('s3://bucket', Path({str(tmp_path)!r}))"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert 'pip install "reina[s3]"' in ended.stderr.splitlines()[-1]
