"""Where each piece of a kit stands on the staff, and with which head.

As N. Weinberg's guidelines of the Percussive Arts Society have it: drums from the lowest up with plain heads,
cymbals above the staff with crosses, what the left foot plays below it. Places are told as pitches of a
treble staff, as notation programs do.
"""

from dataclasses import dataclass
from typing import Literal

from reina.notation.drums.struck import Struck

Letter = Literal["A", "B", "C", "D", "E", "F", "G"]
Head = Literal["plain", "cross", "circled_cross", "diamond", "triangle", "slashed"]
Mark = Literal["accent", "open", "half_open", "closed", "choke"]


@dataclass(frozen=True)
class StaffPlace:
    """A place on the staff: E4 is its lowest line, F5 its highest."""

    letter: Letter
    octave: int


PLACES: dict[str, StaffPlace] = {
    "kick": StaffPlace("F", 4),
    "tom_floor": StaffPlace("A", 4),
    "snare": StaffPlace("C", 5),
    "tom_mid": StaffPlace("D", 5),
    "tom_high": StaffPlace("E", 5),
    "cowbell": StaffPlace("E", 5),
    "ride": StaffPlace("F", 5),
    "hi_hat": StaffPlace("G", 5),
    "crash_left": StaffPlace("A", 5),
    "crash_right": StaffPlace("B", 5),
    "splash": StaffPlace("C", 6),
    "china": StaffPlace("D", 6),
}
PEDAL = StaffPlace("D", 4)
"""The hi-hat where its foot plays it."""

HEADS: dict[str, Head] = {
    "hi_hat": "cross",
    "ride": "cross",
    "crash_left": "cross",
    "crash_right": "cross",
    "splash": "diamond",
    "china": "circled_cross",
    "cowbell": "triangle",
}
"""Of the pieces whose head is not plain."""

GHOSTS = frozenset({"ghost"})
GRACES = frozenset({"flam_grace", "drag_grace"})


def is_foot(hit: Struck) -> bool:
    """Whether a foot plays it."""
    return hit.limb.endswith("foot")


def place_of(hit: Struck) -> StaffPlace:
    """Return where a hit stands; what has no place of its own stands where the snare does."""
    if hit.piece == "hi_hat" and is_foot(hit):
        return PEDAL
    return PLACES.get(hit.piece, PLACES["snare"])


def head_of(hit: Struck) -> Head:
    """Return a hit's head: crosses are of cymbals and of the stick across the rim."""
    if hit.technique == "cross_stick":
        return "cross"
    if hit.technique == "rim_shot":
        return "slashed"
    if hit.zone == "bell":
        return "diamond"
    return HEADS.get(hit.piece, "plain")


def mark_of(hit: Struck) -> Mark | None:
    """Return the sign above or below a hit, None if it has none; a closed hi-hat has none of itself."""
    match hit.technique:
        case "accent":
            return "accent"
        case "open" | "splash":
            return "open"
        case "half_open":
            return "half_open"
        case "choke":
            return "choke"
        case _:
            return None
