"""A score as a synthesizer hears it: notes and controls on channels, at samples.

The plan is canonical: scores that sound the same give the same bytes, and so share one rendering.
"""

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from reina.errors import InputError
from reina.music.controls import Control
from reina.music.notes import NO_PROGRAM
from reina.music.score import Part, Score
from reina.sound.events import (
    CHANNELS_OF_PORT,
    CONTROL_DTYPE,
    DRUM_CHANNEL,
    NOTE_DTYPE,
    SAMPLE_RATE,
    SoundPlan,
)
from reina.sound.programs import default_program

LONGEST_S = 3600.0
AFTER_LAST_NOTE_S = 20.0
"""How long after the last note controls still count: a pedal is lifted after the keys."""
SHORTEST_NOTE = SAMPLE_RATE // 50
"""A tap of no length still has to speak: 20 ms."""

MELODIC_CHANNELS = tuple(channel for channel in range(CHANNELS_OF_PORT) if channel != DRUM_CHANNEL)
MAX_VOICES = 4 * len(MELODIC_CHANNELS)
"""With more melodic voices than this, those of one channel and program share a channel."""
MAX_DRUMS = 8
"""With drums on more channels than this, those of one kit share a channel; each takes a port."""

HEARD_CONTROLLERS = frozenset({1, 33, 7, 39, 10, 42, 11, 43, 64, 91, 93, 6, 38, 98, 99, 100, 101, 121})
"""Those the synthesizer acts on: modulation, volume, pan, expression, hold, reverb, chorus, registered
parameters, reset. All Sound Off and All Notes Off are left out, since the score's notes already end where
they end."""
BANK_SELECT = 0
MARKING_BANKS = frozenset({120, 121, 126, 127})
"""Banks that say whether a channel is drums, and name no sound."""
KEYS = 128
"""MIDI's pitches."""


@dataclass(frozen=True)
class PlayedParts:
    """What of a score one of the players plays.

    Attributes:
        parts: Indices of the parts.
        transposition: Semitones by which they sound higher than the score says, as they are played: octave
            fit and written pitch included. What is no pitch then is not heard, as it is not played.
        program: What they sound with unless the file says otherwise; None: what their names say.
    """

    parts: tuple[int, ...]
    transposition: int = 0
    program: int | None = None


@dataclass(frozen=True)
class _Voice:
    """What a part plays on one channel of the file.

    Attributes:
        part: The part.
        channel: The file's channel.
        program: With what it begins.
        programs: From which sample on it has which program afterwards.
        port: On which port it is rendered.
        seat: On which channel of that port.
    """

    part: Part
    channel: int
    program: int
    programs: tuple[tuple[int, int], ...]
    port: int = 0
    seat: int = 0


def plan_sound(score: Score, played: Sequence[PlayedParts] = (), *, transposition: int = 0) -> SoundPlan:
    """Plan how a score sounds.

    Every part gets a channel of its own for each channel that the file has it on (drums of one channel and
    kit share theirs), on as many ports of sixteen channels as that takes, so that a file whose parts collide
    on a channel, or that names no channels, sounds right. The controls of the file's channel go with it.

    Args:
        score: The score.
        played: What the players play.
        transposition: Semitones by which everything but the drums sounds higher.

    Raises:
        InputError: The score is longer than an hour, or nothing of it is a pitch.
    """
    if score.duration_s > LONGEST_S:
        minutes = score.duration_s / 60
        raise InputError(
            f"the score lasts {minutes:.0f} minutes; sound is made for at most {LONGEST_S / 60:.0f}: "
            "cut it, or send a song with it"
        )
    voices, voice_of_note = _voices(score, {part: one.program for one in played for part in one.parts})
    keys = score.notes.sounding_pitch.astype(np.int64)
    for one in played:
        keys += np.where(np.isin(score.notes.part, one.parts), one.transposition, 0)
    if transposition:
        drums = [part.index for part in score.parts if part.is_drums]
        keys += np.where(np.isin(score.notes.part, drums), 0, transposition)
    if not np.any(_is_key(keys)):
        moved = ", ".join(str(one.transposition + transposition) for one in played)
        raise InputError(f"moved by {moved} semitones, no note of the score is a pitch: move it less")
    seats = np.array([(voice.port, voice.seat) for voice in voices], dtype=np.uint16)
    notes, parts = _plan_notes(score, seats[voice_of_note], keys)
    return SoundPlan(notes=notes, controls=_plan_controls(score, voices), parts=parts)


def _is_key(keys: NDArray[np.int64]) -> NDArray[np.bool_]:
    return (keys >= 0) & (keys < KEYS)


def _voices(
    score: Score, program_of_part: Mapping[int, int | None]
) -> tuple[list[_Voice], NDArray[np.int64]]:
    """Return the voices of a score, seated, and (N,) which one each note belongs to."""
    notes = score.notes
    keys = notes.part.astype(np.int64) << 16 | notes.channel
    unique, first, voice_of_note = np.unique(keys, return_index=True, return_inverse=True)
    known = notes.program != NO_PROGRAM
    # A voice's program changes at notes that name another one than the last of its notes that names one.
    order = np.flatnonzero(known)[np.argsort(voice_of_note[known], kind="stable")]
    changed = np.ones(len(order), dtype=np.bool_)
    changed[1:] = (np.diff(voice_of_note[order]) != 0) | (np.diff(notes.program[order]) != 0)
    changes: dict[int, list[tuple[int, int]]] = defaultdict(list)
    for note in order[changed].tolist():
        tick = round(float(notes.onset_s[note]) * SAMPLE_RATE)
        changes[int(voice_of_note[note])].append((tick, int(notes.program[note])))
    voices: list[_Voice] = []
    values: list[int] = unique.tolist()
    for index, value in enumerate(values):
        part = score.parts[value >> 16]
        programs = changes[index]
        begins_with_it = programs and notes.program[first[index]] != NO_PROGRAM
        program = (
            programs.pop(0)[1] if begins_with_it else default_program(part, program_of_part.get(part.index))
        )
        voices.append(_Voice(part, value & 0xFFFF, program, tuple(programs)))
    return _seat(voices), voice_of_note


def _seat(voices: list[_Voice]) -> list[_Voice]:
    """Give each voice its port and channel."""
    melodic = sum(not voice.part.is_drums for voice in voices)
    drum_channels = {voice.channel for voice in voices if voice.part.is_drums}
    seats: dict[tuple[object, ...], tuple[int, int]] = {}
    seated: list[_Voice] = []
    drums = tones = 0
    for index, voice in enumerate(voices):
        if voice.part.is_drums:
            channel = voice.channel if len(drum_channels) <= MAX_DRUMS else None
            key: tuple[object, ...] = ("drums", channel, voice.program)
        elif melodic <= MAX_VOICES:
            key = ("voice", index)
        else:
            key = ("shared", voice.channel, voice.program)
        if key not in seats and voice.part.is_drums:
            seats[key] = (drums, DRUM_CHANNEL)
            drums += 1
        elif key not in seats:
            port, place = divmod(tones, len(MELODIC_CHANNELS))
            seats[key] = (port, MELODIC_CHANNELS[place])
            tones += 1
        port, seat = seats[key]
        seated.append(replace(voice, port=port, seat=seat))
    return seated


def _plan_notes(
    score: Score, seats: NDArray[np.uint16], keys: NDArray[np.int64]
) -> tuple[NDArray[np.void], NDArray[np.int32]]:
    """Return the notes, and which part each is of; (N, 2) seats are port and channel, (N,) keys the pitch."""
    notes = np.zeros(len(score.notes), dtype=NOTE_DTYPE)
    on = np.rint(score.notes.onset_s * SAMPLE_RATE).astype(np.int64)
    end = np.rint(score.notes.end_s * SAMPLE_RATE).astype(np.int64)
    notes["on"] = on
    notes["off"] = np.maximum(end, on + SHORTEST_NOTE)
    notes["port"], notes["channel"] = seats.T
    notes["key"] = np.clip(keys, 0, KEYS - 1)
    notes["velocity"] = np.clip(np.rint(score.notes.velocity * 127), 1, 127)
    is_key = _is_key(keys)
    return _without_overlaps(notes[is_key], score.notes.part[is_key])


def _without_overlaps(
    notes: NDArray[np.void], parts: NDArray[np.int32]
) -> tuple[NDArray[np.void], NDArray[np.int32]]:
    """Let each new stroke of a sounding key end the one before, and last as long as that would have."""
    strings = (notes["port"].astype(np.int64) * CHANNELS_OF_PORT + notes["channel"]) * KEYS + notes["key"]
    order = np.lexsort((-notes["velocity"].astype(np.int64), notes["on"], strings))
    notes, parts, strings = notes[order], parts[order], strings[order]
    same_string = np.diff(strings, prepend=-1) == 0
    twice = same_string & (np.diff(notes["on"].astype(np.int64), prepend=-1) == 0)
    group = np.cumsum(~same_string) - 1
    off = notes["off"].astype(np.int64)
    step = int(off.max()) + 1
    off = np.maximum.accumulate(off + group * step) - group * step
    # Where a note stands twice, the last of its copies carries the running maximum.
    last_copy = ~np.append(twice[1:], False)
    off = off[last_copy]
    notes, parts, strings = notes[~twice], parts[~twice], strings[~twice]
    following = np.append(notes["on"][1:].astype(np.int64), 0)
    struck_again = np.append(np.diff(strings) == 0, False)
    notes["off"] = np.where(struck_again, np.minimum(off, following), off)
    in_time = np.lexsort((notes["key"], notes["channel"], notes["port"], notes["on"]))
    return notes[in_time], parts[in_time]


def _plan_controls(score: Score, voices: list[_Voice]) -> NDArray[np.void]:
    last_tick = round((score.duration_s + AFTER_LAST_NOTE_S) * SAMPLE_RATE)
    by_channel: dict[int, list[tuple[int, Control]]] = defaultdict(list)
    for control in score.controls:
        tick = max(0, round(control.onset_s * SAMPLE_RATE))
        if tick <= last_tick:
            by_channel[control.channel].append((tick, control))
    crowd = Counter((voice.channel, voice.part.is_drums) for voice in voices)
    rows: list[tuple[int, int, int, int, int]] = []
    seated: set[tuple[int, int]] = set()
    for voice in voices:
        if (voice.port, voice.seat) in seated:
            continue
        seated.add((voice.port, voice.seat))
        alone = crowd[voice.channel, voice.part.is_drums] == 1
        for tick, program in ((0, voice.program), *voice.programs):
            rows.append((tick, voice.port, 0xC0 | voice.seat, program, 0))
        for tick, control in by_channel[voice.channel]:
            message = _message(control, has_banks=alone and not voice.part.is_drums)
            if message is not None:
                status, data1, data2 = message
                rows.append((tick, voice.port, status | voice.seat, data1, data2))
    table = np.array(rows, dtype=CONTROL_DTYPE)
    return table[np.argsort(table["tick"], kind="stable")]


def _message(control: Control, *, has_banks: bool) -> tuple[int, int, int] | None:
    """Return status (channel 0) and data bytes of a control that is heard, or None.

    Programs are not: notes have theirs.
    """
    if control.kind == "pitch_bend":
        bend = min(max(control.value + 8192, 0), 16383)
        return 0xE0, bend & 0x7F, bend >> 7
    if control.kind == "controller":
        heard = control.number in HEARD_CONTROLLERS
        if control.number == BANK_SELECT:
            heard = has_banks and control.value not in MARKING_BANKS
        return (0xB0, control.number, control.value) if heard else None
    return None
