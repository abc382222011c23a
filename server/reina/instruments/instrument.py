"""What an instrument is to the rest of Reina."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reina.curves import Parameter
    from reina.instruments.chart_note import ChartNote
    from reina.instruments.note_fingerings import NoteFingering
    from reina.instruments.played import PlayedPart
    from reina.instruments.player.engagement import Engagement
    from reina.instruments.player.instrument_body import InstrumentBody
    from reina.instruments.ranking import PartRanking
    from reina.kinematics import Curve, MotionCurves
    from reina.music.score import Score

MAX_PITCH = 127
"""The highest MIDI number of a pitch."""


class Instrument(ABC):
    """An instrument and its playing: which part, how it is fingered and written, how its player moves."""

    name: str
    """Its name in the registry and the first word of its parameters' paths."""
    title: str
    """Its name for people."""
    rig: str = ""
    """Name of its folder under rigs/, which a player's hold is named after too; empty if it has none yet."""
    program: int | None = None
    """The General MIDI program, from 0, that it sounds with where the score says none."""
    parameters: tuple[Parameter, ...] = ()
    """What of it moves in every frame; the paths begin with its name."""
    handedness: tuple[str, ...] = ("right",)
    """With which hand leading it can be played: of `HANDEDNESS`."""
    left_handed_rig: str = ""
    """In place of `rig` where the left hand leads: its mirror image; empty where it is held the same."""
    plays_drums: bool = False
    """Whether it plays parts whose keys are drums and no pitches."""
    pieces: tuple[str, ...] = ()
    """What of it can be struck, by name, as the drums of a kit; empty where it is not struck."""
    seat: str | None = None
    """Where it stands by itself, one of it, whoever else plays; None where it stands with the others."""
    show_parameters: tuple[Parameter, ...] = ()
    """What a show may choose of it; the paths begin with ``player/``."""

    @property
    def skeletons(self) -> Mapping[str, str]:
        """Its skeletons in the frame by name, and each one's rig; its own is the first."""
        return {self.name: self.rig}

    def skeletons_led_by(self, handedness: str) -> Mapping[str, str]:
        """`skeletons` as who leads with that hand has them; its own is the first."""
        if handedness == "right" or not self.left_handed_rig:
            return self.skeletons
        return {
            name: self.left_handed_rig if rig == self.rig else rig for name, rig in self.skeletons.items()
        }

    # --- its part

    def can_play(self, sounding_pitch: int) -> bool:
        """Return whether it has a note, a MIDI number as it sounds; it has every one by default."""
        return 0 <= sounding_pitch <= MAX_PITCH

    def can_play_of(self, score: Score, part: int) -> bool:
        """Return whether it has any of a part's notes."""
        pitches: set[int] = set(score.notes.sounding_pitch[score.note_indices(part)].tolist())
        return any(map(self.can_play, pitches))

    @abstractmethod
    def rank_parts(self, score: Score) -> tuple[PartRanking, ...]:
        """Rank the parts of a score by how well they suit it, the best first."""

    @abstractmethod
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
        handedness: str = "right",
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
            handedness: Which hand leads, of those that the instrument can be played with.

        Raises:
            NotInScoreError: If the score has no such part, or one of `joined_parts` cannot be joined.
        """

    # --- its notation

    @property
    def clef(self) -> Literal["treble", "bass"]:
        """The clef that it is written in."""
        return "treble"

    @property
    def valve_count(self) -> int:
        """How many valves it has; an instrument of another kind has none."""
        return 0

    @property
    def fingering_chart(self) -> tuple[ChartNote, ...]:
        """How each note is fingered on valves, from the lowest up; of other kinds there is no chart."""
        return ()

    def written_pitch(self, sounding_pitch: int) -> int:
        """Return the pitch that stands in the player's part for one that sounds, both MIDI numbers."""
        return sounding_pitch

    def show_fingering(self, fingering: NoteFingering) -> str:
        """Return a note's fingering as a table of text has it."""
        return str(fingering)

    # --- its motion

    @abstractmethod
    def plan_gestures(self, played: PlayedPart, *, seed: int = 0) -> dict[str, Curve]:
        """Plan everything that its player does, once.

        Args:
            played: A part as `play` returns it.
            seed: Varies what no score says.

        Returns:
            Curves by name: its own, and those of `reina.instruments.GESTURES` that its player makes;
            the others are 0.
        """

    @abstractmethod
    def body(self, engagement: Engagement, curves: MotionCurves) -> InstrumentBody:
        """Return what turns its player's curves into poses.

        Args:
            engagement: Who plays what, where, on which rigs.
            curves: What is planned: `plan_gestures`, and all `GESTURES`.

        Raises:
            RigError: The rigs lack something that playing needs.
        """
