"""A recording in time with its score: the map between both times, found by ear and put right by hand."""

from reina.sound.alignment.aligner import align
from reina.sound.alignment.alignment import Alignment, AlignmentError, Anchor, Gap, MapPoint
from reina.sound.alignment.document import (
    AlignmentDocument,
    alignment_of,
    document_of,
    read_alignment,
    write_alignment,
)

__all__ = [
    "Alignment",
    "AlignmentDocument",
    "AlignmentError",
    "Anchor",
    "Gap",
    "MapPoint",
    "align",
    "alignment_of",
    "document_of",
    "read_alignment",
    "write_alignment",
]
