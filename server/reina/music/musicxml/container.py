"""The container of compressed MusicXML, which names its document."""

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import ParseError, fromstring

TYPE = "application/vnd.recordare.musicxml"
MUSICXML_TYPES = frozenset({"", TYPE, f"{TYPE}+xml"})


def document_path(data: bytes) -> str | None:
    """Return the path in the archive of the document that a container names; None if it names none."""
    try:
        root = fromstring(data)
    except (ParseError, DefusedXmlException, ValueError, LookupError):
        return None
    for element in root.iter():
        if str(element.tag).rpartition("}")[2] != "rootfile":
            continue
        if element.get("media-type", "").strip() in MUSICXML_TYPES and element.get("full-path"):
            return element.get("full-path")
    return None
