"""Reina: a music visualizer with a player in it."""

__version__ = "0.1.0"
