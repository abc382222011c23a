"""Whether bytes are a MusicXML document, by their beginning."""

import codecs
import re

LOOKED_AT_BYTES = 65_536
"""Comments and processing instructions may stand before a document's first element."""

_ROOT = re.compile(r"<(?:!DOCTYPE\s+|[\w.-]{1,30}:)?score-(?:partwise|timewise)\b")
_UTF_16 = (
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
    (b"<\0", "utf-16-le"),
    (b"\0<", "utf-16-be"),
)


def is_musicxml(data: bytes) -> bool:
    """Return whether `data`, or the file that it is the beginning of, is MusicXML of either kind."""
    head = data[:LOOKED_AT_BYTES]
    encoding = next((name for begins, name in _UTF_16 if head.startswith(begins)), "latin-1")
    text = head.decode(encoding, errors="ignore")
    return text.lstrip("\ufeffï»¿ \t\r\n").startswith("<") and _ROOT.search(text) is not None
