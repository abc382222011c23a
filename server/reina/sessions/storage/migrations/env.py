"""Alembic's: runs the migrations on the connection that `reina.sessions.storage.database` hands over."""

from alembic import context

from reina.sessions.storage.schema import METADATA

context.configure(
    connection=context.config.attributes["connection"], target_metadata=METADATA, transactional_ddl=True
)
with context.begin_transaction():
    context.run_migrations()
