"""Texts in Unicode, and texts that end within a character."""

import codecs
import re

LONGEST_BYTES = 500
MARKS = ((codecs.BOM_UTF8, "utf-8"), (codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be"))

_THREE_BYTES = re.compile(rb"[\xe0-\xf4]")


def without_end(data: bytes) -> bytes:
    """Return the beginning of a text, `LONGEST_BYTES` at most, without the blanks and NULs at its end."""
    data = data[:LONGEST_BYTES]
    return data if data.startswith(tuple(mark for mark, _ in MARKS)) else data.rstrip(b"\0 ")


def decode_unicode(data: bytes, *, longer_than_two: bool = False) -> str | None:
    """Decode a text that begins with a byte order mark, or is UTF-8 beyond ASCII; else return None.

    Args:
        data: The text; it may end within a character.
        longer_than_two: Whether UTF-8 is believed only of characters of three and four bytes: two bytes may
            be a character of a double-byte set as well.
    """
    for mark, encoding in MARKS:
        if data.startswith(mark):
            return decode_whole(data[len(mark) :], encoding)[0]
    if longer_than_two and not _THREE_BYTES.search(data):
        return None
    try:
        text = codecs.getincrementaldecoder("utf-8")().decode(data)
    except UnicodeDecodeError:
        return None
    return None if text.isascii() else text


def decode_whole(data: bytes, encoding: str) -> tuple[str, int]:
    """Return the whole characters of a text, wrong bytes replaced, and how many bytes of one end it."""
    decoder = codecs.getincrementaldecoder(encoding)("replace")
    return decoder.decode(data), len(decoder.getstate()[0])
