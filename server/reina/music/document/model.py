"""Reina's own score document; the published JSON Schema is made from these models.

What may be missing may be null as well, which says the same.
"""

import re
from typing import Annotated, Literal, TypeVar

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    FailFast,
    Field,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
)

_STEPS = {"C": 0, "D": 2, "E": 4, "F": 5, "G": 7, "A": 9, "B": 11}
_ACCIDENTALS = {"": 0, "#": 1, "♯": 1, "##": 2, "x": 2, "b": -1, "♭": -1, "bb": -2}
_NAME = re.compile(r"([A-Ga-g])(##|#|♯|x|bb|b|♭|)(-?\d{1,2})")

MAX_CHANGES = 100_000
"""Of tempos, and of metres."""

MAX_TEXTS = 20_000
"""Of lyrics, of markers, of words."""

DEFAULT_VELOCITY = 0.7
"""Of notes that say none."""


def pitch_number(value: object) -> object:
    """Return the MIDI number of a pitch given by name (``"B♭4"``, ``"F#3"``; C4 is 60), else `value` itself.

    Raises:
        ValueError: If the name is none.
    """
    if not isinstance(value, str):
        return value
    match = _NAME.fullmatch(value.strip())
    if match is None:
        raise ValueError(f"{value[:20]!r} is no pitch; C4, F#3 or Bb5 would be, or a MIDI number")
    step, accidental, octave = match.groups()
    return 12 * (int(octave) + 1) + _STEPS[step.upper()] + _ACCIDENTALS[accidental]


Beat = Annotated[float, Field(ge=0, le=1e7, allow_inf_nan=False)]
Pitch = Annotated[
    int,
    BeforeValidator(pitch_number),
    Field(ge=0, le=127),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "integer", "minimum": 0, "maximum": 127},
                {"type": "string", "pattern": f"^{_NAME.pattern}$"},
            ]
        }
    ),
]
Item = TypeVar("Item")
Listed = Annotated[list[Item] | None, FailFast()]
"""A list that may be long, or missing: of its entries the first with faults is told."""


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class TempoEntry(_Model):
    """A tempo from a beat on."""

    beat: Beat = Field(description="Where it begins, in quarter notes from the beginning.")
    bpm: float = Field(ge=1, le=100_000, allow_inf_nan=False, description="Quarter notes in a minute.")


class TimeSignatureEntry(_Model):
    """A metre from a beat on; it begins a new bar."""

    beat: Beat = Field(description="Where it begins, in quarter notes from the beginning.")
    numerator: int = Field(ge=1, le=255)
    denominator: Literal[1, 2, 4, 8, 16, 32, 64]


class KeySignatureEntry(_Model):
    """A key signature from a beat on."""

    beat: Beat = Field(description="Where it begins, in quarter notes from the beginning.")
    fifths: int = Field(
        ge=-7, le=7, description="How many sharps, as it sounds; flats are negative: -3 is E flat major."
    )
    mode: Literal["major", "minor"] | None = Field(default="major", description="What the key is called.")


class NoteEntry(_Model):
    """A note."""

    beat: Beat = Field(description="Onset in quarter notes from the beginning.")
    duration: float = Field(gt=0, le=1e7, allow_inf_nan=False, description="Duration in quarter notes.")
    pitch: Pitch = Field(description="MIDI number (60 is middle C) or a name such as C4, F#3, Bb5.")
    velocity: float | None = Field(
        default=DEFAULT_VELOCITY, ge=0, le=1, description="Loudness of the attack."
    )

    tongued: bool | None = Field(
        default=None,
        description="Whether it is begun anew, or led to; what the part's slurs say where nothing is said.",
    )


class SlurEntry(_Model):
    """A slur: what begins after its own beginning is led to and not tongued."""

    beat: Beat = Field(description="Onset of its first note in quarter notes from the beginning.")
    end_beat: Beat = Field(description="Onset of its last note.")

    @field_validator("end_beat")
    @classmethod
    def _ends_later(cls, end_beat: float, info: ValidationInfo) -> float:
        beat = info.data.get("beat")
        if beat is not None and end_beat <= beat:
            raise ValueError(f"a slur ends after it begins, which it does at beat {beat:g}")
        return end_beat


class TextEntry(_Model):
    """A text at a beat."""

    beat: Beat = Field(description="Where, in quarter notes from the beginning.")
    text: str = Field(min_length=1, max_length=500)


class ControllerEntry(_Model):
    """A controller's value from a beat on."""

    beat: Beat
    number: int = Field(ge=0, le=127, description="The MIDI controller: 7 is volume, 11 expression.")
    value: int = Field(ge=0, le=127)


class PartEntry(_Model):
    """What one instrument plays."""

    name: str | None = Field(default="", max_length=200)
    program: int | None = Field(
        default=None, ge=0, le=127, description="General MIDI program from 0; 56 is the trumpet."
    )
    drums: bool | None = Field(default=False, description="Whether the pitches are drums.")
    transposition: int | None = Field(
        default=0,
        ge=-48,
        le=48,
        description="Semitones from the pitches written here to those that sound; -2 for a part in B flat.",
    )
    notes: Listed[NoteEntry] = Field(default_factory=list[NoteEntry])
    slurs: Listed[SlurEntry] = Field(
        default=None,
        description="Its slurs; where they are given, even none, every other note is tongued.",
    )
    controllers: Listed[ControllerEntry] = Field(default_factory=list[ControllerEntry])


class ScoreDocument(_Model):
    """A score."""

    format: Literal["reina-score"] = Field(description="Says that this is a score of this form.")
    version: Literal[1] | None = Field(default=1, description="Version of the form.")
    title: str | None = Field(default="", max_length=500)
    tempos: Listed[TempoEntry] = Field(
        default_factory=list[TempoEntry],
        max_length=MAX_CHANGES,
        description="120 a minute where none is said.",
    )
    time_signatures: Listed[TimeSignatureEntry] = Field(
        default_factory=list[TimeSignatureEntry],
        max_length=MAX_CHANGES,
        description="4/4 where none is said.",
    )
    key_signatures: Listed[KeySignatureEntry] = Field(
        default_factory=list[KeySignatureEntry],
        max_length=MAX_CHANGES,
        description="Found from the notes where none is said.",
    )
    pickup_beats: Beat | None = Field(
        default=0.0, description="Length of an incomplete first bar in quarter notes."
    )
    lyrics: Listed[TextEntry] = Field(
        default_factory=list[TextEntry],
        max_length=MAX_TEXTS,
        description="Syllables: a space stands between words, a line feed ends a line, two end a verse.",
    )
    markers: Listed[TextEntry] = Field(
        default_factory=list[TextEntry],
        max_length=MAX_TEXTS,
        description="Rehearsal marks, names of sections.",
    )
    words: Listed[TextEntry] = Field(
        default_factory=list[TextEntry], max_length=MAX_TEXTS, description="Any other words."
    )
    parts: list[PartEntry] = Field(min_length=1)
