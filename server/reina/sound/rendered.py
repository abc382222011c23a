"""Where a rendered song lies: a folder of its own, with its segments beside the whole."""

from pathlib import Path

SONG = "song.flac"
"""It appears when everything else is there."""


def segment_path(song: Path, number: int) -> Path:
    """Where a segment of a rendered song lies, beside the song."""
    return song.with_name(f"{number}.opus")
