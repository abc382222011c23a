"""ID3v2 tags (id3.org), which some programs put before sound of any format."""

from reina.sound.recording.stream import Data

HEADER_BYTES = 10
HAS_FOOTER = 0x10


def skip_tags(data: Data) -> int:
    """Return where the file goes on after the ID3v2 tags at its beginning; several may follow one another.

    A tag that claims to be longer than the file is skipped but for its header.
    """
    at = 0
    while data[at : at + 3] == b"ID3" and len(header := data[at : at + HEADER_BYTES]) == HEADER_BYTES:
        size = 0
        for byte in header[6:]:
            size = size << 7 | byte & 0x7F
        following = at + HEADER_BYTES + size + (HEADER_BYTES if header[5] & HAS_FOOTER else 0)
        at = following if following < len(data) else at + HEADER_BYTES
    return at
