"""JSON that is kept as it came, without being understood: held to what can be written again."""

import math
from collections.abc import Mapping
from typing import Any, cast

from reina.keyframes.place import Place, is_text
from reina.keyframes.value_types import value_items

DEEPEST = 16
"""Lists and objects within one another."""


def check_plain(value: object, place: Place, field: str) -> None:
    """Check that JSON can be written again, by anybody.

    Args:
        value: As it was read.
        place: Where it stands, for the error.
        field: Its field there.

    Raises:
        ShowError: It nests too deep, or holds a number that is not finite or a text that is none.
    """
    level: list[object] = [value]
    for _ in range(DEEPEST):
        below: list[object] = []
        for item in level:
            if isinstance(item, str) and not is_text(item):
                raise place.error("half a character (a lone surrogate) is no text", field)
            if isinstance(item, float) and not math.isfinite(item):
                raise place.error(f"{item} is no number of JSON", field)
            if isinstance(item, Mapping):
                fields = cast("Mapping[str, Any]", item)
                below.extend((*fields.keys(), *fields.values()))
            else:
                below.extend(value_items(item) or ())
        if not below:
            return
        level = below
    raise place.error(f"lists and objects stand within one another more than {DEEPEST} deep", field)
