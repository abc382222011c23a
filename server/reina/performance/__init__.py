"""The layer `performance`; docs/architecture.md says what it holds."""
