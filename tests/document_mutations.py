"""JSON documents made worse at random: values made odd, put elsewhere, taken out, doubled, renamed."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    import random
    from collections.abc import Callable, Iterator

MAX_PLACES = 5_000
"""A document of more places is not made larger."""


def _nested(depth: int) -> Any:
    value: Any = 1
    for _ in range(depth):
        value = [value]
    return value


ODD: tuple[Any, ...] = (
    *(None, True, False, 0, 1, -1, -0.0, 0.5, 1e308, -1e308, 1e-320, 1e12, 2**63, 10**400),
    *(math.nan, math.inf, -math.inf, "", "0", "1e999", "C4", "#12345G", "\ud800", "\0", "x/y", "9" * 300),
    *([], {}, [[]], [None], {"": {}}, _nested(50)),
)  # fmt: skip

Place = tuple[Any, Any]
"""A list or an object, and the index or the name of one of its values."""


def _places(container: Any) -> Iterator[Place]:
    """Every place of a document, without recursion."""
    waiting: list[Any] = [container]
    while waiting:
        at = waiting.pop()
        values = cast(
            "dict[Any, Any]", at if isinstance(at, dict) else dict(enumerate(cast("list[Any]", at)))
        )
        for key, value in values.items():
            yield at, key
            if isinstance(value, dict | list):
                waiting.append(value)


def _copy(value: Any) -> Any:
    return json.loads(json.dumps(value))


def _make_odd(place: Place, _: list[Place], rng: random.Random) -> None:
    place[0][place[1]] = _copy(rng.choice(ODD))


def _put_another(place: Place, places: list[Place], rng: random.Random) -> None:
    """Put a value of the document in the place of another one."""
    container, key = rng.choice(places)
    place[0][place[1]] = _copy(container[key])


def _remove(place: Place, _: list[Place], __: random.Random) -> None:
    del place[0][place[1]]


def _repeat(place: Place, _: list[Place], rng: random.Random) -> None:
    container, key = place
    if isinstance(container, list):
        container[key:key] = [_copy(container[key]) for _ in range(rng.randint(1, 3))]


def _rename(place: Place, places: list[Place], rng: random.Random) -> None:
    """Give a field the name of another one."""
    container, key = place
    names = [name for _, name in places if isinstance(name, str)]
    if isinstance(key, str):
        container[rng.choice(names)] = container.pop(key)


def _move(place: Place, _: list[Place], rng: random.Random) -> None:
    """Make a number a little or much larger or smaller."""
    container, key = place
    value = container[key]
    if isinstance(value, int | float) and abs(value) < 1e300:
        container[key] = rng.choice((-value, value + 1, value * 2, value * 1e6, value * 1e-6, value + 1e-9))


CHANGES: tuple[Callable[[Place, list[Place], random.Random], None], ...] = (
    _make_odd, _make_odd, _put_another, _remove, _repeat, _rename, _move, _move,
)  # fmt: skip


def mutate_document(data: bytes, rng: random.Random) -> bytes | None:
    """A document with one change or more; None where the bytes are no JSON."""
    try:
        document: list[Any] = [json.loads(data)]
    except (ValueError, RecursionError):
        return None
    for _ in range(1 + int(rng.expovariate(0.5))):
        places = list(_places(document))
        if not 0 < len(places) <= MAX_PLACES:
            break
        rng.choice(CHANGES)(rng.choice(places), places, rng)
    return json.dumps(document[0] if document else None).encode()
