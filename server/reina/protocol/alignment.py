"""Where a score is heard in its song: the document, version 1, and what is told of it."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, FailFast, Field

from reina.protocol.model import RequestModel, WireModel

MAX_POINTS = 100_000
MAX_ANCHORS = 10_000
# Lists fail fast: of many thousands of entries with faults the first is told, and no memory goes to the rest.

Seconds = Annotated[float, Field(allow_inf_nan=False, ge=-1e6, le=1e6)]
Length = Annotated[float, Field(allow_inf_nan=False, gt=0, le=1e6)]
Share = Annotated[float, Field(ge=0, le=1)]


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class PointDocument(_Model):
    """A place of the score and where it is heard, as `MapPoint`."""

    score_s: Seconds
    song_s: Seconds
    confidence: Share = 1.0


class GapDocument(_Model):
    """What one of both leaves out, as `Gap`."""

    score_from_s: Seconds
    score_to_s: Seconds
    song_from_s: Seconds
    song_to_s: Seconds


class AnchorDocument(_Model):
    """A place of the score that a person has put where they hear it, as `Anchor`."""

    score_s: Seconds
    song_s: Seconds


class AlignmentDocument(_Model):
    """Where each place of a score is heard in a recording, as `Alignment`."""

    version: Literal[1] = 1
    points: Annotated[list[PointDocument], FailFast(), Field(max_length=MAX_POINTS)]
    score_duration_s: Length
    song_duration_s: Length
    gaps: Annotated[list[GapDocument], FailFast(), Field(max_length=MAX_POINTS)] = []
    is_same_music: bool = True
    transposition: Annotated[int, Field(ge=-6, le=6)] = 0
    tuning_cents: Annotated[float, Field(ge=-50, le=50)] = 0.0
    count_in: Annotated[int, Field(ge=0)] = 0
    sounds_after: bool = False
    anchors: Annotated[list[AnchorDocument], FailFast(), Field(max_length=MAX_ANCHORS)] = []
    offset_s: Seconds = 0.0
    follows_key: bool = False


class AlignmentState(WireModel):
    """How far a session's score is in time with its song."""

    status: Literal["none", "searching", "found", "unlike", "failed"]
    """`none`: the song is rendered from the score, or is M4A or WebM that no page has decoded yet; `unlike`:
    it is other music, and both begin at 0."""
    progress: float
    """0 to 1; 1 once something is known."""
    confidence: float | None
    """0 to 1, how sure it is on the whole; null until something is known."""
    detail: str | None
    """Why it failed."""


class AlignedBeat(WireModel):
    """A beat of the score, and where it is heard."""

    score_s: float
    """In the score as it is written: what an anchor's `score_s` is."""
    song_s: float


class AlignedBar(WireModel):
    """A bar of the score, and where it is heard."""

    number: int
    """As musicians count: the first whole bar is 1, a pickup before it 0."""
    confidence: float
    """0 to 1, how surely it begins where it is thought to."""
    is_heard: bool
    """False where the recording leaves it out."""
    beats: list[AlignedBeat]
    """As they are conducted (dotted quarters in 6/8); the first is the bar line."""


class Alignment(AlignmentState):
    """Where a session's score is heard in its song."""

    is_searchable: bool
    """Whether the server can look for the score in the song: in M4A and WebM only once `song/analysis` has
    had them decoded; there is nothing to look for in what is rendered."""
    song_duration_s: float | None
    """Length of the recording; null where the song is rendered, or its length is not known."""
    bars: list[AlignedBar]
    """Where music ends with a whole bar, the last is the bar line there. Empty where the song is rendered."""
    alignment: AlignmentDocument | None
    """What was found and what people put right: a document that can be kept, and put into a session of the
    same score and song. Null until something is known."""


class AlignmentCorrections(RequestModel):
    """What a person puts right in an alignment."""

    anchors: Annotated[list[AnchorDocument], FailFast(), Field(max_length=MAX_ANCHORS)] = Field(
        default_factory=list[AnchorDocument]
    )
    """Places of the score that are put where they are heard; what was found goes through them."""
    offset_s: Seconds = 0.0
    """By how much everything is heard later, seconds."""
    follows_key: bool = False
    """Whether all is played in the recording's key, `transposition` semitones above the score's; else in the
    score's."""
