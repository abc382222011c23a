"""The layer `protocol`; docs/architecture.md says what it holds."""
