"""Finds the notes of one recording, in a process that `transcriber` starts.

    python -m reina.sound.transcription.worker SONG

What is looked for and the title come on standard input, as `reina.system.parcel` sends them. On standard
output go numbers, the share that is done, and at the end the `Score` or the error that says why there is
none. When standard input is closed, the one who asked is gone, and the process ends.
"""

from __future__ import annotations

import contextlib
import sys
import threading
from pathlib import Path

from reina.errors import InputError
from reina.sound.recording.mono import read_mono
from reina.sound.transcription.transcribe import Line, transcribe
from reina.system.own_process import bound_memory, end_with_parent, take_output, yield_to_server
from reina.system.parcel import receive, send

MAX_MEMORY_BYTES = 4_000_000_000
"""Address space, a good part of it libraries: fifteen minutes of sound take 1 GB."""


def main() -> int:
    """Listen, and tell."""
    told = take_output()
    yield_to_server()
    bound_memory(MAX_MEMORY_BYTES)
    try:
        wanted: tuple[Line, str] = receive(sys.stdin.buffer)
    except EOFError:
        return 2
    threading.Thread(target=end_with_parent, daemon=True).start()
    line, title = wanted
    try:
        samples, rate = read_mono(Path(sys.argv[1]).read_bytes())
        found = transcribe(samples, rate, line, title=title, tell=lambda share: send(told, share))
    except InputError as error:
        send(told, error)
        return 0
    with contextlib.suppress(OSError):
        send(told, found)
    return 0


if __name__ == "__main__":
    sys.exit(main())
