"""A score and its fingering as plain data, for JSON and for tables."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from reina.instruments.casting import Casting
from reina.instruments.choice_findings import choice_findings, spoken_name
from reina.instruments.instrument import Instrument
from reina.instruments.note_fingerings import NoteFingering, ValvesFingering
from reina.instruments.note_names import NoteNames
from reina.instruments.played import PlayedPart
from reina.instruments.ranking import PartRanking
from reina.music.findings import Finding, findings_of
from reina.music.warnings import ScoreWarning
from reina.music.lyrics import lyric_lines
from reina.music.score import Score
from reina.music.texts import ScoreText
from reina.notation import keys_of


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
    counts = np.bincount(score.notes.part, minlength=len(score.parts)).tolist()
    moved = played.transposition + instrument.written_pitch(0)
    bar_lines = score.metre_map.bar_lines(score.duration_beats)
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
                "index": known.index,
                "name": known.name,
                "program": known.program,
                "is_drums": known.is_drums,
                "notes": counts[known.index],
                "score": ranking_of[known.index].score,
                "reasons": list(ranking_of[known.index].reasons),
            }
            for known in score.parts
        ],
        "tempo": [
            {"onset_beats": tempo.onset_beats, "onset_s": tempo.onset_s, "bpm": tempo.beats_per_minute}
            for tempo in score.tempo_map.tempos
        ],
        "metre": [
            {
                "onset_beats": signature.onset_beats,
                "onset_s": score.tempo_map.seconds(signature.onset_beats),
                "numerator": signature.numerator,
                "denominator": signature.denominator,
            }
            for signature in score.metre_map.signatures
        ],
        "keys": [
            {
                "onset_beats": key.onset_beats,
                "name": key.name,
                "fifths": key.fifths,
                "written_name": (written := key.transposed(moved)).name,
                "written_fifths": written.fifths,
                "source": key.source,
            }
            for key in keys_of(score)
        ],
        "pickup_beats": score.metre_map.pickup_beats,
        "bar_lines_s": score.tempo_map.seconds(bar_lines).tolist(),
        "lyrics": [{"start_s": line.start_s, "text": line.text} for line in lyric_lines(score.texts)],
        "markers": [_text(text) for text in score.texts if text.kind == "marker"],
        "texts": [_text(text) for text in score.texts if text.kind == "text"],
        "notes": describe_notes(score, instrument, played, part),
        "warnings": [describe_warning(warning) for warning in (*score.warnings, *played.warnings)],
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


def describe_warning(warning: ScoreWarning) -> dict[str, Any]:
    """Return a warning as JSON has it."""
    return {"kind": warning.kind, "place": warning.place, "message": warning.message}


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
        "details": [describe_warning(warning) for warning in finding.details],
    }
def _text(text: ScoreText) -> dict[str, Any]:
    return {"onset_beats": text.onset_beats, "onset_s": text.onset_s, "text": text.text}


def describe_notes(
    score: Score, instrument: Instrument, played: PlayedPart, part: int | None = None
) -> list[dict[str, Any]]:
    """Return the notes of a score, or of one part; those that are played with their fingering.

    A note of the played part, or of one joined to it, has the pitch it is played at. A note that is not
    played has no fingering (None), with the reason.
    """
    line, fingering = played.line, played.fingering
    place_in_line = {note: place for place, note in enumerate(line.note_index.tolist())}
    shortened = set(line.shortened.tolist())
    names = NoteNames(score, [(instrument, played)])
    usual = {note.sounding_pitch: note.fingerings[0] for note in instrument.fingering_chart}
    described: list[dict[str, Any]] = []
    for index in range(len(score.notes)) if part is None else score.note_indices(part).tolist():
        note = score.notes[index]
        place = place_in_line.get(index)
        own = note.part in played.parts
        pitch = note.sounding_pitch + (played.transposition if own else 0)
        played_so: NoteFingering | None = None
        sounding_name, written_name = names.of(index)
        reason = "another part than the player's"
        if place is not None:
            played_so, reason = fingering.notes[place], fingering.reasons[place]
        elif own:
            reason = "not in the playable line: another note of the part sounds at its time"
        described.append(
            {
                "index": index,
                "part": note.part,
                "onset_s": note.onset_s,
                "duration_s": note.duration_s,
                "onset_beats": note.onset_beats,
                "duration_beats": note.duration_beats,
                "sounding_pitch": pitch,
                "written_pitch": instrument.written_pitch(pitch),
                "sounding_name": sounding_name,
                "written_name": written_name,
                "velocity": note.velocity,
                "valves": list(played_so.valves) if isinstance(played_so, ValvesFingering) else None,
                "usual_valves": list(usual[pitch]) if isinstance(played_so, ValvesFingering) else None,
                "fingering": None if played_so is None else played_so.model_dump(mode="json"),
                "reason": reason,
                "played_duration_s": None
                if place is None
                else float(line.end_s[place] - line.onset_s[place]),
                "shortened": index in shortened,
            }
        )
    return described
