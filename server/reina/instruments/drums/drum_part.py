"""A part as a drummer plays it: how each note is struck, and the hits that are mimed."""

from dataclasses import dataclass, replace
from typing import Literal

from reina.instruments.drums.hit import DrumHit, Hand
from reina.instruments.played import Fingering, PlayedPart, Strokes

Handedness = Literal["left", "right"]


@dataclass(frozen=True)
class Choke:
    """A cymbal that a hand grips, so that it is still.

    Attributes:
        at_s: When it is gripped, seconds.
        piece: Which.
        limb: With which hand.
    """

    at_s: float
    piece: str
    limb: Hand

    def mirrored(self) -> "Choke":
        """Return it as a left-handed player does it."""
        return replace(self, limb="left_hand" if self.limb == "right_hand" else "right_hand")


@dataclass(frozen=True, eq=False)
class DrumFingering(Fingering):
    """How each of the M notes of a drum part is struck.

    Attributes:
        hits: What is mimed, by time: each note that is playable, but one for several that are one stroke.
        hit_notes: Of each hit its note's place among the M.
        chokes: Cymbals that are gripped.
        handedness: Which hand leads.
    """

    hits: tuple[DrumHit, ...]
    hit_notes: tuple[int, ...]
    chokes: tuple[Choke, ...]
    handedness: Handedness


@dataclass(frozen=True, eq=False)
class DrumPart(PlayedPart):
    """A part as a drummer plays it."""

    fingering: DrumFingering

    @property
    def strokes(self) -> Strokes:
        """What is mimed."""
        return Strokes(self.fingering.hits, self.fingering.hit_notes)


def drum_fingering(played: PlayedPart) -> DrumFingering:
    """The fingering of a part that a drummer plays.

    Raises:
        TypeError: Another instrument plays it.
    """
    if not isinstance(played.fingering, DrumFingering):
        raise TypeError(f"a drummer plays what has been given hands and feet, not a {type(played.fingering)}")
    return played.fingering
