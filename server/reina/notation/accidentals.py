"""Which accidentals are printed: those that the signature and the bar so far do not say."""

from collections.abc import Mapping

from reina.notation.spelling import LETTERS, alteration, letter


class Accidentals:
    """The accidentals of a bar; made anew for each bar."""

    def __init__(self, fifths: int) -> None:
        self._signature = _signature(fifths)
        self._said: dict[tuple[str, int], int] = {}

    def printed(self, name: int, octave: int, *, tied_from: bool = False) -> int | None:
        """Return the accidental to be printed before a note: -1 ♭, 0 ♮, 1 ♯; None for none.

        Args:
            name: Its place on the line of fifths.
            octave: Of the name.
            tied_from: A tied note needs none and says nothing of the notes after it.
        """
        if tied_from:
            return None
        place, sign = (letter(name), octave), alteration(name)
        said = self._said.get(place, self._signature.get(place[0], 0))
        self._said[place] = sign
        return None if said == sign else sign


def _signature(fifths: int) -> Mapping[str, int]:
    if fifths >= 0:
        return dict.fromkeys(LETTERS[:fifths], 1)
    return dict.fromkeys(LETTERS[::-1][:-fifths], -1)
