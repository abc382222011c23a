"""The playable line: chords and overlaps of a part become one note at a time, and nothing goes silently."""

from bisect import bisect_left
from collections.abc import Container
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from reina.instruments.joined_parts import notes_of_parts
from reina.instruments.pitch_names import pitch_name
from reina.instruments.played import Line
from reina.music.arrays import read_only
from reina.music.notes import Notes
from reina.music.score import Score
from reina.music.taps import TAP_S
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

GRACE_S = 0.09
"""What is no longer, and lasts a third of the note that it begins with at most, ornaments that note: a
thirty-second note at 90 beats a minute does."""

EARLY_GRACE_S = 0.13
"""So it is up to this length with what begins before that note."""

LEGATO_S = 0.08
"""How far a note may reach into the next where both are meant to follow each other."""

ROUNDING_S = 1e-6


class _Note(NamedTuple):
    note: int
    onset_s: float
    end_s: float
    pitch: int

    @property
    def duration_s(self) -> float:
        return self.end_s - self.onset_s

    def ornaments(self, other: "_Note") -> bool:
        """Whether it is an ornament of a note at its place: written without length, or far shorter."""
        if self.pitch == other.pitch:
            return False
        is_tap = abs(self.duration_s - TAP_S) < ROUNDING_S
        if is_tap and other.duration_s > self.duration_s + ROUNDING_S:
            return True
        is_early = self.onset_s < other.onset_s - SOUND_TOGETHER_S
        longest = EARLY_GRACE_S if is_early else GRACE_S
        return self.duration_s <= longest and 3 * self.duration_s <= other.duration_s


def playable_line(
    score: Score,
    part: int,
    transposition: int,
    log: WarningLog,
    *,
    joined_parts: tuple[int, ...] = (),
    playable: Container[int] = range(128),
) -> Line:
    """Make the line of a part, and of those joined to it as if their notes were its own.

    Of a chord the top note is played. Of two notes that overlap the earlier ends where the later begins,
    unless the later is lower and ends no later: then it is an inner voice and left out. An ornament that
    begins with its note sounds before it where there is room, else it is left out. What the instrument does
    not have is in the line only where it takes the place of nothing that can be played.

    Args:
        score: The score.
        part: Index of the part.
        transposition: Semitones added to its pitches.
        log: Is told of each note that is dropped or shortened.
        joined_parts: Indices of the parts joined to it.
        playable: The sounding pitches that the instrument has.
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
    maker = _LineMaker(notes, log)
    within: list[_Note] = []
    beyond: list[_Note] = []
    for note in map(_Note._make, columns):
        if not 0 <= note.pitch <= 127:
            maker.drop("pitch_out_of_midi", note, f"transposed by {transposition} it is no pitch")
        else:
            (within if note.pitch in playable else beyond).append(note)
    line = maker.one_at_a_time(within)
    if beyond:
        line = maker.fill_in(line, beyond)
    table = np.array(line, dtype=np.float64).reshape(-1, 4)
    note_index = table[:, 0].astype(np.int32)
    onset_s, end_s = table[:, 1], table[:, 2]
    rests = onset_s[1:] - end_s[:-1] >= BREATH_S
    return Line(
        note_index=read_only(note_index),
        onset_s=read_only(onset_s),
        end_s=read_only(end_s),
        sounding_pitch=read_only(table[:, 3].astype(np.int32)),
        velocity=read_only(notes.velocity[note_index]),
        phrase=read_only(np.concatenate((np.zeros(1), np.cumsum(rests)))[: len(table)].astype(np.int32)),
        dropped=read_only(np.array(sorted(maker.dropped), dtype=np.int64)),
        shortened=read_only(np.array(sorted(maker.shortened - maker.dropped), dtype=np.int64)),
        tongued=read_only(notes.tongued[note_index]),
    )


class _LineMaker:
    """Makes lines of notes, and keeps what became of those that are not in them as they were."""

    def __init__(self, notes: Notes, log: WarningLog) -> None:
        self._notes = notes
        self._log = log
        self.dropped: set[int] = set()
        self.shortened: set[int] = set()
        self._above_chords: set[int] = set()

    def drop(self, kind: str, note: _Note, why: str, things: int = 1) -> None:
        """Leave a note out and tell of it."""
        self.dropped.add(note.note)
        what = f"{pitch_name(note.pitch)} is not played: {why}"
        self._log.add(kind, self._place(note), what, things=things)

    def one_at_a_time(self, notes: list[_Note]) -> list[_Note]:
        """Make a line of notes that are sorted by onset."""
        line: list[_Note] = []
        for note in notes:
            if not line or line[-1].end_s <= note.onset_s:
                line.append(note)
                continue
            last = line[-1]
            overlap = last.end_s - note.onset_s
            apart = note.onset_s - last.onset_s
            together = apart <= SOUND_TOGETHER_S or (apart <= CHORD_S and overlap > SOUND_TOGETHER_S)
            if together and last.ornaments(note):
                self._ornament(line, last, note)
            elif together and note.ornaments(last):
                self._ornament(line, note, last)
            elif together:
                lower, line[-1] = sorted((last, note), key=lambda one: (one.pitch, one.duration_s))
                # Chords are counted, not their notes.
                begun = bool({last.note, note.note} & self._above_chords)
                self._above_chords.add(line[-1].note)
                above = f"{pitch_name(line[-1].pitch)} sounds above it"
                self.drop("chord_note_dropped", lower, above, things=0 if begun else 1)
            elif note.pitch < last.pitch and note.end_s <= last.end_s + SOUND_TOGETHER_S:
                self.drop("inner_note_dropped", note, f"{pitch_name(last.pitch)} is held above it")
            else:
                line[-1] = self._cut(last, note)
                line.append(note)
        return line

    def fill_in(self, line: list[_Note], others: list[_Note]) -> list[_Note]:
        """Put notes, sorted by onset, into a line where they take no other note's place."""
        fitting = self.one_at_a_time(self._fitting(line, others))
        filled = sorted([*line, *self._fitting(line, fitting)], key=lambda note: note.onset_s)
        for at, (note, following) in enumerate(pairwise(filled)):
            if note.end_s > following.onset_s:
                filled[at] = self._cut(note, following)
        return filled

    def _fitting(self, line: list[_Note], others: list[_Note]) -> list[_Note]:
        """Return those of the others that are in no note's place; the rest is dropped."""
        onsets = [note.onset_s for note in line]
        fitting: list[_Note] = []
        for note in others:
            at = bisect_left(onsets, note.onset_s)
            before = line[at - 1] if at else None
            after = line[at] if at < len(line) else None
            sounding = None
            if before and before.end_s - note.onset_s > min(
                LEGATO_S, note.duration_s / 2, before.duration_s / 2
            ):
                sounding = before
            elif after and after.onset_s - note.onset_s <= CHORD_S and after.onset_s < note.end_s:
                sounding = after
            if sounding:
                why = f"it is out of range, and {pitch_name(sounding.pitch)} sounds in its place"
                self.drop("out_of_range_dropped", note, why)
            else:
                fitting.append(note)
        return fitting

    def _ornament(self, line: list[_Note], ornament: _Note, note: _Note) -> None:
        """Put an ornament before its note, the last of the line, or leave it out."""
        line[-1] = note
        begins = note.onset_s - ornament.duration_s
        earliest = line[-2].end_s if len(line) > 1 else 0.0
        main = pitch_name(note.pitch)
        if ornament.onset_s < note.onset_s - SOUND_TOGETHER_S:
            line[-1:] = [self._cut(ornament, note), note]
        elif begins >= earliest:
            line[-1:] = [ornament._replace(onset_s=begins, end_s=note.onset_s), note]
            what = f"{pitch_name(ornament.pitch)} sounds before {main}, which it ornaments"
            self._log.add("ornament_moved", self._place(ornament), what)
        else:
            self.drop("ornament_dropped", ornament, f"it ornaments {main}, before which there is no room")

    def _cut(self, note: _Note, following: _Note) -> _Note:
        """End a note where the following begins."""
        overlap = note.end_s - following.onset_s
        if overlap > TOLD_OVERLAP_S:
            self.shortened.add(note.note)
            what = f"{pitch_name(note.pitch)} ends {overlap * 1000:.0f} ms earlier"
            where = f"where {pitch_name(following.pitch)} begins"
            self._log.add("note_shortened", self._place(note), f"{what}, {where}")
        return note._replace(end_s=following.onset_s)

    def _place(self, note: _Note) -> str:
        return f"part {self._notes.part[note.note]}, note {note.note} at {note.onset_s:.3f} s"
