"""Seconds to read MIDI files of 1,000 to 100,000 notes, beside mido, pretty_midi and symusic.

Run as ``python tests/benchmarks/bench_reader.py``. Every reader gets the same bytes and has to give notes
with their times in seconds; the best of a few runs counts. Of MusicXML a document of about a megabyte is
read. pretty_midi and symusic are measured where they are installed (``pip install -r
requirements/bench.txt``). The status is 1 if Reina needs more than a second for 100,000 notes, or if its time
grows faster than the notes.
"""

import importlib
import io
import json
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import mido
import numpy as np
from machine import heading, version
from table import SHORT, Row, alternate, tell

from reina.music import read_score

ROOT = Path(__file__).parents[2]

SIZES = (1_000, 10_000, 30_000) if SHORT else (1_000, 10_000, 100_000)
MAX_S = 1.0
MAX_GROWTH = 2.0
"""How much longer a note may take in the largest file than in the middle one."""


def midi_file(notes: int) -> bytes:
    """Three parts with tempo changes, chords, controllers and bends."""
    rng = np.random.default_rng(notes)
    file = mido.MidiFile(type=1, ticks_per_beat=480)
    conductor = file.add_track("Bench")
    for _ in range(max(1, notes // 500)):
        conductor.append(mido.MetaMessage("set_tempo", tempo=int(rng.integers(300_000, 700_000)), time=960))
    for part in range(3):
        track = file.add_track(f"Part {part}")
        track.append(mido.Message("program_change", channel=part, program=56 + part))
        for note in range(notes // 3 + (notes % 3 if part == 0 else 0)):
            pitch = int(rng.integers(50, 90))
            if note % 10 == 0:
                track.append(mido.Message("control_change", channel=part, control=11, value=note % 128))
            wait, length = int(rng.integers(0, 60)), int(rng.integers(20, 200))
            track.append(mido.Message("note_on", channel=part, note=pitch, velocity=80, time=wait))
            track.append(mido.Message("note_off", channel=part, note=pitch, time=length))
    stream = io.BytesIO()
    file.save(file=stream)
    return stream.getvalue()


def json_file(notes: int) -> bytes:
    """The same number of notes as Tone.js's converter writes them."""
    entries = [
        {"midi": 60 + note % 20, "ticks": note * 60, "time": note / 16, "duration": 0.05, "velocity": 0.5}
        for note in range(notes)
    ]
    header = {"ppq": 480, "tempos": [{"bpm": 120, "ticks": 0}]}
    return json.dumps({"header": header, "tracks": [{"notes": entries}]}).encode()


def musicxml_file(parts: int = 4, measures: int = 110) -> bytes:
    """A document with slurs, hairpins and what notation programs write for the eye."""
    sys.path.insert(0, str(ROOT))
    from tests.unit.music.musicxml import musicxml_text as xml

    rng = np.random.default_rng(parts)
    bars: list[str] = []
    for bar in range(measures):
        begin = xml.attributes(extra=xml.B_FLAT) + xml.tempo(100) if bar == 0 else ""
        begin += {0: xml.dynamic("p") + xml.wedge("crescendo"), 4: xml.wedge("stop") + xml.dynamic("f")}.get(
            bar % 8, ""
        )
        for note in range(8):
            marks = {0: xml.slur("start"), 3: xml.slur("stop")}.get(note % 4, "")
            looks = '<stem default-y="3">up</stem><beam number="1">begin</beam>' + marks
            name = str(rng.choice(["C4", "D4", "F#4", "Bb4"]))
            begin += xml.note(name, 0.5, inner=looks).replace("><", ">\n        <")
        bars.append(begin)
    return xml.document(*[xml.measures(*bars)] * parts)


def by_reina(data: bytes) -> int:
    """Read with Reina."""
    return len(read_score(data).notes)


def by_mido(data: bytes) -> int:
    """Read with mido and go through the messages in seconds, as its users do."""
    return sum(message.type == "note_on" for message in mido.MidiFile(file=io.BytesIO(data)))


def by_pretty_midi(data: bytes) -> int:
    """Read with pretty_midi."""
    module: Any = importlib.import_module("pretty_midi")
    return sum(len(instrument.notes) for instrument in module.PrettyMIDI(io.BytesIO(data)).instruments)


def by_symusic(data: bytes) -> int:
    """Read with symusic, times in seconds."""
    module: Any = importlib.import_module("symusic")
    score = module.Score.from_midi(data, ttype="second")
    return sum(len(track.notes) for track in score.tracks)


READERS: dict[str, tuple[Callable[[bytes], int], int]] = {
    "reina": (by_reina, 5),
    "mido": (by_mido, 1),
    "pretty_midi": (by_pretty_midi, 1),
    "symusic": (by_symusic, 5),
}
"""Each reader and how often it runs."""
NOTES = {"mido": "Python", "pretty_midi": "Python, on mido", "symusic": "C++"}


def seconds(read: Callable[[bytes], int], data: bytes, notes: int, runs: int) -> float:
    """Return the best time of a few runs."""
    times: list[float] = []
    for _ in range(runs):
        begin = time.perf_counter()
        found = read(data)
        times.append(time.perf_counter() - begin)
        if found != notes:
            print(f"  ({read.__name__} found {found} notes of {notes})")
    return min(times)


def beside(size: int, data: bytes) -> dict[tuple[str, int], float]:
    """Read a file with every reader that is there, turn by turn; seconds by reader and size."""
    there = {name: reader for name, reader in READERS.items() if version(name)}
    best = alternate(
        1 if SHORT else 2,
        *(partial(seconds, read, data, size, runs) for read, runs in there.values()),
        key=float,
    )
    taken = dict(zip(there, best, strict=True))
    for name in READERS:
        if name != "reina":
            tell(
                Row(
                    "Reading files",
                    f"MIDI of {size:,} notes",
                    "ms",
                    taken["reina"] * 1000,
                    name,
                    version(name),
                    taken[name] * 1000 if name in taken else None,
                    notes=NOTES[name] if name in taken else "not installed",
                )
            )
    return {(name, size): time_s for name, time_s in taken.items()}


def main() -> int:
    """Measure and print a table; return 1 if a bound is missed."""
    print(heading(__file__))
    taken: dict[tuple[str, int], float] = {}
    files = {size: midi_file(size) for size in SIZES}
    for size, data in files.items():
        taken |= beside(size, data)
    taken["json", SIZES[-1]] = seconds(by_reina, json_file(SIZES[-1]), SIZES[-1], 3)
    print(f"reina, JSON of Tone.js's form, {SIZES[-1]:,} notes: {taken['json', SIZES[-1]] * 1000:.1f} ms")
    document = musicxml_file()
    of_document = seconds(by_reina, document, 3520, 3)
    print(f"reina, MusicXML of {len(document) / 1e6:.1f} MB, 3,520 notes: {of_document * 1000:.1f} ms")
    largest = taken["reina", SIZES[-1]]
    growth = (largest / SIZES[-1]) / (taken["reina", SIZES[-2]] / SIZES[-2])
    print(f"a note of the largest file takes {growth:.2f} times as long as one of the middle file")
    missed = max(largest, taken["json", SIZES[-1]], of_document) > MAX_S or growth > MAX_GROWTH
    # The bounds are meant for the whole form alone.
    return 1 if missed and not SHORT else 0


if __name__ == "__main__":
    sys.exit(main())
