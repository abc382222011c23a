"""The parts of a document into one score."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.music.arrays import FloatArray, IntArray
from reina.music.controls import Control
from reina.music.errors import ScoreError
from reina.music.gm import PROGRAM_NAMES
from reina.music.key_signature import KeySignature
from reina.music.limits import Limits
from reina.music.metre import MetreMap
from reina.music.notes import NO_PROGRAM, UNSAID, Notes
from reina.music.score import Part, Score
from reina.music.taps import TAP_S, lengthen_taps
from reina.music.tempo import TempoMap
from reina.music.texts import ScoreText
from reina.music.warnings import WarningLog


@dataclass(frozen=True)
class PartNotes:
    """One part of a document, its notes as columns of one length.

    Attributes:
        path: Where in the document it stands.
        note_index: Where each note stands in the part's list.
        tongued: As `Notes.tongued`, None where nothing says it.
    """

    path: str
    name: str
    program: int | None
    is_drums: bool
    channel: int
    onset_beats: FloatArray
    end_beats: FloatArray
    onset_s: FloatArray
    end_s: FloatArray
    pitch: IntArray
    velocity: FloatArray
    controls: tuple[Control, ...]
    note_index: IntArray
    tongued: IntArray | None = None


def assemble(
    parts: Sequence[PartNotes],
    title: str,
    tempo_map: TempoMap,
    metre_map: MetreMap,
    *,
    key_signatures: tuple[KeySignature, ...] = (),
    texts: tuple[ScoreText, ...] = (),
    limits: Limits,
    log: WarningLog,
) -> Score:
    """Put the parts together; those without notes are left out.

    Raises:
        ScoreError: If no part has a note, or a pitch is none.
        ScoreLimitError: If the score is beyond `limits`.
    """
    played = [part for part in parts if len(part.pitch)]
    if not played:
        raise ScoreError("the score holds no note", location="/")
    for part in played:
        wrong = np.flatnonzero((part.pitch < 0) | (part.pitch > 127))
        if len(wrong):
            number = int(part.pitch[wrong[0]])
            raise ScoreError(
                f"the pitch is {number}; 0 to 127 sound", location=f"{part.path}/notes/{wrong[0]}/pitch"
            )
    for part in parts:
        if not len(part.pitch):
            log.add("empty_part", part.path, "a part without notes was left out")
    path = np.concatenate([np.full(len(part.pitch), index) for index, part in enumerate(played)])
    onset_s = np.concatenate([part.onset_s for part in played])
    onset_beats = np.concatenate([part.onset_beats for part in played])
    end_s = np.concatenate([part.end_s for part in played])
    end_beats = np.concatenate([part.end_beats for part in played])
    # What is shorter than the last digit of its onset has no length in beats.
    end_s = np.where(end_beats <= onset_beats, onset_s, end_s)
    end_s, end_beats, taps = lengthen_taps(onset_s, end_s, end_beats, tempo_map)
    note_index = np.concatenate([part.note_index for part in played])
    for note in taps.tolist():
        place = f"{played[int(path[note])].path}/notes/{note_index[note]}"
        log.add("zero_length_note", place, f"has no duration; it sounds for {TAP_S * 1000:.0f} ms")
    limits.check("duration_s", float(np.max(end_s)), what="length in seconds")
    limits.check("beats", float(np.max(end_beats)), what="length in beats")
    limits.check("bars", metre_map.bar_count(float(np.max(end_beats))), what="number of bars")
    programs = [
        Control("program", 0.0, 0.0, part.channel, 0, part.program)
        for part in played
        if part.program is not None
    ]
    controls = [*programs, *(control for part in played for control in part.controls)]
    notes = Notes.from_columns(
        part=path,
        channel=np.array([part.channel for part in played])[path],
        onset_s=onset_s,
        duration_s=end_s - onset_s,
        onset_beats=onset_beats,
        duration_beats=end_beats - onset_beats,
        sounding_pitch=np.concatenate([part.pitch for part in played]),
        velocity=np.concatenate([part.velocity for part in played]),
        tongued=np.concatenate(
            [np.full(len(part.pitch), UNSAID) if part.tongued is None else part.tongued for part in played]
        ),
        program=np.array([NO_PROGRAM if part.program is None else part.program for part in played])[path],
    )
    return Score(
        title=title,
        parts=tuple(_part(index, part) for index, part in enumerate(played)),
        notes=notes,
        tempo_map=tempo_map,
        metre_map=metre_map,
        controls=tuple(sorted(controls, key=lambda control: control.onset_s)),
        warnings=log.warnings(),
        duration_s=float(np.max(notes.end_s)),
        key_signatures=key_signatures,
        texts=texts,
    )


def _part(index: int, part: PartNotes) -> Part:
    known = "Drums" if part.is_drums else PROGRAM_NAMES[part.program] if part.program is not None else ""
    name = part.name or known or f"Part {index + 1}"
    return Part(index, name, part.program, part.is_drums, part.channel, named=bool(part.name))
