"""Reina's own score document into a score."""

import numpy as np

from reina.music.controls import Control
from reina.music.document.assemble import PartNotes, assemble
from reina.music.document.channels import Wish, allot_channels
from reina.music.document.model import ScoreDocument
from reina.music.limits import Limits
from reina.music.metre import MetreMap, TimeSignature
from reina.music.score import Score
from reina.music.tempo import TempoMap
from reina.music.warnings import WarningLog


def read_own(document: ScoreDocument, *, title: str, limits: Limits) -> Score:
    """Make the score of a valid document.

    Raises:
        ScoreError: If it holds no note, or a transposed pitch is none.
    """
    log = WarningLog()
    tempo_map = TempoMap([t.beat for t in document.tempos], [60.0 / t.bpm for t in document.tempos])
    signatures = [TimeSignature(s.beat, s.numerator, s.denominator) for s in document.time_signatures]
    channels = allot_channels([Wish(part.program, part.drums) for part in document.parts], log)
    parts: list[PartNotes] = []
    for index, (part, channel) in enumerate(zip(document.parts, channels, strict=True)):
        onset_beats = np.array([note.beat for note in part.notes])
        end_beats = onset_beats + np.array([note.duration for note in part.notes])
        controllers = tuple(
            Control(
                "controller", tempo_map.seconds(entry.beat), entry.beat, channel, entry.number, entry.value
            )
            for entry in part.controllers
        )
        parts.append(
            PartNotes(
                path=f"parts/{index}",
                name=part.name,
                program=part.program,
                is_drums=part.drums,
                channel=channel,
                onset_beats=onset_beats,
                end_beats=end_beats,
                onset_s=tempo_map.seconds(onset_beats),
                end_s=tempo_map.seconds(end_beats),
                pitch=np.array([note.pitch for note in part.notes], dtype=np.int64) + part.transposition,
                velocity=np.array([note.velocity for note in part.notes]),
                controls=controllers,
            )
        )
    metre_map = MetreMap(signatures, pickup_beats=document.pickup_beats)
    return assemble(parts, document.title or title, tempo_map, metre_map, limits=limits, log=log)
