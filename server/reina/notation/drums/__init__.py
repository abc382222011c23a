"""Drum parts on paper: five lines, a place and a head for each piece, hands above and feet below."""

from reina.notation.drums.drum_part import (
    DrumEntry,
    DrumMeasure,
    DrumStroke,
    WrittenDrums,
    write_drums,
)
from reina.notation.drums.staff_places import (
    HEADS,
    PLACES,
    Head,
    Mark,
    StaffPlace,
    head_of,
    mark_of,
    place_of,
)
from reina.notation.drums.struck import Struck

__all__ = [
    "HEADS",
    "PLACES",
    "DrumEntry",
    "DrumMeasure",
    "DrumStroke",
    "Head",
    "Mark",
    "StaffPlace",
    "Struck",
    "WrittenDrums",
    "head_of",
    "mark_of",
    "place_of",
    "write_drums",
]
