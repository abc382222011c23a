"""States of a show that are kept and not in memory, read when somebody walks there."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from reina.sessions.storage.show_pieces import stored_track
from reina.show import Show, Track
from reina.show.show_writer import keyframe_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.sessions.show_text import ShowText
    from reina.show import UnknownTrack


def known_tracks(text: ShowText) -> dict[bytes, Track | UnknownTrack]:
    """The tracks of a show that is awake, by the digests that they are kept under."""
    return {stored_track(written).digest: written.track for written in text.tracks.values()}


def wake(read: Show, digests: Sequence[bytes], awake: ShowText) -> Show:
    """A state of a show, which shares with another what both have.

    Args:
        read: The state with those tracks alone that the other does not have.
        digests: Of all its tracks, in their order; none where all have been read.
        awake: The other.
    """
    known = known_tracks(awake) if digests else {}
    others = iter([_sharing(track, awake) for track in read.tracks])
    tracks = tuple(known[digest] if digest in known else next(others) for digest in digests)
    return replace(read, tracks=tracks or tuple(others))


def _sharing(track: Track | UnknownTrack, awake: ShowText) -> Track | UnknownTrack:
    """A track with the keyframes of another state, where they are the same: those weigh nothing then."""
    written = awake.tracks.get(track.parameter)
    if not isinstance(track, Track) or written is None or not isinstance(written.track, Track):
        return track
    shared = dict(zip(written.keyframes, written.track.keyframes, strict=True))
    keyframes = [shared.get(keyframe_text(keyframe), keyframe) for keyframe in track.keyframes]
    return replace(track, keyframes=tuple(keyframes))
