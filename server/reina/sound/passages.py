"""Cuts a plan into passages that can be rendered one by one and added up.

A synthesizer adds voices, so that the sum of the passages is the whole. Rendering in passages gives a true
measure of progress and keeps memory small however long the score is.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reina.sound.events import DRUM_CHANNEL, SAMPLE_RATE, SoundPlan
from reina.sound.midi import write_midi

BLOCK = 64
"""The synthesizer acts on events once in so many samples."""

SHORTEST = 20 * SAMPLE_RATE
LONGEST = 40 * SAMPLE_RATE
RELEASE = 5 * SAMPLE_RATE
"""How long a released note may still ring, reverberation included."""
LONGEST_PEDAL = 15 * SAMPLE_RATE
"""How long after its release the pedal may hold a note: what has no decay would never end under a pedal left
down."""

CHOKES = {46: (42, 44), 81: (80,), 79: (78,), 72: (71,), 74: (73,)}
"""General MIDI drums that ring, each with those that silence it: hi-hat, triangle, cuica, whistle, guiro."""

HOLD_PEDAL, VOLUME, VOLUME_FINE, RESET = 64, 7, 39, 121
DEFAULT_VOLUME = 100 << 7
PARAMETER_CONTROLLERS = frozenset({6, 38, 98, 99, 100, 101})
RESET_CLEARS = frozenset({(0xB0, 1), (0xB0, 33), (0xB0, 11), (0xB0, 43), (0xB0, HOLD_PEDAL), (0xE0, 0)})

NOTE_OFF, CONTROL, NOTE_ON = 0, 1, 2
"""In which order events of one tick take effect."""


@dataclass(frozen=True, eq=False)
class Passage:
    """A stretch of one port.

    Attributes:
        port: Whose sixteen channels sound.
        start: First sample, a multiple of BLOCK.
        end: Where the passage's last note begins at the latest.
        length: How many samples to render, until its last note has died away.
        notes: Which of the plan's notes begin in it, indices.
    """

    port: int
    start: int
    end: int
    length: int
    notes: NDArray[np.int64]


def cut_into_passages(plan: SoundPlan) -> list[Passage]:
    """Cut a plan every 20 to 40 seconds, where fewest notes sound; rests of that length get no passage."""
    rings_until = _rings_until(plan)
    passages: list[Passage] = []
    for start, end in _stretches(plan):
        begins_here = (plan.notes["on"] >= start) & (plan.notes["on"] < end)
        for port in np.unique(plan.notes["port"][begins_here]):
            indices = np.flatnonzero(begins_here & (plan.notes["port"] == port))
            length = int(rings_until[indices].max()) + RELEASE - start
            passages.append(Passage(int(port), start, end, -(-length // BLOCK) * BLOCK, indices))
    return passages


def write_passage(plan: SoundPlan, passage: Passage, *, gain: float = 1.0) -> bytes:
    """Return a passage as a MIDI file; its tick 0 is the passage's first sample.

    Args:
        plan: What the passage is cut from.
        passage: Which stretch.
        gain: How loud as a factor of the amplitude, at most 1; set by the channels' volume.
    """
    controls = plan.controls[plan.controls["port"] == passage.port]
    mixer = _Mixer(gain)
    events: list[tuple[int, int, bytes]] = []
    before = controls["tick"] <= passage.start
    events.extend((0, CONTROL, message) for message in _state(controls[before]))
    until = passage.start + passage.length
    later = controls[~before & (controls["tick"] < until)]
    events.extend((_tick(row["tick"], passage), CONTROL, _bytes(row)) for row in later)
    for note in plan.notes[passage.notes]:
        channel, key, velocity = int(note["channel"]), int(note["key"]), int(note["velocity"])
        events.append((_tick(note["on"], passage), NOTE_ON, bytes((0x90 | channel, key, velocity))))
        events.append((_tick(note["off"], passage), NOTE_OFF, bytes((0x80 | channel, key, 64))))
    choking = plan.notes[_choking(plan, passage, until)]
    for tick, key in zip(choking["on"], choking["key"], strict=True):
        events.append((_tick(tick, passage), NOTE_ON, bytes((0x90 | DRUM_CHANNEL, int(key), 1))))
    events.sort(key=lambda event: event[:2])
    mixed = [(0, message) for message in mixer.opening()]
    for tick, _, message in events:
        mixed.extend((tick, heard) for heard in mixer.mix(message))
    return write_midi(mixed, end_tick=passage.length)


def _tick(sample: int, passage: Passage) -> int:
    """Return the tick that makes the synthesizer act in the block nearest to a sample.

    It acts at the first block that begins at or after a tick; a quarter of a block of room keeps rounding
    from moving an event to the next.
    """
    block = (int(sample) - passage.start + BLOCK // 2) // BLOCK
    return min(max(0, block * BLOCK - BLOCK // 4), passage.length)


def _bytes(control: np.void) -> bytes:
    status = int(control["status"])
    data = (int(control["data1"]), int(control["data2"]))
    return bytes((status, data[0])) if status & 0xF0 == 0xC0 else bytes((status, *data))


def _rings_until(plan: SoundPlan) -> NDArray[np.int64]:
    """Return for each note when it is let go by key and pedal, (N,) samples."""
    until = plan.notes["off"].astype(np.int64)
    pedals = plan.controls[
        (plan.controls["status"] & 0xF0 == 0xB0) & np.isin(plan.controls["data1"], (HOLD_PEDAL, RESET))
    ]
    for port, channel in np.unique(np.stack((pedals["port"], pedals["status"] & 0x0F)), axis=1).T:
        here = pedals[(pedals["port"] == port) & (pedals["status"] & 0x0F == channel)]
        down = (here["data1"] == HOLD_PEDAL) & (here["data2"] >= 64)
        ticks = here["tick"].astype(np.int64)
        indices = np.flatnonzero((plan.notes["port"] == port) & (plan.notes["channel"] == channel))
        ups = np.append(ticks[~down], np.iinfo(np.int64).max // 2)
        last = np.searchsorted(ticks, until[indices], side="right") - 1
        held = (last >= 0) & down[last]
        released = ups[np.searchsorted(ticks[~down], until[indices], side="left")]
        longest = until[indices] + LONGEST_PEDAL
        until[indices] = np.where(held, np.minimum(released, longest), until[indices])
    return until


def _stretches(plan: SoundPlan) -> Iterator[tuple[int, int]]:
    """Yield first sample and end of each stretch; every note begins in exactly one."""
    onsets = plan.notes["on"].astype(np.int64)
    offs = np.sort(plan.notes["off"].astype(np.int64))
    sounding = np.arange(len(onsets)) - np.searchsorted(offs, onsets, side="right")
    first = 0
    while first < len(onsets):
        start = int(onsets[first]) // BLOCK * BLOCK
        # A cut falls before the note i; notes of one onset stay together.
        low, high = np.searchsorted(onsets, (start + SHORTEST, start + LONGEST), side="left")
        if high == len(onsets):
            cut = len(onsets)
        elif low == high:
            cut = int(low)
        else:
            cut = int(low) + int(np.argmin(sounding[low:high]))
        end = int(onsets[cut]) if cut < len(onsets) else int(onsets[-1]) + 1
        yield start, end
        first = int(np.searchsorted(onsets, end, side="left"))


def _choking(plan: SoundPlan, passage: Passage, until: int) -> NDArray[np.int64]:
    """Return the drum notes after a passage that cut short what still rings from it."""
    own = plan.notes[passage.notes]
    ringing = own["key"][own["channel"] == DRUM_CHANNEL]
    silencers = [key for rings, keys in CHOKES.items() if rings in ringing for key in (rings, *keys)]
    later = (
        (plan.notes["on"] >= passage.end) & (plan.notes["on"] < until) & (plan.notes["port"] == passage.port)
    )
    drums = (plan.notes["channel"] == DRUM_CHANNEL) & np.isin(plan.notes["key"], silencers)
    return np.flatnonzero(later & drums)


def _state(controls: NDArray[np.void]) -> list[bytes]:
    """Return the fewest messages that leave the channels as all of `controls` would."""
    parameters: list[bytes] = []
    latest: dict[tuple[int, int, int], bytes] = {}
    for row in controls:
        message = _bytes(row)
        kind, channel = message[0] & 0xF0, message[0] & 0x0F
        number = message[1] if kind == 0xB0 else 0
        if kind == 0xB0 and number in PARAMETER_CONTROLLERS:
            parameters.append(message)
        elif kind == 0xB0 and number == RESET:
            for cleared, cleared_number in RESET_CLEARS:
                latest.pop((cleared, channel, cleared_number), None)
        else:
            latest.pop((kind, channel, number), None)
            latest[kind, channel, number] = message
    return parameters + list(latest.values())


class _Mixer:
    """Turns every channel's volume down by one factor.

    The synthesizer's gain is the square of the volume, which has 14 bits.
    """

    def __init__(self, gain: float) -> None:
        self._factor = gain**0.5
        self._volumes = [DEFAULT_VOLUME] * 16

    def opening(self) -> Iterator[bytes]:
        """Yield the messages that set what the channels begin with."""
        if self._factor != 1.0:
            for channel in range(16):
                yield from self._volume(channel)

    def mix(self, message: bytes) -> Iterator[bytes]:
        """Yield a message, or what takes its place."""
        if self._factor == 1.0 or message[0] & 0xF0 != 0xB0 or message[1] not in (VOLUME, VOLUME_FINE):
            yield message
            return
        channel = message[0] & 0x0F
        coarse, fine = divmod(self._volumes[channel], 128)
        if message[1] == VOLUME:
            coarse = message[2]
        else:
            fine = message[2]
        self._volumes[channel] = coarse * 128 + fine
        yield from self._volume(channel)

    def _volume(self, channel: int) -> Iterator[bytes]:
        coarse, fine = divmod(round(self._volumes[channel] * self._factor), 128)
        yield bytes((0xB0 | channel, VOLUME, coarse))
        yield bytes((0xB0 | channel, VOLUME_FINE, fine))
