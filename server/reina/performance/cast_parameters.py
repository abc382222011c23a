"""Everything that a show of a cast can move."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.performance.performer import player_parameters
from reina.stage import STAGE_PARAMETERS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.curves import Parameter


def show_parameters(players: int, stage: Iterable[Parameter] = STAGE_PARAMETERS) -> tuple[Parameter, ...]:
    """What a show of so many players can move, in the frame's order: the stage's, then each player's.

    Args:
        players: How many play, 1 at least; whatever fewer have, more have too.
        stage: The stage's parameters.
    """
    own = (one for number in range(players) for one in player_parameters(number, alone=players == 1))
    return (*stage, *own)
