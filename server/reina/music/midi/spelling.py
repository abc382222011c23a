"""Whether letters beyond ASCII stand in a word as they do in languages."""

import unicodedata
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

OTHER_SCRIPT = -5.0
"""Beside a letter of another script."""
CAPITAL_WITHIN, CAPITAL_FIRST, CAPITALS = -7.0, -1.0, -0.3
"""A capital after a small letter, at a word's beginning, after a capital."""
SMALL_FIRST = -2.5
"""A text that begins with a small Greek or Cyrillic letter."""
SIGN_WITHIN, NOTHING_OPENED, NOT_CLOSED = -3.0, -3.0, -3.0
"""A sign between two letters; one that opens before no letter; one that closes before a letter."""
ALONE = -2.5
"""A Latin letter that is a whole word, which few are."""
ALTERNATING, LIKE, ALL_LIKE = 0.25, -0.5, -1.8
"""Vowel beside consonant; vowel beside vowel; a Latin letter between two of its own kind."""
FINAL_LAST, FINAL_WITHIN, NOT_FINAL = 1.5, -4.0, -3.0
"""A Hebrew letter or sigma in its final form at a word's end, and within; at the end in its other form."""
NEVER_FIRST = -4.0
"""A Cyrillic sign or ы at a word's beginning."""

VOWELS = frozenset("aeiouyæœøıаеёиоуыэюяіїєъαεηιουω")
FINALS, NOT_FINALS = frozenset("ךםןףץς"), frozenset("כמנפצσ")
NOT_AT_FIRST = frozenset("ьъы")
OPENING, CLOSING = frozenset("¡¿„"), frozenset("…™")
JOINING = frozenset("’·\xa0ºª")
CASED = frozenset({"LATIN", "CYRILLIC", "GREEK"})


@dataclass(frozen=True)
class Sort:
    """What is asked of a character."""

    script: str = ""
    is_vowel: bool = False
    is_capital: bool = False
    is_ascii: bool = True
    is_final: bool = False
    has_final: bool = False
    is_never_first: bool = False
    opens: bool = False
    closes: bool = False
    is_start: bool = False


START, END = Sort(is_start=True), Sort()


def spelling_likelihood(texts: Iterable[str]) -> float:
    """Return the logarithm of how likely the neighbours of each letter beyond ASCII are, up to a constant."""
    neighbours: Counter[tuple[Sort, Sort, Sort]] = Counter()
    for text in texts:
        sorts = [START, *map(_sort, text), END]
        neighbours.update(zip(sorts, sorts[1:], sorts[2:], strict=False))
    return sum(
        count * _cost(before, this, after)
        for (before, this, after), count in neighbours.items()
        if not this.is_ascii
    )


@lru_cache(1024)
def _sort(character: str) -> Sort:
    if not character.isalpha() or character in JOINING:
        return Sort(
            is_ascii=character < "\x80" or character in JOINING,
            opens=character in OPENING,
            closes=character in CLOSING,
        )
    script = unicodedata.name(character, "").split(" ")[0]
    return Sort(
        script,
        unicodedata.normalize("NFD", character.lower())[0] in VOWELS,
        character.isupper(),
        character < "\x80",
        character in FINALS,
        character in NOT_FINALS,
        character in NOT_AT_FIRST,
    )


def _cost(before: Sort, this: Sort, after: Sort) -> float:
    if not this.script:
        return _cost_of_sign(before, this, after)
    beside = [sort for sort in (before, after) if sort.script]
    cost = sum(OTHER_SCRIPT for sort in beside if sort.script != this.script)
    if this.is_final:
        cost += FINAL_WITHIN if after.script else FINAL_LAST
    elif this.has_final and not after.script:
        cost += NOT_FINAL
    elif this.is_never_first and not before.script:
        cost += NEVER_FIRST
    if this.script not in CASED:
        return cost
    cost += _case(before, this, after)
    like = [sort for sort in beside if sort.is_vowel == this.is_vowel]
    if this.script == "LATIN" and len(beside) != 1 and len(like) == len(beside):
        return cost + (ALL_LIKE if like else ALONE)
    return cost + ALTERNATING * (len(beside) - len(like)) + (LIKE * len(like) if this.is_vowel else 0.0)


def _cost_of_sign(before: Sort, this: Sort, after: Sort) -> float:
    cost = SIGN_WITHIN if before.script and after.script else 0.0
    cost += NOTHING_OPENED if this.opens and not after.script else 0.0
    return cost + (NOT_CLOSED if this.closes and after.script else 0.0)


def _case(before: Sort, this: Sort, after: Sort) -> float:
    if this.is_capital:
        is_within_capitals = before.is_capital and not (after.script and not after.is_capital)
        within = CAPITALS if is_within_capitals else CAPITAL_WITHIN
        return within if before.script else CAPITAL_FIRST
    if before.is_start and this.script != "LATIN":
        return SMALL_FIRST
    return CAPITAL_WITHIN if after.is_capital and after.is_ascii else 0.0
