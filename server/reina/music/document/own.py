"""Reina's own score document into a score."""

import numpy as np

from reina.music.arrays import FloatArray, IntArray
from reina.music.controls import Control
from reina.music.document.assemble import PartNotes, assemble
from reina.music.document.channels import Wish, allot_channels
from reina.music.document.model import DEFAULT_VELOCITY, NoteEntry, PartEntry, ScoreDocument, TextEntry
from reina.music.errors import ScoreError
from reina.music.key_signature import KeySignature, in_order
from reina.music.limits import Limits
from reina.music.metre import MetreMap, TimeSignature
from reina.music.notes import UNSAID
from reina.music.score import Score
from reina.music.tempo import TempoMap
from reina.music.texts import ScoreText, TextKind
from reina.music.warnings import WarningLog

SAME_BEAT = 1e-6


def read_own(document: ScoreDocument, *, title: str, limits: Limits, log: WarningLog) -> Score:
    """Make the score of a valid document.

    Raises:
        ScoreError: If it holds no note, or a transposed pitch is none.
    """
    tempos = document.tempos or []
    tempo_map = TempoMap([t.beat for t in tempos], [60.0 / t.bpm for t in tempos])
    signatures = [TimeSignature(s.beat, s.numerator, s.denominator) for s in document.time_signatures or []]
    channels = allot_channels([Wish(part.program, bool(part.drums)) for part in document.parts])
    parts: list[PartNotes] = []
    for index, (part, channel) in enumerate(zip(document.parts, channels, strict=True)):
        notes = part.notes or []
        onset_beats = np.array([note.beat for note in notes])
        end_beats = onset_beats + np.array([note.duration for note in notes])
        controllers = tuple(
            Control(
                "controller", tempo_map.seconds(entry.beat), entry.beat, channel, entry.number, entry.value
            )
            for entry in part.controllers or []
        )
        parts.append(
            PartNotes(
                path=f"parts/{index}",
                name=part.name or "",
                program=part.program,
                is_drums=bool(part.drums),
                channel=channel,
                onset_beats=onset_beats,
                end_beats=end_beats,
                onset_s=tempo_map.seconds(onset_beats),
                end_s=tempo_map.seconds(end_beats),
                pitch=np.array([note.pitch for note in notes], dtype=np.int64) + (part.transposition or 0),
                velocity=np.array([_velocity(note) for note in notes]),
                controls=controllers,
                note_index=np.arange(len(notes)),
                tongued=_tongued(part, onset_beats, f"parts/{index}"),
            )
        )
    metre_map = MetreMap(signatures, pickup_beats=document.pickup_beats or 0.0)
    keys = in_order(
        [KeySignature(k.beat, k.fifths, k.mode == "minor") for k in document.key_signatures or []]
    )
    return assemble(
        parts,
        document.title or title,
        tempo_map,
        metre_map,
        key_signatures=keys,
        texts=_texts(document, tempo_map),
        limits=limits,
        log=log,
    )


def _tongued(part: PartEntry, onset_beats: FloatArray, path: str) -> IntArray:
    """Return how the notes of a part begin, (N,) as `Notes.tongued`.

    Raises:
        ScoreError: If no note begins under a slur.
    """
    tongued = np.full(len(onset_beats), UNSAID if part.slurs is None else 1, dtype=np.int64)
    order = np.argsort(onset_beats, kind="stable")
    ascending = onset_beats[order]
    for index, slur in enumerate(part.slurs or []):
        first, last = np.searchsorted(ascending, (slur.beat + SAME_BEAT, slur.end_beat + SAME_BEAT))
        if first == last:
            raise ScoreError(
                f"no note begins after beat {slur.beat:g} and by beat {slur.end_beat:g}, under the slur",
                location=f"{path}/slurs/{index}",
            )
        tongued[order[first:last]] = 0
    for index, note in enumerate(part.notes or []):
        if note.tongued is not None:
            tongued[index] = note.tongued
    return tongued


def _texts(document: ScoreDocument, tempo_map: TempoMap) -> tuple[ScoreText, ...]:
    kinds: tuple[tuple[TextKind, list[TextEntry] | None], ...] = (
        ("lyric", document.lyrics),
        ("marker", document.markers),
        ("text", document.words),
    )
    texts = [
        ScoreText(kind, tempo_map.seconds(entry.beat), entry.beat, entry.text)
        for kind, entries in kinds
        for entry in entries or []
    ]
    return tuple(sorted(texts, key=lambda text: text.onset_beats))


def _velocity(note: NoteEntry) -> float:
    return DEFAULT_VELOCITY if note.velocity is None else note.velocity
