"""Puts one recording in time with its score, in a process that `aligner_process` starts.

    python -m reina.sound.alignment.worker SONG

It is sent the score, and the outcome is the `Alignment` or the error that says why there is none.
"""

import sys

from reina.sound.alignment.aligner import align
from reina.sound.recording.listening import listen

if __name__ == "__main__":
    sys.exit(listen(align))
