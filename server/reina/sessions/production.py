"""What a session plays, planned: a score, its cast, a show, and the performance of it all."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from reina.instruments import Cast, casting_reasons, choice_findings, spoken_name, unplayed_parts
from reina.instruments.describe import NoteTable
from reina.instruments.player import plan_glances
from reina.music import findings_of, retimed, transposed
from reina.performance import Performance
from reina.protocol import Manifest, build_manifest
from reina.sessions.cast_plan import complete_cast, seats_of
from reina.sessions.music_arrays import music_form, time_map, triggers, tune_form, tune_of
from reina.sessions.note_messages import JOINED_BYTES, NOTE_BYTES
from reina.show import Show, ShowError, ShowPlan, Track, UnknownTrack, unknown_choices
from reina.sound.plan import PlayedParts
from reina.stage import CastForm, Place, write_default_show
from reina.system.json_text import read_json
from reina.system.weight import weight_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reina.curves import ParameterRegistry
    from reina.instruments import (
        Casting,
        Instrument,
        PartRanking,
        Performer,
        PlayedPart,
        TunePassage,
        UnplayedPart,
    )
    from reina.instruments.player import Seat
    from reina.music import Finding, Score, ScoreWarning, SongTimes
    from reina.sessions.packed_score import PackedScore
    from reina.sessions.stage import Stage
    from reina.skeleton import HumanPose


def read_show(data: bytes, registry: ParameterRegistry) -> Show:
    """Read a show from JSON text.

    Raises:
        ShowError: It is no show.
    """
    try:
        document: object = read_json(data)
    except ValueError as error:
        raise ShowError(f"the show is no JSON: {error}") from error
    return Show.from_document(document, registry)


@dataclass(frozen=True)
class Production:
    """Never changed: another cast or another show gives a new one, which shares what stays.

    Attributes:
        stage: What it is played on.
        registry: Everything that its show can move.
        cast: Who plays what, each casting with its part.
        written_score: What is played, in the time of its file.
        score: The same as it is heard: in the time of the song, and in its key where that is asked for.
        rankings: Of each player the parts that suit the instrument, best first.
        show: The show around it.
        show_plan: The show, made ready.
        performance: All of it as a function of time.
        manifest: What its frames hold.
        note_table: Its notes as the cast plays them.
        packed_score: The score as it is answered with, where it is so long that it is written beforehand.
        weight: About how many bytes all of it but the show takes in memory; 0 until `weighed`.
    """

    stage: Stage
    registry: ParameterRegistry
    cast: Cast
    written_score: Score
    score: Score
    rankings: tuple[tuple[PartRanking, ...], ...]
    show: Show
    show_plan: ShowPlan
    performance: Performance
    manifest: Manifest
    note_table: NoteTable
    packed_score: PackedScore | None = None
    weight: int = 0

    @classmethod
    def plan(
        cls,
        stage: Stage,
        score: Score,
        show: Show | None = None,
        cast: Cast | None = None,
        alignment: SongTimes | None = None,
        stances: Mapping[str, HumanPose] | None = None,
        transposition: int = 0,
    ) -> Production:
        """Plan a performance; takes milliseconds to a second, depending on the score.

        Args:
            stage: Who can play what.
            score: What is played.
            show: The show around it; when None, one is written from the form of the music.
            cast: Who plays what, or that the score is to say so; the trumpeter the part that suits best when
                None.
            alignment: Where the score is heard in the song; where it is written when None. Who plays what
                does not depend on it.
            stances: Poses that its players can stand in, by name.
            transposition: Semitones by which all is played higher than it is written, as the song sounds.

        Raises:
            CastError: There is no such player, instrument or seat, or two players have one seat.
            NotInScoreError: The score has no such part.
        """
        cast = cast or Cast()
        if cast.is_to_be_found:
            cast = stage.found_cast(score, cast.sequence)
        heard = transposed(score if alignment is None else retimed(score, alignment), transposition)
        castings, played, rankings = complete_cast(stage, score, heard, cast)
        poses = stances or {}
        registry = stage.registry(tuple(casting.instrument for casting in castings), tuple(poses))
        seats = seats_of(stage, cast)
        glances = plan_glances(played, seats)
        performers = [
            stage.performer(
                casting,
                number,
                seat,
                heard,
                part,
                registry,
                looks,
                poses,
                others=tuple(other for other in seats if other != seat),
            )
            for number, (casting, seat, part, looks) in enumerate(
                zip(castings, seats, played, glances, strict=True)
            )
        ]
        show = _show_for(heard, played, _places(castings, seats)) if show is None else rebound(show, registry)
        show_plan = show.plan(registry, time_map(heard), triggers=triggers(heard, played))
        performance = Performance(performers, show_plan, duration_s=heard.duration_s)
        return cls(
            stage=stage,
            registry=registry,
            cast=replace(cast, castings=castings),
            written_score=score,
            score=heard,
            rankings=rankings,
            show=show,
            show_plan=show_plan,
            performance=performance,
            manifest=build_manifest(performance.layout),
            note_table=NoteTable(heard, [(one.instrument, one.played) for one in performers]),
        )

    def weighed(self) -> Production:
        """The same, with its weight; takes some hundredths of a second."""
        shared = (self.stage, *self.stage.parts, self.show, self.show_plan)
        held = (
            self.written_score,
            self.score,
            self.rankings,
            self.performers,
            self.note_table,
            self.show_plan.triggers,
            self.packed_score,
        )
        # What is told of the notes while they are played is made of them when they are.
        told = NOTE_BYTES if len(self.performers) == 1 else NOTE_BYTES + JOINED_BYTES
        notes = sum(len(performer.played.line) for performer in self.performers)
        return replace(self, weight=weight_of(held, shared) + told * notes)

    @property
    def performers(self) -> tuple[Performer, ...]:
        """Who plays."""
        return self.performance.performers

    @property
    def played(self) -> PlayedPart:
        """The first player's part as it is played."""
        return self.performers[0].played

    @property
    def seats(self) -> tuple[Seat, ...]:
        """Where each player stands."""
        return tuple(performer.seat for performer in self.performers)

    @property
    def places(self) -> tuple[Place, ...]:
        """The same as a show that is written for the cast sees them."""
        return _places(self.cast.castings, self.seats)

    @cached_property
    def tune(self) -> tuple[TunePassage, ...]:
        """Who has the tune when."""
        return tune_of(self.score, [performer.played for performer in self.performers])

    @property
    def instrument(self) -> Instrument:
        """The first player's instrument."""
        return self.performers[0].instrument

    @cached_property
    def casting_reasons(self) -> tuple[tuple[str, ...], ...]:
        """Why there is each player."""
        return casting_reasons(self.written_score, self.cast, self.stage.kinds)

    @cached_property
    def unplayed(self) -> tuple[UnplayedPart, ...]:
        """The parts that nobody plays, and why."""
        return unplayed_parts(self.written_score, self.cast, self.stage.kinds)

    @property
    def sounding(self) -> tuple[PlayedParts, ...]:
        """What of the score the players play, as it sounds."""
        return tuple(
            PlayedParts(one.played.parts, one.played.transposition, one.instrument.program)
            for one in self.performers
        )

    @property
    def warnings(self) -> tuple[ScoreWarning, ...]:
        """What was repaired in the score, and what became of the players' parts."""
        played = (warning for performer in self.performers for warning in performer.played.warnings)
        return (*self.score.warnings, *played)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The same as a musician is told of it, after who plays what."""
        castings = self.cast.castings
        reasons = [
            next(choice.reasons for choice in ranking if choice.part == casting.part)
            for casting, ranking in zip(castings, self.rankings, strict=True)
        ]
        played = (
            finding
            for number, one in enumerate(self.performers)
            for finding in findings_of(
                one.played.warnings, player=number, instrument=spoken_name(one.instrument.name)
            )
        )
        return (
            *choice_findings(self.written_score, castings, self.stage.kinds, reasons),
            *played,
            *findings_of(self.score.warnings),
        )

    @property
    def has_default_show(self) -> bool:
        """Whether the show is still the one that was written from the form of this music."""
        played = [performer.played for performer in self.performers]
        return self.show == _show_for(self.score, played, self.places)

    def with_show(self, show: Show) -> Production:
        """The same with another show; what was planned of the players is kept."""
        show = rebound(show, self.registry)
        plan = show.plan(self.registry, self.show_plan.time_map, earlier=self.show_plan)
        return replace(self, show=show, show_plan=plan, performance=self.performance.with_show(plan))

    def at_rate(self, fps: int) -> Production:
        """The same function on another grid of frames."""
        if fps == self.manifest.fps:
            return self
        times, happens = self.show_plan.time_map, self.show_plan.triggers
        plan = self.show.plan(self.registry, times, triggers=happens, fps=fps, earlier=self.show_plan)
        performance = Performance(self.performers, plan, duration_s=self.score.duration_s, fps=fps)
        return replace(
            self, show_plan=plan, performance=performance, manifest=build_manifest(performance.layout)
        )


def rebound(show: Show, registry: ParameterRegistry) -> Show:
    """A show whose tracks are those of a registry's parameters; others are kept and have no effect."""
    fits = all(isinstance(track, UnknownTrack) != _has_effect(track, registry) for track in show.tracks)
    return show if fits else Show.from_document(show.to_document(), registry)


def _has_effect(track: Track | UnknownTrack, registry: ParameterRegistry) -> bool:
    parameter = registry.get(track.parameter)
    return parameter is not None and not unknown_choices(track, parameter)


def _places(castings: Sequence[Casting], seats: Sequence[Seat]) -> tuple[Place, ...]:
    return tuple(
        Place(
            seat.x_m,
            seat.z_m,
            seat.facing_rad,
            seat.y_m,
            at_drums=seat.name == "drums",
            mirrored=casting.handedness == "left",
        )
        for casting, seat in zip(castings, seats, strict=True)
    )


def _show_for(score: Score, played: Sequence[PlayedPart], places: Sequence[Place]) -> Show:
    """The show that is written for a cast."""
    if [replace(place, mirrored=False) for place in places] == [Place(0.0, 0.0, 0.0)]:
        return write_default_show(music_form(score, played[0]), title=score.title)
    tune = tune_of(score, played)
    cast = CastForm(
        places=tuple(places),
        tune=tuple((passage.start_s, passage.player) for passage in tune),
    )
    return write_default_show(tune_form(score, played, tune), title=score.title, cast=cast)
