"""A casting with all that it names: what a performer is made of."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from reina.instruments.player.seats import SEATS, Seat
from reina.skeleton import mirrored_hold

if TYPE_CHECKING:
    from collections.abc import Mapping

    from reina.curves import ParameterRegistry
    from reina.instruments.played import PlayedPart
    from reina.kinematics import Curve
    from reina.music.score import Score
    from reina.skeleton import Hold, HumanPose, Rig


def player_prefix(number: int) -> str:
    """What the paths of a cast's player begin with, the first being 0: nothing, then ``players/2/``."""
    return f"players/{number + 1}/" if number else ""


@dataclass(frozen=True, eq=False)
class Engagement:
    """Who plays what, on which rigs, and where.

    Attributes:
        score: The score; its tempo and metre lead the body.
        played: What the instrument makes of a part.
        player_rig: The player's rig.
        instrument_rigs: The rig of each of `Instrument.skeletons`, by the skeleton's name, its own first.
        hold: How the player holds it.
        registry: The show's parameters.
        number: The player's place in the cast, the first being 0.
        seat: Where the player stands.
        others: Where the other players of the cast are.
        seed: Which of many equal ways of moving.
        glances: How the player looks at the others, as `plan_glances` gives it.
        stances: Poses that the player can stand in beside those of the rig, by name, in the order of the
            registry's choices.
        right_handed: Of who leads with the left hand, the same as a right-handed player has it; None of who
            leads with the right.
    """

    score: Score
    played: PlayedPart
    player_rig: Rig
    instrument_rigs: Mapping[str, Rig]
    hold: Hold
    registry: ParameterRegistry
    number: int = 0
    seat: Seat = SEATS["middle"]
    others: tuple[Seat, ...] = ()
    seed: int = 0
    glances: Mapping[str, Curve] = field(default_factory=dict[str, "Curve"])
    stances: Mapping[str, HumanPose] = field(default_factory=dict[str, "HumanPose"])
    right_handed: Engagement | None = None

    @property
    def prefix(self) -> str:
        """What the paths of the player's parameters begin with."""
        return player_prefix(self.number)

    @property
    def instrument_rig(self) -> Rig:
        """The rig of what is held."""
        return next(iter(self.instrument_rigs.values()))

    def left_handed(self, instrument_rigs: Mapping[str, Rig]) -> Engagement:
        """The same of who leads with the left hand.

        Args:
            instrument_rigs: As the attribute: the mirror images of the right-handed player's.

        Raises:
            RigError: The player's left and right are not mirror images.
        """
        carried = {name: self.instrument_rigs[name].skeleton for name in self.hold.attachments}
        instrument = next(iter(instrument_rigs.values())).name
        hold = mirrored_hold(self.hold, self.player_rig.skeleton, carried, instrument=instrument)
        return replace(self, instrument_rigs=instrument_rigs, hold=hold, right_handed=self)
