"""Everything that any show can move."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.instruments.parameters import player_parameters
from reina.stage import STAGE_PARAMETERS

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from reina.curves import Parameter
    from reina.instruments import Instrument


def show_parameters(
    instruments: Iterable[Instrument], players: int, stage: Sequence[Parameter] = STAGE_PARAMETERS
) -> tuple[Parameter, ...]:
    """What a show can move of the stage, and then of each of so many players, whatever they play.

    Args:
        instruments: Those that there are.
        players: How many play at most.
        stage: The stage's parameters.
    """
    kinds = tuple(instruments)
    found = {
        parameter.path: parameter
        for number in range(players)
        for instrument in kinds
        for parameter in player_parameters(number, instrument, alone=players == 1)
    }
    return (*stage, *found.values())
