"""What notes are called: as they sound, and as they stand in the part of who plays them."""

from collections.abc import Sequence

import numpy as np

from reina.instruments.instrument import Instrument
from reina.instruments.played import Line, PlayedPart
from reina.music.arrays import IntArray, NarrowIntArray
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
    """The names of a score's notes; a part that nobody plays is spelled when it is asked for first.

    What is played is spelled as the line it is; the rest, part by part, as it stands in the score.
    """

    def __init__(self, score: Score, players: Sequence[tuple[Instrument, PlayedPart]]) -> None:
        self._score = score
        self._keys = keys_of(score)
        self._lead = players[0][0]
        self._player_of_part = {part: player for player in players for part in player[1].parts}
        count = len(score.notes)
        # As they sound, and as they are written.
        self._pitches = np.zeros((2, count), dtype=np.int16)
        self._places = np.zeros((2, count), dtype=np.int8)
        self._spelled = np.zeros(count, dtype=np.bool_)
        for instrument, played in players:
            self._spell_line(instrument, played)

    def of(self, note: int) -> tuple[str, str]:
        """Return what a note is called as it sounds, and as it is written; by its place in the score."""
        if not self._spelled[note]:
            self._spell_part(int(self._score.notes.part[note]))
        sounding, written = zip(self._pitches[:, note].tolist(), self._places[:, note].tolist(), strict=True)
        return named(*sounding), named(*written)

    def _spell_line(self, instrument: Instrument, played: PlayedPart) -> None:
        line, above = played.line, instrument.written_pitch(0)
        places = [
            spell_line(self._score, line, self._keys, moved=played.transposition, written_above_sounding=up)
            for up in (0, above)
        ]
        self._keep(line.note_index, line.sounding_pitch, above, places)

    def _spell_part(self, part: int) -> None:
        instrument, played = self._player_of_part.get(part, (self._lead, None))
        moved = played.transposition if played else 0
        indices = self._score.note_indices(part)
        notes = self._score.notes
        pitches = notes.sounding_pitch[indices].astype(np.int64) + moved
        # What is moved beyond MIDI's pitches stands as in the file.
        pitches = np.where((pitches < 0) | (pitches > 127), notes.sounding_pitch[indices], pitches)
        above = instrument.written_pitch(0)
        places = [
            spell(pitches + up, notes.onset_beats[indices], self._keys, semitones=moved + up)
            for up in (0, above)
        ]
        self._keep(indices, pitches, above, places)

    def _keep(
        self, indices: NarrowIntArray, pitches: NarrowIntArray, above: int, places: Sequence[IntArray]
    ) -> None:
        """Keep the names of notes that have none yet."""
        new = ~self._spelled[indices]
        for row, up in enumerate((0, above)):
            self._pitches[row, indices[new]] = pitches[new] + up
            self._places[row, indices[new]] = places[row][new]
        self._spelled[indices] = True
