"""Names in MIDI files, whose character set is nowhere declared."""

import re

LONGEST_BYTES = 500

_KANA = re.compile(r"[\u3040-\u30ff\uff66-\uff9f]{2}")
_CONTROL = re.compile(r"[\x00-\x20\x7f-\x9f]+")


def decode_text(data: bytes) -> str:
    """Decode the beginning of a name: UTF-8, else Shift JIS if that gives kana, else Windows-1252.

    Control characters become spaces.
    """
    data = data[:LONGEST_BYTES]
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        text = _decode_shift_jis(data) or data.decode("cp1252", errors="replace")
    return _CONTROL.sub(" ", text).strip()


def _decode_shift_jis(data: bytes) -> str | None:
    try:
        text = data.decode("cp932")
    except UnicodeDecodeError:
        return None
    return text if _KANA.search(text) else None
