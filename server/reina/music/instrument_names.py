"""What instruments are called in many languages, and the General MIDI program of each."""

import re
import tomllib
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

LONG_ENOUGH = 6
"""Names of so many letters are recognised within a word; shorter ones where a word begins."""

_WORD = re.compile(r"[^\W\d_]+")
_WITHOUT_SPACES = re.compile(r"[\u0e00-\u0e7f\u3040-\u30ff\u3400-\u9fff\uac00-\ud7a3]")


@dataclass(frozen=True)
class InstrumentNames:
    """One instrument's names.

    Attributes:
        program: Its General MIDI program, counted from 0, or None.
        sought: What is sought in the `_spaced` text of a part's name.
    """

    program: int | None
    sought: tuple[str, ...]


@cache
def spellings() -> Mapping[str, tuple[str, ...]]:
    """Return for each instrument its names as instrument_names.toml writes them."""
    return {
        instrument: tuple(name.strip() for name in row["names"].split(","))
        for instrument, row in _rows().items()
    }


def instruments_of_name(name: str) -> tuple[str, ...]:
    """Return which instruments a part's name speaks of, in the order of instrument_names.toml."""
    text = _spaced(name)
    return tuple(
        instrument
        for instrument, row in _instruments().items()
        if any(sought in text for sought in row.sought)
    )


def program_of_name(name: str) -> int | None:
    """Return the General MIDI program, counted from 0, of the instrument that a part's name speaks of."""
    programs = (_instruments()[instrument].program for instrument in instruments_of_name(name))
    return next((program for program in programs if program is not None), None)


def plain(text: str) -> str:
    """Return `text` without case and accents, half-width and full-width letters made alike."""
    text = unicodedata.normalize("NFKC", text).casefold()
    letters = unicodedata.normalize("NFKD", text.translate(_BASE_LETTERS))
    kept = "".join(
        letter for letter in letters if not (unicodedata.combining(letter) and ord(letter) < 0x370)
    )
    return unicodedata.normalize("NFC", kept)


_BASE_LETTERS = str.maketrans({"ł": "l", "ß": "ss", "đ": "d", "ø": "o", "æ": "ae", "œ": "oe", "ı": "i"})
"""Letters that Unicode does not decompose."""


def _spaced(text: str) -> str:
    """Return the words of `text`, plain, each between spaces."""
    return f" {' '.join(_WORD.findall(plain(text)))} "


def _sought(name: str) -> str:
    words = _spaced(name)
    if name.endswith("."):
        return words
    anywhere = len(words.strip()) >= LONG_ENOUGH or _WITHOUT_SPACES.search(name)
    return words.strip() if anywhere else words[:-1]


@cache
def _rows() -> Mapping[str, Mapping[str, str]]:
    text = resources.files("reina.music").joinpath("instrument_names.toml").read_text("utf-8")
    return tomllib.loads(text)


@cache
def _instruments() -> Mapping[str, InstrumentNames]:
    rows = _rows()
    return {
        instrument: InstrumentNames(
            int(rows[instrument]["program"]) if "program" in rows[instrument] else None,
            tuple(dict.fromkeys(map(_sought, names))),
        )
        for instrument, names in spellings().items()
    }
