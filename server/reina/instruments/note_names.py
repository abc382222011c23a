"""What notes are called: as they sound, and as they stand in the part of who plays them."""

from collections.abc import Sequence

import numpy as np

from reina.instruments.instrument import Instrument
from reina.instruments.played import Line, PlayedPart
from reina.music.arrays import IntArray
from reina.music.score import Score
from reina.notation import Key, keys_of, named, spell


def spell_line(
    score: Score, line: Line, keys: Sequence[Key], *, moved: int, written_above_sounding: int = 0
) -> IntArray:
    """Return the name of each note of a line, (M,) int64 places on the line of fifths.

    Args:
        score: The score.
        line: What is played of it.
        keys: The score's keys as they sound in the file.
        moved: Semitones by which the line is played away from the file's pitches.
        written_above_sounding: What is added to a pitch that sounds to be written for the player.
    """
    return spell(
        line.sounding_pitch + written_above_sounding,
        score.notes.onset_beats[line.note_index],
        keys,
        semitones=moved + written_above_sounding,
    )


class NoteNames:
    """The names of a score's notes; each part is spelled when it is asked for first.

    What is played is spelled as the line it is; the rest, part by part, as it stands in the score.
    """

    def __init__(self, score: Score, players: Sequence[tuple[Instrument, PlayedPart]]) -> None:
        self._score = score
        self._keys = keys_of(score)
        self._lead = players[0][0]
        self._player_of_part = {part: player for player in players for part in player[1].parts}
        self._names: dict[int, tuple[str, str]] = {}
        for instrument, played in players:
            self._keep(played.line.note_index, *self._both(instrument, played))

    def of(self, note: int) -> tuple[str, str]:
        """Return what a note is called as it sounds, and as it is written; by its place in the score."""
        if note not in self._names:
            self._spell_part(int(self._score.notes.part[note]))
        return self._names[note]

    def _both(self, instrument: Instrument, played: PlayedPart) -> tuple[list[str], list[str]]:
        pitches, above = played.line.sounding_pitch, instrument.written_pitch(0)
        names = [
            spell_line(
                self._score, played.line, self._keys, moved=played.transposition, written_above_sounding=up
            )
            for up in (0, above)
        ]
        return _names(pitches, names[0]), _names(pitches + above, names[1])

    def _spell_part(self, part: int) -> None:
        instrument, played = self._player_of_part.get(part, (self._lead, None))
        moved = played.transposition if played else 0
        indices = self._score.note_indices(part)
        notes = self._score.notes
        pitches = notes.sounding_pitch[indices].astype(np.int64) + moved
        # What is moved beyond MIDI's pitches stands as in the file.
        pitches = np.where((pitches < 0) | (pitches > 127), notes.sounding_pitch[indices], pitches)
        above = instrument.written_pitch(0)
        names = [
            spell(pitches + up, notes.onset_beats[indices], self._keys, semitones=moved + up)
            for up in (0, above)
        ]
        self._keep(indices, _names(pitches, names[0]), _names(pitches + above, names[1]))

    def _keep(self, indices: IntArray, sounding: Sequence[str], written: Sequence[str]) -> None:
        shared: dict[tuple[str, str], tuple[str, str]] = {}
        for note, both in zip(indices.tolist(), zip(sounding, written, strict=True), strict=True):
            self._names.setdefault(note, shared.setdefault(both, both))


def _names(pitches: IntArray, names: IntArray) -> list[str]:
    return [named(pitch, name) for pitch, name in zip(pitches.tolist(), names.tolist(), strict=True)]
