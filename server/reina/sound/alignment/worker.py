"""Puts one recording in time with its score, in a process that `aligner_process` starts.

    python -m reina.sound.alignment.worker SONG

It is sent the score, and the outcome is the `Alignment` or the error that says why there is none.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from reina.sound.alignment.aligner import align
from reina.sound.recording.listening import listen
from reina.sound.recording.mono import read_mono

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.music import Score
    from reina.sound.alignment.alignment import Alignment


def align_recording(song: bytes, score: Score, tell: Callable[[float], None]) -> Alignment:
    """The same on a cluster's worker.

    Args:
        song: The recording's file.
        score: What is played in it.
        tell: Called with the share that is done, 0..1.

    Raises:
        InputError: The recording cannot be decoded.
    """
    samples, rate = read_mono(song)
    return align(samples, rate, score, tell)


if __name__ == "__main__":
    sys.exit(listen(align))
