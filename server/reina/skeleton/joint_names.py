"""Joints of one name told apart."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence


def told_apart(names: Sequence[str]) -> tuple[tuple[str, ...], dict[str, list[int]]]:
    """Names that all differ: of joints of one name the later get a number, ``Nub.001``, as in Blender.

    Returns:
        The names, and for each that came more than once the places of those that were numbered.
    """
    taken = set(names)
    numbers: dict[str, int] = {}
    numbered: defaultdict[str, list[int]] = defaultdict(list)
    apart: list[str] = []
    for place, name in enumerate(names):
        free = name
        if name in numbers:
            while free in taken:
                numbers[name] += 1
                free = f"{name}.{numbers[name]:03d}"
            taken.add(free)
            numbered[name].append(place)
        else:
            numbers[name] = 0
        apart.append(free)
    return tuple(apart), dict(numbered)
