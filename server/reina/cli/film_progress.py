"""How far a film is, on the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing import TextIO

PHASES = {
    "recording": "the score is put in time with the recording",
    "sound": "the sound is made",
    "stage": "the stage is set",
    "closing": "the file is closed",
}
TENTHS = 10
PLACES = 78
"""Of a line that is written over, columns."""


class FilmProgress:
    """One line that is written over on a terminal; elsewhere a line a tenth."""

    def __init__(self, out: TextIO) -> None:
        self._out = out
        self._terminal = out.isatty()
        self._said = ""
        self._tenth = -1

    def tell(self, phase: str, done: float, of: int, seconds_left: float | None) -> None:
        """Say how far it is.

        Args:
            phase: One of PHASES, or `pictures`.
            done: Of the sound, the share that is made; of the pictures, how many are drawn.
            of: How many pictures there are.
            seconds_left: None while that cannot be said.
        """
        if phase != "pictures":
            self._say(PHASES.get(phase, phase))
            return
        text = f"frame {done:.0f} of {of}, {100 * done / of:.0f} %"
        if seconds_left is not None and done < of:
            text += f", {length_of_time(seconds_left)} left"
        tenth = int(TENTHS * done / of)
        if self._terminal or tenth > self._tenth:
            self._tenth = tenth
            self._say(text)

    def _say(self, text: str) -> None:
        if text == self._said:
            return
        self._said = text
        if self._terminal:
            self._out.write(f"\r{text:<{PLACES}}")
        else:
            self._out.write(f"{text}\n")
        self._out.flush()

    def end(self) -> None:
        """Leave the line."""
        if self._terminal and self._said:
            self._out.write(f"\r{'':<{PLACES}}\r")
            self._out.flush()


def length_of_time(seconds: float) -> str:
    """A length of time as a clock shows it: `0:45`, `12:03`, `1:02:10`."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
