"""Key signatures as files have them."""

from dataclasses import dataclass

MAX_ACCIDENTALS = 7


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
