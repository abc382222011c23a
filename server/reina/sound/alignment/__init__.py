"""A recording in time with its score: the map between both times, found by ear and put right by hand.

A name's module is imported when the name is asked for: the process that listens needs no documents.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
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

_PLACES = {
    "Alignment": "reina.sound.alignment.alignment",
    "AlignmentDocument": "reina.sound.alignment.document",
    "AlignmentError": "reina.sound.alignment.alignment",
    "Anchor": "reina.sound.alignment.alignment",
    "Gap": "reina.sound.alignment.alignment",
    "MapPoint": "reina.sound.alignment.alignment",
    "align": "reina.sound.alignment.aligner",
    "alignment_of": "reina.sound.alignment.document",
    "document_of": "reina.sound.alignment.document",
    "read_alignment": "reina.sound.alignment.document",
    "write_alignment": "reina.sound.alignment.document",
}
"""In which module each name is."""


def __getattr__(name: str) -> object:
    place = _PLACES.get(name)
    if place is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value: object = getattr(import_module(place), name)
    globals()[name] = value
    return value
