"""A score as a synthesizer hears it: notes and controls on channels, at samples.

The plan is canonical: scores that sound the same give the same bytes, and so share one rendering.
"""

from collections import Counter, defaultdict
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from reina.errors import InputError
from reina.music.controls import Control
from reina.music.score import Part, Score
from reina.sessions.sound_events import (
    CHANNELS_OF_PORT,
    CONTROL_DTYPE,
    DRUM_CHANNEL,
    NOTE_DTYPE,
    SAMPLE_RATE,
    SoundPlan,
)
from reina.sessions.sound_programs import default_program

LONGEST_S = 3600.0
AFTER_LAST_NOTE_S = 20.0
"""How long after the last note controls still count: a pedal is lifted after the keys."""
SHORTEST_NOTE = SAMPLE_RATE // 50
"""A tap of no length still has to speak: 20 ms."""

MELODIC_CHANNELS = tuple(channel for channel in range(CHANNELS_OF_PORT) if channel != DRUM_CHANNEL)
MOST_VOICES = 4 * len(MELODIC_CHANNELS)
"""With more melodic parts than this, those of one channel and program share a voice."""

HEARD_CONTROLLERS = frozenset({1, 33, 7, 39, 10, 42, 11, 43, 64, 91, 93, 6, 38, 98, 99, 100, 101, 121})
"""Those the synthesizer acts on: modulation, volume, pan, expression, hold, reverb, chorus, registered
parameters, reset. All Sound Off and All Notes Off are left out, since the score's notes already end where
they end."""
BANK_SELECT = 0
KEYS = 128
"""MIDI's pitches."""


def plan_sound(
    score: Score,
    *,
    trumpet_part: int | None = None,
    joined_parts: Sequence[int] = (),
    transposition: int = 0,
) -> SoundPlan:
    """Plan how a score sounds.

    Every part gets a channel of its own (drums of one kit share theirs), on as many ports of sixteen channels
    as that takes, so that a file whose parts collide on a channel, or that names no channels, sounds right.
    The controls of a part's channel go with the part.

    Args:
        score: The score.
        trumpet_part: Index of the part that the trumpeter plays; it is a trumpet unless the file says
            otherwise.
        joined_parts: Indices of further parts that the trumpeter plays, of which the same is true.
        transposition: Semitones by which those parts sound higher than the score says, as they are played:
            octave fit and written pitch included. What is no pitch then is not heard, as it is not played.

    Raises:
        InputError: The score is longer than an hour, or nothing of it is a pitch.
    """
    if score.duration_s > LONGEST_S:
        minutes = score.duration_s / 60
        raise InputError(
            f"the score lasts {minutes:.0f} minutes; sound is made for at most {LONGEST_S / 60:.0f}: "
            "cut it, or send a song with it"
        )
    trumpet_parts = [*joined_parts] if trumpet_part is None else [trumpet_part, *joined_parts]
    seats = _seats(score.parts, trumpet_parts)
    moved = np.where(np.isin(score.notes.part, trumpet_parts), transposition, 0)
    keys = score.notes.sounding_pitch.astype(np.int64) + moved
    if not np.any(_is_key(keys)):
        raise InputError(f"moved by {transposition} semitones, no note of the score is a pitch: move it less")
    return SoundPlan(
        notes=_plan_notes(score, seats, keys), controls=_plan_controls(score, seats, trumpet_parts)
    )


def _is_key(keys: NDArray[np.int64]) -> NDArray[np.bool_]:
    return (keys >= 0) & (keys < KEYS)


def _seats(parts: tuple[Part, ...], trumpet_parts: Sequence[int]) -> NDArray[np.uint16]:
    """Return (parts, 2): the port and the channel of each part."""
    melodic = sum(not part.is_drums for part in parts)
    keys: list[tuple[object, ...]] = []
    for part in parts:
        program = default_program(part, is_trumpet=part.index in trumpet_parts)
        if part.is_drums:
            keys.append(("drums", program))
        elif melodic <= MOST_VOICES:
            keys.append(("part", part.index))
        else:
            keys.append(("shared", part.channel, program))
    seats: dict[tuple[object, ...], tuple[int, int]] = {}
    drums = tones = 0
    for key in keys:
        if key in seats:
            continue
        if key[0] == "drums":
            seats[key] = (drums, DRUM_CHANNEL)
            drums += 1
        else:
            port, place = divmod(tones, len(MELODIC_CHANNELS))
            seats[key] = (port, MELODIC_CHANNELS[place])
            tones += 1
    return np.array([seats[key] for key in keys], dtype=np.uint16)


def _plan_notes(score: Score, seats: NDArray[np.uint16], keys: NDArray[np.int64]) -> NDArray[np.void]:
    notes = np.zeros(len(score.notes), dtype=NOTE_DTYPE)
    on = np.rint(score.notes.onset_s * SAMPLE_RATE).astype(np.int64)
    end = np.rint(score.notes.end_s * SAMPLE_RATE).astype(np.int64)
    notes["on"] = on
    notes["off"] = np.maximum(end, on + SHORTEST_NOTE)
    notes["port"], notes["channel"] = seats[score.notes.part].T
    notes["key"] = np.clip(keys, 0, KEYS - 1)
    notes["velocity"] = np.clip(np.rint(score.notes.velocity * 127), 1, 127)
    return _without_overlaps(notes[_is_key(keys)])


def _without_overlaps(notes: NDArray[np.void]) -> NDArray[np.void]:
    """Let each new stroke of a sounding key end the one before, and last as long as that would have."""
    strings = (notes["port"].astype(np.int64) * CHANNELS_OF_PORT + notes["channel"]) * KEYS + notes["key"]
    order = np.lexsort((-notes["velocity"].astype(np.int64), notes["on"], strings))
    notes, strings = notes[order], strings[order]
    same_string = np.diff(strings, prepend=-1) == 0
    twice = same_string & (np.diff(notes["on"].astype(np.int64), prepend=-1) == 0)
    group = np.cumsum(~same_string) - 1
    off = notes["off"].astype(np.int64)
    step = int(off.max()) + 1
    off = np.maximum.accumulate(off + group * step) - group * step
    # Where a note stands twice, the last of its copies carries the running maximum.
    last_copy = ~np.append(twice[1:], False)
    off = off[last_copy]
    notes, strings = notes[~twice], strings[~twice]
    following = np.append(notes["on"][1:].astype(np.int64), 0)
    struck_again = np.append(np.diff(strings) == 0, False)
    notes["off"] = np.where(struck_again, np.minimum(off, following), off)
    return notes[np.lexsort((notes["key"], notes["channel"], notes["port"], notes["on"]))]


def _plan_controls(score: Score, seats: NDArray[np.uint16], trumpet_parts: Sequence[int]) -> NDArray[np.void]:
    first_onset_s: dict[int, float] = {}
    for index in range(len(score.parts)):
        first_onset_s[index] = float(score.notes.onset_s[score.note_indices(index)].min(initial=np.inf))
    by_channel: dict[int, list[Control]] = defaultdict(list)
    for control in score.controls:
        by_channel[control.channel].append(control)
    crowd = Counter((part.channel, part.is_drums) for part in score.parts)
    rows: list[tuple[int, int, int, int, int]] = []
    seated: set[tuple[int, int]] = set()
    for part in score.parts:
        port, channel = (int(number) for number in seats[part.index])
        if (port, channel) in seated:
            continue
        seated.add((port, channel))
        alone = crowd[part.channel, part.is_drums] == 1
        controls = by_channel[part.channel]
        programs = [control for control in controls if control.kind == "program"] if alone else []
        if not any(control.onset_s <= first_onset_s[part.index] for control in programs):
            program = default_program(part, is_trumpet=part.index in trumpet_parts)
            rows.append((0, port, 0xC0 | channel, program, 0))
        for control in controls:
            message = _message(control, is_drums=part.is_drums, follows_programs=alone)
            if message is not None:
                status, data1, data2 = message
                tick = max(0, round(control.onset_s * SAMPLE_RATE))
                rows.append((tick, port, status | channel, data1, data2))
    table = np.array(rows, dtype=CONTROL_DTYPE)
    table = table[table["tick"] <= (score.duration_s + AFTER_LAST_NOTE_S) * SAMPLE_RATE]
    return table[np.argsort(table["tick"], kind="stable")]


def _message(control: Control, *, is_drums: bool, follows_programs: bool) -> tuple[int, int, int] | None:
    """Return status (channel 0) and data bytes of a control that is heard, or None."""
    if control.kind == "program":
        return (0xC0, control.value, 0) if follows_programs else None
    if control.kind == "pitch_bend":
        bend = min(max(control.value + 8192, 0), 16383)
        return 0xE0, bend & 0x7F, bend >> 7
    if control.kind == "controller":
        heard = control.number in HEARD_CONTROLLERS
        if control.number == BANK_SELECT:
            heard = follows_programs and not is_drums
        return (0xB0, control.number, control.value) if heard else None
    return None
