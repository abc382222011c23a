"""What a show may move of a player, by the instrument."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from reina.instruments.player.amounts import PLAYER_PARAMETERS
from reina.instruments.player.engagement import player_prefix
from reina.instruments.player.face import Face
from reina.instruments.player.glances import GLANCE_PARAMETER
from reina.instruments.player.pose_keys import POSE_PARAMETERS
from reina.instruments.player.stance_choice import PATH as STANCE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.curves import Parameter
    from reina.instruments.instrument import Instrument
    from reina.skeleton import Rig


def player_parameters(
    number: int, instrument: Instrument, *, alone: bool = True, stances: Sequence[str] = ()
) -> tuple[Parameter, ...]:
    """What a show may move of a cast's player on an instrument.

    Args:
        number: The player's place in the cast, the first being 0.
        instrument: What is played.
        alone: Whether nobody else plays; there is nobody to look at then.
        stances: Names of stances beside those that there always are.
    """
    prefix = player_prefix(number)
    own = (*PLAYER_PARAMETERS, *instrument.show_parameters, *POSE_PARAMETERS)
    own = own if alone else (*own, GLANCE_PARAMETER)
    return tuple(
        replace(
            parameter,
            path=prefix + parameter.path,
            choices=(*parameter.choices, *stances) if parameter.path == STANCE else parameter.choices,
        )
        for parameter in own
    )


def cast_parameters(instruments: Sequence[Instrument], stances: Sequence[str] = ()) -> tuple[Parameter, ...]:
    """What a show may move of the players of a cast.

    Args:
        instruments: Each player's, in the cast's order.
        stances: Names of stances beside those that there always are.
    """
    alone = len(instruments) == 1
    return tuple(
        parameter
        for number, instrument in enumerate(instruments)
        for parameter in player_parameters(number, instrument, alone=alone, stances=stances)
    )


def streamed_parameters(number: int, instrument: Instrument, player_rig: Rig) -> tuple[Parameter, ...]:
    """What a cast's player gives to every frame beside the show: the instrument's, and the face.

    Args:
        number: The player's place in the cast, the first being 0.
        instrument: What is played.
        player_rig: Who plays.
    """
    prefix = player_prefix(number)
    own = (*instrument.parameters, *Face(player_rig).parameters)
    return tuple(replace(parameter, path=prefix + parameter.path) for parameter in own)
