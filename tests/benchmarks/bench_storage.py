"""Sessions made, loaded and edited a second: SQLite, PostgreSQL, and the folders of version 0.1.

Run as ``python tests/benchmarks/bench_storage.py``. All three in one run on one disk, without the server
around: what is measured is what stands between an edit and its answer. The folders are written as version 0.1
wrote them: the record and the show as files, each synced; that version did not sync score and folder, which a
power cut then took.
"""

from __future__ import annotations

import os
import secrets
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from machine import heading
from tests.servers.postgresql import postgresql

from reina.curves import Parameter, ParameterRegistry
from reina.sessions.record import SessionRecord, created_now, new_id
from reina.sessions.show_revision import ShowRevision
from reina.sessions.storage.session_storage import SessionStorage, ShowChange
from reina.show import Show
from reina.system.tokens import hash_token

if TYPE_CHECKING:
    from collections.abc import Callable

TRACKS = [f"bench/{number}" for number in range(20)]
REGISTRY = ParameterRegistry([Parameter(path, "number", 0.0) for path in TRACKS])
SCORE = secrets.token_bytes(20_000)
SPAN_S = 1.5
"""How long each figure is measured."""


def record() -> SessionRecord:
    """A session that was just made."""
    fields = {"id": new_id(), "title": "Taps", "public": True, "created_at": created_now()}
    fields |= {"token_sha256": hash_token("secret"), "instrument": "trumpet", "part": 0, "transposition": 0}
    return SessionRecord.model_validate({**fields, "score_filename": "taps.mid", "song": None})


def show(keyframes: int) -> Show:
    """A show of twenty tracks of so many keyframes."""
    entries = [{"key": f"k{at}", "time": at / 10, "value": at} for at in range(keyframes)]
    tracks = [{"parameter": path, "keyframes": entries} for path in TRACKS]
    return Show.from_document({"version": 1, "tracks": tracks}, REGISTRY)


def moved(before: Show, number: int) -> Show:
    """The same with one keyframe moved."""
    track = before.track(TRACKS[number % len(TRACKS)])
    keyframes = list(track.keyframes)
    at = number * 7919 % len(keyframes)
    keyframes[at] = replace(keyframes[at], value=float(number))
    other = replace(track, keyframes=tuple(keyframes))
    return replace(before, tracks=tuple(other if each is track else each for each in before.tracks))


def write_synced(path: Path, data: bytes) -> None:
    """As version 0.1 wrote a file."""
    draft = path.with_name(f".{path.name}")
    with draft.open("wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
    draft.replace(path)


class Folders:
    """Sessions as version 0.1 kept them."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def add(self, kept: SessionRecord, revision: ShowRevision) -> SessionRecord:
        """Make one."""
        folder = self._folder / f"making-{kept.id}"
        folder.mkdir()
        (folder / "score").write_bytes(SCORE)
        write_synced(folder / "show.json", revision.text.text())
        write_synced(folder / "session.json", kept.model_dump_json(indent=2).encode())
        folder.rename(self._folder / kept.id)
        return kept

    def read(self, kept: SessionRecord) -> None:
        """Read one."""
        folder = self._folder / kept.id
        SessionRecord.model_validate_json((folder / "session.json").read_bytes())
        (folder / "show.json").read_bytes()

    def edit(self, kept: SessionRecord, _: ShowRevision, after: ShowRevision) -> None:
        """Keep an edit."""
        write_synced(self._folder / kept.id / "show.json", after.text.text())


class Stored:
    """Sessions as they are kept now."""

    def __init__(self, folder: Path, database: str = "") -> None:
        self.storage = SessionStorage.open(folder, database)

    def add(self, kept: SessionRecord, revision: ShowRevision) -> SessionRecord:
        """Make one."""
        folder = self.storage.stage()
        # As folders, too, have a score each.
        (folder / "score").write_bytes(kept.id.encode() + SCORE)
        return self.storage.add(kept, {"score": folder / "score"}, revision.text)

    def read(self, kept: SessionRecord) -> None:
        """Read one."""
        assert self.storage.read(kept.id) is not None

    def edit(self, kept: SessionRecord, before: ShowRevision, after: ShowRevision) -> None:
        """Keep an edit."""
        self.storage.change(kept, show=ShowChange(before, after))


def a_second(work: Callable[[int], float]) -> float:
    """How often something can be done a second, of which work says how long it took."""
    spent_s, count, end = 0.0, 0, time.perf_counter() + SPAN_S
    while time.perf_counter() < end or count < 3:
        spent_s += work(count)
        count += 1
    return count / spent_s


def measure(name: str, keeper: Folders | Stored) -> None:
    """Print a line of figures."""
    small, large = (ShowRevision.begin(show(keyframes)) for keyframes in (50, 10_000))

    def timed(work: Callable[[], object]) -> float:
        began = time.perf_counter()
        work()
        return time.perf_counter() - began

    def edits(revision: ShowRevision) -> float:
        kept = keeper.add(record(), revision)
        revisions = [revision]

        def edit(number: int) -> float:
            before = revisions[0]
            after = before.then(lambda history: history.then(moved(history.show, number)))
            revisions[0] = after
            return timed(lambda: keeper.edit(kept, before, after))

        return a_second(edit)

    kept = keeper.add(record(), small)
    figures = (
        a_second(lambda _: timed(lambda: keeper.add(record(), small))),
        a_second(lambda _: timed(lambda: keeper.read(kept))),
        edits(small),
        edits(large),
    )
    print(f"{name:24}" + "".join(f"{figure:12.0f}" for figure in figures), flush=True)


def main() -> None:
    """Measure all three."""
    print(heading(__file__))
    size = len(ShowRevision.begin(show(10_000)).text.text()) / 1e6
    columns = ("made", "read", "edits", f"of {size:.0f} MB")
    print(f"{'a second':24}" + "".join(f"{column:>12}" for column in columns))
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "folders").mkdir()
        measure("folders (version 0.1)", Folders(Path(folder) / "folders"))
        embedded = Stored(Path(folder) / "sqlite")
        measure("SQLite", embedded)
        embedded.storage.close()
        with postgresql(fsync=True) as server:
            stored = Stored(Path(folder) / "postgresql", server.database())
            measure("PostgreSQL", stored)
            stored.storage.close()


if __name__ == "__main__":
    main()
