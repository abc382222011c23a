"""A note of a MusicXML document as it is played."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from reina.music.musicxml.model import Ornament, Source


@dataclass(slots=True)
class PlayedNote:
    """One note that sounds: onset and end in quarter notes from the beginning."""

    onset: float
    end: float
    written_end: float
    """Where it would end without articulation: where what it is tied to begins."""
    pitch: int
    velocity: float
    slurred: bool
    source: Source
    line: int
    ornament: Ornament | None = None
    ornament_from: float = 0.0
    """Where its ornament begins, if it has one: within it where that stands at a note that is tied to it."""
