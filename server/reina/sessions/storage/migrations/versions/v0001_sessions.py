"""Sessions, their files, their shows with what these were."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None


def _of_session() -> sa.Column[str]:
    return sa.Column(
        "session_id",
        sa.String(22),
        sa.ForeignKey("sessions.id", ondelete="CASCADE"),
        primary_key=True,
        nullable=False,
    )


def upgrade() -> None:
    """Make the tables."""
    op.create_table(
        "sessions",
        sa.Column("id", sa.String(22), primary_key=True),
        sa.Column("record", sa.Text, nullable=False),
        sa.Column("title", sa.Text, nullable=False),
        sa.Column("public", sa.Boolean, nullable=False),
        sa.Column("created_at", sa.Text, nullable=False),
        sa.Column("token_sha256", sa.Text, nullable=False),
        sa.Column("place", sa.Text().with_variant(sa.Text(collation="C"), "postgresql"), nullable=False),
        sa.Column("owner", sa.Text),
        sa.Column("sender", sa.Text, nullable=False),
        sa.Column("file_bytes", sa.BigInteger, nullable=False),
        sa.Column("show_bytes", sa.BigInteger, nullable=False),
        sa.Column("seen_at", sa.Float(53), nullable=False),
        sa.Column("show_state", sa.Integer, nullable=False),
    )
    op.create_index("ix_sessions_place", "sessions", ["public", "place"])
    op.create_index("ix_sessions_owner", "sessions", ["owner", "place"])
    for column in ("sender", "seen_at"):
        op.create_index(f"ix_sessions_{column}", "sessions", [column])
    op.create_table(
        "session_files",
        _of_session(),
        sa.Column("name", sa.Text, primary_key=True),
        sa.Column("digest", sa.String(64), nullable=False),
        sa.Column("size", sa.BigInteger, nullable=False),
    )
    op.create_index("ix_session_files_digest", "session_files", ["digest"])
    op.create_table("alignments", _of_session(), sa.Column("data", sa.LargeBinary, nullable=False))
    op.create_table(
        "show_states",
        _of_session(),
        sa.Column("number", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("weight", sa.BigInteger, nullable=False),
        sa.Column("content", sa.LargeBinary, nullable=False),
    )
    op.create_table(
        "show_objects",
        _of_session(),
        sa.Column("digest", sa.LargeBinary(16), primary_key=True),
        sa.Column("first", sa.Integer, nullable=False),
        sa.Column("last", sa.Integer),
        sa.Column("data", sa.LargeBinary, nullable=False),
    )
