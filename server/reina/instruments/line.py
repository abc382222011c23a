"""The playable line: chords and overlaps of a part become one note at a time, and nothing goes silently."""

import numpy as np

from reina.instruments.joined_parts import notes_of_parts
from reina.instruments.pitch_names import pitch_name
from reina.instruments.played import Line
from reina.music.arrays import read_only
from reina.music.score import Score
from reina.music.warnings import WarningLog

CHORD_S = 0.03
"""Notes that begin within this time and sound together are a chord. In transcribed solos 99 % of the
intervals between changes of fingering are longer (41 ms)."""

SOUND_TOGETHER_S = 0.005
"""Notes that overlap by less follow each other: grace notes do."""

BREATH_S = 0.25
"""A rest of this length begins a new phrase."""

TOLD_OVERLAP_S = 0.001
"""Overlaps of less are cut without a word: they are rounding."""


def playable_line(
    score: Score, part: int, transposition: int, log: WarningLog, *, joined_parts: tuple[int, ...] = ()
) -> Line:
    """Make the line of a part, and of those joined to it as if their notes were its own.

    Of a chord the top note is played. Of two notes that overlap the earlier ends where the later begins,
    unless the later is lower and ends no later: then it is an inner voice and left out.

    Args:
        score: The score.
        part: Index of the part.
        transposition: Semitones added to its pitches.
        log: Is told of each note that is dropped or shortened.
        joined_parts: Indices of the parts joined to it.
    """
    notes = score.notes
    indices = notes_of_parts(score, (part, *joined_parts))
    pitches = notes.sounding_pitch[indices].astype(np.int64) + transposition
    columns = zip(
        indices.tolist(),
        notes.onset_s[indices].tolist(),
        notes.end_s[indices].tolist(),
        pitches.tolist(),
        strict=True,
    )
    dropped: list[int] = []
    shortened: list[int] = []
    line: list[tuple[int, float, float, int]] = []

    def drop(kind: str, note: tuple[int, float, float, int], why: str) -> None:
        dropped.append(note[0])
        log.add(kind, _place(int(notes.part[note[0]]), note), f"{pitch_name(note[3])} is not played: {why}")

    for note in columns:
        index, onset, end, pitch = note
        if not 0 <= pitch <= 127:
            drop("pitch_out_of_midi", note, f"transposed by {transposition} it is no pitch")
            continue
        if line and line[-1][2] > onset:
            last = line[-1]
            overlap = last[2] - onset
            apart = onset - last[1]
            if apart <= SOUND_TOGETHER_S or (apart <= CHORD_S and overlap > SOUND_TOGETHER_S):
                lower, line[-1] = (last, note) if pitch > last[3] else (note, last)
                drop("chord_note_dropped", lower, f"{pitch_name(line[-1][3])} sounds above it")
                continue
            if pitch < last[3] and end <= last[2] + SOUND_TOGETHER_S:
                drop("inner_note_dropped", note, f"{pitch_name(last[3])} is held above it")
                continue
            line[-1] = (last[0], last[1], onset, last[3])
            if overlap > TOLD_OVERLAP_S:
                shortened.append(last[0])
                what = f"{pitch_name(last[3])} ends {overlap * 1000:.0f} ms earlier"
                place = _place(int(notes.part[last[0]]), last)
                log.add("note_shortened", place, f"{what}, where {pitch_name(pitch)} begins")
        line.append((index, onset, end, pitch))
    table = np.array(line, dtype=np.float64).reshape(-1, 4)
    note_index = table[:, 0].astype(np.int64)
    onset_s, end_s = table[:, 1], table[:, 2]
    rests = onset_s[1:] - end_s[:-1] >= BREATH_S
    return Line(
        note_index=read_only(note_index),
        onset_s=read_only(onset_s),
        end_s=read_only(end_s),
        sounding_pitch=read_only(table[:, 3].astype(np.int64)),
        velocity=read_only(notes.velocity[note_index]),
        phrase=read_only(np.concatenate((np.zeros(1), np.cumsum(rests)))[: len(table)].astype(np.int64)),
        dropped=read_only(np.array(sorted(dropped), dtype=np.int64)),
        shortened=read_only(np.array(sorted(set(shortened) - set(dropped)), dtype=np.int64)),
    )


def _place(part: int, note: tuple[int, float, float, int]) -> str:
    return f"part {part}, note {note[0]} at {note[1]:.3f} s"
