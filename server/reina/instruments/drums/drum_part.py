"""A part as a drummer plays it: how each note is struck, and the hits that are mimed."""

from dataclasses import dataclass, replace
from typing import Literal

from reina.instruments.coded_column import coded
from reina.instruments.drums.hit import MIRRORED, DrumHit, Hand
from reina.instruments.note_fingerings import NoteFingering, StrikeFingering
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

    def mirrored(self) -> "DrumFingering":
        """Return it as who leads with the other hand does it: limbs change sides, pieces keep their names."""
        return replace(
            self,
            notes=coded(_mirrored(note) for note in self.notes),
            reasons=coded(_mirror_words(reason) for reason in self.reasons),
            hits=tuple(replace(hit, limb=MIRRORED[hit.limb]) for hit in self.hits),
            chokes=tuple(choke.mirrored() for choke in self.chokes),
            handedness="right" if self.handedness == "left" else "left",
        )


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


def mirrored_part(played: PlayedPart) -> PlayedPart:
    """A drummer's part as who leads with the other hand plays it.

    Raises:
        TypeError: Another instrument plays it.
    """
    return replace(played, fingering=drum_fingering(played).mirrored())


_OTHER: dict[Handedness, Handedness] = {"left": "right", "right": "left"}


def _mirrored(note: NoteFingering | None) -> NoteFingering | None:
    if not isinstance(note, StrikeFingering):
        return note
    return StrikeFingering(
        hand=None if note.hand is None else _OTHER[note.hand],
        foot=None if note.foot is None else _OTHER[note.foot],
        piece=note.piece,
        zone=note.zone,
    )


def _mirror_words(reason: str) -> str:
    """A reason of the other hand's: right and left change places, but those of the crashes' names."""
    kept = reason.replace("left crash", "\0").replace("right crash", "\1")
    kept = kept.replace("right", "\2").replace("left", "right").replace("\2", "left")
    return kept.replace("\0", "left crash").replace("\1", "right crash")
