"""JSON that is kept as it came, without being understood: held to what can be written again."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, cast

from reina.curves.shown import shown
from reina.show.model import is_text

DEEPEST = 16
"""Lists and objects within one another."""


def check_plain(value: object) -> None:
    """Check that JSON can be written again, by anybody.

    Args:
        value: As it was read.

    Raises:
        ValueError: It nests too deep, or holds a number that cannot be written or a text that is none.
    """
    level: list[object] = [value]
    for _ in range(DEEPEST):
        below: list[object] = []
        for item in level:
            if isinstance(item, str) and not is_text(item):
                raise ValueError("half a character (a lone surrogate) is no text")
            if isinstance(item, int) and not -(2**63) <= item < 2**64:
                raise ValueError(f"{shown(item)} is too large a number")
            if isinstance(item, float) and not math.isfinite(item):
                raise ValueError(f"{item} is no number of JSON")
            if isinstance(item, Mapping):
                fields = cast("Mapping[str, Any]", item)
                below.extend((*fields.keys(), *fields.values()))
            elif isinstance(item, list | tuple):
                below.extend(cast("Sequence[object]", item))
        if not below:
            return
        level = below
    raise ValueError(f"lists and objects stand within one another more than {DEEPEST} deep")
