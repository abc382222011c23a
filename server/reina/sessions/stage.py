"""What all sessions share: the players, the instruments, and what a show can move."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.curves import ParameterRegistry
from reina.instruments import INSTRUMENTS, CastError
from reina.performance import Performer, player_parameters
from reina.skeleton import load_hold, load_rig
from reina.stage import stage_registry

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from reina.curves import Parameter
    from reina.instruments import Instrument, PlayedPart
    from reina.instruments.casting import Casting
    from reina.music import Score
    from reina.performance import Seat
    from reina.skeleton import Hold, Rig

FIRST_PLAYER = "trumpeter"
"""Who is named first among those who could play."""


@dataclass(frozen=True)
class Stage:
    """Everything that a cast can be made of.

    Attributes:
        rigs: Players and instruments by name.
        holds: How who holds what: (player, instrument) -> the hold.
        kinds: The instruments by name.
        parameters: What a show can move beside the players.
    """

    rigs: Mapping[str, Rig]
    holds: Mapping[tuple[str, str], Hold]
    kinds: Mapping[str, Instrument]
    parameters: tuple[Parameter, ...] = tuple(stage_registry())

    @classmethod
    def load(cls, rigs_dir: Path) -> Stage:
        """Read the rigs; whoever has a hold on an instrument can play it.

        Args:
            rigs_dir: One folder a rig.

        Raises:
            RigError: A rig is not there, or is broken.
        """
        holds: dict[tuple[str, str], Hold] = {}
        for name, instrument in INSTRUMENTS.items():
            found = {path.parents[1].name for path in rigs_dir.glob(f"*/holds/{instrument.rig}.json")}
            for player in sorted(found, key=lambda player: (player != FIRST_PLAYER, player)):
                holds[player, name] = load_hold(rigs_dir / player, instrument.rig)
        if not holds:
            # Nobody can play: say what of the first player is not there.
            load_hold(rigs_dir / load_rig(rigs_dir / FIRST_PLAYER).name, next(iter(INSTRUMENTS.values())).rig)
        instruments = {INSTRUMENTS[name].rig for _, name in holds}
        rigs = {name: load_rig(rigs_dir / name) for name in {player for player, _ in holds} | instruments}
        kinds = {instrument: INSTRUMENTS[instrument] for _, instrument in holds}
        return cls(rigs=rigs, holds=holds, kinds=kinds)

    @property
    def instruments(self) -> tuple[str, ...]:
        """What somebody can play."""
        return tuple(self.kinds)

    def players(self, instrument: str) -> tuple[str, ...]:
        """Who can play an instrument, by name."""
        return tuple(player for player, held in self.holds if held == instrument)

    def registry(self, players: int = 1) -> ParameterRegistry:
        """Everything that a show of so many players can move."""
        own = (parameter for number in range(players) for parameter in player_parameters(number))
        return ParameterRegistry((*self.parameters, *own))

    def instrument(self, casting: Casting, place: str) -> Instrument:
        """A casting's instrument.

        Raises:
            CastError: There is none of that name, or the player cannot play it.
        """
        if casting.instrument not in self.instruments:
            known = ", ".join(self.instruments)
            raise CastError(
                f"there is no instrument {casting.instrument!r}; there are {known}",
                location=f"{place}instrument",
            )
        if (casting.player, casting.instrument) not in self.holds:
            known = ", ".join(self.players(casting.instrument))
            raise CastError(
                f"there is no player {casting.player!r}; there are {known} for the {casting.instrument}",
                location=f"{place}player",
            )
        return self.kinds[casting.instrument]

    def performer(
        self,
        casting: Casting,
        number: int,
        seat: Seat,
        score: Score,
        played: PlayedPart,
        registry: ParameterRegistry,
    ) -> Performer:
        """Who plays a casting that names what there is.

        Args:
            casting: Who plays on what.
            number: Its place in the cast, the first being 0.
            seat: Where.
            score: What is played.
            played: The part as it is played.
            registry: The show's parameters.
        """
        instrument = self.kinds[casting.instrument]
        return Performer(
            score=score,
            played=played,
            instrument=instrument,
            player_rig=self.rigs[casting.player],
            instrument_rig=self.rigs[instrument.rig],
            hold=self.holds[casting.player, casting.instrument],
            registry=registry,
            number=number,
            seat=seat,
            seed=number,
        )
