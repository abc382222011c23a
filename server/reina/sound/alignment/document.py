"""An alignment as a JSON document, version 1."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from reina.curves.faults import fault_words
from reina.sound.alignment.alignment import Alignment, AlignmentError, Anchor, Gap, MapPoint
from reina.system.json_text import json_text, read_json

MAX_POINTS = 100_000
MAX_ANCHORS = 10_000

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
    points: Annotated[list[PointDocument], Field(max_length=MAX_POINTS)]
    score_duration_s: Length
    song_duration_s: Length
    gaps: Annotated[list[GapDocument], Field(max_length=MAX_POINTS)] = []
    is_same_music: bool = True
    transposition: Annotated[int, Field(ge=-6, le=6)] = 0
    tuning_cents: Annotated[float, Field(ge=-50, le=50)] = 0.0
    count_in: Annotated[int, Field(ge=0)] = 0
    sounds_after: bool = False
    anchors: Annotated[list[AnchorDocument], Field(max_length=MAX_ANCHORS)] = []
    offset_s: Seconds = 0.0


def write_alignment(alignment: Alignment) -> bytes:
    """An alignment as JSON text; times to a tenth of a millisecond."""
    document = {
        "version": 1,
        **{name: getattr(alignment, name) for name in AlignmentDocument.model_fields if name != "version"},
        "points": [_rounded(point, alignment.song_duration_s) for point in alignment.points],
        "gaps": [_rounded(gap, alignment.song_duration_s) for gap in alignment.gaps],
        "anchors": [vars(anchor) for anchor in alignment.anchors],
    }
    return json_text(document)


def read_alignment(text: bytes) -> Alignment:
    """Read what `write_alignment` writes, or what a person or program has made of it.

    Raises:
        AlignmentError: It is no such document, runs backwards or leaves the recording; `location` says where.
    """
    try:
        document = AlignmentDocument.model_validate(read_json(text))
    except ValidationError as error:
        # The outermost fault: what is within it follows from it.
        fault = min(error.errors(include_url=False), key=lambda found: len(found["loc"]))
        place = "/".join(str(part) for part in fault["loc"]) or None
        raise AlignmentError(_words(place, fault["type"]) or fault_words(fault), location=place) from error
    except ValueError as error:
        raise AlignmentError(f"it is no JSON: {error}") from error
    return alignment_of(document)


def alignment_of(document: AlignmentDocument) -> Alignment:
    """The alignment that a document holds.

    Raises:
        AlignmentError: It runs backwards or leaves the recording; `location` says where.
    """
    return Alignment(
        points=tuple(MapPoint(**point.model_dump()) for point in document.points),
        score_duration_s=document.score_duration_s,
        song_duration_s=document.song_duration_s,
        gaps=tuple(Gap(**gap.model_dump()) for gap in document.gaps),
        is_same_music=document.is_same_music,
        transposition=document.transposition,
        tuning_cents=document.tuning_cents,
        count_in=document.count_in,
        sounds_after=document.sounds_after,
        anchors=tuple(Anchor(**anchor.model_dump()) for anchor in document.anchors),
        offset_s=document.offset_s,
    )


def _words(place: str | None, kind: str) -> str | None:
    if kind == "extra_forbidden":
        return "there is no such field"
    if place == "version":
        return "only version 1 is read here"
    return None


def _rounded(item: MapPoint | Gap, song_duration_s: float) -> dict[str, float]:
    """Rounded, but not out of the recording."""
    rounded = {name: round(value, 4) for name, value in vars(item).items()}
    return {
        name: min(value, song_duration_s) if name.startswith("song") else value
        for name, value in rounded.items()
    }
