"""The tables: what `migrations` lead to."""

from __future__ import annotations

from sqlalchemy import (
    BigInteger,
    Boolean,
    Column,
    Float,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    String,
    Table,
    Text,
)

METADATA = MetaData()

# Compared byte by byte on every database: pages of the list go on from a text.
_BYTEWISE = Text().with_variant(Text(collation="C"), "postgresql")


def _of_session() -> Column[str]:
    return Column(
        "session_id",
        String(22),
        ForeignKey("sessions.id", ondelete="CASCADE"),
        primary_key=True,
        nullable=False,
    )


SESSIONS = Table(
    "sessions",
    METADATA,
    Column("id", String(22), primary_key=True),
    Column("record", Text, nullable=False),  # SessionRecord as JSON; the columns beside it follow from it
    Column("title", Text, nullable=False),
    Column("public", Boolean, nullable=False),
    Column("created_at", Text, nullable=False),
    Column("token_sha256", Text, nullable=False),
    Column("place", _BYTEWISE, nullable=False),  # in the list of sessions, if it is listed
    Column("owner", Text),  # whose it is; NULL: of nobody who is known
    Column("sender", Text, nullable=False),
    Column("file_bytes", BigInteger, nullable=False),
    Column("show_bytes", BigInteger, nullable=False),  # of all states, compressed
    Column("seen_at", Float(53), nullable=False),  # seconds since 1970
    Column("show_state", Integer, nullable=False),  # the number of the present one
    Column("version", Integer, nullable=False, server_default="0"),  # how often it was changed, clocks apart
)
"""One row a session."""
Index("ix_sessions_place", SESSIONS.c.public, SESSIONS.c.place)
Index("ix_sessions_owner", SESSIONS.c.owner, SESSIONS.c.place)
Index("ix_sessions_sender", SESSIONS.c.sender)
Index("ix_sessions_seen_at", SESSIONS.c.seen_at)

SESSION_FILES = Table(
    "session_files",
    METADATA,
    _of_session(),
    Column("name", Text, primary_key=True),
    Column("digest", String(64), nullable=False),
    Column("size", BigInteger, nullable=False),
)
"""Which files of the file store a session has; the same as its record says."""
Index("ix_session_files_digest", SESSION_FILES.c.digest)

ALIGNMENTS = Table("alignments", METADATA, _of_session(), Column("data", LargeBinary, nullable=False))
"""Where a score is heard in its song, compressed."""

SHOW_STATES = Table(
    "show_states",
    METADATA,
    _of_session(),
    Column("number", Integer, primary_key=True, autoincrement=False),
    Column("weight", BigInteger, nullable=False),  # of the step that leads to it from the one before
    Column("content", LargeBinary, nullable=False),  # which objects it is made of, compressed
)
"""What the show is and was: numbered without a gap, so that undo and redo move `show_state` by one."""

SHOW_OBJECTS = Table(
    "show_objects",
    METADATA,
    _of_session(),
    Column("digest", LargeBinary(16), primary_key=True),
    Column("first", Integer, nullable=False),  # the first state that has it
    Column("last", Integer),  # the last one; NULL: the newest has it
    Column("data", LargeBinary, nullable=False),
)
"""Tracks and pieces of them, each once however many states have it."""
