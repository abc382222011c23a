"""The layer `music`; docs/architecture.md says what it holds."""
