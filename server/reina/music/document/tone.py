"""A document of Tone.js's converter into a score.

It is read generously: a note needs its pitch and its time, everything else may be missing or strange and is
then left out with a warning that names its path.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import cast

import numpy as np

from reina.music.arrays import FloatArray
from reina.music.controls import Control, ControlKind
from reina.music.document.assemble import PartNotes, assemble
from reina.music.document.channels import Wish, allot_channels
from reina.music.document.fields import LEFT_OUT, Entries, Entry, JsonObject, Span, shown, to_number
from reina.music.document.model import pitch_number
from reina.music.document.tone_header import ToneHeader, read_header
from reina.music.document.tonejs import (
    BEND_VALUE,
    CHANGE,
    CHANNEL,
    CONTROLLER_VALUE,
    CONTROLLERS,
    DOCUMENT,
    INSTRUMENT,
    MIDI_NUMBER,
    NOTE,
    TICKS,
    TRACK,
)
from reina.music.errors import ScoreError
from reina.music.gm import DRUM_CHANNEL
from reina.music.limits import Limits
from reina.music.metre import MetreMap
from reina.music.score import Score
from reina.music.tempo import TempoMap
from reina.music.warnings import WarningLog

LONGEST_NAME = 500
DEFAULT_VELOCITY = 0.7

AGREES_S = 0.001
"""Ticks are kept as the beat of a time in seconds if they say the same to this; else the seconds hold."""


def read_tone(document: JsonObject, *, title: str, limits: Limits, log: WarningLog) -> Score:
    """Make the score of a document.

    Raises:
        ScoreError: If it has no list of tracks, or no note in them has a pitch and a time.
    """
    root = Entry(document, "", log)
    root.tell_unknown(DOCUMENT)
    if not isinstance(document["tracks"], list):
        raise ScoreError(f"is {shown(document['tracks'])}; a list of tracks is needed", location="tracks")
    header = read_header(root.entry("header"), limits)
    tracks = root.entries("tracks")
    tracks.tell_unknown(TRACK)
    reader = _TrackReader(header, limits, log)
    parts = reader.read(tracks)
    if not any(len(part.pitch) for part in parts):
        raise _no_note(log)
    parts, header = _within_limits(parts, header, limits, log)
    return assemble(
        parts,
        header.name[:LONGEST_NAME] or title,
        header.tempo_map,
        header.metre_map,
        key_signatures=header.key_signatures,
        limits=limits,
        log=log,
    )


def _no_note(log: WarningLog) -> ScoreError:
    """Return why there is nothing to read."""
    notes = [warning for warning in log.warnings() if warning.kind == "note_left_out"]
    others = [warning for warning in log.warnings() if warning.kind == LEFT_OUT]
    faults = [(warning.place, warning.message) for warning in notes or others]
    if not faults:
        return ScoreError("the score holds no note", location="/")
    count = log.count("note_left_out")
    more = f" (and {count - 1} more notes)" if count > 1 else ""
    where, what = faults[0]
    return ScoreError(f"{what}{more}, and the score holds no other note", location=where, problems=faults)


def _within_limits(
    parts: list[PartNotes], header: ToneHeader, limits: Limits, log: WarningLog
) -> tuple[list[PartNotes], ToneHeader]:
    """Leave out tempos and metres by which the seconds of the notes would hold too many beats or bars."""

    def ends() -> float:
        return max(float(np.max(part.end_beats)) for part in parts if len(part.pitch))

    if ends() > limits.beats or MetreMap().bar_count(ends()) > limits.bars:
        log.add(LEFT_OUT, "header/tempos", f"make {ends():,.0f} beats; beats are counted at 120 a minute")
        header = replace(header, tempo_map=TempoMap())
        beats = header.tempo_map.beats
        parts = [
            replace(
                part,
                onset_beats=beats(part.onset_s),
                end_beats=beats(part.end_s),
                controls=tuple(c._replace(onset_beats=beats(c.onset_s)) for c in part.controls),
            )
            for part in parts
        ]
    bars = header.metre_map.bar_count(ends())
    if bars > limits.bars:
        log.add(LEFT_OUT, "header/timeSignatures", f"make {bars:,.0f} bars; bars are counted as of 4/4")
        header = replace(header, metre_map=MetreMap())
    return parts, header


class _TrackReader:
    """Reads the tracks of one document."""

    def __init__(self, header: ToneHeader, limits: Limits, log: WarningLog) -> None:
        self._ppq = header.ppq
        self._tempo_map = header.tempo_map
        self._seconds = Span(0, limits.duration_s)
        self._log = log

    def read(self, tracks: Entries) -> list[PartNotes]:
        entries = [tracks.entry(row) for row in range(len(tracks))]
        notes = [track.entries("notes", kind="note_left_out") for track in entries]
        loudest = self._loudest(notes)
        instruments = [_instrument(track) for track in entries]
        wishes = [_wish(*pair) for pair in zip(entries, instruments, strict=True)]
        channels = allot_channels(wishes)
        return [
            self._part(track, instrument, played, wish, channel, loudest)
            for track, instrument, played, wish, channel in zip(
                entries, instruments, notes, wishes, channels, strict=True
            )
        ]

    def _loudest(self, tracks: Sequence[Entries]) -> Span:
        """Return the scale of velocities: 0 to 1, or MIDI's 0 to 127 if most are above 1."""
        velocities = np.concatenate([np.zeros(0), *(n.read("velocity", CONTROLLER_VALUE)[0] for n in tracks)])
        if np.count_nonzero(velocities > 1) <= np.count_nonzero((velocities > 0) & (velocities <= 1)):
            return Span(0, 1)
        self._log.add("velocity_scale", "tracks", "most velocities are above 1; they are read as 0 to 127")
        return CONTROLLER_VALUE

    def _part(
        self, track: Entry, instrument: Entry, notes: Entries, wish: Wish, channel: int, loudest: Span
    ) -> PartNotes:
        notes.tell_unknown(NOTE)
        notes, pitch, onset_s, onset_beats = self._essentials(notes)
        end_s, end_beats = self._ends(notes, onset_s, onset_beats)
        velocity = notes.column("velocity", loudest) / loudest.high
        names = (track.text("name"), instrument.text("name"))
        return PartNotes(
            path=track.path,
            name=(names[0] or names[1])[:LONGEST_NAME],
            program=wish.program,
            is_drums=wish.is_drums,
            channel=channel,
            onset_beats=onset_beats,
            end_beats=end_beats,
            onset_s=onset_s,
            end_s=end_s,
            pitch=pitch.astype(np.int64),
            velocity=np.where(np.isnan(velocity), DEFAULT_VELOCITY, velocity),
            controls=(*self._controllers(track, channel), *self._bends(track, channel)),
            note_index=np.array(notes.indices, dtype=np.int64),
        )

    def _essentials(self, notes: Entries) -> tuple[Entries, FloatArray, FloatArray, FloatArray]:
        """Return the notes that have a pitch and a time, with their pitches, seconds and beats."""
        midi, bad_midi = notes.read("midi", MIDI_NUMBER, _pitch)
        name, bad_name = notes.read("name", MIDI_NUMBER, _named_pitch)
        time, bad_time = notes.read("time", self._seconds)
        ticks, bad_ticks = notes.read("ticks", TICKS)
        pitch = np.where(np.isnan(midi), name, midi)
        seconds, beats = self._agreed(time, ticks)
        kept = ~np.isnan(pitch) & (seconds <= self._seconds.high)
        for row in np.flatnonzero(~kept).tolist():
            if self._log.room("note_left_out"):
                why = self._lacking(notes.values[row], bool(np.isnan(pitch[row])))
                self._log.add("note_left_out", notes.place(row), why)
            else:
                self._log.add("note_left_out", "", "")
        for key, faults, expected in (
            ("midi", bad_midi, str(MIDI_NUMBER)),
            ("name", bad_name, "a pitch such as C4 or F#3"),
            ("time", bad_time, str(self._seconds)),
            ("ticks", bad_ticks, str(TICKS)),
        ):
            notes.leave_out(key, (row for row in faults if kept[row]), expected)
        return notes.only(kept), pitch[kept], seconds[kept], beats[kept]

    def _lacking(self, note: JsonObject, no_pitch: bool) -> str:
        keys = ("midi", "name") if no_pitch else ("time", "ticks")
        said = " and ".join(f"{key} is {shown(note[key])}" for key in keys if key in note)
        if no_pitch:
            what = f"has no pitch: midi, {MIDI_NUMBER}, or a name such as C4 is needed"
        else:
            what = f"neither time nor ticks says when this is, within {self._seconds.high:,g} seconds"
        return f"{what}; {said}" if said else what

    def _agreed(self, time: FloatArray, ticks: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the seconds and the beats that times and ticks say together, NaN where neither does."""
        beats = ticks / self._ppq
        by_beats = self._tempo_map.seconds(beats)
        seconds = np.where(np.isnan(time), by_beats, time)
        agrees = np.abs(by_beats - seconds) <= AGREES_S
        return seconds, np.where(agrees, beats, self._tempo_map.beats(seconds))

    def _ends(
        self, notes: Entries, onset_s: FloatArray, onset_beats: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the ends in seconds and beats; those of notes without duration are their onsets."""
        long_s = notes.column("duration", self._seconds)
        long_beats = notes.column("durationTicks", TICKS) / self._ppq
        end_by_beats = self._tempo_map.seconds(onset_beats + long_beats)
        end_s = np.where(np.isnan(long_s), end_by_beats, onset_s + long_s)
        late = np.flatnonzero(end_s > self._seconds.high)
        said = np.isnan(long_s[late])
        for key, rows in (("duration", late[~said]), ("durationTicks", late[said])):
            notes.leave_out(key, rows.tolist(), f"an end within {self._seconds.high:,g} seconds")
        end_s[late] = np.nan
        end_s = np.where(np.isnan(end_s), onset_s, end_s)
        agrees = (long_beats > 0) & (np.abs(end_by_beats - end_s) <= AGREES_S)
        return end_s, np.where(agrees, onset_beats + long_beats, self._tempo_map.beats(end_s))

    def _controllers(self, track: Entry, channel: int) -> list[Control]:
        controls: list[Control] = []
        changes = track.entry("controlChanges")
        for key in changes.value:
            number = int(key) if key.isascii() and key.isdigit() and len(key) <= 3 else CONTROLLERS.get(key)
            if number is None or number > 127:
                changes.leave_out(key, "a controller's number from 0 to 127 as key")
                continue
            if key in CONTROLLERS:
                self._log.add("controller_name", changes.place(key), f"is read as controller {number}")
            entries, seconds, beats = self._changes(changes.entries(key))
            value = entries.column("value", CONTROLLER_VALUE)
            value = np.rint(np.where(value <= 1, value * 127, value))
            controls.extend(_controls("controller", number, channel, seconds, beats, value))
        return controls

    def _bends(self, track: Entry, channel: int) -> list[Control]:
        entries, seconds, beats = self._changes(track.entries("pitchBends"))
        value = np.clip(np.rint(entries.column("value", BEND_VALUE) * 8192), -8192, 8191)
        return _controls("pitch_bend", 0, channel, seconds, beats, value)

    def _changes(self, entries: Entries) -> tuple[Entries, FloatArray, FloatArray]:
        """Return the changes that have a time within the score's limits, with their seconds and beats."""
        entries.tell_unknown(CHANGE)
        entries.tell_missing("value")
        seconds, beats = self._agreed(entries.column("time", self._seconds), entries.column("ticks", TICKS))
        kept = seconds <= self._seconds.high
        for row in np.flatnonzero(~kept).tolist():
            self._log.add(LEFT_OUT, entries.place(row), self._lacking(entries.values[row], no_pitch=False))
        return entries.only(kept), seconds[kept], beats[kept]


def _controls(
    kind: ControlKind,
    number: int,
    channel: int,
    seconds: FloatArray,
    beats: FloatArray,
    values: FloatArray,
) -> list[Control]:
    rows = zip(seconds.tolist(), beats.tolist(), values.tolist(), strict=True)
    return [
        Control(kind, second, beat, channel, number, int(value))
        for second, beat, value in rows
        if not math.isnan(value)
    ]


def _instrument(track: Entry) -> Entry:
    """Return the instrument; in the older form it is a name, with its number beside it."""
    value = track.value.get("instrument")
    if isinstance(value, str):
        return Entry({"name": value}, track.path, track.log)
    instrument = track.entry("instrument")
    instrument.tell_unknown(INSTRUMENT)
    return instrument


def _wish(track: Entry, instrument: Entry) -> Wish:
    programs = (instrument.number("number", MIDI_NUMBER), track.number("instrumentNumber", MIDI_NUMBER))
    channels = (track.number("channel", CHANNEL), track.number("channelNumber", CHANNEL))
    program = next((int(number) for number in programs if number is not None), None)
    channel = next((int(number) for number in channels if number is not None), None)
    says_drums = [
        channel == DRUM_CHANNEL,
        track.flag("isPercussion"),
        instrument.flag("percussion"),
        instrument.text("family") == "drums",
        track.text("instrumentFamily") == "drums",
    ]
    return Wish(program, any(says_drums), channel)


@lru_cache(maxsize=1024)
def _pitch_of_name(name: str) -> float:
    try:
        return float(cast("int", pitch_number(name)))
    except ValueError:
        return math.nan


def _named_pitch(value: object) -> float:
    return _pitch_of_name(value) if isinstance(value, str) else math.nan


def _pitch(value: object) -> float:
    """Return a pitch's number from a number or a name, NaN if it is neither."""
    named = _named_pitch(value)
    return to_number(value) if math.isnan(named) else named
