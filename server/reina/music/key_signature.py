"""Key signatures as files have them."""

from dataclasses import dataclass, replace

MAX_ACCIDENTALS = 7


MOST_FIFTHS = 6
"""Sharps or flats of the simpler of two spellings, at most."""


@dataclass(frozen=True)
class KeySignature:
    """A key signature from a beat on.

    Attributes:
        onset_beats: Where it begins, quarter notes from the score's beginning.
        fifths: How many sharps it has; flats are negative: -3 is E♭ major or C minor. -7 to 7.
        is_minor: Whether the key is called a minor one.
    """

    onset_beats: float
    fifths: int
    is_minor: bool = False

    def moved(self, semitones: int) -> "KeySignature":
        """The same so many semitones higher, with six sharps or flats at most."""
        if semitones % 12 == 0:
            return self
        fifths = self.fifths + (7 * semitones + 5) % 12 - 5
        return replace(self, fifths=(fifths + 5) % 12 - 5 if abs(fifths) > MOST_FIFTHS else fifths)


def in_order(signatures: list[KeySignature]) -> tuple[KeySignature, ...]:
    """Return signatures by their beat; of several at one beat the first, and none that changes nothing."""
    kept: list[KeySignature] = []
    for signature in sorted(signatures, key=lambda one: one.onset_beats):
        if kept and kept[-1].onset_beats == signature.onset_beats:
            continue
        if kept and (kept[-1].fifths, kept[-1].is_minor) == (signature.fifths, signature.is_minor):
            continue
        kept.append(signature)
    return tuple(kept)
