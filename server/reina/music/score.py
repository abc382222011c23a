"""A score as Reina knows it, whatever file it came from."""

from dataclasses import dataclass

import numpy as np

from reina.music.arrays import IntArray
from reina.music.controls import Control
from reina.music.key_signature import KeySignature
from reina.music.metre import MetreMap
from reina.music.notes import Notes
from reina.music.tempo import TempoMap
from reina.music.texts import ScoreText
from reina.music.warnings import ScoreWarning


@dataclass(frozen=True)
class Part:
    """What one instrument plays.

    Attributes:
        index: Its place in the score's parts.
        name: As the file names it, or what is known of it: ``"Track 3"``, ``"Trumpet"``.
        program: General MIDI program counted from 0, or None if the file says none.
        is_drums: Whether its pitches are drums and not tones.
        channel: MIDI channel counted from 0.
        named: Whether the file itself names the part.
    """

    index: int
    name: str
    program: int | None
    is_drums: bool
    channel: int = 0
    named: bool = True


@dataclass(frozen=True, eq=False)
class Score:
    """A score: what is played when.

    Attributes:
        title: As the file has it, else the file's name.
        parts: At least one; each has at least one note.
        notes: Of all parts, sorted by onset, part, pitch.
        tempo_map: Beats and seconds.
        metre_map: Beats and bars.
        controls: Programs, controllers, bends and pressures with their channel, sorted by time.
        warnings: What was repaired.
        duration_s: End of the last note.
        sequence: Which of the file's sequences this is, counted from 0; a file of format 2 may hold several.
        sequences: How many it holds.
        key_signatures: As the file has them, by their beat; none where it says nothing of a key.
        written_tempos: The file's own tempos, where `tempo_map` is that of a recording.
        texts: Lyrics, markers and other words, by their time.
    """

    title: str
    parts: tuple[Part, ...]
    notes: Notes
    tempo_map: TempoMap
    metre_map: MetreMap
    controls: tuple[Control, ...]
    warnings: tuple[ScoreWarning, ...]
    duration_s: float
    sequence: int = 0
    sequences: int = 1
    key_signatures: tuple[KeySignature, ...] = ()
    texts: tuple[ScoreText, ...] = ()
    written_tempos: TempoMap | None = None

    @property
    def written_tempo_map(self) -> TempoMap:
        """Beats and seconds as the file has them."""
        return self.written_tempos or self.tempo_map

    @property
    def duration_beats(self) -> float:
        """End of the last note in quarter notes."""
        return float(np.max(self.notes.onset_beats + self.notes.duration_beats))

    def note_indices(self, part: int) -> IntArray:
        """Return the indices into `notes` of one part's notes, (M,) int64, in their order."""
        return np.flatnonzero(self.notes.part == part)
