"""What a session plays, planned: a score, the player's part of it, a show, and the performance of it all."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from reina.instruments import INSTRUMENTS
from reina.keyframes import ParameterRegistry, Show, ShowError, ShowPlan, stage_registry, write_default_show
from reina.performance import PLAYER_PARAMETERS, POSE_PARAMETERS, Performance
from reina.protocol import Manifest, build_manifest
from reina.sessions.music_arrays import music_form, time_map, triggers
from reina.skeleton import Hold, Rig, load_hold, load_rig

if TYPE_CHECKING:
    from pathlib import Path

    from reina.instruments import Instrument, PartRanking, PlayedPart
    from reina.music import Score

PLAYER_RIG = "trumpeter"
INSTRUMENT = "trumpet"
"""Whom every session has on its stage."""


@dataclass(frozen=True)
class Stage:
    """What all sessions share: the player, the instrument and the parameters of the show.

    Attributes:
        instrument: How it is played.
        player_rig: Who plays.
        instrument_rig: On what.
        hold: How it is held.
        registry: Everything that a show can move.
    """

    instrument: Instrument
    player_rig: Rig
    instrument_rig: Rig
    hold: Hold
    registry: ParameterRegistry

    @classmethod
    def load(cls, rigs_dir: Path) -> Stage:
        """Read the rigs.

        Args:
            rigs_dir: One folder a rig.

        Raises:
            RigError: A rig is not there, or is broken.
        """
        instrument = INSTRUMENTS[INSTRUMENT]
        return cls(
            instrument=instrument,
            player_rig=load_rig(rigs_dir / PLAYER_RIG),
            instrument_rig=load_rig(rigs_dir / instrument.rig),
            hold=load_hold(rigs_dir / PLAYER_RIG, instrument.rig),
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
        part: int | None = None,
        transposition: int = 0,
        written: bool = False,
        octave_fit: bool = False,
    ) -> Production:
        """Plan a performance; takes milliseconds to a second, depending on the score.

        Args:
            stage: Who plays on what.
            score: What is played.
            show: The show around it; when None, one is written from the form of the music.
            part: The part that the player plays; the one that suits the instrument best when None.
            transposition: Semitones by which it is moved.
            written: Whether it is notated for the instrument and sounds as the instrument transposes.
            octave_fit: Whether to move it by the octaves that bring most of it into range.

        Raises:
            NotInScoreError: The score has no such part.
        """
        ranking = stage.instrument.rank_parts(score)
        played = stage.instrument.play(
            score,
            ranking[0].part if part is None else part,
            transposition,
            written=written,
            octave_fit=octave_fit,
        )
        if show is None:
            show = _show_for(score, played)
        show_plan = show.plan(stage.registry, time_map(score), triggers=triggers(score, played))
        performance = _performance(stage, score, played, show_plan)
        return cls(
            stage=stage,
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
        performance = _performance(self.stage, self.score, self.played, plan, fps=fps)
        return replace(
            self, show_plan=plan, performance=performance, manifest=build_manifest(performance.layout)
        )


def _show_for(score: Score, played: PlayedPart) -> Show:
    return write_default_show(music_form(score, played), title=score.title)


def _performance(
    stage: Stage, score: Score, played: PlayedPart, show_plan: ShowPlan, *, fps: int = 60
) -> Performance:
    return Performance(
        score=score,
        played=played,
        instrument=stage.instrument,
        player_rig=stage.player_rig,
        instrument_rig=stage.instrument_rig,
        hold=stage.hold,
        show_plan=show_plan,
        registry=stage.registry,
        fps=fps,
    )
