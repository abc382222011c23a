"""How much of each gesture is shown: the player's own parameters, for the registry of a show."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.curves import Parameter
from reina.instruments.player.stances import STANCES

if TYPE_CHECKING:
    from reina.curves import ParameterRegistry
    from reina.rotations.arrays import FloatArray, IntArray


def _amount(name: str, documentation: str, *, maximum: float = 2.0) -> Parameter:
    return Parameter(
        path=f"player/{name}",
        type="number",
        default=1.0,
        minimum=0.0,
        maximum=maximum,
        documentation=documentation,
    )


PLAYER_PARAMETERS: tuple[Parameter, ...] = (
    _amount(
        "breath", "How deeply the player is seen to breathe: chest, shoulders, horn, corners of the mouth."
    ),
    _amount("sway", "How far the player sways with the metre."),
    _amount("lean", "How far the player leans back with the breath and into phrases."),
    _amount("turn", "How far the player turns to one side in a phrase."),
    _amount("lift", "How far head, shoulders and bell rise on high notes."),
    _amount("vibrato", "How far the right hand rocks on long notes."),
    _amount("finger_lift", "How far idle fingers lift off their valve caps."),
    _amount("face", "How much lips, brows and smile work.", maximum=1.5),
    _amount(
        "cheeks", "How far the cheeks fill as air is blown; trained players keep them firm.", maximum=6.0
    ),
    _amount("tongue", "How much each tongued note is seen at the lips."),
    _amount("blink", "How far the eyes close in a blink.", maximum=1.0),
    _amount("gaze", "How far the eyes wander."),
    _amount("lower", "How far the instrument is taken down in long rests.", maximum=1.0),
    Parameter(
        path="player/stance",
        type="choice",
        default="shifting",
        choices=STANCES,
        blend=False,
        documentation="How the player stands under all playing; going to another takes a second and a half.",
        open_choices=True,
    ),
    _amount("stance/amount", "How far the player moves in that stance.", maximum=1.5),
)
"""Amounts of gestures, 1 as played by default and 0 none, and which stance is played in.

One that an instrument's player has no gesture for has no effect."""


class Amounts:
    """Reads the amounts out of a show's values.

    Args:
        registry: The show's parameters; amounts that it has not stay at their defaults.
        prefix: What the player's paths begin with.
    """

    def __init__(self, registry: ParameterRegistry, prefix: str = "") -> None:
        layout = registry.layout()
        amounts = [parameter for parameter in PLAYER_PARAMETERS if parameter.type == "number"]
        self._names = [parameter.path.removeprefix("player/") for parameter in amounts]
        paths = [prefix + parameter.path for parameter in amounts]
        self._shown: IntArray = np.flatnonzero([path in layout for path in paths])
        self._columns: IntArray = np.array(
            [layout[path][0] for path in paths if path in layout], dtype=np.intp
        )
        self._defaults: FloatArray = np.array(
            [float(parameter.floats(parameter.default)[0]) for parameter in amounts]
        )

    def read(self, values: FloatArray) -> dict[str, FloatArray]:
        """Amounts by name, ``(F,)`` each, from values ``(F, P)``; none is below 0."""
        rows = np.repeat(self._defaults[:, None], len(values), axis=1)
        rows[self._shown] = np.maximum(values.T[self._columns], 0.0)
        return dict(zip(self._names, rows, strict=True))
