"""Puts one recording in time with its score, in a process that `aligner_process` starts.

    python -m reina.sound.alignment.worker SONG

The score comes on standard input, as `reina.system.parcel` sends it. On standard output go numbers, the share
that is done, and at the end the `Alignment` or the error that says why there is none. When standard input is
closed, the one who asked is gone, and the process ends.
"""

from __future__ import annotations

import contextlib
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.sound.alignment.aligner import align
from reina.sound.recording.mono import read_mono
from reina.system.own_process import bound_memory, end_with_parent, take_output, yield_to_server
from reina.system.parcel import receive, send

if TYPE_CHECKING:
    from reina.music import Score

MAX_MEMORY_BYTES = 4_000_000_000
"""Address space, a good part of it libraries: an hour of sound at the rate that is listened to has 300 MB."""


def main() -> int:
    """Align, and tell."""
    told = take_output()
    yield_to_server()
    bound_memory(MAX_MEMORY_BYTES)
    try:
        score: Score = receive(sys.stdin.buffer)
    except EOFError:
        return 2
    threading.Thread(target=end_with_parent, daemon=True).start()
    try:
        samples, rate = read_mono(Path(sys.argv[1]).read_bytes())
        found = align(samples, rate, score, lambda share: send(told, share))
    except InputError as error:
        send(told, error)
        return 0
    with contextlib.suppress(OSError):
        send(told, found)
    return 0


if __name__ == "__main__":
    sys.exit(main())
