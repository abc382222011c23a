"""Scores as JSON: Reina's own form and the one of Tone.js's converter."""

from reina.music.document.reader import read_json
from reina.music.document.schema import score_schema

__all__ = ["read_json", "score_schema"]
