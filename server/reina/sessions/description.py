"""A session's score, notes and clock as the wire tells them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from reina.instruments.describe import (
    DescribedNote,
    describe_metres,
    describe_parts,
    describe_tempi,
    describe_warnings,
)
from reina.music.lyrics import lyric_lines
from reina.protocol import resources
from reina.protocol.links import stance_href
from reina.protocol.messages import Transport
from reina.protocol.notes import WireNote
from reina.protocol.transport import Loop, TransportState
from reina.sessions.written_part import music_keys

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.instruments import PartRanking
    from reina.music import ClockState, Finding, Score, ScoreWarning
    from reina.music.texts import TextKind
    from reina.sessions.production import Production
    from reina.sessions.record import SessionRecord, StanceRecord


def transport_state(state: ClockState) -> TransportState:
    """The clock's state."""
    return TransportState(
        playing=state.playing,
        song_time_s=state.song_time_s,
        server_time_s=state.server_time_s,
        rate=state.rate,
        loop=loop_of(state),
        count_in_s=state.count_in_s,
        epoch=state.epoch,
    )


def loop_of(state: ClockState) -> Loop | None:
    """The clock's loop."""
    if state.loop is None:
        return None
    start_s, end_s = state.loop
    return Loop(start_s=start_s, end_s=end_s, count_in_s=state.loop_count_in_s)


def transport_message(state: ClockState) -> Transport:
    """The clock's state as a message of the stream."""
    return Transport.model_validate(transport_state(state).model_dump())


def warned(warnings: Iterable[ScoreWarning]) -> list[resources.Warned]:
    """Warnings in their order."""
    return [resources.Warned(**fields) for fields in describe_warnings(warnings)]


def found(findings: Iterable[Finding]) -> list[resources.Finding]:
    """Findings in their order."""
    return [
        resources.Finding(
            kind=finding.kind,
            about=finding.about,
            weight=finding.weight,
            count=finding.count,
            values=dict(finding.values),
            text=finding.text,
            player=finding.player,
            details=warned(finding.details),
        )
        for finding in findings
    ]


def lead_fields(production: Production) -> dict[str, Any]:
    """What the first player plays, as the fields of a session, a score and a `score_changed`."""
    lead = production.cast.lead
    return {
        "part": lead.part,
        "transposition": lead.transposition,
        "written": lead.written,
        "octave_fit": lead.octave_fit,
        "joined_parts": list(lead.joined_parts),
        "handedness": lead.handedness,
        "usual_fingerings": lead.usual_fingerings,
    }


def part_summaries(score: Score) -> list[resources.PartSummary]:
    """The parts of a score, with how many notes each has."""
    return [resources.PartSummary(**fields) for fields in describe_parts(score)]


def cast_resource(production: Production) -> resources.Cast:
    """Who plays what, and why."""
    summary = cast_summary(production)
    castings = [
        resources.Casting(**dict(casting), choices=part_choices(ranking))
        for casting, ranking in zip(summary.castings, production.rankings, strict=True)
    ]
    tune = [
        resources.TunePassage(start_s=passage.start_s, end_s=passage.end_s, player=passage.player)
        for passage in production.tune
    ]
    fields: dict[str, Any] = dict(summary) | {"castings": castings, "tune": tune}
    return resources.Cast(**fields)


def cast_summary(production: Production) -> resources.CastSummary:
    """Who plays what, without what else each could play."""
    score, cast = production.score, production.cast
    castings: list[resources.CastingSummary] = []
    for casting, performer, ranking, why in zip(
        cast.castings,
        production.performers,
        production.rankings,
        production.casting_reasons,
        strict=True,
    ):
        played = performer.played
        castings.append(
            resources.CastingSummary(
                part=played.part,
                part_name=score.parts[played.part].name,
                instrument=casting.instrument,
                player=casting.player,
                seat=performer.seat.name,
                seat_chosen=casting.seat is not None,
                transposition=casting.transposition,
                written=casting.written,
                octave_fit=casting.octave_fit,
                joined_parts=list(played.joined_parts),
                handedness=casting.handedness,
                usual_fingerings=casting.usual_fingerings,
                sounding_transposition=played.transposition,
                notes=len(played.line),
                playable=int(np.count_nonzero(played.fingering.playable)),
                reasons=next(list(choice.reasons) for choice in ranking if choice.part == played.part),
                cast_because=list(why),
            )
        )
    return resources.CastSummary(
        sequence=score.sequence,
        auto=cast.auto,
        castings=castings,
        unplayed=[
            resources.UnplayedPart(part=one.part, part_name=score.parts[one.part].name, reason=one.reason)
            for one in production.unplayed
        ],
    )


def part_choices(ranking: Iterable[PartRanking]) -> list[resources.PartChoice]:
    """How well each part suits an instrument."""
    return [
        resources.PartChoice(part=choice.part, score=choice.score, reasons=list(choice.reasons))
        for choice in ranking
    ]


def wire_note(note: DescribedNote) -> WireNote:
    """A note as the wire has it."""
    return WireNote(**vars(note))


def lyrics(score: Score) -> list[resources.LyricLine]:
    """The lines of a score's lyrics."""
    return [
        resources.LyricLine(
            start_s=line.start_s,
            end_s=line.end_s,
            syllables=[
                resources.SungSyllable(onset_s=syllable.onset_s, text=syllable.text)
                for syllable in line.syllables
            ],
        )
        for line in lyric_lines(score.texts)
    ]


def score_texts(score: Score, kind: TextKind) -> list[resources.ScoreText]:
    """A score's words of one kind."""
    return [
        resources.ScoreText(onset_s=text.onset_s, onset_beats=text.onset_beats, text=text.text)
        for text in score.texts
        if text.kind == kind
    ]


def score_head(production: Production) -> dict[str, Any]:
    """A score as JSON, without its title and its notes."""
    score = production.score
    bar_lines = score.metre_map.bar_lines(score.duration_beats + 1e-9)
    head = resources.Score(
        title="",
        duration_s=score.duration_s,
        sequence=score.sequence,
        **lead_fields(production),
        parts=part_summaries(score),
        tempi=[resources.Tempo(**fields) for fields in describe_tempi(score)],
        metres=[resources.Metre(**fields) for fields in describe_metres(score)],
        keys=music_keys(score, production.played.transposition, production.instrument.written_pitch(0)),
        bar_lines_s=score.tempo_map.seconds(bar_lines).tolist(),
        notes=[],
        lyrics=lyrics(score),
        markers=score_texts(score, "marker"),
        texts=score_texts(score, "text"),
        warnings=warned(production.warnings),
    )
    return head.model_dump(mode="json", exclude={"title", "notes"})


def stances_of(record: SessionRecord) -> list[resources.Stance]:
    """A session's own stances."""
    return [stance_resource(record.id, stance) for stance in record.stances]


def stance_resource(session_id: str, stance: StanceRecord) -> resources.Stance:
    """One of them."""
    return resources.Stance(
        name=stance.name,
        file=stance.file,
        time_s=stance.time_s,
        href=stance_href(session_id, stance.name),
    )
