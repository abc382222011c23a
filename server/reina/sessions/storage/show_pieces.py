"""A show in pieces: what an edit does not touch is kept once for all states.

A state is the show's head and its tracks, by their digests; a long track is a list of pieces, by theirs.
Where a track is cut follows from its keyframes' own text, so that an edit in the middle leaves the other
pieces as they are, whatever moves.
"""

from __future__ import annotations

import hashlib
import zlib
from dataclasses import dataclass
from itertools import accumulate
from typing import TYPE_CHECKING, Any, cast

from reina.show import Track
from reina.system.json_text import Written, json_text, read_json

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from reina.sessions.show_text import ShowText, TrackText

DIGEST_BYTES = 16
CUT_AFTER = 128
"""One keyframe in so many, by the checksum of its text, is the last of its piece."""
PIECE_BYTES = 65_536
"""A shorter track is not cut, and one that is no keyframes is cut into pieces of this length."""
LEVEL = 1
"""Of zlib: pieces are short, and written often."""
TEXT, LIST = b"t", b"l"
"""What an object begins with: it is a text, or a list of the digests of such."""


class ShowUnreadableError(ValueError):
    """What is kept of a show is not all there."""


@dataclass(frozen=True)
class StoredTrack:
    """A track as it is kept.

    Attributes:
        digest: Of its object.
        pieces: Of the pieces, where it is a list of them.
        objects: Each object that belongs to it, not compressed: digest -> bytes.
    """

    digest: bytes
    pieces: tuple[bytes, ...]
    objects: Mapping[bytes, bytes | memoryview]

    @classmethod
    def of(cls, track: TrackText) -> StoredTrack:
        """Cut a track; nothing is copied but what is short."""
        ends = _cuts(track)
        if len(ends) == 1:
            whole = TEXT + track.text
            return cls(_digest(whole), (), {_digest(whole): whole})
        text = memoryview(track.text)
        pieces = [text[start:end] for start, end in zip([0, *ends], ends, strict=False)]
        digests = tuple(_digest(TEXT, piece) for piece in pieces)
        listed = LIST + b"".join(digests)
        objects: dict[bytes, bytes | memoryview] = dict(zip(digests, pieces, strict=True))
        return cls(_digest(listed), digests, {**objects, _digest(listed): listed})


@dataclass(frozen=True)
class StoredState:
    """A show as it was at one time, as it is kept.

    Attributes:
        head: Everything but its tracks; None where it is one text, as it came.
        tracks: The digests of its tracks in their order, or of the one text.
    """

    head: Mapping[str, Any] | None
    tracks: tuple[bytes, ...]

    def written(self) -> bytes:
        """As it stands in the database."""
        document = {"head": self.head, "tracks": b"".join(self.tracks).hex()}
        return zlib.compress(json_text(document), LEVEL)

    @classmethod
    def read(cls, data: bytes) -> StoredState:
        """What `written` gave.

        Raises:
            ShowUnreadableError: It is damaged.
        """
        try:
            document = read_json(zlib.decompress(data))
            return cls(document["head"], split(bytes.fromhex(document["tracks"])))
        except (ValueError, zlib.error, KeyError, TypeError) as error:
            raise ShowUnreadableError(f"a state of its show is damaged: {error}") from error


def state_of(text: ShowText) -> tuple[StoredState, dict[bytes, StoredTrack]]:
    """A show as it is to be kept: the state, and its tracks by digest."""
    tracks = [stored_track(track) for track in text.tracks.values()]
    state = StoredState(text.head, tuple(track.digest for track in tracks))
    return state, {track.digest: track for track in tracks}


def state_of_text(text: bytes) -> tuple[StoredState, dict[bytes, StoredTrack]]:
    """A show that is kept byte by byte as it came."""
    whole = TEXT + text
    digest = _digest(whole)
    return StoredState(None, (digest,)), {digest: StoredTrack(digest, (), {digest: whole})}


def stored_track(track: TrackText) -> StoredTrack:
    """A track as it is to be kept; kept beside the text, which is cut once."""
    kept = cast("StoredTrack | None", track.__dict__.get(_STORED))
    if kept is None:
        kept = StoredTrack.of(track)
        object.__setattr__(track, _STORED, kept)
    return kept


_STORED = "_stored"


def packed(content: bytes | memoryview) -> bytes:
    """An object as it stands in the database: compressed, with what it is in front."""
    # Pieces are parts of a text that is in memory once; whole objects have their kind already.
    whole = content if isinstance(content, bytes) else b"".join((TEXT, content))
    return zlib.compress(whole, LEVEL)


def unpacked(digest: bytes, data: bytes) -> tuple[bytes, bytes]:
    """What an object is, and what it holds.

    Raises:
        ShowUnreadableError: It is damaged.
    """
    try:
        whole = zlib.decompress(data)
    except zlib.error as error:
        raise ShowUnreadableError(f"a part of its show is damaged: {error}") from error
    if _digest(whole) != digest:
        raise ShowUnreadableError("a part of its show is not what it was")
    return whole[:1], whole[1:]


def track_texts(
    tracks: Iterable[bytes], fetch: Callable[[set[bytes]], Mapping[bytes, bytes]]
) -> dict[bytes, bytes]:
    """The texts of tracks.

    Args:
        tracks: Their digests.
        fetch: Digests -> objects as they stand in the database.

    Raises:
        ShowUnreadableError: Something is missing or damaged.
    """
    wanted = set(tracks)
    objects = {digest: unpacked(digest, data) for digest, data in fetch(wanted).items()}
    pieces = {piece for kind, content in objects.values() if kind == LIST for piece in split(content)}
    parts = {digest: unpacked(digest, data) for digest, data in fetch(pieces).items()} if pieces else {}
    texts: dict[bytes, bytes] = {}
    try:
        for digest in wanted:
            kind, content = objects[digest]
            texts[digest] = content if kind == TEXT else b"".join(parts[each][1] for each in split(content))
    except KeyError:
        raise ShowUnreadableError("a part of its show is missing") from None
    return texts


def show_text(state: StoredState, texts: Mapping[bytes, bytes]) -> bytes:
    """The show of a state as JSON text, with those of its tracks whose texts are given."""
    if state.head is None:
        return b"".join(texts[digest] for digest in state.tracks)
    tracks = [Written(texts[digest]) for digest in state.tracks if digest in texts]
    return json_text({**state.head, "tracks": tracks})


def split(digests: bytes) -> tuple[bytes, ...]:
    """Digests that stand one after another."""
    return tuple(digests[at : at + DIGEST_BYTES] for at in range(0, len(digests), DIGEST_BYTES))


def _digest(*content: bytes | memoryview) -> bytes:
    made = hashlib.blake2b(digest_size=DIGEST_BYTES)
    for each in content:
        made.update(each)
    return made.digest()


def _cuts(written: TrackText) -> list[int]:
    """Where the pieces of a track's text end; the last at its end."""
    track, size = written.track, len(written.text)
    if size <= PIECE_BYTES:
        return [size]
    if not isinstance(track, Track):
        return [*range(PIECE_BYTES, size, PIECE_BYTES), size]
    texts = written.keyframes
    # The keyframes end the text: "…[a,b,c]}". A piece ends after the comma behind its last one.
    start = size - len("]}") - sum(map(len, texts)) - (len(texts) - 1)
    ends = accumulate((len(text) + 1 for text in texts), initial=start)
    next(ends)
    cuts = [end for text, end in zip(texts, ends, strict=True) if zlib.crc32(text) % CUT_AFTER == 0]
    return [*(cut for cut in cuts if cut < size), size]
