"""Sessions count their changes, so that of several servers none undoes what another has changed."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"


def upgrade() -> None:
    """Add the count."""
    op.add_column("sessions", sa.Column("version", sa.Integer, nullable=False, server_default="0"))
