"""A show as text: what is kept on disk, what is answered, and what its validators are made of."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from reina.show import Show, Track
from reina.show.show_writer import WrittenTrack, written_track
from reina.system.json_text import json_text, with_list

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.show import UnknownTrack

NO_TRACK_ETAG = '"none"'
"""The validator of a track that is not there, so that its first keyframe can be added under a condition."""


@dataclass(frozen=True)
class TrackText:
    """One track.

    Attributes:
        track: The track.
        text: Its JSON, UTF-8.
        etag: Its validator, in quotes (RFC 9110, 8.8.3).
        written: Where in the text its keyframes are.
    """

    track: Track | UnknownTrack
    text: bytes
    etag: str
    written: WrittenTrack | None = None

    @property
    def keyframes(self) -> list[bytes]:
        """The text of each keyframe."""
        return [] if self.written is None else self.written.keyframes()

    @property
    def known(self) -> dict[int, bytes]:
        """The texts of its keyframes by their ids (`id`)."""
        objects = self.track.keyframes if isinstance(self.track, Track) else ()
        return dict(zip(map(id, objects), self.keyframes, strict=True))


@dataclass(frozen=True)
class ShowText:
    """A show, written. Validators follow from what is written alone: they outlive the server.

    Attributes:
        show: The show.
        head: Everything but its tracks.
        tracks: Each track, by its parameter's path.
        etag: The whole show's validator, in quotes.
    """

    show: Show
    head: dict[str, Any]
    tracks: dict[str, TrackText]
    etag: str

    @classmethod
    def of(cls, show: Show, earlier: ShowText | None = None) -> ShowText:
        """Write a show; tracks that an earlier state shares are not written again."""
        before = {} if earlier is None else earlier.tracks
        known: dict[int, TrackText] = {}
        if earlier is not None and earlier.show.time == show.time:
            known = {id(written.track): written for written in before.values()}
        tracks = {
            track.parameter: known.get(id(track)) or _written(track, show, before.get(track.parameter))
            for track in show.tracks
        }
        head = replace(show, tracks=()).to_document()
        del head["tracks"]
        etag = _etag(json_text(head), *(written.etag.encode() for written in tracks.values()))
        return cls(show=show, head=head, tracks=tracks, etag=etag)

    def text(self, parameters: Iterable[str] | None = None) -> bytes:
        """The show as JSON with the tracks of some parameters alone; with all of them when None."""
        paths = self.tracks if parameters is None else dict.fromkeys(parameters)
        return with_list(
            self.head, "tracks", [self.tracks[path].text for path in paths if path in self.tracks]
        )

    def track_etag(self, path: str) -> str:
        """The validator of a parameter's track; `NO_TRACK_ETAG` where there is none."""
        written = self.tracks.get(path)
        return written.etag if written else NO_TRACK_ETAG


def _written(track: Track | UnknownTrack, show: Show, before: TrackText | None) -> TrackText:
    if not isinstance(track, Track):
        return TrackText(track, track.text, _etag(track.text))
    written = written_track(track, show.time, None if before is None else before.known)
    return TrackText(track, written.text, _etag(written.text), written)


def _etag(*texts: bytes) -> str:
    digest = hashlib.sha256(b"\n".join(texts)).hexdigest()
    return f'"{digest[:24]}"'
