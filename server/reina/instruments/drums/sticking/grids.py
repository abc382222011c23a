"""How a bar is divided, and which hand then leads at a place."""

from __future__ import annotations

from typing import Final

import numpy as np

from reina.instruments.drums.sticking.habits import LEFT, RIGHT

EVEN_GRIDS: Final = (2.0, 1.0, 0.5, 0.25, 0.125, 1.0 / 6.0, 1.0 / 12.0)
"""Divisions in quarter notes that put the leading hand on each beat or each second one."""

UNEVEN_GRIDS: Final = (4.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0)
"""Divisions that do not."""

OFF: Final = 0.2
"""A gap is of a division if it is off by this part at most."""


def nearest_grid(gap: float) -> float | None:
    """The even division that a gap in quarter notes is of, or None."""
    if not 0.0 < gap < np.inf:
        return None
    grid = min((*EVEN_GRIDS, *UNEVEN_GRIDS), key=lambda grid: abs(np.log(gap / grid)))
    return grid if grid in EVEN_GRIDS and abs(gap - grid) <= OFF * grid else None


def wrong_hand(beat: float, grid: float) -> int | None:
    """The hand that does not lead at a place in the bar; None where it lies off the division."""
    place = beat / grid
    nearest = round(place)
    if abs(place - nearest) > 0.3:
        return None
    return RIGHT if nearest % 2 else LEFT
