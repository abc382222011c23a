"""The text of a BVH file, word by word: what a word is, which are numbers, and on which line each stands."""

from __future__ import annotations

import re
from typing import NoReturn

from reina.skeleton.errors import BvhError

LARGEST = 1e12
"""No length and no angle is larger; sums of so many stay finite, in 32 bits too."""
MAX_DIGITS = 100
MAX_LETTERS = 1000
_SHOWN = 60

# White space is ASCII's alone: what else Unicode and Python count as such stays part of a word.
_WORD = re.compile(r"\s*([{}:]|[^{}:\s]+)", re.ASCII)
_NAME = re.compile(r"\s*([^{}\n]*)", re.ASCII)
# What Python reads beside these (1_000, ², nan, inf) is no number of a BVH file.
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)

_MARKS = ((b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"), (b"H\0", "utf-16-le"), (b"\0H", "utf-16-be"))


def decoded(data: bytes) -> str:
    """A file's text: UTF-8, UTF-16 where it begins so, else Latin-1, which takes any byte."""
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return data.decode(encoding, "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def shown(text: str) -> str:
    """What stands in a file, quoted for a message, cut where it is long."""
    quoted = repr(text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…")
    # A character that cannot be printed takes up to ten.
    return quoted if len(quoted) <= 2 * _SHOWN else f"{quoted[: 2 * _SHOWN]}…"


class Tokens:
    """Words, braces and colons in order; `at` is where the next begins to be looked for."""

    def __init__(self, text: str) -> None:
        self.text = text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
        self.at = 0
        self._begin = 0

    def peek(self) -> str | None:
        """The next word as it is written, which stays the next; None at the end."""
        found = _WORD.match(self.text, self.at)
        return found[1] if found else None

    def next(self) -> str:
        """The next word as it is written.

        Raises:
            BvhError: The file ends here.
        """
        found = _WORD.match(self.text, self.at)
        if not found:
            raise BvhError("the file ends here, in the middle", location=self.line(len(self.text)))
        self._begin, self.at = found.start(1), found.end()
        return found[1]

    def name(self) -> str:
        """A name: what stands next, up to a brace or the line's end, spaces and colons in it included."""
        found = _NAME.match(self.text, self.at)
        if not found:
            return ""
        name = found[1].strip()
        self._begin, self.at = found.start(1), found.end()
        if len(name) > MAX_LETTERS:
            self.fail(f"a name of {len(name)} letters is longer than Reina reads, {MAX_LETTERS}")
        return name

    def brace(self, brace: str) -> None:
        """Go past a brace that has to stand here."""
        word = self.next()
        if word != brace:
            self.fail(f"here belongs {brace!r}, not {shown(word)}")

    def number(self) -> float:
        """The next word as a number."""
        return self.number_of(self.next(), self._begin)

    def number_of(self, word: str, at: int) -> float:
        """The number that a word at a place in the text is.

        Raises:
            BvhError: It is none, or one that no motion has.
        """
        if len(word) > MAX_DIGITS:
            self.fail(f"{shown(word)} has {len(word)} characters; a number has at most {MAX_DIGITS}", at)
        if not _NUMBER.fullmatch(word):
            comma = ": BVH has a point before decimals, and spaces between numbers" if "," in word else ""
            self.fail(f"{shown(word)} is no number{comma}", at)
        value = float(word)
        if abs(value) > LARGEST:
            self.fail(f"{word} is too large: numbers go up to {LARGEST:g}", at)
        return value

    @property
    def begin(self) -> int:
        """Where the word or name that was last given begins."""
        return self._begin

    def line(self, at: int | None = None) -> str:
        """``"line 7"``: that of a place in the text, of the last word where None."""
        return f"line {self.text.count(chr(10), 0, self._begin if at is None else at) + 1}"

    def fail(self, detail: str, at: int | None = None) -> NoReturn:
        """Refuse the file for what stands at a place, at the last word where None."""
        raise BvhError(detail, location=self.line(at))
