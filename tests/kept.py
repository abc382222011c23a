"""What a data directory holds of sessions, and the database in it, to look into and to damage."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from typing import TYPE_CHECKING, Any

from reina.sessions.storage.database import FILE
from reina.sessions.storage.directory_lock import LOCK
from reina.system.reserve import RESERVE

if TYPE_CHECKING:
    from pathlib import Path


def sql(data_dir: Path, statement: str, *values: Any) -> list[tuple[Any, ...]]:
    """Run a statement on the embedded database beside whoever has it open."""
    with closing(sqlite3.connect(data_dir / FILE, timeout=30)) as connection, connection:
        return connection.execute(statement, values).fetchall()


def kept(data_dir: Path) -> list[str]:
    """Everything that is kept: files but the database, the lock and room set aside; and sessions in it."""
    files = [
        path
        for path in data_dir.rglob("*")
        if path.is_file() and not path.name.startswith(FILE) and path.name not in {LOCK, RESERVE}
    ]
    rows = [f"session {row[0]}" for row in sql(data_dir, "SELECT id FROM sessions")]
    for table in ("session_files", "alignments", "show_states", "show_objects"):
        rows += [f"{table} of {row[0]}" for row in sql(data_dir, f"SELECT session_id FROM {table}")]
    return [*(str(path.relative_to(data_dir)) for path in sorted(files)), *rows]
