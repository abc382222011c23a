"""An alignment as a JSON document, version 1."""

from pydantic import ValidationError

from reina.curves.faults import fault_words
from reina.protocol.alignment import AlignmentDocument
from reina.sound.alignment.alignment import Alignment, AlignmentError, Anchor, Gap, MapPoint
from reina.system.json_text import json_text, read_json


def write_alignment(alignment: Alignment) -> bytes:
    """An alignment as JSON text; times to a tenth of a millisecond."""
    return json_text(_fields(alignment))


def document_of(alignment: Alignment) -> AlignmentDocument:
    """An alignment as its document, checked already; times to a tenth of a millisecond."""
    return AlignmentDocument.model_validate(_fields(alignment))


def _fields(alignment: Alignment) -> dict[str, object]:
    return {
        "version": 1,
        **{name: getattr(alignment, name) for name in AlignmentDocument.model_fields if name != "version"},
        "points": [_rounded(point, alignment.song_duration_s) for point in alignment.points],
        "gaps": [_rounded(gap, alignment.song_duration_s) for gap in alignment.gaps],
        "anchors": [vars(anchor) for anchor in alignment.anchors],
    }


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
        follows_key=document.follows_key,
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
