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


def schema_parameters(
    instruments: Iterable[Instrument], stage: Sequence[Parameter] = STAGE_PARAMETERS
) -> tuple[Parameter, ...]:
    """What a schema of shows names: the stage's, and those of one player of a cast, the first.

    Those of the others differ by what their paths begin with, see `any_player_pattern`.

    Args:
        instruments: Those that there are.
        stage: The stage's parameters.
    """
    of_two = show_parameters(instruments, 2, stage)
    return tuple(parameter for parameter in of_two if not parameter.path.startswith("players/"))


def any_player_pattern(parameter: Parameter) -> str | None:
    """The paths that a first player's parameter has for each player of a cast, as a regular expression.

    None where it is the stage's.
    """
    if parameter.path in _OF_THE_STAGE:
        return None
    return f"^(players/([2-9]|[1-9][0-9]+)/)?{parameter.path}$"


_OF_THE_STAGE = frozenset(parameter.path for parameter in STAGE_PARAMETERS)
