"""What connects servers that serve the same sessions."""
