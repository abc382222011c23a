"""The layer `kinematics`; docs/architecture.md says what it holds."""
