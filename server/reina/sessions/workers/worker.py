"""Does one piece of work after another in a process of its own, started by `reina.sessions.workers.pool`.

On standard input come what both processes share, then functions with their arguments; on standard output
goes what each returned or raised. When standard input is closed the server is gone, and the process ends.
"""

from __future__ import annotations

import os
import queue
import sys
import threading
from typing import TYPE_CHECKING, Any, BinaryIO

from reina.errors import InputError
from reina.system.failure import ProcessFailure, failure_of
from reina.system.logs import configure
from reina.system.own_process import bound_memory, take_output, yield_to_server
from reina.system.parcel import receive, send

if TYPE_CHECKING:
    from collections.abc import Callable

MAX_MEMORY_BYTES = 4_000_000_000
"""Address space, a good part of it libraries."""


def main() -> int:
    """Work until the process is ended."""
    asked, told = sys.stdin.buffer, take_output()
    configure()
    yield_to_server()
    bound_memory(MAX_MEMORY_BYTES)
    shared: tuple[object, ...] = receive(asked)
    work: queue.SimpleQueue[tuple[Callable[..., Any], tuple[Any, ...]]] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(asked, shared, work), daemon=True).start()
    while True:
        function, arguments = work.get()
        outcome = _outcome(function, arguments)
        del function, arguments
        send(told, outcome, shared)
        del outcome


def _outcome(function: Callable[..., Any], arguments: tuple[Any, ...]) -> tuple[Any, Exception | None]:
    try:
        return function(*arguments), None
    except InputError as error:
        return None, error
    except MemoryError:
        most = MAX_MEMORY_BYTES / 1e9
        return None, InputError(f"reading it takes more than {most:g} GB of memory; make it smaller")
    except Exception as error:
        return None, ProcessFailure(failure_of(error))


def _listen(
    asked: BinaryIO,
    shared: tuple[object, ...],
    work: queue.SimpleQueue[tuple[Callable[..., Any], tuple[Any, ...]]],
) -> None:
    """Take work in while other work is done, so that the server's end is noticed at any time."""
    while True:
        try:
            work.put(receive(asked, shared))
        except EOFError:
            os._exit(2)


if __name__ == "__main__":
    sys.exit(main())
