"""A document of Tone.js's converter into a score."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from reina.music.arrays import FloatArray
from reina.music.controls import Control
from reina.music.document.assemble import PartNotes, assemble
from reina.music.document.channels import Wish, allot_channels
from reina.music.document.tonejs import ToneDocument, ToneHeader, ToneTrack
from reina.music.errors import ScoreError
from reina.music.gm import DRUM_CHANNEL
from reina.music.limits import Limits
from reina.music.metre import MetreMap, TimeSignature
from reina.music.score import Score
from reina.music.tempo import DEFAULT_SECONDS_PER_BEAT, TempoMap
from reina.music.warnings import WarningLog

LONGEST_NAME = 500

AGREES_S = 0.001
"""Ticks are kept as the beat of a time in seconds if they say the same to this; else the seconds hold."""


class Timed(Protocol):
    """What has its time in seconds, in ticks, or in both."""

    @property
    def time(self) -> float | None:
        """Seconds."""
        ...

    @property
    def ticks(self) -> float | None:
        """Ticks."""
        ...


def read_tone(document: ToneDocument, *, title: str, limits: Limits) -> Score:
    """Make the score of a valid document.

    Raises:
        ScoreError: If it holds no note, or a note has no time.
    """
    log = WarningLog()
    header = document.header
    tempo_map = _tempo_map(header)
    programs = [_program(track) for track in document.tracks]
    drums = [_is_drums(track) for track in document.tracks]
    wishes = [Wish(p, d, t.channel) for p, d, t in zip(programs, drums, document.tracks, strict=True)]
    channels = allot_channels(wishes, log)
    parts = [
        _part(track, f"tracks/{index}", programs[index], drums[index], channels[index], header.ppq, tempo_map)
        for index, track in enumerate(document.tracks)
    ]
    return assemble(
        parts,
        header.name.strip()[:LONGEST_NAME] or title,
        tempo_map,
        _metre_map(header),
        limits=limits,
        log=log,
    )


def _tempo_map(header: ToneHeader) -> TempoMap:
    """Place tempos by their ticks; those that have seconds alone by the tempo that they end."""
    beat, second = 0.0, 0.0
    length = DEFAULT_SECONDS_PER_BEAT if header.bpm is None else 60.0 / header.bpm
    beats, lengths = [beat], [length]
    for tempo in header.tempos:
        ticks = tempo.ticks
        to = beat + ((tempo.time or 0.0) - second) / length if ticks is None else ticks / header.ppq
        second += (to - beat) * length
        beat, length = max(to, 0.0), 60.0 / tempo.bpm
        beats.append(beat)
        lengths.append(length)
    return TempoMap(beats, lengths)


def _metre_map(header: ToneHeader) -> MetreMap:
    signatures = [
        TimeSignature(entry.ticks / header.ppq, *entry.timeSignature) for entry in header.timeSignatures
    ]
    if not signatures and header.timeSignature:
        signatures = [TimeSignature(0.0, *header.timeSignature)]
    return MetreMap(signatures)


def _program(track: ToneTrack) -> int | None:
    return track.instrument.number if track.instrument.number is not None else track.instrumentNumber


def _is_drums(track: ToneTrack) -> bool:
    return track.channel == DRUM_CHANNEL or track.isPercussion or track.instrument.family == "drums"


def _times(
    entries: Sequence[Timed], ppq: float, tempo_map: TempoMap, path: str
) -> tuple[FloatArray, FloatArray]:
    """Return the seconds and the beats of `entries`."""
    seconds = np.array([np.nan if entry.time is None else entry.time for entry in entries], dtype=np.float64)
    beats = (
        np.array([np.nan if entry.ticks is None else entry.ticks for entry in entries], dtype=np.float64)
        / ppq
    )
    untimed = np.flatnonzero(np.isnan(seconds) & np.isnan(beats))
    if len(untimed):
        raise ScoreError("neither time nor ticks says when this is", where=f"{path}/{untimed[0]}")
    seconds = np.where(np.isnan(seconds), tempo_map.seconds(beats), seconds)
    agrees = np.abs(tempo_map.seconds(beats) - seconds) <= AGREES_S
    return seconds, np.where(agrees, beats, tempo_map.beats(seconds))


def _part(
    track: ToneTrack,
    path: str,
    program: int | None,
    is_drums: bool,
    channel: int,
    ppq: float,
    tempo_map: TempoMap,
) -> PartNotes:
    notes = track.notes
    onset_s, onset_beats = _times(notes, ppq, tempo_map, f"{path}/notes")
    long_s = np.array(
        [np.nan if note.duration is None else note.duration for note in notes], dtype=np.float64
    )
    long_beats = np.array([note.durationTicks or 0.0 for note in notes], dtype=np.float64) / ppq
    end_by_beats = tempo_map.seconds(onset_beats + long_beats)
    end_s = np.where(np.isnan(long_s), end_by_beats, onset_s + long_s)
    agrees = (long_beats > 0) & (np.abs(end_by_beats - end_s) <= AGREES_S)
    return PartNotes(
        path=path,
        name=(track.name.strip() or track.instrument.name.strip())[:LONGEST_NAME],
        program=program,
        is_drums=is_drums,
        channel=channel,
        onset_beats=onset_beats,
        end_beats=np.where(agrees, onset_beats + long_beats, tempo_map.beats(end_s)),
        onset_s=onset_s,
        end_s=end_s,
        pitch=np.array([note.midi for note in notes], dtype=np.int64),
        velocity=np.array([note.velocity for note in notes], dtype=np.float64),
        controls=tuple(_controls(track, path, channel, ppq, tempo_map)),
    )


def _controller(value: float) -> int:
    return round(value * 127) if value <= 1 else round(value)


def _controls(track: ToneTrack, path: str, channel: int, ppq: float, tempo_map: TempoMap) -> list[Control]:
    controls: list[Control] = []
    for number, entries in track.controlChanges.items():
        if not (number.isascii() and number.isdigit() and int(number) < 128):
            raise ScoreError(
                "a controller has a number from 0 to 127", where=f"{path}/controlChanges/{number[:20]}"
            )
        times = zip(*_times(entries, ppq, tempo_map, f"{path}/controlChanges/{number}"), strict=True)
        controls.extend(
            Control("controller", float(second), float(beat), channel, int(number), _controller(entry.value))
            for entry, (second, beat) in zip(entries, times, strict=True)
        )
    times = zip(*_times(track.pitchBends, ppq, tempo_map, f"{path}/pitchBends"), strict=True)
    controls.extend(
        Control(
            "pitch_bend",
            float(second),
            float(beat),
            channel,
            0,
            max(-8192, min(8191, round(bend.value * 8192))),
        )
        for bend, (second, beat) in zip(track.pitchBends, times, strict=True)
    )
    return controls
