"""Score files made worse at random: what the fuzz tests and the longer fuzz of the benchmarks read."""

from __future__ import annotations

import io
import json
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import mido
from tests import mutations
from tests.document_mutations import mutate_document
from tests.unit.music.midi_bytes import END, chunk, events, header, metre, midi, name, off, on, program, tempo

if TYPE_CHECKING:
    import random
    from collections.abc import Iterator

EXAMPLES = Path(__file__).parents[3] / "examples" / "scores"

SCORES = mutations.Format(
    interesting=(0x00, 0x01, 0x7F, 0x80, 0xFF, 0x2F, 0x51, 0x58, 0x90, 0xF0, 0xF7, 0xC0, 0xE0),
    tokens=(
        b"MTrk",
        b"MThd",
        b"\xff\x2f\x00",
        b"\xff\xff\xff\xff",
        b"\x00\x00\x00\x00",
        b"\xff\x51\x03\x00\x00\x00",
    ),
    numbers=(b"-1", b"1e308", b"0", b"1e-320", b"null", b"9999999999", b'"C9"', b"[]", b"{}"),
)
"""What means something to readers of MIDI and JSON."""


@cache
def midi_seeds() -> tuple[bytes, ...]:
    """Small MIDI files of every kind to begin from."""
    melody = [event for pitch in (60, 64, 67, 72) for event in (on(10, pitch), off(110, pitch))]
    written = mido.MidiFile(type=1, ticks_per_beat=96)
    track = written.add_track("Trumpet")
    track.append(mido.Message("sysex", data=[1, 2, 3]))
    track.append(mido.Message("pitchwheel", pitch=100))
    track.append(mido.Message("note_on", note=70, time=5))
    track.append(mido.Message("note_off", note=70, time=50))
    stream = io.BytesIO()
    written.save(file=stream)
    plain = midi([name("Song"), tempo(0, 400_000), metre(0, 3, 2)], [name("Tpt"), program(0, 56), *melody])
    return (
        plain,
        midi([tempo(0, 300_000), *melody], form=0),
        midi(melody, melody, form=2),
        midi(melody, division=(256 - 25) << 8 | 40),
        b"RIFF"
        + (len(plain) + 12).to_bytes(4, "little")
        + b"RMIDdata"
        + len(plain).to_bytes(4, "little")
        + plain,
        header()
        + chunk(
            b"MTrk", events(on(0, 60), (20, b"\x3c\x00"), (0, b"\xf0\x02\x01\xf7"), (5, b"\x40\x50"), END)
        ),
        stream.getvalue(),
        (EXAMPLES / "taps.mid").read_bytes(),
    )


@cache
def json_seeds() -> tuple[bytes, ...]:
    """A small JSON score of either form."""
    return (
        json.dumps(
            {
                "format": "reina-score",
                "tempos": [{"beat": 0, "bpm": 90}],
                "pickup_beats": 1,
                "lyrics": [{"beat": 0, "text": "la "}],
                "markers": [{"beat": 1, "text": "A"}],
                "parts": [
                    {
                        "name": "T",
                        "program": 56,
                        "slurs": [{"beat": 0, "end_beat": 1}],
                        "notes": [
                            {"beat": 0, "duration": 1, "pitch": "C4", "tongued": True},
                            {"beat": 1, "duration": 1, "pitch": 62},
                        ],
                    }
                ],
            }
        ).encode(),
        json.dumps(
            {
                "header": {"ppq": 480, "tempos": [{"bpm": 90, "ticks": 0}]},
                "tracks": [
                    {"notes": [{"midi": 60, "time": 0.5, "duration": 1, "ticks": 360, "velocity": 0.5}]}
                ],
            }
        ).encode(),
    )


def seeds() -> tuple[bytes, ...]:
    """Small files of every kind to begin from."""
    return (*midi_seeds(), *json_seeds())


def mutate_midi(data: bytes, rng: random.Random) -> bytes:
    """A MIDI file with one mutation or more."""
    return mutations.mutate(data, SCORES, rng)


def mutate_json(data: bytes, rng: random.Random) -> bytes:
    """A JSON score with one mutation or more, of its values or of its bytes."""
    worse = mutate_document(data, rng) if rng.random() < 0.7 else None
    return mutations.mutate(data, SCORES, rng) if worse is None else worse


def mutated(count: int, seed: int) -> Iterator[bytes]:
    """Yield `count` files, each a seed with one mutation or more."""
    return mutations.mutated(seeds(), SCORES, count, seed)
