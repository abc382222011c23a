"""Writes a score as a Standard MIDI File of format 1: a conductor's track, then one track a part and port."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import mido
import numpy as np

from reina.music.gm import DRUM_CHANNEL
from reina.music.midi.messages import CHANNELS_OF_PORT
from reina.music.midi.sysex import rhythm_part
from reina.music.notes import NO_PROGRAM

if TYPE_CHECKING:
    from collections.abc import Iterator

    from reina.music.controls import Control
    from reina.music.metre import MetreMap
    from reina.music.score import Part, Score
    from reina.music.texts import TextKind

TICKS_PER_BEAT = 960
"""A place in the score is written within half a tick: 0.26 ms at 120 beats a minute."""
MAX_TEMPO_US = 0xFFFFFF
"""A tempo has three bytes."""
MAX_NUMERATOR = 255
PICKUP_DENOMINATORS = (4, 8, 16, 32, 64)

WORDS: dict[TextKind, str] = {"lyric": "lyrics", "marker": "marker", "text": "text"}
"""What mido calls the meta events of each kind of words."""

ENDS, STATES, BEGINS = range(3)
"""At one tick notes end first, then programs and controllers change, then notes begin."""

Timed = tuple[int, int, mido.Message | mido.MetaMessage]
"""A tick, an order within it, and the message."""


def write_midi(score: Score) -> bytes:
    """Write a score: its notes, tempo, metre, names, words, programs and controllers.

    Notes keep their channels; 16 and up are written on further ports. Texts are UTF-8.

    Args:
        score: The score.

    Returns:
        The file. Read again it has the same notes: onsets and ends within half a tick of theirs, and
        velocities within half a step of 127.
    """
    file = mido.MidiFile(type=1, ticks_per_beat=TICKS_PER_BEAT, charset="utf-8")
    file.tracks.append(
        _track(
            [
                (0, STATES, _text("track_name", score.title)),
                *_tempos(score),
                *_metres(score.metre_map),
                *_words(score),
            ]
        )
    )
    ports = score.notes.channel // CHANNELS_OF_PORT
    unwritten = _controls_by_port(score)
    for part in score.parts:
        for port in np.unique(ports[score.notes.part == part.index]).tolist():
            # Whoever plays first on a port also brings its channels' controllers: they hold for all tracks.
            controls = unwritten.pop(port, ())
            events = [*_head(part, port), *controls, *_notes(score, part, port)]
            file.tracks.append(_track(events))
    data = io.BytesIO()
    file.save(file=data)
    return data.getvalue()


def _track(events: list[Timed]) -> mido.MidiTrack:
    track = mido.MidiTrack()
    before = 0
    for tick, _, message in sorted(events, key=lambda event: event[:2]):
        track.append(message.copy(time=tick - before))
        before = tick
    return track


def _ticks(beats: float) -> int:
    return max(0, round(beats * TICKS_PER_BEAT))


def _text(kind: str, text: str) -> mido.MetaMessage:
    return mido.MetaMessage(kind, name=text)


def _tempos(score: Score) -> Iterator[Timed]:
    tempo_map = score.tempo_map
    for beats, length_s in zip(
        tempo_map.onset_beats.tolist(), tempo_map.seconds_per_beat.tolist(), strict=True
    ):
        tempo = min(max(1, round(length_s * 1e6)), MAX_TEMPO_US)
        yield _ticks(beats), STATES, mido.MetaMessage("set_tempo", tempo=tempo)


def _metres(metre_map: MetreMap) -> Iterator[Timed]:
    signatures = [(s.onset_beats, s.numerator, s.denominator) for s in metre_map.signatures]
    pickup = metre_map.pickup_beats
    first_beats = signatures[1][0] if len(signatures) > 1 else None
    if pickup > 0 and pickup != first_beats:
        # A file has no other way to say it: a first bar of its own metre.
        for denominator in PICKUP_DENOMINATORS:
            numerator = pickup * denominator / 4
            if numerator.is_integer():
                signatures = [
                    (0.0, int(numerator), denominator),
                    (pickup, *signatures[0][1:]),
                    *signatures[1:],
                ]
                break
    for beats, numerator, denominator in signatures:
        # The file holds the denominator as a power of two.
        if numerator <= MAX_NUMERATOR and denominator & (denominator - 1) == 0:
            message = mido.MetaMessage("time_signature", numerator=numerator, denominator=denominator)
            yield _ticks(beats), STATES, message


def _words(score: Score) -> Iterator[Timed]:
    """Lyrics, marks and other words."""
    for text in score.texts:
        yield _ticks(text.onset_beats), STATES, mido.MetaMessage(WORDS[text.kind], text=text.text)


def _head(part: Part, port: int) -> Iterator[Timed]:
    yield 0, STATES, _text("track_name", part.name)
    if port > 0:
        yield 0, STATES, mido.MetaMessage("midi_port", port=port)


def _controls_by_port(score: Score) -> dict[int, list[Timed]]:
    """Every channel's controllers, and what the notes find on it that no controller says, by port."""
    notes = score.notes
    by_port: dict[int, list[Timed]] = {}
    for channel in sorted(
        {*np.unique(notes.channel).tolist(), *(control.channel for control in score.controls)}
    ):
        port, own = divmod(channel, CHANNELS_OF_PORT)
        events = by_port.setdefault(port, [])
        here = notes.channel == channel
        drums = {part.is_drums for part in score.parts if np.any(here & (notes.part == part.index))}
        if len(drums) == 1 and drums != {own == DRUM_CHANNEL}:
            events.append((0, STATES, mido.Message("sysex", data=rhythm_part(own, on=drums == {True}))))
        controls = [control for control in score.controls if control.channel == channel]
        events.extend((_ticks(control.onset_beats), STATES, _message(control, own)) for control in controls)
        events.extend(_programs(score, channel, controls))
    return by_port


def _programs(score: Score, channel: int, controls: list[Control]) -> Iterator[Timed]:
    """The programs that a channel's notes sound with and no program change says."""
    notes = score.notes
    said = iter([control for control in controls if control.kind == "program"])
    change = next(said, None)
    current = NO_PROGRAM
    for note in np.flatnonzero(notes.channel == channel).tolist():
        beats, program = float(notes.onset_beats[note]), int(notes.program[note])
        while change is not None and change.onset_beats <= beats:
            current, change = change.value, next(said, None)
        if program not in (NO_PROGRAM, current):
            message = mido.Message("program_change", channel=channel % CHANNELS_OF_PORT, program=program)
            yield _ticks(beats), STATES, message
            current = program


def _message(control: Control, channel: int) -> mido.Message:
    number, value = control.number, control.value
    match control.kind:
        case "program":
            return mido.Message("program_change", channel=channel, program=value)
        case "controller":
            return mido.Message("control_change", channel=channel, control=number, value=value)
        case "pitch_bend":
            return mido.Message("pitchwheel", channel=channel, pitch=value)
        case "channel_pressure":
            return mido.Message("aftertouch", channel=channel, value=value)
        case "key_pressure":
            return mido.Message("polytouch", channel=channel, note=number, value=value)


def _notes(score: Score, part: Part, port: int) -> Iterator[Timed]:
    notes = score.notes
    here = np.flatnonzero((notes.part == part.index) & (notes.channel // CHANNELS_OF_PORT == port))
    columns = zip(
        (notes.channel[here] % CHANNELS_OF_PORT).tolist(),
        notes.sounding_pitch[here].tolist(),
        np.clip(np.round(notes.velocity[here] * 127), 1, 127).astype(int).tolist(),
        notes.onset_beats[here].tolist(),
        (notes.onset_beats[here] + notes.duration_beats[here]).tolist(),
        strict=True,
    )
    for channel, pitch, velocity, onset_beats, end_beats in columns:
        begin = _ticks(onset_beats)
        yield begin, BEGINS, mido.Message("note_on", channel=channel, note=pitch, velocity=velocity)
        end = max(_ticks(end_beats), begin + 1)
        yield end, ENDS, mido.Message("note_off", channel=channel, note=pitch, velocity=64)
