"""What a MusicXML document says of a part, measure by measure as it is written."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

Place = tuple[int, float]
"""A measure, counted from 0, and the quarter notes since it began."""

GraceKind = Literal["", "before", "on"]

OrnamentKind = Literal["trill", "mordent", "turn", "delayed-turn", "tremolo"]


@dataclass(frozen=True)
class Ornament:
    """A sign for more notes than are written.

    Attributes:
        kind: What is made of the note.
        first: The other pitch of a trill or mordent, the first of a turn: MIDI number as it sounds.
        second: The last other pitch of a turn.
        other_first: Whether a trill begins with its other pitch.
        is_long: Whether a mordent goes twice.
        unit_beats: Quarter notes of each stroke of a tremolo.
    """

    kind: OrnamentKind
    first: int = 0
    second: int = 0
    other_first: bool = False
    is_long: bool = False
    unit_beats: float = 0.0


@dataclass(frozen=True)
class Source:
    """What sounds a note: each has a MIDI channel of its own.

    Attributes:
        program: General MIDI program counted from 0, or None.
        is_drums: Whether its pitches are drums.
        volume: MIDI's controller 7, or None.
        pan: MIDI's controller 10, or None.
    """

    program: int | None
    is_drums: bool
    volume: int | None = None
    pan: int | None = None


@dataclass(slots=True)
class WrittenNote:
    """One note as it is written; of tied notes each is one.

    Attributes:
        measure: Its measure, from 0.
        offset: Quarter notes since that began.
        duration: Quarter notes; of a grace note how long it is written.
        pitch: MIDI number as it sounds.
        voice: Which voice of the part it is in.
        source: What sounds it.
        line: Where it stands in the document.
        velocity: 0..1 as the note itself says it, None where the dynamics do.
        louder: What its accents add, 0..1.
        gate: Which share of its length sounds.
        slurred: Whether a slur leads to it.
        in_chord: Whether it begins with the note before it.
        tie_start: Whether it is tied to one after it.
        tie_stop: Whether one before it is tied to it.
        grace: How a grace note takes its time: from what is before it, or from its note; "" if it is none.
        steals: Which share of that note it takes, None if nothing is said.
        times: On which playings of its measure it sounds; none: on all.
        ornament: What is made of it, None if it is played as it is written.
        breath: Quarter notes that it ends earlier, for breath or for a pause.
    """

    measure: int
    offset: float
    duration: float
    pitch: int
    voice: str
    source: Source
    line: int
    velocity: float | None = None
    louder: float = 0.0
    gate: float = 1.0
    slurred: bool = False
    in_chord: bool = False
    tie_start: bool = False
    tie_stop: bool = False
    grace: GraceKind = ""
    steals: float | None = None
    times: frozenset[int] = frozenset()
    ornament: Ornament | None = None
    breath: float = 0.0

    @property
    def place(self) -> Place:
        """Its measure and its offset there."""
        return self.measure, self.offset


@dataclass(frozen=True)
class DynamicMark:
    """A dynamic: a level from there on, an accent of the notes there, or both; 0..1."""

    place: Place
    level: float | None
    accent: float | None = None


@dataclass(frozen=True)
class Hairpin:
    """A crescendo (`sign` 1) or diminuendo (-1); without `end` it lasts until the next dynamic."""

    begin: Place
    end: Place | None
    sign: int


@dataclass(frozen=True)
class TempoMark:
    """A tempo: quarter notes a minute, or `ratio` times the one before."""

    place: Place
    bpm: float | None
    ratio: float = 1.0
    times: frozenset[int] = frozenset()


@dataclass(frozen=True)
class TempoShift:
    """A change of tempo by words: to `ratio` times the tempo there.

    Attributes:
        place: Where it begins.
        ratio: Below 1 is slower.
        gradual: Whether it comes little by little; else at once.
        end: Where the dashes after the words end, None if there are none.
    """

    place: Place
    ratio: float
    gradual: bool = True
    end: Place | None = None


@dataclass(frozen=True)
class TempoReturn:
    """Words that lead back to a tempo: to the last one that is said, or to the piece's first."""

    place: Place
    to_first: bool


@dataclass(frozen=True)
class Hold:
    """A fermata, or a pause: all parts wait.

    Attributes:
        place: Where what is held begins.
        beats: How long that is, quarter notes.
        added: How many more it lasts.
    """

    place: Place
    beats: float
    added: float


@dataclass(frozen=True)
class KeyMark:
    """A key signature as it sounds."""

    place: Place
    fifths: int
    is_minor: bool


@dataclass(frozen=True)
class Syllable:
    """A syllable of one verse."""

    place: Place
    verse: int
    text: str


@dataclass(frozen=True)
class Words:
    """A rehearsal mark (``marker``) or other words (``text``)."""

    place: Place
    kind: Literal["marker", "text"]
    text: str


@dataclass
class WrittenPart:
    """What is written in one part; notes in the document's order."""

    notes: list[WrittenNote] = field(default_factory=list[WrittenNote])
    dynamics: list[DynamicMark] = field(default_factory=list[DynamicMark])
    hairpins: list[Hairpin] = field(default_factory=list[Hairpin])
    tempos: list[TempoMark] = field(default_factory=list[TempoMark])
    tempo_words: list[TempoShift | TempoReturn] = field(default_factory=list["TempoShift | TempoReturn"])
    holds: list[Hold] = field(default_factory=list[Hold])
    keys: list[KeyMark] = field(default_factory=list[KeyMark])
    syllables: list[Syllable] = field(default_factory=list[Syllable])
    words: list[Words] = field(default_factory=list[Words])


@dataclass
class WrittenMeasure:
    """One measure of the score, as all parts have it together.

    Attributes:
        number: What the document numbers it.
        implicit: Whether it counts as no measure, as a pickup.
        length: How many quarter notes are written in it.
        metre: Numerator and denominator in force, None in free time.
        forward: Whether a repeat begins here.
        backward: How often what ends here is played; 0 if no repeat ends here.
        after_jump: Whether its repeat is made after a jump too.
        ending_begins: The passes of an ending that begins here.
        ending_ends: Whether an ending does.
        segno: Names of the signs that stand here.
        coda: Names of the codas that begin here.
        da_capo: Whether a Da Capo stands at its end.
        dal_segno: The sign to which a Dal Segno at its end leads, or None.
        to_coda: The coda to which a jump at its end leads, or None.
        fine: Whether the piece ends here after a jump.
    """

    number: str = ""
    implicit: bool = False
    length: float = 0.0
    metre: tuple[int, int] | None = (4, 4)
    forward: bool = False
    backward: int = 0
    after_jump: bool = False
    ending_begins: frozenset[int] = frozenset()
    ending_ends: bool = False
    segno: set[str] = field(default_factory=set[str])
    coda: set[str] = field(default_factory=set[str])
    da_capo: bool = False
    dal_segno: str | None = None
    to_coda: str | None = None
    fine: bool = False
