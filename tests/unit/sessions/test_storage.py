"""What is kept of sessions, in each of the databases."""

from __future__ import annotations

import threading
import zlib
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory

from reina.curves import Parameter, ParameterRegistry
from reina.sessions.kept_clock import KeptClock
from reina.sessions.record import SESSION_ID, SessionRecord, created_now, new_id
from reina.sessions.show_revision import ShowRevision
from reina.sessions.sleeping_show import known_tracks, wake
from reina.sessions.storage.database import FILE, HEAD, Database, database_url
from reina.sessions.storage.errors import (
    ChangedElsewhereError,
    DatabaseAwayError,
    DatabaseError,
    SessionDamagedError,
    SessionGoneError,
)
from reina.sessions.storage.local_files import LocalFiles
from reina.sessions.storage.open_files import FILES
from reina.sessions.storage.schema import METADATA
from reina.sessions.storage.session_storage import SessionStorage, ShowChange
from reina.sessions.usage import Usage
from reina.show import Show, ShowHistory
from reina.sound.alignment.alignment import Alignment, MapPoint
from reina.system.json_text import read_json
from reina.system.tokens import hash_token, new_token, token_matches

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator
    from pathlib import Path

    from sqlalchemy import Connection
    from tests.servers.postgresql import PostgreSQL

LIGHT, FOG = "lights/key/intensity", "fog/density"
REGISTRY = ParameterRegistry([Parameter(path, "number", 0.0) for path in (LIGHT, FOG)])


def record(**changes: object) -> SessionRecord:
    fields: dict[str, object] = {
        "id": new_id(),
        "title": "Taps",
        "public": False,
        "created_at": created_now(),
        "token_sha256": hash_token("secret"),
        "instrument": "trumpet",
        "part": 0,
        "transposition": 0,
        "score_filename": "taps.mid",
        "song": None,
        "sender": "192.0.2.1",
    }
    return SessionRecord.model_validate(fields | changes)


def show_of(**tracks: list[float]) -> Show:
    """A show of two tracks by their values, one a second."""
    documents: list[dict[str, Any]] = []
    for path, name in ((LIGHT, "light"), (FOG, "fog")):
        if name in tracks:
            keyframes = [
                {"key": f"k{at}", "time": at, "value": value} for at, value in enumerate(tracks[name])
            ]
            documents.append({"parameter": path, "keyframes": keyframes})
    return Show.from_document({"version": 1, "tracks": documents}, REGISTRY)


class Keeper:
    """A storage, and files for it."""

    def __init__(self, data_dir: Path, database: str) -> None:
        self.data_dir, self.database = data_dir, database
        self.storage = SessionStorage.open(data_dir, database)

    def again(self) -> Keeper:
        """The same as another server finds it."""
        self.storage.close()
        self.storage = SessionStorage.open(self.data_dir, self.database)
        return self

    def add(self, kept: SessionRecord, show: Show | None = None, **files: bytes) -> SessionRecord:
        folder = self.storage.stage()
        staged = {name: folder / name for name in files}
        for name, content in files.items():
            staged[name].write_bytes(content)
        revision = ShowRevision.begin(show or Show())
        return self.storage.add(kept, staged, revision.text)

    def kept_files(self) -> list[Path]:
        return [path for path in (self.data_dir / FILES).rglob("*") if path.is_file()]

    def sql(self, statement: str) -> None:
        """Run a statement beside it."""
        opened = Database(database_url(self.data_dir, self.database))
        with opened.writing() as connection:
            connection.exec_driver_sql(statement)
        opened.close()

    def count(self, table: str) -> int:
        opened = Database(database_url(self.data_dir, self.database))
        with opened.reading() as connection:
            count = connection.exec_driver_sql(f"SELECT count(*) FROM {table}").scalar()
        opened.close()
        return int(count or 0)


class Editor:
    """Edits a session's show as a server does: each step is kept."""

    def __init__(self, keeper: Keeper, kept: SessionRecord) -> None:
        self.keeper, self.kept = keeper, kept
        read = keeper.storage.read(kept.id)
        assert read is not None
        show = Show.from_document(read_json(read.show.text), REGISTRY)
        self.revision = ShowRevision.begin(
            show, earlier=read.show.earlier, later=read.show.later, weights=read.show.weights
        )

    def step(self, step: Callable[[ShowHistory], ShowHistory]) -> None:
        before = self.revision
        self.revision = before.then(step)
        if self.revision is not before:
            self.keeper.storage.change(self.kept, show=ShowChange(before, self.revision))

    def edit(self, show: Show) -> None:
        self.step(lambda history: history.then(show))

    def wake(self, steps: int) -> None:
        """Have the state before or after the present one at hand."""
        text = self.revision.text
        data, digests = self.keeper.storage.state_beside(self.kept, steps, known_tracks(text))
        woken = wake(Show.from_document(read_json(data), REGISTRY), digests, text)
        add = self.revision.with_earlier if steps < 0 else self.revision.with_later
        self.revision = add(woken)

    def undo(self) -> None:
        if not self.revision.history.past:
            self.wake(-1)
        self.step(ShowHistory.undone)

    def redo(self) -> None:
        if not self.revision.history.future:
            self.wake(1)
        self.step(ShowHistory.redone)

    def is_kept(self) -> bool:
        """Whether what another server reads is what is shown here."""
        other = Editor(self.keeper, self.kept).revision
        return (other.text.etag, other.state.undo, other.state.redo, other.weights) == (
            self.revision.text.etag,
            self.revision.state.undo,
            self.revision.state.redo,
            self.revision.weights,
        )


@pytest.fixture
def keeper(tmp_path: Path, database: str) -> Iterator[Keeper]:
    opened = Keeper(tmp_path, database)
    yield opened
    opened.storage.close()


def test_the_migrations_lead_to_the_tables(tmp_path: Path, database: str) -> None:
    opened = Database(database_url(tmp_path, database))
    with opened.reading() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, METADATA) == []
    opened.close()


def test_a_newer_schema_is_refused(tmp_path: Path, database: str) -> None:
    keeper = Keeper(tmp_path, database)
    keeper.sql("UPDATE alembic_version SET version_num = '9999'")
    keeper.storage.close()
    with pytest.raises(DatabaseError, match=r"newer version of Reina .its schema is 9999"):
        SessionStorage.open(tmp_path, database)


def test_several_servers_may_start_at_the_same_time(tmp_path: Path, postgresql_server: PostgreSQL) -> None:
    url = postgresql_server.database()
    with ThreadPoolExecutor(4) as threads:
        opened = list(threads.map(Database, [database_url(tmp_path, url)] * 4))
    for each in opened:
        each.close()
    assert postgresql_server.sql(url, "SELECT count(*) FROM alembic_version").strip() == "1"


def test_a_session_is_read_as_it_was_written(keeper: Keeper) -> None:
    made = keeper.add(record(title="Näme \0 ♯"), show_of(light=[1, 2]), score=b"MThd", song=b"RIFF")
    found = keeper.again().storage.read(made.id)
    assert found is not None
    assert found.record == made
    assert [(file.name, file.size) for file in made.files] == [("score", 4), ("song", 4)]
    assert keeper.storage.file(made, "score").read_bytes() == b"MThd"
    assert Show.from_document(read_json(found.show.text), REGISTRY) == show_of(light=[1, 2])
    assert (found.alignment, found.show.earlier, found.show.later) == (None, 0, 0)
    assert keeper.storage.read(new_id()) is None


@pytest.mark.parametrize("session_id", ["..", "../sessions", "", ".", "a/b", "x" * 22 + "\n", "x" * 21, "\0"])
def test_what_is_no_id_is_no_session(tmp_path: Path, session_id: str) -> None:
    storage = SessionStorage.open(tmp_path)
    assert session_id not in storage
    assert storage.read(session_id) is None
    storage.close()


def test_ids_and_tokens_are_random_and_tokens_are_not_kept() -> None:
    ids = {new_id() for _ in range(100)}
    assert len(ids) == 100
    assert all(SESSION_ID.fullmatch(session_id) for session_id in ids)
    token = new_token()
    kept = record(token_sha256=hash_token(token))
    assert token not in kept.model_dump_json()
    assert token_matches(kept.token_sha256, token)
    assert not token_matches(kept.token_sha256, new_token())


def test_a_change_is_kept_as_a_whole(keeper: Keeper, tmp_path: Path) -> None:
    made = keeper.add(record(), score=b"MThd")
    points = (MapPoint(0.0, 0.0, 1.0), MapPoint(2.0, 2.5, 1.0))
    alignment = Alignment(points, 2.0, 2.5)
    (tmp_path / "peaks").write_bytes(b"peaks")
    renamed = made.model_copy(update={"title": "Reveille"})
    changed = keeper.storage.change(renamed, alignment=alignment, staged={"song.peaks": tmp_path / "peaks"})
    found = keeper.again().storage.read(made.id)
    assert found is not None
    assert (found.record, found.record.title, found.alignment) == (changed, "Reveille", alignment)
    assert [file.name for file in changed.files] == ["score", "song.peaks"]
    keeper.storage.change(changed, alignment=None)
    found = keeper.storage.read(made.id)
    assert found is not None
    assert found.alignment is None


def test_what_is_ended_cannot_be_changed(keeper: Keeper) -> None:
    made = keeper.add(record(), score=b"MThd")
    keeper.storage.remove(made.id)
    keeper.storage.remove(made.id)
    with pytest.raises(SessionGoneError):
        keeper.storage.change(made)
    assert made.id not in keeper.storage
    tables = ("sessions", "session_files", "show_states", "show_objects", "alignments")
    assert [keeper.count(table) for table in tables] == [0] * 5
    assert keeper.kept_files() == []


def test_the_same_file_stands_once_until_the_last_session_with_it_ends(keeper: Keeper) -> None:
    one, two = (keeper.add(record(), score=b"MThd") for _ in range(2))
    assert len(keeper.kept_files()) == 1
    keeper.storage.remove(one.id)
    assert keeper.storage.file(two, "score").read_bytes() == b"MThd"
    keeper.storage.remove(two.id)
    assert keeper.kept_files() == []


def test_a_file_that_takes_anothers_place_leaves_none_behind(keeper: Keeper, tmp_path: Path) -> None:
    made = keeper.add(record(), score=b"MThd", peaks=b"old")
    (tmp_path / "new").write_bytes(b"new")
    changed = keeper.storage.change(made, staged={"peaks": tmp_path / "new"})
    assert keeper.storage.file(changed, "peaks").read_bytes() == b"new"
    assert len(keeper.kept_files()) == 2


def test_files_that_no_session_has_are_removed_but_none_that_is_about_to_be_named(
    keeper: Keeper, monkeypatch: pytest.MonkeyPatch
) -> None:
    keeper.add(record(), score=b"MThd")
    (keeper.data_dir / "left").write_bytes(b"of a server that ended")
    keeper.storage._store.keep(keeper.data_dir / "left")  # pyright: ignore[reportPrivateUsage]
    kept, go_on = threading.Event(), threading.Event()
    write = Database.writing

    def slowly(database: Database) -> Any:
        kept.set()
        assert go_on.wait(30)
        return write(database)

    monkeypatch.setattr(Database, "writing", slowly)
    with ThreadPoolExecutor(1) as thread:
        adding = thread.submit(keeper.add, record(), score=b"under way")
        assert kept.wait(30)
        orphans = keeper.storage.orphans()
        assert len(orphans) == 2
        assert keeper.storage.remove_files(orphans) == 1
        go_on.set()
        made = adding.result(30)
    assert keeper.storage.file(made, "score").read_bytes() == b"under way"
    assert keeper.storage.orphans() == set()


def test_what_cannot_be_written_leaves_no_file(keeper: Keeper) -> None:
    made = keeper.add(record(), score=b"MThd")
    with pytest.raises(Exception, match=r"(?i)unique"):
        keeper.add(record(id=made.id), score=b"another")
    assert len(keeper.kept_files()) == 1
    found = keeper.storage.read(made.id)
    assert found is not None
    assert found.record == made


# The list


def listed(keeper: Keeper, *days: int, public: bool = True) -> list[SessionRecord]:
    return [
        keeper.add(record(title=f"day {day}", created_at=f"2026-07-{day:02}T12:00:00+00:00", public=public))
        for day in days
    ]


def titles(keeper: Keeper, limit: int = 10, after: str | None = None) -> list[str]:
    return [entry.title for entry in keeper.storage.page(limit, after)[0]]


def test_listed_sessions_come_newest_first_in_pages(keeper: Keeper) -> None:
    listed(keeper, 3, 1, 5, 2, 4)
    listed(keeper, 6, public=False)
    first, following = keeper.storage.page(2)
    assert [entry.title for entry in first] == ["day 5", "day 4"]
    second, last = keeper.storage.page(2, following)
    assert [entry.title for entry in second] == ["day 3", "day 2"]
    assert keeper.storage.page(2, last) == (keeper.storage.page(10)[0][-1:], None)
    assert keeper.storage.page(5)[1] is None
    assert titles(keeper, after="0\0") == []


def test_a_page_goes_on_where_the_one_before_ended_whatever_came_or_went(keeper: Keeper) -> None:
    records = listed(keeper, 1, 2, 3, 4)
    _, following = keeper.storage.page(2)
    keeper.storage.remove(records[2].id)
    listed(keeper, 9)
    assert titles(keeper, after=following) == ["day 2", "day 1"]


def test_sessions_of_one_second_each_come_once(keeper: Keeper) -> None:
    made = listed(keeper, *[1] * 7)
    seen: list[str] = []
    after: str | None = None
    while True:
        entries, after = keeper.storage.page(2, after)
        seen += [entry.id for entry in entries]
        if after is None:
            break
    assert sorted(seen) == sorted(kept.id for kept in made)


def test_the_list_follows_what_is_changed(keeper: Keeper) -> None:
    (kept,) = listed(keeper, 1)
    keeper.storage.change(kept.model_copy(update={"title": "Renamed"}))
    assert titles(keeper) == ["Renamed"]
    keeper.storage.change(kept.model_copy(update={"public": False}))
    assert titles(keeper) == []


# What is counted


def test_usage_is_of_one_sender_or_of_all(keeper: Keeper, tmp_path: Path) -> None:
    assert keeper.storage.usage() == Usage(0, 0)
    keeper.add(record(), score=bytes(1000))
    made = keeper.add(record(), score=bytes(1000))
    (tmp_path / "score").write_bytes(bytes(5))
    keeper.storage.add(record(sender="192.0.2.2"), {"score": tmp_path / "score"}, b"{}")
    usage = keeper.storage.usage("192.0.2.1")
    assert usage.sessions == 2
    assert 2000 < usage.bytes < 3000
    assert keeper.storage.usage().sessions == 3
    assert keeper.storage.usage("192.0.2.3") == Usage(0, 0)
    before = keeper.storage.usage().bytes
    keeper.storage.remove(made.id)
    assert keeper.storage.usage().bytes < before - 1000


def test_what_nobody_has_seen_for_long_is_told(keeper: Keeper) -> None:
    one, two, three = (keeper.add(record()) for _ in range(3))
    assert keeper.storage.unseen_since(1e9) == []
    keeper.storage.note_seen([one.id], 500.0)
    keeper.storage.note_seen([two.id, "gone"], 300.0)
    keeper.storage.change(two.model_copy(update={"title": "Renamed"}))
    assert keeper.storage.unseen_since(1e9) == [two.id, one.id]
    assert keeper.storage.unseen_since(500.0) == [two.id]
    assert three.id in keeper.storage.unseen_since(1e12)
    keeper.storage.note_seen([], 1.0)


# Shows and what they were


def test_every_step_is_kept_and_can_be_taken_back_by_another_server(keeper: Keeper) -> None:
    shows = [show_of(light=[float(at)], fog=[1.0] * 3) for at in range(6)]
    editor = Editor(keeper, keeper.add(record(), shows[0], score=b"MThd"))
    for show in shows[1:]:
        editor.edit(show)
        assert editor.is_kept()
    editor.undo()
    editor.undo()
    assert editor.is_kept()
    other = Editor(keeper.again(), editor.kept)
    assert (other.revision.show, other.revision.state.undo, other.revision.state.redo) == (shows[3], 3, 2)
    for show in (shows[4], shows[5]):
        other.redo()
        assert other.revision.show == show
    for show in reversed(shows[:5]):
        other.undo()
        assert other.revision.show == show
        assert other.is_kept()
    other.redo()
    other.edit(show_of(light=[9.0]))
    assert (other.revision.state.undo, other.revision.state.redo) == (2, 0)
    assert other.is_kept()
    assert keeper.count("show_states") == 3


def test_an_edit_forgets_what_was_taken_back_and_is_asleep(keeper: Keeper) -> None:
    editor = Editor(keeper, keeper.add(record(), show_of(light=[0.0])))
    for value in (1.0, 2.0, 3.0):
        editor.edit(show_of(light=[value]))
    editor.undo()
    editor.undo()
    other = Editor(keeper, editor.kept)
    other.edit(show_of(light=[7.0]))
    assert (other.revision.done, other.revision.undone) == (2, 0)
    assert other.is_kept()
    other.undo()
    other.undo()
    assert other.revision.show == show_of(light=[0.0])
    assert keeper.count("show_objects") == 3


def test_states_that_are_forgotten_leave_nothing_behind(keeper: Keeper) -> None:
    editor = Editor(keeper, keeper.add(record(), show_of(light=[0.0], fog=[0.0])))
    editor.revision = replace(editor.revision, history=replace(editor.revision.history, longest=3))
    for value in range(1, 12):
        editor.edit(show_of(light=[float(value % 5)], fog=[0.0]))
        assert editor.is_kept()
        assert keeper.count("show_states") == min(value, 3) + 1
        # Each state has a light of its own, and all have one fog.
        assert keeper.count("show_objects") == min(value, 3) + 2
    kept = keeper.storage.usage().bytes
    editor.edit(show_of(light=[float(12 % 5)], fog=[0.0]))
    assert abs(keeper.storage.usage().bytes - kept) < 10


def test_any_walk_through_edits_undo_and_redo_is_kept(keeper: Keeper) -> None:
    import random

    chance = random.Random(4)
    editor = Editor(keeper, keeper.add(record(), show_of(light=[0.0])))
    for _ in range(60):
        way = chance.choice(["edit", "edit", "undo", "redo", "load"])
        if way == "edit":
            # Few values, so that states come back.
            editor.edit(show_of(light=[float(chance.randrange(3))], fog=[float(chance.randrange(3))]))
        elif way == "undo" and editor.revision.done:
            editor.undo()
        elif way == "redo" and editor.revision.undone:
            editor.redo()
        elif way == "load":
            editor = Editor(keeper, editor.kept)
        assert editor.is_kept()
    editor.edit(show_of())
    while editor.revision.done:
        editor.undo()
    editor.edit(show_of(light=[1.0]))
    assert keeper.count("show_states") == 2
    assert keeper.count("show_objects") <= 3


def test_one_keyframe_of_a_long_track_costs_little(keeper: Keeper) -> None:
    values = [float(at) for at in range(30_000)]
    editor = Editor(keeper, keeper.add(record(), show_of(light=values)))
    whole, objects = keeper.storage.usage().bytes, keeper.count("show_objects")
    assert objects > 100
    values[15_000] = 0.5
    editor.edit(show_of(light=values))
    assert keeper.count("show_objects") == objects + 2, "a piece, and the list of the pieces"
    assert keeper.storage.usage().bytes - whole < whole / 20
    # One more in the middle moves all that follow it.
    shorter = replace(
        editor.revision.show.track(LIGHT),
        keyframes=editor.revision.show.track(LIGHT).keyframes[:9]
        + editor.revision.show.track(LIGHT).keyframes[10:],
    )
    editor.edit(replace(editor.revision.show, tracks=(shorter,)))
    assert keeper.count("show_objects") == objects + 4
    assert editor.is_kept()
    other = Editor(keeper, editor.kept)
    other.wake(-1)
    before, now = other.revision.history.past[-1].track(LIGHT), other.revision.show.track(LIGHT)
    assert (
        sum(one is two for one, two in zip(before.keyframes[10:], now.keyframes[9:], strict=True)) == 29_990
    )


def test_a_track_that_is_no_keyframes_is_cut_too(keeper: Keeper) -> None:
    unknown = {"parameter": "gone/since", "keyframes": [{"text": "♪" * 100_000}]}
    show = Show.from_document({"version": 1, "tracks": [unknown]}, REGISTRY)
    editor = Editor(keeper, keeper.add(record(), show))
    assert editor.revision.show == show
    assert keeper.count("show_objects") == 6


# What is damaged


def damage(keeper: Keeper, what: str, made: SessionRecord, other: SessionRecord) -> None:
    id_ = f"'{made.id}'"
    match what:
        case "record":
            keeper.sql(f"UPDATE sessions SET record = '{{' WHERE id = {id_}")
        case "copy":
            copied = f"(SELECT record FROM sessions WHERE id = '{other.id}')"
            keeper.sql(f"UPDATE sessions SET record = {copied} WHERE id = {id_}")
        case "state":
            keeper.sql(f"DELETE FROM show_states WHERE session_id = {id_}")
        case "object":
            keeper.sql(f"DELETE FROM show_objects WHERE session_id = {id_}")
        case "content":
            blank = zlib.compress(b"t{}").hex()
            data = f"x'{blank}'" if not keeper.database else f"decode('{blank}', 'hex')"
            keeper.sql(f"UPDATE show_objects SET data = {data} WHERE session_id = {id_}")
        case _:
            data = "x'00'" if not keeper.database else "decode('00', 'hex')"
            keeper.sql(f"INSERT INTO alignments (session_id, data) VALUES ({id_}, {data})")


@pytest.mark.parametrize("what", ["record", "copy", "state", "object", "content", "alignment"])
def test_what_is_damaged_is_told_and_disturbs_no_other(keeper: Keeper, what: str) -> None:
    made = keeper.add(record(public=True), show_of(light=[1.0]), score=b"MThd")
    other = keeper.add(record(public=True), show_of(light=[2.0]), score=b"other")
    damage(keeper, what, made, other)
    with pytest.raises(SessionDamagedError) as told:
        keeper.storage.read(made.id)
    assert told.value.token_sha256 == made.token_sha256
    found = keeper.storage.read(other.id)
    assert found is not None
    assert found.record == other
    assert {entry.id for entry in keeper.storage.page(10)[0]} == {made.id, other.id}
    keeper.storage.remove(made.id)
    assert keeper.storage.read(made.id) is None
    assert len(keeper.kept_files()) == 1


def test_a_lost_file_is_damage(keeper: Keeper) -> None:
    made = keeper.add(record(), score=b"MThd")
    keeper.kept_files()[0].unlink()
    for name in ("score", "none"):
        with pytest.raises(SessionDamagedError, match=f"its file {name} is lost"):
            keeper.storage.file(made, name)


# The database itself


def test_everything_is_for_nobody_else_to_read(tmp_path: Path) -> None:
    storage = SessionStorage.open(tmp_path / "data")
    kept = Keeper(tmp_path / "data", "")
    kept.add(record(), score=b"MThd")
    modes = {path: path.stat().st_mode & 0o777 for path in (tmp_path / "data").rglob("*")}
    assert {FILE, f"{FILE}-wal"} <= {path.name for path in modes}
    assert {path: mode for path, mode in modes.items() if mode != (0o700 if path.is_dir() else 0o600)} == {}
    assert (tmp_path / "data").stat().st_mode & 0o777 == 0o700
    storage.close()
    kept.storage.close()


def test_what_is_no_database_is_told(tmp_path: Path) -> None:
    for url in ("mysql://host/name", "no address", "sqlite:///elsewhere.db"):
        with pytest.raises(DatabaseError, match=r"it is as postgresql\+psycopg://"):
            database_url(tmp_path, url)
    (tmp_path / FILE).write_bytes(b"not a database at all" * 100)
    with pytest.raises(DatabaseError, match=r"is damaged: .*restore it from a backup"):
        SessionStorage.open(tmp_path)


def test_without_the_driver_its_extra_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found: dict[str, object] = {}
    monkeypatch.setattr("reina.sessions.storage.database.find_spec", found.get)
    with pytest.raises(DatabaseError, match=r'pip install "reina\[postgres\]"'):
        database_url(tmp_path, "postgresql://host/name")


def test_a_password_is_in_no_message(tmp_path: Path) -> None:
    with pytest.raises(DatabaseAwayError, match=r"user:\*\*\*@127.0.0.1") as told:
        SessionStorage.open(tmp_path, "postgresql+psycopg://user:secret@127.0.0.1:1/name")
    assert "secret" not in str(told.value)


def test_a_database_that_is_away_is_told_and_used_again_when_it_is_back(tmp_path: Path) -> None:
    from tests.servers.postgresql import postgresql

    with postgresql() as server:
        url = server.database()
        keeper = Keeper(tmp_path, url)
        made = keeper.add(record(), score=b"MThd")
        server.stop()
        for _ in range(2):
            with pytest.raises(DatabaseAwayError, match="does not answer"):
                keeper.storage.read(made.id)
        with pytest.raises(DatabaseAwayError):
            keeper.add(record(), score=b"never")
        server.start()
        found = keeper.storage.read(made.id)
        assert found is not None
        assert found.record == made
        keeper.storage.remove_files(keeper.storage.orphans())
        assert len(keeper.kept_files()) == 1
        keeper.storage.close()


def test_what_is_written_by_many_at_once_is_all_there(keeper: Keeper) -> None:
    def add(number: int) -> SessionRecord:
        return keeper.add(record(), score=b"%d" % (number % 3))

    with ThreadPoolExecutor(8) as threads:
        made = list(threads.map(add, range(24)))
        list(threads.map(keeper.storage.remove, [each.id for each in made[:12]]))
    assert keeper.storage.usage().sessions == 12
    for each in made[12:]:
        assert keeper.storage.file(each, "score").is_file()


def test_the_schema_that_a_start_looks_for_is_the_last_migrations() -> None:
    config = Config()
    config.set_main_option("script_location", "reina.sessions.storage:migrations")
    assert ScriptDirectory.from_config(config).get_current_head() == HEAD


def test_no_server_removes_what_another_is_about_to_name(
    tmp_path: Path, postgresql_server: PostgreSQL, monkeypatch: pytest.MonkeyPatch
) -> None:
    database, files = postgresql_server.database(), LocalFiles(tmp_path / "files")
    storages = [SessionStorage.open(tmp_path / name, database, files) for name in ("one", "other")]
    one, other = storages
    insert, removed = one._database.writing, list[int]()  # pyright: ignore[reportPrivateUsage]

    @contextmanager
    def writing() -> Generator[Connection]:
        # The file is kept, and no transaction has named it yet.
        removed.append(other.remove_files({file.digest for file in files.files()}))
        with insert() as connection:
            yield connection

    monkeypatch.setattr(one._database, "writing", writing)  # pyright: ignore[reportPrivateUsage]
    staged = one.stage() / "score"
    staged.write_bytes(b"notes")
    kept = one.add(record(), {"score": staged}, ShowRevision.begin(Show()).text)
    assert removed == [0]
    assert one.file(kept, "score").read_bytes() == b"notes"
    monkeypatch.undo()
    one.remove(kept.id)
    assert list(files.files()) == []
    for storage in storages:
        storage.close()


def test_of_two_who_change_a_session_one_is_refused(keeper: Keeper) -> None:
    made = keeper.add(record())
    assert keeper.storage.version(made.id) == 0
    keeper.storage.change(made.model_copy(update={"title": "One"}), version=0)
    with pytest.raises(ChangedElsewhereError, match="changed on another server"):
        keeper.storage.change(made.model_copy(update={"title": "Other"}), version=0)
    found = keeper.storage.read(made.id)
    assert found is not None
    assert (found.record.title, found.version) == ("One", 1)
    clock = KeptClock(at_s=1.0, song_time_s=2.0)
    assert keeper.storage.keep_clock(found.record.model_copy(update={"clock": clock}), 1)
    assert not keeper.storage.keep_clock(made, 0), "it would take back the title"
    found = keeper.storage.read(made.id)
    assert found is not None
    assert (found.record.title, found.record.clock, found.version) == ("One", clock, 1)
    keeper.storage.remove(made.id)
    assert keeper.storage.version(made.id) is None
    assert not keeper.storage.keep_clock(made, 1)
    with pytest.raises(SessionGoneError):
        keeper.storage.change(made, version=1)
