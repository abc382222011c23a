"""Names in MIDI files, whose character set is nowhere declared."""

import re

from reina.music.midi.languages import DOUBLE_BYTE
from reina.music.midi.unicode_text import LONGEST_BYTES, decode_unicode, decode_whole, without_end

_CONTROL = re.compile(r"[\x00-\x20\x7f-\x9f\u2028\u2029\ufeff]+")


def decode_text(data: bytes, encoding: str) -> str:
    """Decode the beginning of a name: Unicode if it is, else as `encoding` says.

    Control characters become spaces, wrong bytes U+FFFD; a character that is cut off at the end is left out.

    Args:
        data: The name.
        encoding: What `decide_encoding` found for the file.
    """
    return _CONTROL.sub(" ", decode_words(without_end(data), encoding)).strip()


def decode_words(data: bytes, encoding: str) -> str:
    """Decode a text as `decode_text` does, with its blanks and line ends."""
    data = data[:LONGEST_BYTES].rstrip(b"\0")
    text = decode_unicode(data, longer_than_two=encoding in DOUBLE_BYTE or encoding == "euc_jp")
    return decode_whole(data, encoding)[0] if text is None else text
