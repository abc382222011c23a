"""Keys on the body itself: turns that a show adds to what the playing asks of head, torso and eyes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.curves import Parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    from reina.curves import ParameterRegistry
    from reina.rotations.arrays import FloatArray

LARGEST_TURN_RAD = {"torso": 0.28, "head": 0.22}
"""The largest turn about any axis. Within these no hand, foot or lip leaves its place, and no joint its
limits, whatever else the player does."""

LARGEST_GAZE_RAD = {"left": 0.5, "up": 0.3}

AXES = ("bow", "turn", "tip")
"""Components of a turn: forward about +x (the player's left), to the left about +y, to the right about +z."""


def _turn(name: str, what: str) -> Parameter:
    bound = LARGEST_TURN_RAD[name]
    return Parameter(
        path=f"player/pose/{name}",
        type="vector",
        default=(0.0, 0.0, 0.0),
        unit="rad",
        minimum=-bound,
        maximum=bound,
        documentation=f"Turns {what} over what the playing asks: bowed forward, turned left, tipped right.",
    )


def _gaze(side: str, what: str) -> Parameter:
    bound = LARGEST_GAZE_RAD[side]
    return Parameter(
        path=f"player/pose/gaze_{side}",
        type="number",
        default=0.0,
        unit="rad",
        minimum=-bound,
        maximum=bound,
        documentation=f"Turns the eyes {what}, over their own wandering.",
    )


POSE_PARAMETERS: tuple[Parameter, ...] = (
    _turn("torso", "the trunk, with head, horn and arms on it,"),
    _turn("head", "the head, and the horn with it,"),
    _gaze("left", "to the player's left"),
    _gaze("up", "up"),
)
"""What a show may key on the player's body; all 0 as played."""


class PoseKeys:
    """Reads the added turns out of a show's values as rows for `body_table.SIGNALS`.

    Args:
        registry: The show's parameters; what it has not stays at 0.
        prefix: What the player's paths begin with.
    """

    def __init__(self, registry: ParameterRegistry, prefix: str = "") -> None:
        layout = registry.layout()
        path = f"{prefix}player/pose"
        self._turns = {name: _first(layout, f"{path}/{name}") for name in LARGEST_TURN_RAD}
        self._gaze = {side: _first(layout, f"{path}/gaze_{side}") for side in LARGEST_GAZE_RAD}

    def read(self, values: FloatArray) -> dict[str, FloatArray]:
        """Signals by name, radians, ``(F,)`` each, from values ``(F, P)``.

        A turn about several axes at once is as large as its rotation vector is long, and so is its bound.
        """
        still = np.zeros((len(values), 3))
        rows: dict[str, FloatArray] = {}
        for name, column in self._turns.items():
            turn = still if column is None else values[:, column : column + 3]
            if turn.any():
                size = np.sqrt(np.einsum("fi,fi->f", turn, turn))
                turn = turn * (LARGEST_TURN_RAD[name] / np.maximum(size, LARGEST_TURN_RAD[name]))[:, None]
            rows |= {f"{name}_{axis}": turn[:, place] for place, axis in enumerate(AXES)}
        for side, column in self._gaze.items():
            rows[f"eyes_{side}"] = still[:, 0] if column is None else values[:, column]
        return rows


def _first(layout: Mapping[str, tuple[int, int]], path: str) -> int | None:
    return layout[path][0] if path in layout else None
