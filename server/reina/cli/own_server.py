"""A server of the command's own, for as long as it needs one."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from contextlib import contextmanager
from typing import TYPE_CHECKING

from reina.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Generator

ENDING_S = 10


@contextmanager
def own_server() -> Generator[str]:
    """Start a server on a free port with a data directory that is removed at the end; gives its address.

    Raises:
        InputError: It does not start.
    """
    with tempfile.TemporaryDirectory(prefix="reina-") as data_dir, tempfile.TemporaryFile("w+") as said:
        command = [sys.executable, "-P", "-m", "reina", "serve", "--port", "0", "--data-dir", data_dir]
        process = subprocess.Popen(  # noqa: S603 - this very program
            command,
            stdout=subprocess.PIPE,
            stderr=said,
            text=True,
            # Ctrl-C is this command's to take: it ends the server when it is done with it.
            start_new_session=True,
        )
        try:
            address = process.stdout.readline().strip() if process.stdout is not None else ""
            if not address.startswith("http"):
                process.wait(ENDING_S)
                said.seek(0)
                raise InputError(f"no server could be started: {_reason(said.read())}")
            yield address
        finally:
            process.terminate()
            try:
                process.wait(ENDING_S)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            if process.stdout is not None:
                process.stdout.close()


def _reason(said: str) -> str:
    lines = said.strip().splitlines()
    return lines[-1].removeprefix("reina serve: ") if lines else "it said nothing"
