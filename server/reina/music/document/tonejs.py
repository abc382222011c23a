"""The JSON that Tone.js's MIDI converter writes, of the present and of the older form.

Unlike Reina's own form it is read generously: fields that are not needed may be missing, strange or more.
"""

from typing import Annotated

from pydantic import AliasChoices, BaseModel, BeforeValidator, ConfigDict, Field

from reina.music.document.model import MOST_CHANGES, Pitch

Seconds = Annotated[float, Field(ge=0, le=1e6, allow_inf_nan=False)]
Ticks = Annotated[float, Field(ge=0, le=1e12, allow_inf_nan=False)]
Bpm = Annotated[float, Field(ge=1, le=1e8, allow_inf_nan=False)]
MetreNumber = Annotated[int, Field(ge=1, le=1024)]


class _Model(BaseModel):
    model_config = ConfigDict(extra="ignore", frozen=True)


class ToneTempo(_Model):
    """An entry of ``header.tempos``."""

    bpm: Bpm
    ticks: Ticks | None = None
    time: Seconds | None = None


class ToneTimeSignature(_Model):
    """An entry of ``header.timeSignatures``."""

    timeSignature: tuple[MetreNumber, MetreNumber]  # noqa: N815
    ticks: Ticks = 0.0


class ToneHeader(_Model):
    """The header; ``bpm``, ``PPQ`` and ``timeSignature`` are of the older form."""

    name: str = ""
    ppq: float = Field(
        default=480.0, ge=1, le=1e6, allow_inf_nan=False, validation_alias=AliasChoices("ppq", "PPQ")
    )
    tempos: list[ToneTempo] = Field(default_factory=list[ToneTempo], max_length=MOST_CHANGES)
    timeSignatures: list[ToneTimeSignature] = Field(  # noqa: N815
        default_factory=list[ToneTimeSignature], max_length=MOST_CHANGES
    )
    bpm: Bpm | None = None
    timeSignature: tuple[MetreNumber, MetreNumber] | None = None  # noqa: N815


class ToneNote(_Model):
    """An entry of ``tracks[].notes``; seconds and ticks both say when, the seconds go first."""

    midi: Pitch = Field(validation_alias=AliasChoices("midi", "name"))
    time: Seconds | None = None
    duration: Seconds | None = None
    ticks: Ticks | None = None
    durationTicks: Ticks | None = None  # noqa: N815
    velocity: float = Field(default=0.7, ge=0, le=1)


class ToneInstrument(_Model):
    """``tracks[].instrument``."""

    number: int | None = Field(default=None, ge=0, le=127)
    name: str = ""
    family: str = ""


def _instrument(value: object) -> object:
    """In the older form the instrument is a name, with its number beside it."""
    return {"name": value} if isinstance(value, str) else value or {}


class ToneController(_Model):
    """An entry of ``tracks[].controlChanges[number]``; values are 0 to 1, above 1 they are MIDI's own."""

    value: float = Field(ge=0, le=127)
    time: Seconds | None = None
    ticks: Ticks | None = None


class ToneBend(_Model):
    """An entry of ``tracks[].pitchBends``; -1 to 1 is the bend's whole range."""

    value: float = Field(ge=-2, le=2)
    time: Seconds | None = None
    ticks: Ticks | None = None


class ToneTrack(_Model):
    """An entry of ``tracks``."""

    name: str = ""
    channel: int | None = Field(
        default=None, ge=0, le=15, validation_alias=AliasChoices("channel", "channelNumber")
    )
    instrument: Annotated[ToneInstrument, BeforeValidator(_instrument)] = Field(
        default_factory=ToneInstrument
    )
    instrumentNumber: int | None = Field(default=None, ge=0, le=127)  # noqa: N815
    isPercussion: bool = False  # noqa: N815
    notes: list[ToneNote] = Field(default_factory=list[ToneNote])
    controlChanges: dict[str, list[ToneController]] = Field(default_factory=dict[str, list[ToneController]])  # noqa: N815
    pitchBends: list[ToneBend] = Field(default_factory=list[ToneBend])  # noqa: N815


class ToneDocument(_Model):
    """The whole document."""

    header: ToneHeader = Field(default_factory=ToneHeader)
    tracks: list[ToneTrack] = Field(min_length=1)
