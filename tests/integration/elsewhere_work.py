"""What workers of a cluster are given by the tests."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.system.elsewhere import CalledOffError

if TYPE_CHECKING:
    from collections.abc import Callable

    Tell = Callable[[float], None]


def doubled(number: int, tell: Tell) -> int:
    tell(0.5)
    return 2 * number


def refused(number: int, tell: Tell) -> int:
    raise InputError(f"{number} is no number")


def endless(called_off: str, tell: Tell) -> None:
    """Goes on until it is called off, which a file tells."""
    try:
        while True:
            tell(0.25)
            time.sleep(0.01)
    except CalledOffError:
        Path(called_off).write_text("called off")
        raise


def deadly(tell: Tell) -> None:
    os.kill(os.getpid(), signal.SIGKILL)
