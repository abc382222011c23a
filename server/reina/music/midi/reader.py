"""A Standard MIDI File into a score."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from reina.music.arrays import BoolArray, FloatArray
from reina.music.errors import NotInScoreError, ScoreError
from reina.music.limits import Limits
from reina.music.midi.channel_state import read_channel_state
from reina.music.midi.chunks import read_header, unwrap
from reina.music.midi.control_messages import read_controls
from reina.music.midi.division import Division, read_division
from reina.music.midi.encoding import decide_encoding
from reina.music.midi.maps import read_key_signatures, read_metre_map, read_tempo_map
from reina.music.midi.messages import Messages
from reina.music.midi.note_ends import NoteEnds, find_note_ends
from reina.music.midi.pairing import Pairs, pair_notes
from reina.music.midi.parts import find_parts
from reina.music.midi.silences import find_silences
from reina.music.midi.text import decode_text
from reina.music.midi.track import INSTRUMENT_NAME, NOTE_OFF, NOTE_ON, TRACK_NAME, Track
from reina.music.midi.tracks import read_tracks
from reina.music.midi.words import karaoke_title, read_texts
from reina.music.notes import Notes
from reina.music.score import Score
from reina.music.taps import TAP_S, lengthen_taps
from reina.music.tempo import TempoMap
from reina.music.warnings import WarningLog


def read_midi(data: bytes, *, title: str, sequence: int | None, limits: Limits) -> Score:
    """Read a MIDI file; `reina.music.read_score` says more.

    Raises:
        ScoreError: If it holds no note, or is no MIDI file.
    """
    log = WarningLog()
    data, offset = unwrap(data, log)
    header = read_header(data, log)
    division = read_division(header.division, log)
    tracks = read_tracks(data, header, offset=offset, limits=limits, log=log)
    if header.format == 0 and len(tracks) > 1:
        log.add(
            "format_0_tracks", "byte 8", f"format 0 has one track; all {len(tracks)} were read, as format 1"
        )
    encoding = decide_encoding(_texts(tracks))
    sequences = 1
    if header.format == 2:
        tracks, sequence, sequences = _choose_sequence(tracks, sequence, log)
    elif sequence not in {None, 0}:
        raise NotInScoreError(
            f"the file holds one sequence, 0; there is no sequence {sequence}", location="sequence"
        )

    messages = Messages.of(tracks)
    is_silence = find_silences(messages)
    sounding = (messages.command == NOTE_ON) | (messages.command == NOTE_OFF)
    note_messages = messages.take(np.flatnonzero(sounding & ~is_silence))
    is_on = (note_messages.command == NOTE_ON) & (note_messages.second > 0)
    if not np.any(is_on):
        raise ScoreError(
            "the file is MIDI and holds no note", location=f"{len(tracks)} track{'s' * (len(tracks) != 1)}"
        )
    limits.check("notes", int(np.count_nonzero(is_on)), what="number of notes")

    tempo_map = read_tempo_map(tracks, division, log)
    key = note_messages.track << 19 | note_messages.channel << 7 | note_messages.first
    pairs = pair_notes(key, is_on, note_messages.tick)
    on = note_messages.take(pairs.on)
    track_end = np.array([track.end_tick for track in tracks], dtype=np.int64)
    silences = messages.take(np.flatnonzero(is_silence))
    ends = find_note_ends(silences, note_messages, is_on, pairs, track_end, division.ticks_per_beat)
    notes = _time_notes(on, ends, tracks, division, tempo_map, log)
    _tell_of_pairs(note_messages, pairs, tracks, log)
    state = read_channel_state(messages, on, tracks)
    parts, part = find_parts(tracks, on, state, encoding)
    end_s, end_beats = float(np.max(notes.end_s)), float(np.max(notes.end_beats))
    limits.check("duration_s", end_s, what="length in seconds")
    limits.check("beats", end_beats, what="length in beats")
    metre_map = read_metre_map(tracks, division, log)
    key_signatures = read_key_signatures(tracks, division, log)
    limits.check("bars", metre_map.bar_count(end_beats), what="number of bars")
    table = Notes.from_columns(
        part=part,
        channel=on.channel,
        onset_s=notes.onset_s,
        duration_s=notes.end_s - notes.onset_s,
        onset_beats=notes.onset_beats,
        duration_beats=notes.end_beats - notes.onset_beats,
        sounding_pitch=on.first,
        velocity=on.second / 127.0,
        program=state.program,
    )
    return Score(
        title=karaoke_title(tracks, encoding) or _title(tracks, header.format, encoding) or title,
        parts=parts,
        notes=table,
        tempo_map=tempo_map,
        metre_map=metre_map,
        controls=read_controls(messages, division, tempo_map),
        warnings=log.warnings(),
        duration_s=float(np.max(table.end_s)),
        sequence=sequence or 0,
        sequences=sequences,
        key_signatures=key_signatures,
        texts=read_texts(tracks, encoding, division, tempo_map),
    )


def _choose_sequence(
    tracks: list[Track], sequence: int | None, log: WarningLog
) -> tuple[list[Track], int, int]:
    """Return the tracks of one sequence of a format 2 file, its number and how many have notes."""
    with_notes = [t for t in tracks if any(p >> 20 & 0xF == NOTE_ON and p & 0xFF for p in t.packed)]
    if not with_notes:
        return tracks, 0, 1
    if sequence is not None and not 0 <= sequence < len(with_notes):
        last = len(with_notes) - 1
        held = f"{last + 1} sequences, 0 to {last}" if last else "one sequence, 0"
        raise NotInScoreError(f"the file holds {held}; there is no sequence {sequence}", location="sequence")
    if len(with_notes) > 1 and sequence is None:
        count = len(with_notes)
        log.add(
            "sequences",
            "byte 8",
            f"the file holds {count} sequences; the first was read, the others can be chosen",
            things=count,
        )
    chosen = sequence or 0
    return [with_notes[chosen]], chosen, len(with_notes)


@dataclass(frozen=True)
class TimedNotes:
    """When notes sound, in the order of their messages, as columns of one length."""

    onset_beats: FloatArray
    end_beats: FloatArray
    onset_s: FloatArray
    end_s: FloatArray


def _time_notes(
    on: Messages,
    ends: NoteEnds,
    tracks: Sequence[Track],
    division: Division,
    tempo_map: TempoMap,
    log: WarningLog,
) -> TimedNotes:
    onset_beats = on.tick / division.ticks_per_beat
    end_beats = ends.tick / division.ticks_per_beat
    onset_s, end_s = tempo_map.seconds(onset_beats), tempo_map.seconds(end_beats)
    end_s, end_beats, taps = lengthen_taps(onset_s, end_s, end_beats, tempo_map)
    _tell(
        log,
        tracks,
        on,
        "unreleased_note",
        ends.struck_again,
        "is never released; it ends where its key is struck again",
    )
    _tell(
        log,
        tracks,
        on,
        "unreleased_note",
        ends.left,
        "is never released; when it ends is a guess",
    )
    _tell(log, tracks, on, "silenced_note", ends.silenced, "ends where its channel is silenced")
    is_tap = np.zeros(len(onset_s), dtype=np.bool_)
    is_tap[taps] = True
    _tell(
        log,
        tracks,
        on,
        "zero_length_note",
        is_tap,
        f"ends where it begins; it sounds for {TAP_S * 1000:.0f} ms",
    )
    return TimedNotes(onset_beats, end_beats, onset_s, end_s)


def _tell_of_pairs(messages: Messages, pairs: Pairs, tracks: Sequence[Track], log: WarningLog) -> None:
    on = messages.take(pairs.on)
    _tell(
        log,
        tracks,
        on,
        "overlapping_note",
        pairs.overlapping,
        "begins while it sounds; the first to begin ends first",
    )
    if len(pairs.stray):
        count, first = len(pairs.stray), int(pairs.stray[0])
        place = f"track {tracks[int(messages.track[first])].number}, tick {messages.tick[first]}"
        message = f"{count} note-offs end no note, the first here; they were left out"
        log.add("stray_note_off", place, message, things=count)


def _tell(
    log: WarningLog, tracks: Sequence[Track], on: Messages, kind: str, chosen: BoolArray, what: str
) -> None:
    """Tell of notes what was found; `on` are their messages."""
    found = np.flatnonzero(chosen).tolist()
    for done, note in enumerate(found):
        if not log.room(kind):
            log.add(kind, "", "", count=len(found) - done)
            break
        place = f"track {tracks[int(on.track[note])].number}, tick {on.tick[note]}"
        log.add(kind, place, f"note {on.first[note]} {what}")


def _texts(tracks: Sequence[Track]) -> Iterator[bytes]:
    """Yield the names, which matter most, then the other texts."""
    for track in tracks:
        yield from (meta.data for meta in track.metas if meta.kind in {TRACK_NAME, INSTRUMENT_NAME})
    for track in tracks:
        yield from track.texts


def _title(tracks: Sequence[Track], file_format: int, encoding: str) -> str:
    """Return the name of the first track if that names the sequence and not a part, else nothing."""
    first = tracks[0]
    names = [decode_text(meta.data, encoding) for meta in first.metas if meta.kind == TRACK_NAME]
    is_sequence = file_format != 1 or not any(p >> 20 & 0xF == NOTE_ON for p in first.packed)
    return names[0] if names and is_sequence else ""
