"""What all sessions share: the players, the instruments, and what a show can move."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.curves import ParameterRegistry
from reina.instruments import (
    INSTRUMENTS,
    MAX_PLAYERS,
    CastError,
    Performer,
    cast_parameters,
    find_cast,
    refuse_handedness,
    streamed_parameters,
)
from reina.instruments.player import Engagement
from reina.performance import schema_parameters, show_parameters
from reina.skeleton import load_hold, load_rig
from reina.stage import stage_registry
from reina.system.digest import digest_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from reina.curves import Parameter
    from reina.instruments import Instrument, PlayedPart
    from reina.instruments.casting import Cast, Casting
    from reina.instruments.player import Seat
    from reina.kinematics import Curve
    from reina.music import Score
    from reina.skeleton import Hold, HumanPose, Rig

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
        digest: Says which rigs and holds they are.
    """

    rigs: Mapping[str, Rig]
    holds: Mapping[tuple[str, str], Hold]
    kinds: Mapping[str, Instrument]
    parameters: tuple[Parameter, ...] = tuple(stage_registry())
    digest: str = ""

    @property
    def parts(self) -> tuple[object, ...]:
        """What it consists of, one by one: what sessions refer to and share."""
        parts = (*self.rigs.values(), *self.holds.values(), *self.kinds.values())
        return (self.rigs, self.holds, self.kinds, self.parameters, *parts, *self.parameters)

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
            if not instrument.rig:
                continue
            found = {path.parents[1].name for path in rigs_dir.glob(f"*/holds/{instrument.rig}.json")}
            for player in sorted(found, key=lambda player: (player != FIRST_PLAYER, player)):
                holds[player, name] = load_hold(rigs_dir / player, instrument.rig)
        if not holds:
            # Nobody can play: say what of the first player is not there.
            load_hold(rigs_dir / load_rig(rigs_dir / FIRST_PLAYER).name, next(iter(INSTRUMENTS.values())).rig)
        names = {player for player, _ in holds}
        names |= {
            rig
            for _, held in holds
            for hand in INSTRUMENTS[held].handedness
            for rig in INSTRUMENTS[held].skeletons_led_by(hand).values()
        }
        rigs = {name: load_rig(rigs_dir / name) for name in names}
        kinds = {instrument: INSTRUMENTS[instrument] for _, instrument in holds}
        digest = digest_of(rigs_dir, "*/rig.json", "*/holds/*.json", "*/clips/*.bvh")
        return cls(rigs=rigs, holds=holds, kinds=kinds, digest=digest)

    @property
    def instruments(self) -> tuple[str, ...]:
        """What somebody can play."""
        return tuple(self.kinds)

    def players(self, instrument: str) -> tuple[str, ...]:
        """Who can play an instrument, by name."""
        return tuple(player for player, held in self.holds if held == instrument)

    def registry(
        self, instruments: Sequence[str] | None = None, stances: Sequence[str] = ()
    ) -> ParameterRegistry:
        """Everything that a show can move where these are played, by the names that there are.

        Args:
            instruments: Each player's, in the cast's order; by default the first that there is, alone.
            stances: Names of stances beside those that there always are.
        """
        played = self.instruments[:1] if instruments is None else instruments
        own = cast_parameters([self.kinds[name] for name in played], stances)
        return ParameterRegistry((*self.parameters, *own))

    def largest_registry(self) -> ParameterRegistry:
        """Everything that a show of the largest cast can move, whatever its players play."""
        return ParameterRegistry(show_parameters(self.kinds.values(), MAX_PLAYERS, self.parameters))

    def schema_parameters(self) -> tuple[Parameter, ...]:
        """What the schema of shows names."""
        return schema_parameters(self.kinds.values(), self.parameters)

    def streamed(self) -> tuple[Parameter, ...]:
        """All that the largest cast can give to a frame beside the show, whoever plays what."""
        found = {
            parameter.path: parameter
            for number in range(MAX_PLAYERS)
            for player, instrument in self.holds
            for parameter in streamed_parameters(number, self.kinds[instrument], self.rigs[player])
        }
        return tuple(found.values())

    def instrument(self, casting: Casting, place: str) -> Instrument:
        """A casting's instrument.

        Raises:
            CastError: There is none of that name, or the player cannot play it, or not so.
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
        instrument = self.kinds[casting.instrument]
        refuse_handedness(instrument, casting.handedness, place)
        return instrument

    def found_cast(self, score: Score, sequence: int | None = None) -> Cast:
        """The cast that a score asks for by itself.

        Args:
            score: The score.
            sequence: Which sequence of the file it is, as `Cast` has it.
        """
        players = {name: self.players(name) for name in self.instruments}
        return find_cast(score, self.kinds, players, sequence=sequence)

    def performer(
        self,
        casting: Casting,
        number: int,
        seat: Seat,
        score: Score,
        played: PlayedPart,
        registry: ParameterRegistry,
        glances: Mapping[str, Curve],
        stances: Mapping[str, HumanPose],
        others: tuple[Seat, ...] = (),
    ) -> Performer:
        """Who plays a casting that names what there is.

        Args:
            casting: Who plays on what.
            number: Its place in the cast, the first being 0.
            seat: Where.
            score: What is played.
            played: The part as it is played.
            registry: The show's parameters.
            glances: How the player looks at the others.
            stances: Poses to stand in, by name.
            others: Where the other players are.
        """
        instrument = self.kinds[casting.instrument]
        engagement = Engagement(
            score=score,
            played=played,
            player_rig=self.rigs[casting.player],
            instrument_rigs={name: self.rigs[rig] for name, rig in instrument.skeletons.items()},
            hold=self.holds[casting.player, casting.instrument],
            registry=registry,
            number=number,
            seat=seat,
            others=others,
            seed=number,
            glances=glances,
            stances=stances,
        )
        if casting.handedness == "left":
            mirrored = instrument.skeletons_led_by("left").items()
            engagement = engagement.left_handed({name: self.rigs[rig] for name, rig in mirrored})
        return Performer(instrument, engagement)
