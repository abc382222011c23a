"""Who plays what: a cast of castings."""

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from reina.errors import InputError

if TYPE_CHECKING:
    from reina.instruments.instrument import Instrument
    from reina.instruments.played import PlayedPart
    from reina.music.score import Score

MAX_PLAYERS = 4
"""How many play at once at most."""

HANDEDNESS = ("right", "left")
"""Which hand leads, as a casting may say it."""

PLAYER = "trumpeter"
INSTRUMENT = "trumpet"


class CastError(InputError):
    """A cast names what there is not; the message says what there is."""


def refuse_handedness(instrument: "Instrument", handedness: str, place: str = "") -> None:
    """Refuse a leading hand that an instrument cannot be played with.

    Args:
        instrument: The instrument.
        handedness: Which hand leads.
        place: What stands before the field's name in the cast, as ``castings/0/``.

    Raises:
        CastError: It is not played so; the message says how it is.
    """
    if handedness in instrument.handedness:
        return
    known = " or ".join(instrument.handedness)
    told = f"is played {known}-handed, not {handedness}-handed"
    if handedness not in HANDEDNESS:
        told = f"is played {known}-handed; there is no handedness {handedness!r}"
    raise CastError(f"the {instrument.title} {told}", location=f"{place}handedness")


@dataclass(frozen=True)
class Casting:
    """One player's share.

    Attributes:
        part: Index of the part; None: the one that suits the instrument best and nobody else plays.
        instrument: Name of the instrument.
        player: Name of the player's rig.
        seat: Name of the place on the stage; None: by how many play.
        transposition: Semitones by which the part was asked to be moved.
        written: Whether the part is taken as notated for the instrument.
        octave_fit: Whether it is moved by the octaves that bring most of it into range.
        joined_parts: Further parts that are played together with it.
        handedness: Which hand leads: one of `HANDEDNESS` that the instrument is played with.
        usual_fingerings: Whether no fingering is taken but the usual one of each note.
    """

    part: int | None = None
    instrument: str = INSTRUMENT
    player: str = PLAYER
    seat: str | None = None
    transposition: int = 0
    written: bool = False
    octave_fit: bool = False
    joined_parts: tuple[int, ...] = ()
    handedness: str = "right"
    usual_fingerings: bool = False

    @property
    def sound(self) -> tuple[object, ...]:
        """What of it is heard: who plays, where, and with which valves, is not."""
        heard = (self.part, self.transposition, self.written, self.octave_fit, self.joined_parts)
        return (*heard, self.instrument)

    def play(self, instrument: "Instrument", score: "Score", part: int) -> "PlayedPart":
        """The part as it is played.

        Args:
            instrument: The casting's.
            score: The score.
            part: The casting's, or the one that was found for it.

        Raises:
            NotInScoreError: The score has no such part, or one of `joined_parts` cannot be joined.
        """
        return instrument.play(
            score,
            part,
            self.transposition,
            written=self.written,
            octave_fit=self.octave_fit,
            joined_parts=self.joined_parts,
            usual_fingerings=self.usual_fingerings,
            handedness=self.handedness,
        )

    def changed(self, **changes: Any) -> "Casting":
        """The same with other fields; another part is played alone unless `joined_parts` comes with it."""
        if "joined_parts" not in changes and changes.get("part", self.part) != self.part:
            changes["joined_parts"] = ()
        return replace(self, **changes)


@dataclass(frozen=True)
class Cast:
    """Everybody who plays, and which of the score's sequences.

    Attributes:
        castings: At least one, in the order of the players.
        sequence: Which sequence of a MIDI file of format 2; None: nobody chose, and the first is played.
        auto: Whether the castings are found from the score by `find_cast`: they are still to be found where
            one of them has no part.

    Raises:
        CastError: There is nobody, or there are too many.
    """

    castings: tuple[Casting, ...] = field(default=(Casting(),))
    sequence: int | None = None
    auto: bool = False

    def __post_init__(self) -> None:
        if not 1 <= len(self.castings) <= MAX_PLAYERS:
            told = f"1 to {MAX_PLAYERS} players play at once, not {len(self.castings)}"
            raise CastError(told, location="castings")

    @property
    def is_to_be_found(self) -> bool:
        """Whether the score has still to say who plays."""
        return self.auto and any(casting.part is None for casting in self.castings)

    @property
    def lead(self) -> Casting:
        """The first player's."""
        return self.castings[0]

    @property
    def sound(self) -> tuple[object, ...]:
        """What of it is heard."""
        return (self.sequence, *(casting.sound for casting in self.castings))

    def found_anew(self, sequence: int | None = None) -> "Cast":
        """The cast that the score asks for by itself, of this sequence or another."""
        return Cast(sequence=self.sequence if sequence is None else sequence, auto=True)

    def changed(self, *, sequence: int | None = None, **lead: Any) -> "Cast":
        """The same with another sequence, or other fields of the first player's casting.

        Of another sequence, whose parts are others, everybody plays the part that suits best, unless the
        first player's is named with it. Another player who has the part that the first is given takes the
        first's in exchange; one whose part is joined to the first's leaves.
        """
        castings = self.castings
        if sequence is not None and sequence != (self.sequence or 0):
            kept = castings[:1] if self.auto and lead else castings
            castings = tuple(replace(one, part=None, joined_parts=()) for one in kept)
        if lead:
            first, *others = castings
            given = lead.get("part", first.part)
            if given is not None and given != first.part:
                others = [
                    other.changed(part=first.part) if other.part == given else other for other in others
                ]
            first = first.changed(**lead)
            others = [other for other in others if other.part not in first.joined_parts]
            castings = (first, *others)
        chosen = self.sequence if sequence is None else sequence
        return Cast(castings, chosen, auto=self.auto and not lead)
