"""A score and how it is played as plain data: for the wire, for JSON and for tables."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from reina.instruments.casting import Casting
from reina.instruments.choice_findings import choice_findings, spoken_name
from reina.instruments.instrument import MAX_PITCH, Instrument
from reina.instruments.note_fingerings import NoteFingering, ValvesFingering
from reina.instruments.note_names import NoteNames
from reina.instruments.played import PlayedPart
from reina.instruments.ranking import PartRanking
from reina.music.arrays import read_only
from reina.music.findings import Finding, findings_of
from reina.music.lyrics import lyric_lines
from reina.music.score import Score
from reina.music.texts import ScoreText
from reina.music.warnings import ScoreWarning
from reina.notation import keys_of

NOT_PLAYED = "nobody plays this part"
NOT_IN_LINE = "the player plays one note at a time, and another one sounds here"
NO_PITCH = "the part is moved so far that this note is no pitch"


@dataclass(frozen=True)
class DescribedNote:
    """A note of a score, with its fingering where somebody plays it; the fields are those of the wire."""

    index: int
    part: int
    onset_s: float
    duration_s: float
    onset_beats: float
    duration_beats: float
    sounding_pitch: int
    """As it is played, for a note of a part that is played."""
    written_pitch: int
    sounding_name: str
    written_name: str
    velocity: float
    valves: list[int] | None
    usual_valves: list[int] | None
    fingering: NoteFingering | None
    reason: str
    player: int | None
    in_played_part: bool


class NoteTable:
    """The notes of a score as a cast plays them.

    Args:
        score: The score.
        players: What each player plays, and on what, in the cast's order.
    """

    def __init__(self, score: Score, players: Sequence[tuple[Instrument, PlayedPart]]) -> None:
        self._score = score
        self._players = players
        self._names = NoteNames(score, players)
        self._usual = [
            {note.sounding_pitch: list(note.fingerings[0]) for note in instrument.fingering_chart}
            for instrument, _ in players
        ]
        self._player_of_part = {
            part: player for player, (_, played) in enumerate(players) for part in played.parts
        }
        place_in_line = np.full(len(score.notes), -1, dtype=np.int32)
        for _, played in players:
            place_in_line[played.line.note_index] = np.arange(len(played.line))
        self._place_in_line = read_only(place_in_line)

    def note(self, index: int) -> DescribedNote:
        """A note by its place in the score's table."""
        note = self._score.notes[index]
        pitch, played_so, reason = note.sounding_pitch, None, NOT_PLAYED
        sounding_name, written_name = self._names.of(index)
        player = self._player_of_part.get(note.part)
        instrument, played = self._players[player or 0]
        place = int(self._place_in_line[index])
        if place >= 0:
            pitch = int(played.line.sounding_pitch[place])
            played_so, reason = played.fingering.notes[place], played.fingering.reasons[place]
        elif player is not None:
            # What the player leaves out stands, and is heard, where the rest of the part does.
            moved = pitch + played.transposition
            pitch, reason = (moved, NOT_IN_LINE) if 0 <= moved <= MAX_PITCH else (pitch, NO_PITCH)
        on_valves = isinstance(played_so, ValvesFingering)
        return DescribedNote(
            index=index,
            part=note.part,
            onset_s=note.onset_s,
            duration_s=note.duration_s,
            onset_beats=note.onset_beats,
            duration_beats=note.duration_beats,
            sounding_pitch=pitch,
            written_pitch=instrument.written_pitch(pitch),
            sounding_name=sounding_name,
            written_name=written_name,
            velocity=note.velocity,
            valves=list(played_so.valves) if on_valves else None,
            usual_valves=self._usual[player or 0][pitch] if on_valves else None,
            fingering=played_so,
            reason=reason,
            player=player,
            in_played_part=player is not None,
        )


def describe_score(
    score: Score,
    instrument: Instrument,
    played: PlayedPart,
    *,
    rankings: tuple[PartRanking, ...] | None = None,
    part: int | None = None,
) -> dict[str, Any]:
    """Return a score and how one of its parts is played, as JSON has it.

    Args:
        score: The score.
        instrument: What plays.
        played: How it plays its part.
        rankings: How well each part suits it, if known; else they are made.
        part: The part whose notes are listed; all parts' by default.
    """
    ranking_of = {ranking.part: ranking for ranking in rankings or instrument.rank_parts(score)}
    return {
        "title": score.title,
        "duration_s": score.duration_s,
        "sequence": score.sequence,
        "sequences": score.sequences,
        "instrument": instrument.name,
        "part": played.part,
        "joined_parts": list(played.joined_parts),
        "transposition": played.transposition,
        "parts": [
            {
                **known,
                "score": ranking_of[known["index"]].score,
                "reasons": list(ranking_of[known["index"]].reasons),
            }
            for known in describe_parts(score)
        ],
        "tempo": describe_tempi(score),
        "metre": describe_metres(score),
        "keys": describe_keys(score, played.transposition, instrument.written_pitch(0)),
        "pickup_beats": score.metre_map.pickup_beats,
        "bar_lines_s": score.tempo_map.seconds(score.metre_map.bar_lines(score.duration_beats)).tolist(),
        "lyrics": [{"start_s": line.start_s, "text": line.text} for line in lyric_lines(score.texts)],
        "markers": [_text(text) for text in score.texts if text.kind == "marker"],
        "texts": [_text(text) for text in score.texts if text.kind == "text"],
        "notes": describe_notes(score, instrument, played, part),
        "warnings": describe_warnings((*score.warnings, *played.warnings)),
        "findings": [
            describe_finding(finding)
            for finding in score_findings(score, instrument, played, ranking_of[played.part].reasons)
        ],
    }


def score_findings(
    score: Score, instrument: Instrument, played: PlayedPart, reasons: Sequence[str] = ()
) -> tuple[Finding, ...]:
    """Return what a musician is told of a score of which one part is played.

    Args:
        score: The score.
        instrument: What plays.
        played: How it plays its part.
        reasons: Why it is that part.
    """
    casting = Casting(part=played.part, instrument=instrument.name, joined_parts=played.joined_parts)
    return (
        *choice_findings(score, [casting], {instrument.name: instrument}, [reasons]),
        *findings_of(played.warnings, player=0, instrument=spoken_name(instrument.name)),
        *findings_of(score.warnings),
    )


def describe_finding(finding: Finding) -> dict[str, Any]:
    """Return what a musician is told as JSON has it."""
    return {
        "kind": finding.kind,
        "about": finding.about,
        "weight": finding.weight,
        "count": finding.count,
        "values": dict(finding.values),
        "text": finding.text,
        "player": finding.player,
        "details": describe_warnings(finding.details),
    }


def _text(text: ScoreText) -> dict[str, Any]:
    return {"onset_beats": text.onset_beats, "onset_s": text.onset_s, "text": text.text}


def describe_notes(
    score: Score, instrument: Instrument, played: PlayedPart, part: int | None = None
) -> list[dict[str, Any]]:
    """Return the notes of a score, or of one part; those that are played with their fingering and length.

    A note of the played part, or of one joined to it, has the pitch it is played at. A note that is not
    played has no fingering (None), with the reason.
    """
    line, table = played.line, NoteTable(score, [(instrument, played)])
    sounds_s = dict(zip(line.note_index.tolist(), (line.end_s - line.onset_s).tolist(), strict=True))
    shortened = set(line.shortened.tolist())
    described: list[dict[str, Any]] = []
    for index in range(len(score.notes)) if part is None else score.note_indices(part).tolist():
        note = table.note(index)
        fingering = None if note.fingering is None else note.fingering.model_dump(mode="json")
        lasts = {"played_duration_s": sounds_s.get(index), "shortened": index in shortened}
        described.append({**vars(note), "fingering": fingering, **lasts})
    return described


def describe_parts(score: Score) -> list[dict[str, Any]]:
    """The parts of a score, with how many notes each has."""
    counts = np.bincount(score.notes.part, minlength=len(score.parts)).tolist()
    return [
        {
            "index": part.index,
            "name": part.name,
            "program": part.program,
            "is_drums": part.is_drums,
            "notes": counts[part.index],
        }
        for part in score.parts
    ]


def describe_tempi(score: Score) -> list[dict[str, float]]:
    """Each tempo and where it begins."""
    return [
        {"onset_beats": tempo.onset_beats, "onset_s": tempo.onset_s, "bpm": tempo.beats_per_minute}
        for tempo in score.tempo_map.tempos
    ]


def describe_metres(score: Score) -> list[dict[str, Any]]:
    """Each metre and where it begins."""
    return [
        {
            "onset_beats": signature.onset_beats,
            "onset_s": score.tempo_map.seconds(signature.onset_beats),
            "numerator": signature.numerator,
            "denominator": signature.denominator,
        }
        for signature in score.metre_map.signatures
    ]


def describe_keys(score: Score, moved: int, above: int) -> list[dict[str, Any]]:
    """The keys of a part, as they sound and as they are written.

    Args:
        score: The score.
        moved: Semitones by which the part is played away from the file's pitches.
        above: Semitones from a pitch that sounds to the one that is written.
    """
    return [
        {
            "onset_beats": key.onset_beats,
            "onset_s": score.tempo_map.seconds(key.onset_beats),
            "name": (sounding := key.transposed(moved)).name,
            "fifths": sounding.fifths,
            "written_name": (written := key.transposed(moved + above)).name,
            "written_fifths": written.fifths,
            "source": key.source,
        }
        for key in keys_of(score)
    ]


def describe_warnings(warnings: Iterable[ScoreWarning]) -> list[dict[str, str]]:
    """Warnings in their order."""
    return [
        {"kind": warning.kind, "place": warning.place, "message": warning.message} for warning in warnings
    ]
