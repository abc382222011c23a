"""The layer `api`; docs/architecture.md says what it holds."""
