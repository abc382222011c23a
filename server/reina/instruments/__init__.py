"""The layer `instruments`; docs/architecture.md says what it holds."""
