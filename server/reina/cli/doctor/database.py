"""The sessions' database: whether it opens, is whole, and is of this version."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory
from alembic.util import CommandError
from sqlalchemy import create_engine, make_url, text
from sqlalchemy.exc import ArgumentError, SQLAlchemyError

from reina.cli.doctor.finding import fail, ok, warn
from reina.sessions.storage.archive import DATABASE

if TYPE_CHECKING:
    from pathlib import Path

    from sqlalchemy import Connection, Engine

    from reina.cli.doctor.finding import Finding

SCRIPTS = "reina.sessions.storage:migrations"
PATIENCE_S = 5
RESTORE = "restore a backup with `reina restore` (docs/operating.md)"
MIGRATED_AT_START = "start the server, which brings it up to date"


def database_finding(directory: Path, address: str) -> Finding:
    """Look at a database without changing anything of it.

    Args:
        directory: The data directory, which has the embedded one.
        address: Of another database, as REINA_DATABASE_URL has it; empty for the embedded one.
    """
    path = directory / DATABASE
    if not address and not path.exists():
        return ok("database", f"{DATABASE} will be made")
    try:
        engine = _another(address) if address else _embedded(path)
    except (ArgumentError, ImportError) as error:
        return fail("database", f"REINA_DATABASE_URL: {_first_line(error)}", "correct it, or leave it out")
    shown = engine.url.render_as_string(hide_password=True) if address else str(path)
    try:
        with engine.connect() as connection:
            if not address and (damage := _damage(connection)) is not None:
                return fail("database", f"{shown} is damaged: {damage}", RESTORE)
            return _of_version(shown, MigrationContext.configure(connection).get_current_revision())
    except SQLAlchemyError as error:
        to_do = "see that it runs, and that address and password are right" if address else RESTORE
        return fail("database", f"{shown}: {_first_line(getattr(error, 'orig', None) or error)}", to_do)
    finally:
        engine.dispose()


def _embedded(path: Path) -> Engine:
    return create_engine(f"sqlite:///file:{path}?mode=ro&uri=true", connect_args={"timeout": PATIENCE_S})


def _another(address: str) -> Engine:
    url = make_url(address)
    # As the server has it: one driver, however the address names the database.
    if url.drivername in {"postgres", "postgresql"}:
        url = url.set(drivername="postgresql+psycopg")
    return create_engine(url, connect_args={"connect_timeout": PATIENCE_S})


def _damage(connection: Connection) -> str | None:
    found = str(connection.execute(text("PRAGMA quick_check(1)")).scalar())
    return None if found == "ok" else found


def _of_version(shown: str, revision: str | None) -> Finding:
    known, newest = known_revisions()
    if revision is None:
        return warn("database", f"{shown} has no tables yet", MIGRATED_AT_START)
    if newest is None or revision == newest:
        return ok("database", f"{shown} is whole, at revision {revision}")
    if revision in known:
        return warn("database", f"{shown} is at revision {revision}, before {newest}", MIGRATED_AT_START)
    detail = f"{shown} is of a newer version of Reina: revision {revision}"
    return fail("database", detail, f"install that version, or {RESTORE}")


def known_revisions() -> tuple[frozenset[str], str | None]:
    """The revisions that this version knows, and the newest; none where it has no tables of its own."""
    config = Config()
    config.set_main_option("script_location", SCRIPTS)
    try:
        scripts = ScriptDirectory.from_config(config)
        known = frozenset(script.revision for script in scripts.walk_revisions())
        return known, scripts.get_current_head()
    except (CommandError, ImportError):
        return frozenset(), None


def _first_line(error: Any) -> str:
    lines = str(error).strip().splitlines()
    return lines[0] if lines else type(error).__name__
