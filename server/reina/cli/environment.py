"""Numbers and switches that the environment sets."""

from __future__ import annotations

import math
import os

from reina.errors import InputError

ON = ("1", "yes", "true", "on")
OFF = ("0", "no", "false", "off")


def whole_number(variable: str, default: int) -> int:
    """A whole number from 1 on.

    Raises:
        InputError: It is something else.
    """
    given = os.environ.get(variable, "").strip()
    if not given:
        return default
    if not (given.isascii() and given.isdecimal()) or int(given) < 1:
        raise InputError(f"{variable} is a whole number from 1 on, not {given!r}")
    return int(given)


def seconds(variable: str, default: float) -> float:
    """A length of time, seconds, above 0.

    Raises:
        InputError: It is something else.
    """
    given = os.environ.get(variable, "").strip()
    if not given:
        return default
    try:
        found = float(given)
    except ValueError:
        found = math.nan
    if not (0 < found < math.inf):
        raise InputError(f"{variable} is a number of seconds above 0, not {given!r}")
    return found


def switch(variable: str) -> bool | None:
    """A switch; None where it is not set.

    Raises:
        InputError: It is neither on nor off.
    """
    given = os.environ.get(variable, "").strip()
    if not given:
        return None
    if given.lower() not in (*ON, *OFF):
        raise InputError(f"{variable} is one of {', '.join((*ON, *OFF))}, not {given!r}")
    return given.lower() in ON
