"""How one note is played, by the kind of instrument; what stands as a note's `fingering` on the wire.

An instrument gives each note one of these. A kind that none of them tells is added here, and nowhere else.
"""

from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from reina.system.described import DescribedModel

Side = Literal["left", "right"]


class _NoteFingering(DescribedModel):
    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        allow_inf_nan=False,
        json_schema_serialization_defaults_required=True,
    )


class ValvesFingering(_NoteFingering):
    """How valved brass plays a note."""

    type: Literal["valves"] = "valves"
    valves: tuple[int, ...]
    """The valves that are down, ascending; [] is open."""

    def __str__(self) -> str:
        return "-".join(map(str, self.valves)) or "open"


class SlideFingering(_NoteFingering):
    """How an instrument with a slide plays a note."""

    type: Literal["slide"] = "slide"
    position: str
    """The position's name: `1` is in."""
    extension_m: float
    """How far the slide is out, metres."""

    def __str__(self) -> str:
        return self.position


class StrikeFingering(_NoteFingering):
    """How percussion plays a note: with a hand or with a foot; the other is null."""

    type: Literal["strike"] = "strike"
    hand: Side | None = None
    foot: Side | None = None
    piece: str
    """What is struck: a piece that the instrument's rig names."""
    zone: str
    """Where on the piece."""

    def __str__(self) -> str:
        limb = f"{self.hand} hand" if self.hand else f"{self.foot} foot"
        return f"{limb}: {self.piece}, {self.zone}"


class KeysFingering(_NoteFingering):
    """How an instrument with keys or finger holes plays a note."""

    type: Literal["keys"] = "keys"
    keys: tuple[str, ...]
    """The keys that are down, or the holes that are shut, by name."""

    def __str__(self) -> str:
        return " ".join(self.keys) or "open"


NoteFingering = Annotated[
    ValvesFingering | SlideFingering | StrikeFingering | KeysFingering, Field(discriminator="type")
]
