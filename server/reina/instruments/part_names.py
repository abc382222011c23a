"""What a part's name says of its instrument."""

import re
import tomllib
import unicodedata
from collections.abc import Mapping
from functools import cache
from importlib import resources

_WORD = re.compile(r"[a-z]+")


@cache
def _kinds() -> Mapping[str, Mapping[str, tuple[str, ...]]]:
    text = resources.files("reina.instruments").joinpath("part_names.toml").read_text("utf-8")
    return {
        kind: {way: tuple(names) for way, names in ways.items()} for kind, ways in tomllib.loads(text).items()
    }


def plain(text: str) -> str:
    """Return `text` without case and accents, half-width and full-width letters made alike."""
    text = unicodedata.normalize("NFKC", text).casefold()
    letters = unicodedata.normalize("NFKD", text.replace("ł", "l").replace("ß", "ss"))
    kept = "".join(
        letter for letter in letters if not (unicodedata.combining(letter) and ord(letter) < 0x370)
    )
    return unicodedata.normalize("NFC", kept)


def kinds_of_name(name: str) -> frozenset[str]:
    """Return which of the kinds in part_names.toml a part's name speaks of."""
    text = plain(name)
    words = _WORD.findall(text)

    def speaks_of(ways: Mapping[str, tuple[str, ...]]) -> bool:
        return (
            any(word.startswith(ways["words"]) for word in words)
            or any(word in ways["tokens"] for word in words)
            or any(characters in text for characters in ways["characters"])
        )

    return frozenset(kind for kind, ways in _kinds().items() if speaks_of(ways))


_DESK = re.compile(r"(?<![0-9])(?:no\.?\s*)?([1-9])(?![0-9])|\b(i{1,3}|iv)\b")
_ROMAN = {"i": 1, "ii": 2, "iii": 3, "iv": 4}


def desk_of_name(name: str) -> int | None:
    """Return which of several a part is: 2 for ``"Trumpet 2"`` and ``"Tromba II"``; else None."""
    match = _DESK.search(plain(name))
    if match is None:
        return None
    digit, roman = match.groups()
    return int(digit) if digit else _ROMAN[roman]
