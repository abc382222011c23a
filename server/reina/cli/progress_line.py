"""How far long work is, on the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing import TextIO

TENTHS = 10
PLACES = 78
"""Of a line that is written over, columns."""


class ProgressLine:
    """One line that is written over on a terminal; elsewhere a line a tenth.

    Args:
        out: Where to.
    """

    def __init__(self, out: TextIO) -> None:
        self._out = out
        self.on_terminal = out.isatty()
        """Whether it is written over."""
        self._said = ""
        self._tenth = -1

    def tell(self, text: str, share: float) -> None:
        """Say how far it is.

        Args:
            text: In words.
            share: How much is done, 0..1.
        """
        tenth = int(TENTHS * share)
        if self.on_terminal or tenth > self._tenth:
            self._tenth = tenth
            self.say(text)

    def say(self, text: str) -> None:
        """Say something else, wherever it goes."""
        if text == self._said:
            return
        self._said = text
        if self.on_terminal:
            self._out.write(f"\r{text:<{PLACES}}")
        else:
            self._out.write(f"{text}\n")
        self._out.flush()

    def end(self) -> None:
        """Leave the line; what is said next begins it anew."""
        if self.on_terminal and self._said:
            self._out.write(f"\r{'':<{PLACES}}\r")
            self._out.flush()
        self._said = ""


def length_of_time(seconds: float) -> str:
    """A length of time as a clock shows it: `0:45`, `12:03`, `1:02:10`."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
