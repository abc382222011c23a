"""Names in MIDI files, whose character set is nowhere declared."""

import re

from reina.music.midi.languages import DOUBLE_BYTE
from reina.music.midi.unicode_text import decode_unicode, decode_whole, without_end

_CONTROL = re.compile(r"[\x00-\x20\x7f-\x9f\u2028\u2029\ufeff]+")


def decode_text(data: bytes, encoding: str) -> str:
    """Decode the beginning of a name: Unicode if it is, else as `encoding` says.

    Control characters become spaces, wrong bytes U+FFFD; a character that is cut off at the end is left out.

    Args:
        data: The name.
        encoding: What `decide_encoding` found for the file.
    """
    data = without_end(data)
    text = decode_unicode(data, longer_than_two=encoding in DOUBLE_BYTE or encoding == "euc_jp")
    if text is None:
        text, _ = decode_whole(data, encoding)
    return _CONTROL.sub(" ", text).strip()
