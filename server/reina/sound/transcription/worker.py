"""Finds the notes of one recording, in a process that `transcriber` starts.

    python -m reina.sound.transcription.worker SONG

It is sent what is looked for and the title, and the outcome is the `Score` or the error that says why there
is none.
"""

import sys
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from reina.music import Score
from reina.sound.recording.listening import listen
from reina.sound.transcription.transcribe import Line, transcribe


def find_notes(
    samples: NDArray[np.float32], rate: int, wanted: tuple[Line, str], tell: Callable[[float], None]
) -> Score:
    """`transcribe` as `listen` calls it."""
    line, title = wanted
    return transcribe(samples, rate, line, title=title, tell=tell)


if __name__ == "__main__":
    sys.exit(listen(find_notes))
