"""How likely a text is in each of the languages that names in MIDI files are written in."""

import math
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

REPLACED = "\ufffd"

DOUBLE_BYTE: Mapping[str, tuple[tuple[range, int, float], ...]] = {
    "cp932": (
        (range(0x81, 0x82), 0x40, -8.0),  # punctuation
        (range(0x82, 0x83), 0x9F, -5.4),  # hiragana
        (range(0x82, 0x83), 0x40, -8.0),  # wide letters and digits
        (range(0x83, 0x84), 0x40, -5.4),  # katakana
        (range(0x88, 0x98), 0x40, -11.0),  # kanji of level 1
        (range(0x98, 0xEB), 0x40, -14.0),  # kanji of level 2
    ),
    "gb18030": (
        (range(0xA1, 0xA2), 0xA1, -8.0),  # punctuation
        (range(0xA3, 0xA4), 0xA1, -8.0),  # wide letters and digits
        (range(0xB0, 0xD8), 0xA1, -9.7),  # GB 2312, level 1
        (range(0xD8, 0xF8), 0xA1, -12.8),  # GB 2312, level 2
    ),
    "cp950": (
        (range(0xA1, 0xA2), 0x40, -8.0),  # punctuation
        (range(0xA2, 0xA4), 0x40, -10.0),  # symbols, wide letters
        (range(0xA4, 0xC7), 0x40, -10.0),  # level 1
        (range(0xC9, 0xFA), 0x40, -13.5),  # level 2
    ),
    "cp949": (
        (range(0xA1, 0xA2), 0xA1, -9.0),  # punctuation
        (range(0xA3, 0xA4), 0xA1, -8.0),  # wide letters and digits
        (range(0xB0, 0xC9), 0xA1, -9.7),  # hangul of KS X 1001
        (range(0xCA, 0xFE), 0xA1, -14.7),  # hanja
    ),
}
"""The double-byte sets: by lead byte, from a trail byte on, the log-probability of each character that is not
among the commonest of its language; the first row that fits counts."""

NO_ROW, NOT_ENCODED = -17.0, -30.0
COMMON_SHARE = {"cp932": 0.35, "gb18030": 0.75, "cp950": 0.75, "cp949": 0.75}
"""How much of a text the commonest characters make; of a Japanese one kana make as much."""

PRIOR = {"cp1252": 1.0, "mac_roman": -1.5}
"""Files of Western Europe are the commonest, those of old Macs rarer."""

HALF_WIDTH = range(0xFF61, 0xFFA0)
HALF_WIDTH_PRIOR = -6.0

LATIN_LETTER, LATIN_FOREIGN, LATIN_SHARE = -3.2, -6.0, 0.08
"""Log-probability of an ASCII letter, of one foreign to the language; the share of letters beyond ASCII."""

OTHER_ALPHABET_LETTER = -6.0
"""Log-probability of an ASCII letter in a Greek, Cyrillic or Hebrew text."""

DOUBLE_BYTE_LETTER = -5.0
SPACE, DIGIT, SIGN, CONTROL = -2.5, -5.0, -6.0, -4.0
TYPOGRAPHY = {"–": -4.5} | dict.fromkeys("«»„“”…©", -5.5) | dict.fromkeys("‘’—°ºª®", -7.0)
STRANGE_LETTER, STRANGE_SIGN = -9.5, -10.0
WORD = 3.0
"""What a word of the language adds."""


@dataclass(frozen=True)
class Language:
    """A language in one character set.

    Attributes:
        encoding: The character set, by Python's name.
        prior: Logarithm of how common such files are, up to a constant.
        characters: Log-probability of its own characters and of ASCII.
        words, beginnings, endings: Lower-case words of the language, and parts of words.
    """

    encoding: str
    prior: float
    characters: Mapping[str, float]
    words: frozenset[str] = frozenset()
    beginnings: tuple[str, ...] = ()
    endings: tuple[str, ...] = ()

    def likelihood(self, counts: Mapping[str, int], words: Iterable[str]) -> float:
        """Return the log-likelihood of a text.

        Args:
            counts: How often each character occurs.
            words: Its words with letters beyond ASCII, in lower case, each once.
        """
        total = self.prior + WORD * sum(map(self._knows, words))
        for character, count in counts.items():
            probability = self.characters.get(character)
            total += count * (self._of_others(character) if probability is None else probability)
        return total

    def _knows(self, word: str) -> bool:
        return word in self.words or word.startswith(self.beginnings) or word.endswith(self.endings)

    def _of_others(self, character: str) -> float:
        if character == REPLACED:
            return NOT_ENCODED
        if character < " ":
            return CONTROL
        if self.encoding not in DOUBLE_BYTE:
            return STRANGE_LETTER if character.isalpha() else STRANGE_SIGN
        try:
            code = character.encode(self.encoding)
        except UnicodeEncodeError:
            return NOT_ENCODED
        if len(code) != 2:
            return STRANGE_LETTER if len(code) == 1 else NOT_ENCODED
        rows = DOUBLE_BYTE[self.encoding]
        return next((p for leads, trail, p in rows if code[0] in leads and code[1] >= trail), NO_ROW)


@cache
def languages() -> Mapping[str, tuple[Language, ...]]:
    """Return the languages of languages.toml for each character set."""
    text = resources.files("reina.music.midi").joinpath("languages.toml").read_text("utf-8")
    found: dict[str, list[Language]] = {}
    for row in tomllib.loads(text).values():
        for encoding in row["encodings"]:
            made = _double_byte(encoding, row["common"]) if "common" in row else _single_byte(encoding, row)
            found.setdefault(encoding, []).append(made)
    return {encoding: tuple(of_encoding) for encoding, of_encoding in found.items()}


def _ascii(letter: float) -> dict[str, float]:
    characters = {chr(code): SIGN for code in range(0x21, 0x7F)}
    return (
        characters | {c: letter if c.isalpha() else DIGIT for c in characters if c.isalnum()} | {" ": SPACE}
    )


def _double_byte(encoding: str, common: str) -> Language:
    characters = set("".join(common.split()))
    half_width = all(ord(character) in HALF_WIDTH for character in characters)
    share = 0.9 if half_width else COMMON_SHARE[encoding]
    known = dict.fromkeys(characters, math.log(share / len(characters)))
    return Language(encoding, HALF_WIDTH_PRIOR if half_width else 0.0, _ascii(DOUBLE_BYTE_LETTER) | known)


def _single_byte(encoding: str, row: Mapping[str, str]) -> Language:
    letters = row["letters"]
    is_latin = "words" in row
    known = _ascii(LATIN_LETTER if is_latin else OTHER_ALPHABET_LETTER)
    known |= TYPOGRAPHY
    for letter in row.get("foreign", ""):
        known[letter] = known[letter.upper()] = LATIN_FOREIGN
    weights = [1 / (rank + (2 if is_latin else 8)) for rank in range(len(letters))]
    scale = (LATIN_SHARE if is_latin else 0.95) / sum(weights)
    for letter, weight in zip(letters, weights, strict=True):
        known[letter] = math.log(weight * scale)
        if len(letter.upper()) == 1:
            known.setdefault(letter.upper(), known[letter])
    words = [word.strip() for word in row.get("words", "").split(",")] if is_latin else []
    return Language(
        encoding,
        PRIOR.get(encoding, 0.0),
        known,
        frozenset(word for word in words if "-" not in word),
        tuple(word[:-1] for word in words if word.endswith("-")),
        tuple(word[1:] for word in words if word.startswith("-")),
    )
