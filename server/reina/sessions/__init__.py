"""The layer `sessions`; docs/architecture.md says what it holds."""
