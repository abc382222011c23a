"""A Standard MIDI File into a score."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from reina.music.arrays import FloatArray, IntArray
from reina.music.errors import NotInScoreError, ScoreError
from reina.music.limits import Limits
from reina.music.midi.chunks import read_header, unwrap
from reina.music.midi.control_messages import read_controls
from reina.music.midi.division import Division, read_division
from reina.music.midi.encoding import decide_encoding
from reina.music.midi.maps import read_metre_map, read_tempo_map
from reina.music.midi.messages import Messages
from reina.music.midi.pairing import Pairs, pair_notes
from reina.music.midi.parts import find_parts
from reina.music.midi.text import decode_text
from reina.music.midi.track import INSTRUMENT_NAME, NOTE_OFF, NOTE_ON, PROGRAM, TRACK_NAME, Track
from reina.music.midi.tracks import read_tracks
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
            f"the file holds one sequence, 0; there is no sequence {sequence}", where="sequence"
        )

    messages = Messages.of(tracks)
    sounding = (messages.command == NOTE_ON) | (messages.command == NOTE_OFF)
    note_messages = messages.take(np.flatnonzero(sounding))
    is_on = (note_messages.command == NOTE_ON) & (note_messages.second > 0)
    if not np.any(is_on):
        raise ScoreError("the file is MIDI and holds no note", where=f"{len(tracks)} tracks")
    limits.check("notes", int(np.count_nonzero(is_on)), what="number of notes")

    tempo_map = read_tempo_map(tracks, division, log)
    key = note_messages.track << 11 | note_messages.channel << 7 | note_messages.first
    pairs = pair_notes(key, is_on)
    notes, part_of_note = _time_notes(note_messages, pairs, tracks, division, tempo_map, log)
    parts, part = find_parts(tracks, part_of_note, notes.tick, _programs(messages), encoding)
    end_s, end_beats = float(np.max(notes.end_s)), float(np.max(notes.end_beats))
    limits.check("duration_s", end_s, what="length in seconds")
    limits.check("beats", end_beats, what="length in beats")
    metre_map = read_metre_map(tracks, division, log)
    limits.check("bars", metre_map.bar_count(end_beats), what="number of bars")
    table = Notes.from_columns(
        part=part,
        channel=notes.channel,
        onset_s=notes.onset_s,
        duration_s=notes.end_s - notes.onset_s,
        onset_beats=notes.onset_beats,
        duration_beats=notes.end_beats - notes.onset_beats,
        sounding_pitch=notes.pitch,
        velocity=notes.velocity,
    )
    return Score(
        title=_title(tracks, header.format, encoding) or title,
        parts=parts,
        notes=table,
        tempo_map=tempo_map,
        metre_map=metre_map,
        controls=read_controls(messages.take(np.flatnonzero(~sounding)), division, tempo_map),
        warnings=log.warnings(),
        duration_s=float(np.max(table.end_s)),
        sequence=sequence or 0,
        sequences=sequences,
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
        raise NotInScoreError(f"the file holds {held}; there is no sequence {sequence}", where="sequence")
    if len(with_notes) > 1 and sequence is None:
        count = len(with_notes)
        log.add(
            "sequences",
            "byte 8",
            f"the file holds {count} sequences; the first was read, the others can be chosen",
        )
    chosen = sequence or 0
    return [with_notes[chosen]], chosen, len(with_notes)


@dataclass(frozen=True)
class TimedNotes:
    """Notes in the order of their messages, as columns of one length."""

    channel: IntArray
    pitch: IntArray
    velocity: FloatArray
    tick: IntArray
    onset_beats: FloatArray
    end_beats: FloatArray
    onset_s: FloatArray
    end_s: FloatArray


def _time_notes(
    messages: Messages,
    pairs: Pairs,
    tracks: Sequence[Track],
    division: Division,
    tempo_map: TempoMap,
    log: WarningLog,
) -> tuple[TimedNotes, IntArray]:
    on = messages.take(pairs.on)
    released = pairs.off >= 0
    track_end = np.array([track.end_tick for track in tracks], dtype=np.int64)[on.track]
    end_tick = np.where(released, messages.tick[pairs.off], np.maximum(track_end, on.tick))
    onset_beats = on.tick / division.ticks_per_beat
    end_beats = end_tick / division.ticks_per_beat
    onset_s, end_s = tempo_map.seconds(onset_beats), tempo_map.seconds(end_beats)
    end_s, end_beats, taps = lengthen_taps(onset_s, end_s, end_beats, tempo_map)

    numbers = np.array([track.number for track in tracks])[on.track]

    def tell(kind: str, chosen: IntArray, what: str) -> None:
        for done, note in enumerate(chosen.tolist()):
            if not log.room(kind):
                log.add(kind, "", "", count=len(chosen) - done)
                break
            place = f"track {numbers[note]}, tick {on.tick[note]}"
            log.add(kind, place, f"note {on.first[note]} {what}")

    tell("unreleased_note", np.flatnonzero(~released), "is never released; it ends with its track")
    tell("zero_length_note", taps, f"ends where it begins; it sounds for {TAP_S * 1000:.0f} ms")
    tell(
        "overlapping_note",
        np.flatnonzero(pairs.overlapping),
        "begins while it sounds; the first to begin ends first",
    )
    if len(pairs.stray):
        count, first = len(pairs.stray), int(pairs.stray[0])
        place = f"track {tracks[int(messages.track[first])].number}, tick {messages.tick[first]}"
        log.add("stray_note_off", place, f"{count} note-offs end no note, the first here; they were left out")
    notes = TimedNotes(
        channel=on.channel,
        pitch=on.first,
        velocity=on.second / 127.0,
        tick=on.tick,
        onset_beats=onset_beats,
        end_beats=end_beats,
        onset_s=onset_s,
        end_s=end_s,
    )
    return notes, on.track << 4 | on.channel


def _programs(messages: Messages) -> Messages:
    chosen = np.flatnonzero(messages.command == PROGRAM)
    return messages.take(chosen[np.argsort(messages.tick[chosen], kind="stable")])


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
