"""The database that sessions are kept in: SQLite in the data directory, or PostgreSQL by its address."""

from __future__ import annotations

import os
import sqlite3
import threading
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sqlalchemy import create_engine, event, exc, inspect, text
from sqlalchemy.engine import URL, make_url

from reina.sessions.storage.errors import DatabaseAwayError, DatabaseError
from reina.sessions.storage.file_store import StoreFullError

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Generator
    from contextlib import AbstractContextManager

    from sqlalchemy import Connection, Engine

FILE = "reina.db"
"""The embedded database, in the data directory."""
POSTGRESQL = "postgresql+psycopg"
PATIENCE_S = 10
"""How long a connection, or the turn to write, is waited for."""
HEAD = "0002"
"""The revision of this version's schema: that of the last of `migrations`."""
MIGRATING = 0x5265696E61
"""The number of the lock that servers of one PostgreSQL take in turn while they migrate it."""
FILES = 0x66696C65
"""The number of the kind of locks that stand for files."""

_FULL = frozenset({sqlite3.SQLITE_FULL})
_UNUSABLE = frozenset({sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB})
_WRITES = "reina_writes"


def database_url(data_dir: Path, given: str = "") -> URL:
    """The address of the database.

    Args:
        data_dir: Holds the embedded one.
        given: ``postgresql+psycopg://…`` (``postgresql://…`` is taken for it), or nothing.

    Raises:
        DatabaseError: It is no such address, or what speaks to PostgreSQL is not installed.
    """
    if not given:
        return URL.create("sqlite", database=str(data_dir / FILE))
    try:
        url = make_url(given)
    except exc.ArgumentError:
        raise DatabaseError(f"the database's address cannot be read; {_LIKE}") from None
    if url.drivername in {"postgresql", "postgres"}:
        url = url.set(drivername=POSTGRESQL)
    if url.drivername != POSTGRESQL:
        raise DatabaseError(f"{url.drivername} is no database that sessions are kept in; {_LIKE}")
    if find_spec("psycopg") is None:
        raise DatabaseError('PostgreSQL needs a driver that is not installed: pip install "reina[postgres]"')
    return url


_LIKE = "it is as postgresql+psycopg://user:password@host:5432/name, and without one SQLite is used"


class Database:
    """A pool of connections, for threads; migrated to this version's schema when it is opened.

    Args:
        url: See `database_url`.

    Raises:
        DatabaseAwayError: It does not answer.
        DatabaseError: It is a newer version's, or none.
    """

    def __init__(self, url: URL) -> None:
        self.is_embedded = url.get_backend_name() == "sqlite"
        self.shown = url.database or "" if self.is_embedded else url.render_as_string(hide_password=True)
        """Where it is, fit for a message."""
        self._turn = threading.Lock()
        self._engine = _embedded(url) if self.is_embedded else _postgresql(url)
        try:
            self._migrate()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Give its connections back."""
        self._engine.dispose()

    @contextmanager
    def reading(self) -> Generator[Connection]:
        """A transaction that reads: all of it sees one state.

        Raises:
            DatabaseAwayError: It does not answer.
        """
        with self._telling(), self._engine.connect() as connection:
            if not self.is_embedded:
                connection.execution_options(isolation_level="REPEATABLE READ")
            with connection.begin():
                yield connection

    @contextmanager
    def writing(self) -> Generator[Connection]:
        """A transaction that writes; at its end it outlives a power cut, or has not been.

        Raises:
            DatabaseAwayError: It does not answer; nothing is written then.
            StoreFullError: There is no room; nothing is written then.
        """
        # Who waits for SQLite looks again and again: threads of this process had better queue.
        turn = self._turn if self.is_embedded else threading.Lock()
        if not turn.acquire(timeout=PATIENCE_S):
            raise DatabaseAwayError(f"the database {self.shown} is busy; try again")
        try:
            with self._telling(), self._engine.connect() as connection:
                connection.execution_options(**{_WRITES: True})
                with connection.begin():
                    yield connection
        finally:
            turn.release()

    @property
    def file_locks(self) -> DatabaseLocks | None:
        """What servers with the same database hold while they name or remove files; None for one alone."""
        return None if self.is_embedded else DatabaseLocks(self._engine, self._telling)

    @contextmanager
    def _telling(self) -> Generator[None]:
        try:
            yield
        except exc.TimeoutError as error:
            raise DatabaseAwayError(f"the database {self.shown} is busy; try again") from error
        except exc.DBAPIError as error:
            raise self._told(error) from error

    def _told(self, error: exc.DBAPIError) -> Exception:
        why = _reason(error)
        code = getattr(error.orig, "sqlite_errorcode", 0) & 0xFF
        if code in _FULL or getattr(error.orig, "sqlstate", None) == "53100":
            return StoreFullError()
        if code in _UNUSABLE:
            return DatabaseError(f"the database {self.shown} is damaged: {why}; restore it from a backup")
        if isinstance(error, exc.OperationalError | exc.InterfaceError) or error.connection_invalidated:
            return DatabaseAwayError(f"the database {self.shown} does not answer: {why}")
        return error

    def _migrate(self) -> None:
        with self.reading() as connection:
            present = _revision(connection)
        if present == HEAD:
            return
        # Alembic takes a tenth of a server's time to start, and most starts need nothing of it.
        from alembic import command
        from alembic.config import Config
        from alembic.script import ScriptDirectory

        config = Config()
        config.set_main_option("script_location", "reina.sessions.storage:migrations")
        known = {script.revision for script in ScriptDirectory.from_config(config).walk_revisions()}
        if present is not None and present not in known:
            raise DatabaseError(
                f"the database {self.shown} is of a newer version of Reina (its schema is {present}; this "
                f"version knows up to {HEAD}): start that version, or restore a backup"
            )
        with self.writing() as connection:
            if not self.is_embedded:
                connection.execute(text("SELECT pg_advisory_xact_lock(:number)"), {"number": MIGRATING})
            config.attributes["connection"] = connection
            command.upgrade(config, "head")


class DatabaseLocks:
    """Locks of PostgreSQL, each on a connection of its own: they go with whoever holds them.

    Args:
        engine: Gives connections.
        telling: Turns what goes wrong into what is told of it.
    """

    def __init__(self, engine: Engine, telling: Callable[[], AbstractContextManager[None]]) -> None:
        self._engine = engine
        self._telling = telling

    @contextmanager
    def naming(self, digests: Collection[str]) -> Generator[None]:
        """See `FileLocks.naming`.

        Raises:
            DatabaseAwayError: It does not answer.
        """
        # In one order everywhere: nobody waits for one who waits for him.
        numbers = sorted({_lock_number(digest) for digest in digests})
        with self._locked("pg_advisory_lock_shared", "pg_advisory_unlock_shared", numbers):
            yield

    @contextmanager
    def removing(self, digest: str) -> Generator[bool]:
        """See `FileLocks.removing`.

        Raises:
            DatabaseAwayError: It does not answer.
        """
        numbers = [_lock_number(digest)]
        with self._locked("pg_try_advisory_lock", "pg_advisory_unlock", numbers) as locked:
            yield locked

    @contextmanager
    def _locked(self, lock: str, unlock: str, numbers: list[int]) -> Generator[bool]:
        with self._telling():
            connection = self._engine.connect().execution_options(isolation_level="AUTOCOMMIT")
        try:
            # Those that wait give nothing, which stands for having them.
            got = [self._call(connection, lock, number) is not False for number in numbers]
            try:
                yield all(got)
            finally:
                # A connection that broke holds none any more.
                with suppress(DatabaseAwayError):
                    for number, held in zip(numbers, got, strict=True):
                        if held:
                            self._call(connection, unlock, number)
        finally:
            connection.close()

    def _call(self, connection: Connection, function: str, number: int) -> object:
        with self._telling():
            asked = text(f"SELECT {function}(:kind, :number)")
            return connection.execute(asked, {"kind": FILES, "number": number}).scalar()


def _lock_number(digest: str) -> int:
    """Of a file's lock: 32 bits with a sign; files that share it wait for one another once in a while."""
    return int.from_bytes(bytes.fromhex(digest[:8]), signed=True)


def _revision(connection: Connection) -> str | None:
    """The revision that Alembic has noted; None where there are no tables yet."""
    if not inspect(connection).has_table("alembic_version"):
        return None
    noted: str | None = connection.scalar(text("SELECT version_num FROM alembic_version"))
    return noted


def _embedded(url: URL) -> Engine:
    # Made here, for nobody else to read; what SQLite puts beside it has the same mode.
    path = Path(str(url.database))
    try:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            os.fchmod(handle, 0o600)
        finally:
            os.close(handle)
        folder = os.open(path.parent, os.O_RDONLY | os.O_CLOEXEC)
        try:
            # That it is there survives a power cut, too.
            os.fsync(folder)
        finally:
            os.close(folder)
    except OSError as error:
        raise DatabaseError(f"the database {url.database} cannot be opened: {error.strerror}") from error
    engine = create_engine(url, connect_args={"timeout": PATIENCE_S}, pool_timeout=PATIENCE_S)
    event.listen(engine, "connect", _prepare)
    event.listen(engine, "begin", _begin)
    return engine


def _prepare(connection: Any, _: object) -> None:
    # Transactions begin where SQLAlchemy says, for changes of tables too.
    connection.isolation_level = None
    for setting in (
        "journal_mode=WAL",
        # Each commit is on the disk when it returns.
        "synchronous=FULL",
        "foreign_keys=ON",
        f"busy_timeout={PATIENCE_S * 1000}",
    ):
        connection.execute(f"PRAGMA {setting}").close()


def _begin(connection: Connection) -> None:
    writes = connection.get_execution_options().get(_WRITES, False)
    # One that reads first and writes then could not wait for its turn.
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")


def _postgresql(url: URL) -> Engine:
    return create_engine(
        url,
        connect_args={"connect_timeout": PATIENCE_S, "application_name": "reina"},
        # A connection that broke while nobody used it is made anew.
        pool_pre_ping=True,
        pool_timeout=PATIENCE_S,
    )


def _reason(error: exc.DBAPIError) -> str:
    lines = str(error.orig).strip().splitlines()
    return lines[0] if lines else type(error.orig).__name__
