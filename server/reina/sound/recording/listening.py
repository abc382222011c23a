"""The program of a process that listens to one recording and tells what it hears in it."""

from __future__ import annotations

import contextlib
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reina.errors import InputError
from reina.sound.recording.mono import read_mono
from reina.system.logs import configure
from reina.system.own_process import bound_memory, end_with_parent, take_output, yield_to_server
from reina.system.parcel import receive, send

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

MAX_MEMORY_BYTES = 4_000_000_000
"""Address space, a good part of it libraries: an hour of sound at the rate that is listened to has 300 MB,
and to find the notes in fifteen minutes takes 1 GB."""


def listen(work: Callable[[NDArray[np.float32], int, Any, Callable[[float], None]], object]) -> int:
    """Hear one recording, as `python -m MODULE SONG`, for a server that has `ToldProcesses` start it.

    When standard input is closed, the one who asked is gone, and the process ends.

    Args:
        work: Given the recording's samples, one channel, their rate in hertz, what came on standard input,
            and what tells the share that is done, 0..1. What it returns, or the InputError that it raises, is
            the outcome.

    Returns:
        The exit status.
    """
    told = take_output()
    configure()
    yield_to_server()
    bound_memory(MAX_MEMORY_BYTES)
    try:
        asked = receive(sys.stdin.buffer)
    except EOFError:
        return 2
    threading.Thread(target=end_with_parent, daemon=True).start()
    try:
        samples, rate = read_mono(Path(sys.argv[1]).read_bytes())
        outcome = work(samples, rate, asked, lambda share: send(told, share))
    except InputError as error:
        send(told, error)
        return 0
    with contextlib.suppress(OSError):
        send(told, outcome)
    return 0
