"""How a bar is divided, and which hand then leads at a place."""

from __future__ import annotations

from typing import Final

from reina.instruments.drums.sticking.habits import LEFT, RIGHT

EVEN_GRIDS: Final = (2.0, 1.0, 0.5, 0.25, 0.125, 1.0 / 6.0, 1.0 / 12.0)
"""Divisions in quarter notes that put the leading hand on each beat or each second one."""


def nearest_grid(gap: float) -> float | None:
    """The even division that a gap in quarter notes is of, or None."""
    for grid in EVEN_GRIDS:
        if abs(gap - grid) <= 0.12 * grid:
            return grid
    return None


def wrong_hand(beat: float, grid: float) -> int | None:
    """The hand that does not lead at a place in the bar; None where it lies off the division."""
    place = beat / grid
    nearest = round(place)
    if abs(place - nearest) > 0.3:
        return None
    return RIGHT if nearest % 2 else LEFT
