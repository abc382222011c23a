"""The layer `rotations`; docs/architecture.md says what it holds."""
