"""What an instrument is to the rest of Reina."""

from collections.abc import Sequence
from typing import Literal, Protocol

from reina.curves.parameter import Parameter
from reina.instruments.chart_note import ChartNote
from reina.instruments.played import PlayedPart
from reina.instruments.ranking import PartRanking
from reina.music.score import Score


class Instrument(Protocol):
    """An instrument that a player can hold."""

    @property
    def name(self) -> str:
        """Its name in `INSTRUMENTS` and the first word of its parameters' paths."""
        ...

    @property
    def title(self) -> str:
        """Its name for people."""
        ...

    @property
    def rig(self) -> str:
        """Name of its folder under rigs/."""
        ...

    @property
    def valve_count(self) -> int:
        """How many valves it has."""
        ...

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What of it moves in every frame: its valves, 0 up and 1 down, and its slide, 0 in and 1 out."""
        ...

    @property
    def clef(self) -> Literal["treble", "bass"]:
        """The clef that it is written in."""
        ...

    @property
    def fingering_chart(self) -> tuple[ChartNote, ...]:
        """How each note that it has is fingered, from the lowest up."""
        ...

    def written_pitch(self, sounding_pitch: int) -> int:
        """Return the pitch that stands in the player's part for one that sounds, both MIDI numbers."""
        ...

    def rank_parts(self, score: Score) -> tuple[PartRanking, ...]:
        """Rank the parts of a score by how well they suit it, the best first."""
        ...

    def play(
        self,
        score: Score,
        part: int,
        transposition: int = 0,
        *,
        written: bool = False,
        octave_fit: bool = False,
        joined_parts: Sequence[int] = (),
        usual_fingerings: bool = False,
    ) -> PlayedPart:
        """Make a part playable and finger it.

        Args:
            score: The score.
            part: Index of the part.
            transposition: Semitones to add to its pitches.
            written: Whether its pitches are the written ones of this instrument and not those that sound.
            octave_fit: Whether to move it by the octaves that bring most of its notes into range.
            joined_parts: Indices of further parts that are played with it, as if their notes were its own.
            usual_fingerings: Whether to take no fingering but the usual one of each note.

        Raises:
            NotInScoreError: If the score has no such part, or one of `joined_parts` cannot be joined.
        """
        ...
