"""A note as the wire shows it: in the score, and in `note_on` and `note_off`."""

from typing import Annotated

from pydantic import Field

from reina.instruments import NoteFingering
from reina.protocol.model import WireModel

MidiPitch = Annotated[int, Field(ge=0, le=127)]


class WireNote(WireModel):
    """One note of a part, with its fingering where a player plays that part."""

    index: int
    """The note's place in the score's table of notes."""
    part: int
    """Index of its part."""
    onset_s: float
    """Seconds from the start of the score."""
    duration_s: float
    onset_beats: float
    """Quarter notes from the start of the score."""
    duration_beats: float
    sounding_pitch: MidiPitch
    """MIDI number as it sounds."""
    written_pitch: int
    """MIDI number as a player of the instrument reads it."""
    sounding_name: str
    """What it is called as it sounds, in the key of the music: `F♯4`; C4 is 60."""
    written_name: str
    """What it is called in the part of who plays it."""
    velocity: float
    """0 to 1."""
    valves: list[int] | None
    """The valves that are down, ascending; [] is open, null is not playable, not played, no valves."""
    fingering: NoteFingering | None
    """How it is played, by the kind of instrument; null where it is not."""
    usual_valves: list[int] | None
    """What a beginner's chart shows for it, null where `valves` is; where both differ, `reason` says why."""
    reason: str
    """Why it is played so, or why it is not."""
    player: int | None
    """Who plays its part: a place in the cast, 0 being the first; null if nobody does."""
    in_played_part: bool
    """Whether somebody plays its part; `reason` says why a note of it is left out."""
