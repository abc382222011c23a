"""One hit on a drum kit, and the names of what it is made of."""

from dataclasses import dataclass
from typing import Literal

Limb = Literal["left_hand", "right_hand", "left_foot", "right_foot"]

Technique = Literal[
    "ghost",
    "accent",
    "flam_grace",
    "drag_grace",
    "open",
    "half_open",
    "closed",
    "chick",
    "splash",
    "cross_stick",
    "rim_shot",
    "choke",
]

Hand = Literal["left_hand", "right_hand"]

HANDS: tuple[Hand, Hand] = ("right_hand", "left_hand")
"""The leading hand of a right-handed player first."""

FEET: tuple[Limb, Limb] = ("right_foot", "left_foot")

MIRRORED: dict[Limb, Limb] = {
    "right_hand": "left_hand",
    "left_hand": "right_hand",
    "right_foot": "left_foot",
    "left_foot": "right_foot",
}
"""Each limb's on the other side."""

PIECES = (
    "snare",
    "kick",
    "tom_high",
    "tom_mid",
    "tom_floor",
    "hi_hat",
    "ride",
    "crash_left",
    "crash_right",
    "china",
    "splash",
    "cowbell",
)
"""What the kit holds, by the names that its rig has."""

SPOKEN = {
    "snare": "the snare",
    "kick": "the bass drum",
    "tom_high": "the high tom",
    "tom_mid": "the middle tom",
    "tom_floor": "the floor tom",
    "hi_hat": "the hi-hat",
    "ride": "the ride",
    "crash_left": "the left crash",
    "crash_right": "the right crash",
    "china": "the china",
    "splash": "the splash",
    "cowbell": "the cowbell",
}
"""Each piece in words."""


@dataclass(frozen=True)
class DrumHit:
    """One hit, as it is played.

    Attributes:
        onset_s: When, seconds.
        onset_beats: When, quarter notes.
        piece: Of `PIECES`.
        zone: Where on the piece: centre, edge or rim of a drum; bow, bell or edge of a cymbal.
        limb: With what.
        velocity: In 0..1.
        technique: How, where it is no plain stroke.
    """

    onset_s: float
    onset_beats: float
    piece: str
    zone: str
    limb: Limb
    velocity: float
    technique: Technique | None = None
