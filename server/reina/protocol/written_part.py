"""A player's part on paper: what `GET /sessions/{id}/part` answers."""

from typing import Literal

from reina.protocol.model import WireModel
from reina.protocol.resources import MusicKey

Accidental = Literal["flat", "natural", "sharp"]
Limb = Literal["left_hand", "right_hand", "left_foot", "right_foot"]
Voice = Literal["hands", "feet"]
HeadShape = Literal["plain", "cross", "circled_cross", "diamond", "triangle", "slashed"]
HeadMark = Literal["accent", "open", "half_open", "closed", "choke"]


class PartPitch(WireModel):
    """Where a note stands on the staff."""

    name: str
    """For people: `F♯5`."""
    letter: Literal["A", "B", "C", "D", "E", "F", "G"]
    octave: int
    accidental: Accidental | None
    """What is printed before it; null where signature and bar say it already."""


class PartNote(WireModel):
    """A note of the line that is played."""

    index: int
    """Its place in the score's table of notes."""
    onset_s: float
    end_s: float
    sounding_name: str
    written_name: str
    valves: list[int] | None
    """The valves that are down, ascending; null where it cannot be played."""
    usual_valves: list[int] | None
    reason: str
    piece: str | None = None
    """Of a drum part what is struck: `snare`, `hi_hat`."""
    limb: Limb | None = None
    """And with what."""


class PartHead(WireModel):
    """One of the hits that stand above one another in a drum part."""

    note: int
    """Its place in `notes`."""
    letter: Literal["A", "B", "C", "D", "E", "F", "G"]
    """Where it stands, as on a treble staff: E4 is the lowest line."""
    octave: int
    shape: HeadShape
    mark: HeadMark | None
    """The sign at it."""
    is_ghost: bool
    """Whether it stands in brackets."""
    hand: Literal["R", "L"] | None
    """The letter beneath it; null for a foot."""


class PartGrace(WireModel):
    """A grace note."""

    note: int
    """Its place in `notes`."""
    written: PartPitch
    sounding: PartPitch
    head: PartHead | None = None
    """Of a drum part how it is drawn."""


class PartEntry(WireModel):
    """A note or a rest in a bar."""

    begin_ticks: int
    """From the bar's beginning; a quarter has 48."""
    ticks: int
    value: int
    """Which part of a whole note is written: 4 for a quarter."""
    dots: int
    note: int | None
    """Its place in `notes`; null for a rest."""
    is_bar_rest: bool
    """Whether it is the rest of whole bars."""
    written: PartPitch | None
    """As the player reads it."""
    sounding: PartPitch | None
    tied_from: bool
    """Whether a tie comes from the note before."""
    tied_to: bool
    """Whether a tie goes to the next note."""
    beam: int | None
    """Notes of a bar with one number are under one beam."""
    tuplet: int | None
    """Entries of a bar with one number are a tuplet: three (or six) in the time of two (or four)."""
    is_staccato: bool
    graces: list[PartGrace]
    """Before it."""
    trill: int | None
    """A trill with this note of `notes`, which is the upper one."""
    voice: Voice | None = None
    """Of a drum part: hands have stems up, feet stems down, and each alone fills the bar; else null."""
    heads: list[PartHead]
    """Of a drum part what is struck, from the lowest up; none for a rest, and in other parts."""


class PartMeasure(WireModel):
    """A bar, or several of rest as one."""

    number: int
    """The first whole bar is 1, a pickup 0."""
    bars: int
    """How many bars of rest it stands for, else 1."""
    begin_s: float
    end_s: float
    ticks: int
    """How long each bar is: its entries last together as long."""
    numerator: int
    denominator: int
    fifths: int
    """Of the signature as it sounds."""
    written_fifths: int
    """Of the signature in the player's part."""
    entries: list[PartEntry]


class PartTempo(WireModel):
    """A tempo that is printed."""

    measure: int
    """Index into `measures`."""
    begin_ticks: int
    """Where in it."""
    bpm: float | None
    """Quarter notes a minute; null where a word stands."""
    word: str
    """`rit.`, `accel.` or nothing."""


class WrittenPart(WireModel):
    """What one player plays, as notation."""

    title: str
    part_name: str
    player: int
    """A place in the cast, 0 being the first."""
    instrument: str
    instrument_title: str
    clef: Literal["treble", "bass", "percussion"]
    written_above_sounding: int
    """Semitones from a pitch that sounds to the one that is written."""
    swing: bool
    """Whether swung eighths are written even."""
    keys: list[MusicKey]
    tempi: list[PartTempo]
    notes: list[PartNote]
    """The line, by onset."""
    measures: list[PartMeasure]
    """Up to the end of the last note."""
