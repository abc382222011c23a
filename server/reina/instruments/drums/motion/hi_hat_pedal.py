"""How far the hi-hat is closed, from what is struck on it and from its foot."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.hit import DrumHit
    from reina.rotations.arrays import FloatArray

OPEN, HALF, CLOSED = 0.0, 0.62, 1.0
LIFTED: Final = 0.35
"""How far the foot leaves it closed before it chicks."""

RELEASE_S: Final = 0.07
"""The pedal comes up before an open stroke, and is up at its onset."""

PRESS_S: Final = 0.045
"""The pedal goes down, and is down at the onset."""

CHICK_LIFT_S: Final = 0.11
"""What the foot needs to come up before a chick."""

SPLASH_S: Final = 0.05
"""After so long the foot is up again from a splash."""

IDLE_S: Final = 1.6
"""So long after an open stroke the foot closes the hi-hat, if nothing else is asked of it."""

CLOSE_S: Final = 0.25


def hi_hat_movements(hits: Sequence[DrumHit]) -> FloatArray:
    """Movements ``(start_s, end_s, value)`` of the pedal, as `MotionCurves` takes them: 0 open, 1 closed.

    Args:
        hits: By time; those of the hi-hat count, and of a chick or a splash those of the foot.
    """
    wanted: list[tuple[float, float, float]] = []  # done at, how far closed, how long it takes
    for hit in hits:
        if hit.piece != "hi_hat":
            continue
        if hit.limb.endswith("foot") or hit.technique in ("chick", "splash"):
            wanted.append((hit.onset_s - PRESS_S, LIFTED, CHICK_LIFT_S))
            wanted.append((hit.onset_s, CLOSED, PRESS_S))
            if hit.technique == "splash":
                wanted.append((hit.onset_s + SPLASH_S, OPEN, SPLASH_S))
        elif hit.technique == "open":
            wanted.append((hit.onset_s, OPEN, RELEASE_S))
        elif hit.technique == "half_open":
            wanted.append((hit.onset_s, HALF, RELEASE_S))
        else:
            wanted.append((hit.onset_s, CLOSED, PRESS_S))
    movements: list[tuple[float, float, float]] = []
    now, free_s = CLOSED, -np.inf
    for done_s, value, takes_s in sorted(wanted, key=lambda want: want[0]):
        if now < HALF and done_s - free_s > IDLE_S + CLOSE_S and movements:
            # Nobody holds the pedal up for ever.
            movements.append((free_s + IDLE_S, free_s + IDLE_S + CLOSE_S, CLOSED))
            now, free_s = CLOSED, free_s + IDLE_S + CLOSE_S
        if value == now:
            free_s = max(free_s, done_s)
            continue
        start_s = max(free_s, done_s - takes_s)
        if start_s >= done_s:
            continue
        movements.append((start_s, done_s, value))
        now, free_s = value, done_s
    if movements and now < HALF:
        movements.append((free_s + IDLE_S, free_s + IDLE_S + CLOSE_S, CLOSED))
    return np.array(movements, dtype=np.float64).reshape(-1, 3)
