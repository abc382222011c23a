"""A session's score, notes and clock as the wire tells them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from reina.instruments import NoteNames, ValvesFingering
from reina.music.lyrics import lyric_lines
from reina.protocol import resources
from reina.protocol.messages import Transport
from reina.protocol.notes import WireNote
from reina.protocol.transport import Loop, TransportState
from reina.sessions.written_part import music_keys
from reina.system.json_text import Written, json_text

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.instruments import PartRanking
    from reina.music import ClockState, Finding, Score, ScoreWarning
    from reina.music.texts import TextKind
    from reina.sessions.production import Production

NOT_PLAYED = "nobody plays this part"
NOT_IN_LINE = "the player plays one note at a time, and another one sounds here"
NO_PITCH = "the part is moved so far that this note is no pitch"


def transport_state(state: ClockState) -> TransportState:
    """The clock's state."""
    return TransportState(
        playing=state.playing,
        song_time_s=state.song_time_s,
        server_time_s=state.server_time_s,
        rate=state.rate,
        loop=Loop(start_s=state.loop[0], end_s=state.loop[1]) if state.loop else None,
        epoch=state.epoch,
    )


def transport_message(state: ClockState) -> Transport:
    """The clock's state as a message of the stream."""
    return Transport.model_validate(transport_state(state).model_dump())


def warned(warnings: Iterable[ScoreWarning]) -> list[resources.Warned]:
    """Warnings in their order."""
    return [
        resources.Warned(kind=warning.kind, place=warning.place, message=warning.message)
        for warning in warnings
    ]


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
    counts = np.bincount(score.notes.part, minlength=len(score.parts))
    return [
        resources.PartSummary(
            index=part.index,
            name=part.name,
            program=part.program,
            is_drums=part.is_drums,
            notes=int(counts[part.index]),
        )
        for part in score.parts
    ]


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


class NoteTable:
    """The notes of a production's score, with the fingering of those that are played."""

    def __init__(self, production: Production) -> None:
        self._production = production
        performers = list(enumerate(production.performers))
        self._names = NoteNames(
            production.score, [(one.instrument, one.played) for one in production.performers]
        )
        self._usual = [
            {note.sounding_pitch: list(note.fingerings[0]) for note in one.instrument.fingering_chart}
            for one in production.performers
        ]
        self._player_of_part = {part: player for player, one in performers for part in one.played.parts}
        self._line_of_note = {
            note: number
            for _, one in performers
            for number, note in enumerate(one.played.line.note_index.tolist())
        }

    def note(self, index: int) -> WireNote:
        """A note by its place in the score's table."""
        production = self._production
        note = production.score.notes[index]
        pitch, played_so, reason = note.sounding_pitch, None, NOT_PLAYED
        sounding_name, written_name = self._names.of(index)
        player = self._player_of_part.get(note.part)
        performer = production.performers[player or 0]
        number = self._line_of_note.get(index)
        if number is not None:
            fingering = performer.played.fingering
            pitch = int(performer.played.line.sounding_pitch[number])
            played_so, reason = fingering.notes[number], fingering.reasons[number]
        elif player is not None:
            # What the player leaves out stands, and is heard, where the rest of the part does.
            moved = pitch + performer.played.transposition
            pitch, reason = (moved, NOT_IN_LINE) if 0 <= moved <= 127 else (pitch, NO_PITCH)
        return WireNote(
            index=index,
            part=note.part,
            onset_s=note.onset_s,
            duration_s=note.duration_s,
            onset_beats=note.onset_beats,
            duration_beats=note.duration_beats,
            sounding_pitch=pitch,
            written_pitch=performer.instrument.written_pitch(pitch),
            sounding_name=sounding_name,
            written_name=written_name,
            velocity=note.velocity,
            valves=list(played_so.valves) if isinstance(played_so, ValvesFingering) else None,
            usual_valves=self._usual[player or 0][pitch] if isinstance(played_so, ValvesFingering) else None,
            fingering=played_so,
            reason=reason,
            player=player,
            in_played_part=player is not None,
        )


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


def score_text(production: Production, title: str, part: int | None = None) -> bytes:
    """The whole score as JSON, or the notes of one part of it alone.

    Written note by note: as one, a long score would hold the interpreter's lock for most of a second.
    """
    score = production.score
    table = NoteTable(production)
    indices = range(len(score.notes)) if part is None else score.note_indices(part)
    tempo_map, metre_map = score.tempo_map, score.metre_map
    bar_lines = metre_map.bar_lines(score.duration_beats + 1e-9)
    head = resources.Score(
        title=title,
        duration_s=score.duration_s,
        sequence=score.sequence,
        **lead_fields(production),
        parts=part_summaries(score),
        tempi=[
            resources.Tempo(onset_beats=tempo.onset_beats, onset_s=tempo.onset_s, bpm=tempo.beats_per_minute)
            for tempo in tempo_map.tempos
        ],
        metres=[
            resources.Metre(
                onset_beats=signature.onset_beats,
                onset_s=tempo_map.seconds(signature.onset_beats),
                numerator=signature.numerator,
                denominator=signature.denominator,
            )
            for signature in metre_map.signatures
        ],
        keys=music_keys(score, production.played.transposition, production.instrument.written_pitch(0)),
        bar_lines_s=tempo_map.seconds(bar_lines).tolist(),
        notes=[],
        lyrics=lyrics(score),
        markers=score_texts(score, "marker"),
        texts=score_texts(score, "text"),
        warnings=warned(production.warnings),
    )
    notes = [Written(table.note(int(index)).model_dump_json().encode()) for index in indices]
    return json_text({**head.model_dump(mode="json"), "notes": notes})
