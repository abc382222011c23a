"""The layer `keyframes`; docs/architecture.md says what it holds."""
