"""What a part's name says of its instrument."""

import re

from reina.music.instrument_names import instruments_of_name, plain

KINDS = {
    "trumpet": "trumpet",
    "piccolo trumpet": "trumpet",
    "cornet": "cornet",
    "flugelhorn": "flugelhorn",
    "euphonium": "euphonium",
    "tuba": "tuba",
    "brass": "brass",
    "melody": "melody",
    "vocals": "melody",
}
"""Kinds of parts that an instrument may weigh (`Suitability.names`), by the row of instrument_names.toml."""


def kinds_of_name(name: str) -> frozenset[str]:
    """Return which of `KINDS` a part's name speaks of, ``"other"`` for any other instrument."""
    return frozenset(KINDS.get(instrument, "other") for instrument in instruments_of_name(name))


_DESK = re.compile(r"(?<![0-9])(?:no\.?\s*)?([1-9])(?![0-9])|\b(i{1,3}|iv)\b")
_ROMAN = {"i": 1, "ii": 2, "iii": 3, "iv": 4}


def desk_of_name(name: str) -> int | None:
    """Return which of several a part is: 2 for ``"Trumpet 2"`` and ``"Tromba II"``; else None."""
    match = _DESK.search(plain(name))
    if match is None:
        return None
    digit, roman = match.groups()
    return int(digit) if digit else _ROMAN[roman]
