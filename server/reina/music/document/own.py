"""Reina's own score document into a score."""

import numpy as np

from reina.music.controls import Control
from reina.music.document.assemble import PartNotes, assemble
from reina.music.document.channels import Wish, allot_channels
from reina.music.document.model import DEFAULT_VELOCITY, NoteEntry, ScoreDocument
from reina.music.key_signature import KeySignature, in_order
from reina.music.limits import Limits
from reina.music.metre import MetreMap, TimeSignature
from reina.music.score import Score
from reina.music.tempo import TempoMap
from reina.music.warnings import WarningLog


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
            )
        )
    metre_map = MetreMap(signatures, pickup_beats=document.pickup_beats or 0.0)
    keys = in_order(
        [KeySignature(k.beat, k.fifths, k.mode == "minor") for k in document.key_signatures or []]
    )
    return assemble(
        parts, document.title or title, tempo_map, metre_map, key_signatures=keys, limits=limits, log=log
    )


def _velocity(note: NoteEntry) -> float:
    return DEFAULT_VELOCITY if note.velocity is None else note.velocity
