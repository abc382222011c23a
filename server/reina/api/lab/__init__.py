"""The laboratory's calls."""
