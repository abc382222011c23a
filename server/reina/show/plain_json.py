"""JSON that is kept as it came, without being understood: held to what can be written again."""

import math
from collections.abc import Mapping
from typing import Any, cast

from reina.curves.value_types import value_items
from reina.show.location import Location, is_text

DEEPEST = 16
"""Lists and objects within one another."""


def check_plain(value: object, location: Location, field: str) -> None:
    """Check that JSON can be written again, by anybody.

    Args:
        value: As it was read.
        location: Where it stands, for the error.
        field: Its field there.

    Raises:
        ShowError: It nests too deep, or holds a number that is not finite or a text that is none.
    """
    level: list[object] = [value]
    for _ in range(DEEPEST):
        below: list[object] = []
        for item in level:
            if isinstance(item, str) and not is_text(item):
                raise location.error("half a character (a lone surrogate) is no text", field)
            if isinstance(item, float) and not math.isfinite(item):
                raise location.error(f"{item} is no number of JSON", field)
            if isinstance(item, Mapping):
                fields = cast("Mapping[str, Any]", item)
                below.extend((*fields.keys(), *fields.values()))
            else:
                below.extend(value_items(item) or ())
        if not below:
            return
        level = below
    raise location.error(f"lists and objects stand within one another more than {DEEPEST} deep", field)
