"""A score as Reina's own score document."""

from typing import TYPE_CHECKING, Any

from reina.music.notes import UNSAID
from reina.music.retime import from_second_zero
from reina.music.score import Part, Score

if TYPE_CHECKING:
    from reina.music.texts import TextKind

MAX_TEXT = 500


def score_document(score: Score) -> dict[str, Any]:
    """Return a score as a document that `read_score` reads again: `score.schema.json` says its form.

    Read again it has the same notes, parts, tempos, metres, keys and texts. Pitch bends, and programs that
    change within a part, have no place in the form.
    """
    score = from_second_zero(score)
    metre = score.metre_map
    document: dict[str, Any] = {
        "format": "reina-score",
        "version": 1,
        "title": score.title[:MAX_TEXT],
        "tempos": [{"beat": t.onset_beats, "bpm": t.beats_per_minute} for t in score.tempo_map.tempos],
        "time_signatures": [
            {"beat": s.onset_beats, "numerator": s.numerator, "denominator": s.denominator}
            for s in metre.signatures
        ],
        "key_signatures": [
            {"beat": k.onset_beats, "fifths": k.fifths, "mode": "minor" if k.is_minor else "major"}
            for k in score.key_signatures
        ],
        "pickup_beats": metre.pickup_beats,
        "parts": [_part(score, part) for part in score.parts],
    }
    kinds: tuple[tuple[str, TextKind], ...] = (("lyrics", "lyric"), ("markers", "marker"), ("words", "text"))
    for name, kind in kinds:
        texts = [
            {"beat": max(text.onset_beats, 0.0), "text": text.text[:MAX_TEXT]}
            for text in score.texts
            if text.kind == kind and text.text
        ]
        if texts:
            document[name] = texts
    return document


def _part(score: Score, part: Part) -> dict[str, Any]:
    notes = score.notes
    made: dict[str, Any] = {"name": part.name if part.named else "", "drums": part.is_drums, "notes": []}
    if part.program is not None:
        made["program"] = part.program
    for index in score.note_indices(part.index).tolist():
        note = notes[index]
        entry: dict[str, Any] = {
            "beat": note.onset_beats,
            "duration": note.duration_beats,
            "pitch": note.sounding_pitch,
            "velocity": note.velocity,
        }
        if notes.tongued[index] != UNSAID:
            entry["tongued"] = bool(notes.tongued[index])
        made["notes"].append(entry)
    controllers = [
        {"beat": control.onset_beats, "number": control.number, "value": control.value}
        for control in score.controls
        if control.kind == "controller" and control.channel == part.channel
    ]
    if controllers:
        made["controllers"] = controllers
    return made
