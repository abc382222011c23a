"""How far a film is, on the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.cli.progress_line import ProgressLine, length_of_time

if TYPE_CHECKING:
    from typing import TextIO

PHASES = {
    "recording": "the score is put in time with the recording",
    "sound": "the sound is made",
    "stage": "the stage is set",
    "closing": "the file is closed",
}


class FilmProgress:
    """One line that is written over on a terminal; elsewhere a line a tenth."""

    def __init__(self, out: TextIO) -> None:
        self._line = ProgressLine(out)

    def tell(self, phase: str, done: float, of: int, seconds_left: float | None) -> None:
        """Say how far it is.

        Args:
            phase: One of PHASES, or `pictures`.
            done: Of the sound, the share that is made; of the pictures, how many are drawn.
            of: How many pictures there are.
            seconds_left: None while that cannot be said.
        """
        if phase != "pictures":
            self._line.say(PHASES.get(phase, phase))
            return
        text = f"frame {done:.0f} of {of}, {100 * done / of:.0f} %"
        if seconds_left is not None and done < of:
            text += f", {length_of_time(seconds_left)} left"
        self._line.tell(text, done / of)

    def end(self) -> None:
        """Leave the line."""
        self._line.end()
