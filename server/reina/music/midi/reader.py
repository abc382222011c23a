"""A Standard MIDI File into a score."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.music.arrays import FloatArray, IntArray
from reina.music.controls import Control, ControlKind
from reina.music.errors import ScoreError
from reina.music.limits import Limits
from reina.music.metre import MetreMap, TimeSignature
from reina.music.midi.chunks import read_header, unwrap
from reina.music.midi.division import Division, read_division
from reina.music.midi.pairing import Pairs, pair_notes
from reina.music.midi.parts import find_parts
from reina.music.midi.text import decode_text
from reina.music.midi.track import (
    CHANNEL_PRESSURE,
    CONTROLLER,
    KEY_PRESSURE,
    NOTE_OFF,
    NOTE_ON,
    PITCH_BEND,
    PROGRAM,
    SET_TEMPO,
    TIME_SIGNATURE,
    TRACK_NAME,
    Track,
)
from reina.music.midi.tracks import read_tracks
from reina.music.notes import Notes
from reina.music.score import Score
from reina.music.taps import TAP_S, lengthen_taps
from reina.music.tempo import TempoMap
from reina.music.warnings import WarningLog

CONTROL_KINDS: dict[int, ControlKind] = {
    KEY_PRESSURE: "key_pressure",
    CONTROLLER: "controller",
    PROGRAM: "program",
    CHANNEL_PRESSURE: "channel_pressure",
    PITCH_BEND: "pitch_bend",
}


@dataclass(frozen=True)
class Messages:
    """The channel messages of all tracks as columns of one length.

    Attributes:
        track: Index of the track.
        tick: Time in ticks.
        command: Upper four bits of the status.
        channel: Counted from 0.
        first: First data byte.
        second: Second data byte, or 0.
    """

    track: IntArray
    tick: IntArray
    command: IntArray
    channel: IntArray
    first: IntArray
    second: IntArray

    @classmethod
    def of(cls, tracks: Sequence[Track]) -> "Messages":
        """Unpack the messages of `tracks`, one track after the other."""
        lengths = [len(track.packed) for track in tracks]
        packed = np.concatenate([np.array(track.packed, dtype=np.int64) for track in tracks])
        status = packed >> 16 & 0xFF
        return cls(
            track=np.repeat(np.arange(len(tracks)), lengths),
            tick=packed >> 24,
            command=status >> 4,
            channel=status & 0xF,
            first=packed >> 8 & 0xFF,
            second=packed & 0xFF,
        )

    def take(self, chosen: IntArray) -> "Messages":
        """Return the messages at the given indices."""
        columns = (self.track, self.tick, self.command, self.channel, self.first, self.second)
        return Messages(*(column[chosen] for column in columns))


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
    sequences = 1
    if header.format == 2:
        tracks, sequence, sequences = _choose_sequence(tracks, sequence, log)
    elif sequence not in {None, 0}:
        raise ScoreError(f"the file has one sequence, so there is no sequence {sequence}", where="sequence")

    messages = Messages.of(tracks)
    sounding = (messages.command == NOTE_ON) | (messages.command == NOTE_OFF)
    note_messages = messages.take(np.flatnonzero(sounding))
    is_on = (note_messages.command == NOTE_ON) & (note_messages.second > 0)
    if not np.any(is_on):
        raise ScoreError("the file is MIDI and holds no note", where=f"{len(tracks)} tracks")
    limits.check("notes", int(np.count_nonzero(is_on)), what="number of notes")

    tempo_map = _tempo_map(tracks, division, log)
    key = note_messages.track << 11 | note_messages.channel << 7 | note_messages.first
    pairs = pair_notes(key, is_on)
    notes, part_of_note = _time_notes(note_messages, pairs, tracks, division, tempo_map, log)
    parts, part = find_parts(tracks, part_of_note, notes.tick, _programs(messages))
    end_s, end_beats = float(np.max(notes.end_s)), float(np.max(notes.end_beats))
    limits.check("duration_s", end_s, what="length in seconds")
    limits.check("beats", end_beats, what="length in beats")
    metre_map = _metre_map(tracks, division, log)
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
        title=_title(tracks, header.format) or title,
        parts=parts,
        notes=table,
        tempo_map=tempo_map,
        metre_map=metre_map,
        controls=_controls(messages.take(np.flatnonzero(~sounding)), division, tempo_map),
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
        raise ScoreError(
            f"there is no sequence {sequence}; there are 0 to {len(with_notes) - 1}", where="sequence"
        )
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


def _tempo_map(tracks: Sequence[Track], division: Division, log: WarningLog) -> TempoMap:
    """Merge the tempos of all tracks; at one tick the later track's holds, as in players."""
    changes: list[tuple[int, int]] = []
    for track in tracks:
        for meta in track.metas:
            if meta.kind != SET_TEMPO:
                continue
            value = int.from_bytes(meta.data[:3], "big")
            place = f"track {track.number}, byte {meta.byte}"
            if len(meta.data) != 3 or value == 0:
                log.add(
                    "bad_tempo", place, f"a tempo of the data {meta.data[:8].hex() or 'none'} was left out"
                )
            elif division.seconds_per_tick is not None:
                log.add("smpte_tempo", place, "in a file in SMPTE frames a tempo changes nothing")
            else:
                changes.append((meta.tick, value))
    if not changes:
        return TempoMap()
    changes.sort(key=lambda change: change[0])
    ticks, lengths = np.array(changes, dtype=np.float64).T
    return TempoMap(ticks / division.ticks_per_beat, lengths / 1e6)


def _metre_map(tracks: Sequence[Track], division: Division, log: WarningLog) -> MetreMap:
    signatures: list[TimeSignature] = []
    for track in tracks:
        for meta in track.metas:
            if meta.kind != TIME_SIGNATURE:
                continue
            numerator, power = (meta.data + b"\0\xff")[:2]
            if len(meta.data) < 2 or numerator == 0 or power > 6:
                place = f"track {track.number}, byte {meta.byte}"
                log.add(
                    "bad_metre", place, f"a metre of the data {meta.data[:8].hex() or 'none'} was left out"
                )
            else:
                signatures.append(TimeSignature(meta.tick / division.ticks_per_beat, numerator, 2**power))
    return MetreMap(signatures)


def _programs(messages: Messages) -> Messages:
    chosen = np.flatnonzero(messages.command == PROGRAM)
    return messages.take(chosen[np.argsort(messages.tick[chosen], kind="stable")])


def _controls(messages: Messages, division: Division, tempo_map: TempoMap) -> tuple[Control, ...]:
    messages = messages.take(np.argsort(messages.tick, kind="stable"))
    beats = messages.tick / division.ticks_per_beat
    has_number = (messages.command == CONTROLLER) | (messages.command == KEY_PRESSURE)
    bend = (messages.second << 7 | messages.first) - 8192
    value = np.where(
        has_number, messages.second, np.where(messages.command == PITCH_BEND, bend, messages.first)
    )
    columns = zip(
        (CONTROL_KINDS[command] for command in messages.command.tolist()),
        tempo_map.seconds(beats).tolist(),
        beats.tolist(),
        messages.channel.tolist(),
        np.where(has_number, messages.first, 0).tolist(),
        value.tolist(),
        strict=True,
    )
    return tuple(map(Control._make, columns))


def _title(tracks: Sequence[Track], file_format: int) -> str:
    """Return the name of the first track if that names the sequence and not a part, else nothing."""
    first = tracks[0]
    names = [decode_text(meta.data) for meta in first.metas if meta.kind == TRACK_NAME]
    is_sequence = file_format != 1 or not any(p >> 20 & 0xF == NOTE_ON for p in first.packed)
    return names[0] if names and is_sequence else ""
