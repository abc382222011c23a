"""The layer `skeleton`; docs/architecture.md says what it holds."""
