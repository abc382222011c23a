"""What a show may move of a player, by the instrument."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from reina.instruments.player.amounts import PLAYER_PARAMETERS
from reina.instruments.player.engagement import player_prefix
from reina.instruments.player.pose_keys import POSE_PARAMETERS

if TYPE_CHECKING:
    from reina.curves import Parameter
    from reina.instruments.instrument import Instrument


def player_parameters(number: int, instrument: Instrument) -> tuple[Parameter, ...]:
    """What a show may move of a cast's player, the first being 0, on an instrument."""
    prefix = player_prefix(number)
    own = (*PLAYER_PARAMETERS, *instrument.show_parameters, *POSE_PARAMETERS)
    return tuple(replace(parameter, path=prefix + parameter.path) for parameter in own)
