"""Scores and a soundfont of a single click, for the tests of sound."""

import struct
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from reina.music import Control, MetreMap, Notes, Part, Score, TempoMap

Row = tuple[int, float, float, int, float]
"""Part, onset and duration in seconds, pitch, velocity 0..1."""


def a_part(
    index: int = 0,
    name: str = "Trumpet",
    program: int | None = None,
    *,
    is_drums: bool = False,
    channel: int | None = None,
) -> Part:
    """A part; drums are on channel 9 and others on 0 unless told otherwise."""
    return Part(index, name, program, is_drums, channel if channel is not None else 9 if is_drums else 0)


def a_score(
    rows: Sequence[Row],
    parts: Sequence[Part] = (),
    controls: Iterable[Control] = (),
    *,
    programs: Sequence[int | None] = (),
    channels: Sequence[int] = (),
) -> Score:
    """A score at 60 beats a minute, so that beats are seconds.

    Notes have the program and the channel of their part, unless `programs` or `channels` says theirs.
    """
    parts = tuple(parts) or (a_part(),)
    program_of = programs or [parts[row[0]].program for row in rows]
    notes = Notes.from_columns(
        part=[row[0] for row in rows],
        channel=channels or [parts[row[0]].channel for row in rows],
        onset_s=[row[1] for row in rows],
        duration_s=[row[2] for row in rows],
        onset_beats=[row[1] for row in rows],
        duration_beats=[row[2] for row in rows],
        sounding_pitch=[row[3] for row in rows],
        velocity=[row[4] for row in rows],
        program=[-1 if program is None else program for program in program_of],
    )
    return Score(
        title="test",
        parts=parts,
        notes=notes,
        tempo_map=TempoMap((0.0,), (1.0,)),
        metre_map=MetreMap(),
        controls=tuple(controls),
        warnings=(),
        duration_s=float(notes.end_s.max()),
    )


def a_controller(number: int, value: int, at_s: float = 0.0, channel: int = 0) -> Control:
    """A controller message."""
    return Control("controller", at_s, at_s, channel, number, value)


CLICK_HZ = 1000.0
CLICK_RATE = 48000
CLICK_LENGTH = 9600


def write_click_soundfont(path: Path) -> Path:
    """Write an SF2 whose only preset is 0.2 s of 1 kHz on key 60 that begins at once, at full scale."""
    wave = np.cos(2 * np.pi * CLICK_HZ * np.arange(CLICK_LENGTH) / CLICK_RATE)
    samples = np.concatenate((np.rint(wave * 32000), np.zeros(46))).astype("<i2").tobytes()
    info = riff_list(
        b"INFO", [(b"ifil", struct.pack("<HH", 2, 1)), (b"isng", b"EMU8000\0"), (b"INAM", b"Click\0")]
    )
    end = b"\0" * 4
    preset = struct.pack("<20sHHHIII", b"Click", 0, 0, 0, 0, 0, 0)
    last_preset = struct.pack("<20sHHHIII", b"EOP", 0, 0, 1, 0, 0, 0)
    sample = struct.pack(
        "<20sIIIIIBbHH", b"Click", 0, CLICK_LENGTH, 8, CLICK_LENGTH - 8, CLICK_RATE, 60, 0, 0, 1
    )
    hydra = [
        (b"phdr", preset + last_preset),
        (b"pbag", struct.pack("<4H", 0, 0, 1, 0)),
        (b"pmod", b"\0" * 10),
        (b"pgen", struct.pack("<HH", 41, 0) + end),
        (b"inst", struct.pack("<20sH20sH", b"Click", 0, b"EOI", 1)),
        (b"ibag", struct.pack("<4H", 0, 0, 1, 0)),
        (b"imod", b"\0" * 10),
        (b"igen", struct.pack("<HH", 53, 0) + end),
        (b"shdr", sample + struct.pack("<20sIIIIIBbHH", b"EOS", 0, 0, 0, 0, 0, 0, 0, 0, 0)),
    ]
    body = b"sfbk" + info + riff_list(b"sdta", [(b"smpl", samples)]) + riff_list(b"pdta", hydra)
    path.write_bytes(struct.pack("<4sI", b"RIFF", len(body)) + body)
    return path


def riff_list(kind: bytes, chunks: Iterable[tuple[bytes, bytes]]) -> bytes:
    """A list of chunks, as RIFF has it."""
    body = kind + b"".join(
        struct.pack("<4sI", name, len(data)) + data + b"\0" * (len(data) % 2) for name, data in chunks
    )
    return struct.pack("<4sI", b"LIST", len(body)) + body
