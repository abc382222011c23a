"""The transport: what a viewer hears of the music clock, and what a controller may ask of it."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from reina.protocol.model import RequestModel, WireModel

MINIMUM_RATE = 0.1
MAXIMUM_RATE = 4.0
MAXIMUM_COUNT_IN_S = 120.0


class Loop(WireModel):
    """The span of song time that is played over and over."""

    start_s: float
    end_s: float
    count_in_s: float = 0.0
    """Song seconds that are counted in before each further round, at the rate, at start_s."""


class TransportState(WireModel):
    """Song time as a function of server time: song_time_s + (t - server_time_s) · rate while playing.

    A count-in comes before: so many song seconds pass, at the rate, while song time stands.
    """

    playing: bool
    song_time_s: float
    """Song time at `server_time_s`."""
    server_time_s: float
    """Seconds on the server's monotonic clock, the one that `pong` answers with."""
    rate: float
    """Song seconds a second."""
    loop: Loop | None
    count_in_s: float = 0.0
    """Song seconds that are still counted in at `server_time_s`, before song time runs."""
    epoch: int
    """Raised by every play, pause, seek, rate, loop and edit; frames carry it modulo 256."""


CountIn = Annotated[float, Field(ge=0, le=MAXIMUM_COUNT_IN_S)]


class Play(RequestModel):
    """Play from where the clock stands (from the start, where it stands at the end)."""

    action: Literal["play"]
    count_in_s: CountIn = 0.0
    """Song seconds that are counted in before: so long song time stands, at the rate."""


class Pause(RequestModel):
    """Stop, and stay."""

    action: Literal["pause"]


class Seek(RequestModel):
    """Go to a song time, held within the score."""

    action: Literal["seek"]
    song_time_s: Annotated[float, Field(ge=0)]


class SetRate(RequestModel):
    """Play faster or slower."""

    action: Literal["rate"]
    rate: Annotated[float, Field(ge=MINIMUM_RATE, le=MAXIMUM_RATE)]


class SetLoop(RequestModel):
    """Loop over a span; both null, or left out, end the loop."""

    action: Literal["loop"]
    start_s: Annotated[float, Field(ge=0)] | None = None
    end_s: Annotated[float, Field(gt=0)] | None = None
    count_in_s: CountIn = 0.0
    """Song seconds that are counted in before each further round."""

    @model_validator(mode="after")
    def _both_or_neither(self) -> Self:
        if (self.start_s is None) != (self.end_s is None):
            raise ValueError("a loop has a start and an end; null both, or leave both out, to end it")
        return self


TransportCommand = Annotated[Play | Pause | Seek | SetRate | SetLoop, Field(discriminator="action")]
