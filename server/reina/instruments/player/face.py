"""How playing looks on a face: a table from signals to morph weights."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.curves import Parameter
from reina.rotations import product

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray
    from reina.skeleton import Rig

SIGNALS: tuple[str, ...] = ("raised", "air", "effort", "inhale", "tongue", "cheeks", "content", "blink")
"""The rows of the table. ``cheeks`` is the air behind them; ``content`` is 1 when the horn is down."""

WEIGHTS: dict[str, dict[str, float]] = {
    "face/blink_left": {"blink": 1.0},
    "face/blink_right": {"blink": 1.0},
    "face/cheek_puff": {"cheeks": 0.12},
    "face/mouth_pucker": {"raised": 0.30, "air": 0.08, "inhale": -0.25},
    "face/mouth_press": {"raised": 0.20, "air": 0.30, "effort": 0.20, "inhale": -0.20, "tongue": 0.12},
    "face/jaw_open": {"inhale": 0.14},
    "face/brow_up": {"inhale": 0.18, "effort": 0.22, "air": 0.05},
    "face/smile": {"inhale": 0.10, "content": 0.16},
}
"""Morph parameter -> signal -> weight; the sum is kept within 0..1."""


class Face:
    """The morphs of a rig.

    Args:
        rig: Its morphs; those that the table does not know stay at 0.
    """

    def __init__(self, rig: Rig) -> None:
        paths = tuple(morph.parameter for morph in rig.morphs)
        self.parameters: tuple[Parameter, ...] = tuple(
            Parameter(
                path=path,
                type="number",
                default=0.0,
                minimum=0.0,
                maximum=1.0,
                documentation=f"Weight of the face's morph {path.removeprefix('face/').replace('_', ' ')}.",
            )
            for path in paths
        )
        self._weights: FloatArray = np.array(
            [[WEIGHTS.get(path, {}).get(signal, 0.0) for path in paths] for signal in SIGNALS]
        ).reshape(len(SIGNALS), len(paths))

    def evaluate(self, signals: FloatArray) -> FloatArray:
        """Morph weights ``(F, M)`` for signals ``(len(SIGNALS), F)``."""
        return np.minimum(np.maximum(product(signals.T, self._weights), 0.0), 1.0)
