"""Where the links of an Ogg file stand (RFC 3533): one after another, as radio and joined files have."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from reina.sound.recording.facts import BrokenAudioError
from reina.sound.recording.flac import unbounded_flac
from reina.sound.recording.stream import Data, SoundStream, Splice

MARK = b"OggS"
HEADER_BYTES = 27
VERSION = 0
BEGINS_A_STREAM = 2
"""Flag of a page."""
FLAC_PACKET = b"\x7fFLAC"
FLAC_PREFIX_BYTES = 9
"""What stands before the FLAC file in the first packet: the mark, a version, the number of header packets."""


@dataclass
class _Link:
    """One link, and where its pages' contents stand, by the serial number of their stream."""

    start: int
    end: int
    contents: dict[bytes, list[range]] = field(default_factory=dict[bytes, list[range]])


def is_ogg(head: bytes) -> bool:
    """Whether a file that begins so is Ogg."""
    return head.startswith(MARK)


def ogg_streams(data: Data, start: int) -> list[SoundStream]:
    """Return the links of an Ogg file; positions that their pages claim are not looked at.

    Raises:
        BrokenAudioError: Not one page is whole.
    """
    links: list[_Link] = []
    within_headers = False
    for at, end, flags, serial, content in _pages(data, start):
        begins = bool(flags & BEGINS_A_STREAM)
        # Several streams of one link, such as pictures and sound, all begin before the first goes on.
        if not links or (begins and not within_headers):
            links.append(_Link(at, end))
        within_headers = begins
        links[-1].end = end
        links[-1].contents.setdefault(serial, []).append(content)
    if not links:
        raise BrokenAudioError("it has no whole Ogg page")
    return [_stream(data, link) for link in links]


def _stream(data: Data, link: _Link) -> SoundStream:
    """A link as it is, or the FLAC file in it, which in Ogg is only cut into packets."""
    for contents in link.contents.values():
        first = contents[0]
        if data[first.start : first.start + len(FLAC_PACKET)] == FLAC_PACKET:
            return unbounded_flac(data, (first[FLAC_PREFIX_BYTES:], *contents[1:]))
    return SoundStream(Splice(data, range(link.start, link.end)), is_ogg=True, piped=True)


def _pages(data: Data, start: int) -> Iterator[tuple[int, int, int, bytes, range]]:
    """Yield each whole page: its beginning, its end, its flags, its stream, and where its content stands."""
    at = data.find(MARK, start)
    while at >= 0:
        header = data[at : at + HEADER_BYTES]
        following = at + len(MARK)
        if len(header) == HEADER_BYTES and header[4] == VERSION:
            content = at + HEADER_BYTES + header[26]
            end = content + sum(data[at + HEADER_BYTES : content])
            if end <= len(data):
                yield at, end, header[5], header[14:18], range(content, end)
                following = end
        at = data.find(MARK, following)
