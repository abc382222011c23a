"""All tracks of a file, however its chunks are counted and measured."""

from reina.music.errors import ScoreError
from reina.music.limits import Limits
from reina.music.midi.chunks import Header, is_chunk, next_track
from reina.music.midi.track import Track, read_track
from reina.music.warnings import WarningLog


def read_tracks(data: bytes, header: Header, *, offset: int, limits: Limits, log: WarningLog) -> list[Track]:
    """Read every track chunk after the header; unknown chunks, wrong counts and lengths are told of.

    Raises:
        ScoreError: If there is no track.
        ScoreLimitError: If there are too many tracks, other chunks or events.
    """
    tracks: list[Track] = []
    passed = 0
    events_left = limits.events
    at = header.end
    while at < len(data):
        if data[at : at + 4] != b"MTrk":
            passed += 1
            limits.check("chunks", passed, what="number of chunks", location=f"byte {at + offset}")
            at = _pass_chunk(data, at, offset, log)
        elif at + 8 >= len(data):
            log.add("truncated_track", f"byte {at + offset}", "the file ends at the beginning of a track")
            break
        else:
            number = len(tracks) + 1
            limits.check("tracks", number, what="number of tracks", location=f"byte {at + offset}")
            track, at = _read_chunk(data, at, number, offset, events_left, log)
            events_left -= len(track.packed)
            tracks.append(track)
    if not tracks:
        raise ScoreError("the file has a MIDI header and no track", location=f"byte {header.end + offset}")
    if len(tracks) != header.tracks:
        log.add(
            "track_count", "byte 10", f"the header counts {header.tracks} tracks; {len(tracks)} were found"
        )
    return tracks


def _read_chunk(
    data: bytes, at: int, number: int, offset: int, most_events: int, log: WarningLog
) -> tuple[Track, int]:
    """Read the track chunk at `at`; return it and where to go on."""
    place = f"track {number}, byte {at + offset}"
    begin = at + 8
    claimed = int.from_bytes(data[at + 4 : begin], "big")
    end = begin + claimed
    if end > len(data):
        limit = next_track(data, begin)
    else:
        limit = end if is_chunk(data, end) else next_track(data, end)
    track = read_track(data, begin, limit, number=number, offset=offset, most_events=most_events, log=log)
    if track.intact and not track.ended:
        log.add("no_end_of_track", place, "the track has no end-of-track event")
    following = data.find(b"MTrk", track.end, end)
    if end > len(data) or track.end > end or following >= 0:
        log.add("track_length", place, f"the track claims {claimed} bytes; {track.end - begin} were read")
        return track, track.end if following < 0 else following
    if track.ended and track.end < end:
        log.add("after_end_of_track", place, f"{end - track.end} bytes after the track's end were skipped")
    return track, end


def _pass_chunk(data: bytes, at: int, offset: int, log: WarningLog) -> int:
    if is_chunk(data, at):
        length = int.from_bytes(data[at + 4 : at + 8], "big")
        name = data[at : at + 4].decode("ascii")
        log.add(
            "unknown_chunk", f"byte {at + offset}", f"a chunk called {name!r} of {length} bytes was skipped"
        )
        return at + 8 + length
    end = next_track(data, at)
    log.add("unknown_bytes", f"byte {at + offset}", f"{end - at} bytes between the tracks were skipped")
    return end
