"""What a session plays, planned: a score, the player's part of it, a show, and the performance of it all."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.instruments import INSTRUMENTS
from reina.keyframes import ParameterRegistry, Show, ShowError, ShowPlan, stage_registry, write_default_show
from reina.performance import PLAYER_PARAMETERS, POSE_PARAMETERS, Performance
from reina.protocol import Manifest, build_manifest
from reina.sessions.music_arrays import music_form, time_map, triggers
from reina.skeleton import Hold, Rig, load_hold, load_rig

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from reina.instruments import Instrument, PartRanking, PlayedPart
    from reina.music import Score

PLAYER = "trumpeter"
"""Who plays where nobody chose."""

INSTRUMENT = "trumpet"
"""On what."""


class UnknownPlayerError(InputError):
    """A player was asked for that no rig is."""


@dataclass(frozen=True)
class Player:
    """Somebody who can play: their rig, and how they hold the instrument."""

    rig: Rig
    hold: Hold


@dataclass(frozen=True)
class Stage:
    """What all sessions share: the players, the instrument and the parameters of the show.

    Attributes:
        instrument: How it is played.
        players: Who can play it, by name.
        instrument_rig: On what.
        registry: Everything that a show can move.
    """

    instrument: Instrument
    players: Mapping[str, Player]
    instrument_rig: Rig
    registry: ParameterRegistry

    def player(self, name: str) -> Player:
        """A player.

        Raises:
            UnknownPlayerError: There is none of that name.
        """
        if name not in self.players:
            known = ", ".join(self.players)
            raise UnknownPlayerError(f"there is no player {name!r}; there are {known}", where="player")
        return self.players[name]

    @classmethod
    def load(cls, rigs_dir: Path) -> Stage:
        """Read the rigs; whoever has a hold on the instrument can play it.

        Args:
            rigs_dir: One folder a rig.

        Raises:
            RigError: A rig is not there, or is broken.
        """
        instrument = INSTRUMENTS[INSTRUMENT]
        holds = rigs_dir.glob(f"*/holds/{instrument.rig}.json")
        others = sorted({path.parents[1].name for path in holds} - {PLAYER})
        return cls(
            instrument=instrument,
            players={
                name: Player(load_rig(rigs_dir / name), load_hold(rigs_dir / name, instrument.rig))
                for name in (PLAYER, *others)
            },
            instrument_rig=load_rig(rigs_dir / instrument.rig),
            registry=stage_registry().extended([*PLAYER_PARAMETERS, *POSE_PARAMETERS]),
        )


def read_show(data: bytes, registry: ParameterRegistry) -> Show:
    """Read a show from JSON text.

    Raises:
        ShowError: It is no show.
    """
    try:
        document: object = json.loads(data)
    except (ValueError, RecursionError) as error:
        raise ShowError(f"the show is no JSON: {error}") from error
    return Show.from_document(document, registry)


@dataclass(frozen=True)
class Production:
    """Never changed: another part or another show gives a new one, which shares what stays.

    Attributes:
        stage: What it is played on.
        player: Name of who plays.
        score: What is played.
        ranking: The parts that suit the instrument, best first.
        part: The part that the player plays.
        transposition: Semitones by which it was asked to be moved.
        written: Whether it is taken as notated for the instrument.
        octave_fit: Whether it is moved into range by octaves.
        played: The playable line and its fingering; `played.transposition` is how far all this moves it.
        show: The show around it.
        show_plan: The show, made ready.
        performance: All of it as a function of time.
        manifest: What its frames hold.
    """

    stage: Stage
    player: str
    score: Score
    ranking: tuple[PartRanking, ...]
    part: int
    transposition: int
    written: bool
    octave_fit: bool
    played: PlayedPart
    show: Show
    show_plan: ShowPlan
    performance: Performance
    manifest: Manifest

    @classmethod
    def plan(
        cls,
        stage: Stage,
        score: Score,
        show: Show | None = None,
        *,
        player: str = PLAYER,
        part: int | None = None,
        transposition: int = 0,
        written: bool = False,
        octave_fit: bool = False,
        joined_parts: Sequence[int] = (),
    ) -> Production:
        """Plan a performance; takes milliseconds to a second, depending on the score.

        Args:
            stage: Who plays on what.
            score: What is played.
            show: The show around it; when None, one is written from the form of the music.
            player: Name of who plays.
            part: The part that the player plays; the one that suits the instrument best when None.
            transposition: Semitones by which it is moved.
            written: Whether it is notated for the instrument and sounds as the instrument transposes.
            octave_fit: Whether to move it by the octaves that bring most of it into range.
            joined_parts: Further parts that the player plays together with it.

        Raises:
            NotInScoreError: The score has no such part, or one cannot be joined.
            UnknownPlayerError: There is no such player.
        """
        who = stage.player(player)
        ranking = stage.instrument.rank_parts(score)
        played = stage.instrument.play(
            score,
            ranking[0].part if part is None else part,
            transposition,
            written=written,
            octave_fit=octave_fit,
            joined_parts=joined_parts,
        )
        if show is None:
            show = _show_for(score, played)
        show_plan = show.plan(stage.registry, time_map(score), triggers=triggers(score, played))
        performance = _performance(stage, who, score, played, show_plan)
        return cls(
            stage=stage,
            player=player,
            score=score,
            ranking=ranking,
            part=played.part,
            transposition=transposition,
            written=written,
            octave_fit=octave_fit,
            played=played,
            show=show,
            show_plan=show_plan,
            performance=performance,
            manifest=build_manifest(performance.layout),
        )

    @property
    def instrument(self) -> Instrument:
        """How the instrument is played."""
        return self.stage.instrument

    @property
    def has_default_show(self) -> bool:
        """Whether the show is still the one that was written from the form of this music."""
        return self.show == _show_for(self.score, self.played)

    def with_show(self, show: Show) -> Production:
        """The same with another show; what was planned of the player is kept."""
        plan = show.plan(self.stage.registry, self.show_plan.time_map, earlier=self.show_plan)
        return replace(self, show=show, show_plan=plan, performance=self.performance.with_show(plan))

    def at_rate(self, fps: int) -> Production:
        """The same function on another grid of frames."""
        if fps == self.manifest.fps:
            return self
        plan = self.show.plan(
            self.stage.registry, self.show_plan.time_map, triggers=self.show_plan.triggers, fps=fps
        )
        who = self.stage.player(self.player)
        performance = _performance(self.stage, who, self.score, self.played, plan, fps=fps)
        return replace(
            self, show_plan=plan, performance=performance, manifest=build_manifest(performance.layout)
        )


def _show_for(score: Score, played: PlayedPart) -> Show:
    return write_default_show(music_form(score, played), title=score.title)


def _performance(
    stage: Stage, player: Player, score: Score, played: PlayedPart, show_plan: ShowPlan, *, fps: int = 60
) -> Performance:
    return Performance(
        score=score,
        played=played,
        instrument=stage.instrument,
        player_rig=player.rig,
        instrument_rig=stage.instrument_rig,
        hold=player.hold,
        show_plan=show_plan,
        registry=stage.registry,
        fps=fps,
    )
