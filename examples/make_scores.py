"""Write the scores of examples/scores: ``python examples/make_scores.py [FOLDER]``.

All tunes are in the public domain; notes, harmony and variation are set here. A tune is written as words:
``F#5:1.5`` is a pitch and its length in quarter notes, ``r:1`` a rest, ``F#5:2~`` a trill, ``F#5:1^`` a short
trill at the beginning (prall), ``A4:1'`` a note held for half of its length, ``|`` a bar line for the reader.
"""

import json
import re
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mido

FOLDER = Path(__file__).parent / "scores"
TICKS = 480
STEPS = {"C": 0, "D": 2, "E": 4, "F": 5, "G": 7, "A": 9, "B": 11}
D_MAJOR = (2, 4, 6, 7, 9, 11, 1)


@dataclass(frozen=True)
class Note:
    """A note: onset and duration in quarter notes, MIDI pitch, velocity 1 to 127."""

    onset: float
    duration: float
    pitch: int
    velocity: int


def pitch_of(name: str) -> int:
    """Return the MIDI number of ``F#4``, ``Bb3``."""
    step, rest = name[0], name[1:]
    shift = rest.count("#") - rest.count("b")
    return 12 * (int(rest.strip("#b")) + 1) + STEPS[step] + shift


def upper_neighbour(pitch: int, scale: Sequence[int]) -> int:
    """Return the next higher pitch in a scale of pitch classes."""
    return next(higher for higher in range(pitch + 1, pitch + 4) if higher % 12 in scale)


def tune(
    words: str,
    *,
    start: float = 0.0,
    velocity: int = 88,
    hold: float = 0.92,
    scale: Sequence[int] = D_MAJOR,
    bar: float = 4.0,
) -> tuple[list[Note], float]:
    """Return the notes of a tune and where it ends; the first beat of a bar is a little stronger."""
    notes: list[Note] = []
    at = start
    for word in words.replace("|", " ").split():
        name, _, rest = word.partition(":")
        length = float(rest.rstrip("~^'"))
        if name != "r":
            pitch = pitch_of(name)
            strong = velocity + (6 if (at - start) % bar == 0 else 0)
            upper = upper_neighbour(pitch, scale) if word[-1] in "~^" else pitch
            if word.endswith("~"):
                # The shake takes most of the note; it begins above and comes to rest.
                strokes = 2 * round(length * 0.75 / 0.375) - 1
                notes += [
                    Note(at + 0.1875 * stroke, 0.1875, (upper, pitch)[stroke % 2], strong - 4)
                    for stroke in range(strokes)
                ]
                begin = 0.1875 * strokes
                notes.append(Note(at + begin, (length - begin) * hold, pitch, strong - 4))
            elif word.endswith("^"):
                notes.append(Note(at, 0.125, pitch, strong))
                notes.append(Note(at + 0.125, 0.125, upper, strong - 6))
                notes.append(Note(at + 0.25, (length - 0.25) * hold, pitch, strong - 4))
            else:
                notes.append(Note(at, length * (0.5 if word.endswith("'") else hold), pitch, strong))
        at += length
    return notes, at


def chords(words: str, voicings: dict[str, str], *, start: float, velocity: int) -> list[Note]:
    """Return chords, as ``D:2 A:2``; neighbours of one name are tied."""
    merged: list[tuple[str, float]] = []
    for word in words.replace("|", " ").split():
        name, length = word.split(":")
        if merged and merged[-1][0] == name:
            merged[-1] = (name, merged[-1][1] + float(length))
        else:
            merged.append((name, float(length)))
    notes: list[Note] = []
    at = start
    for name, length in merged:
        notes += [Note(at, length * 0.97, pitch_of(voice), velocity) for voice in voicings[name].split()]
        at += length
    return notes


def track(
    name: str, channel: int, program: int | None, notes: Iterable[Note], pan: int = 64
) -> mido.MidiTrack:
    """Return one part as a MIDI track."""
    events: list[tuple[int, int, mido.Message]] = []
    for note in notes:
        on, off = round(note.onset * TICKS), round((note.onset + note.duration) * TICKS)
        events.append(
            (on, 1, mido.Message("note_on", channel=channel, note=note.pitch, velocity=note.velocity))
        )
        events.append((off, 0, mido.Message("note_off", channel=channel, note=note.pitch, velocity=64)))
    events.sort(key=lambda event: (event[0], event[1], event[2].note))
    part = mido.MidiTrack([mido.MetaMessage("track_name", name=name)])
    if program is not None:
        part.append(mido.Message("program_change", channel=channel, program=program))
    part.append(mido.Message("control_change", channel=channel, control=10, value=pan))
    now = 0
    for tick, _, message in events:
        part.append(message.copy(time=tick - now))
        now = tick
    return part


def conductor(title: str, *messages: tuple[float, mido.MetaMessage]) -> mido.MidiTrack:
    """Return the first track: title, tempos and metres at their beats."""
    first = mido.MidiTrack([mido.MetaMessage("track_name", name=title)])
    now = 0
    for beat, message in messages:
        tick = round(beat * TICKS)
        first.append(message.copy(time=tick - now))
        now = tick
    return first


def tempo(bpm: float) -> mido.MetaMessage:
    """Return a tempo of quarter notes a minute."""
    return mido.MetaMessage("set_tempo", tempo=mido.bpm2tempo(bpm))


def metre(numerator: int, denominator: int) -> mido.MetaMessage:
    """Return a time signature."""
    return mido.MetaMessage("time_signature", numerator=numerator, denominator=denominator)


def save(path: Path, *tracks: mido.MidiTrack) -> None:
    """Write a MIDI file of format 1."""
    file = mido.MidiFile(type=1, ticks_per_beat=TICKS, charset="utf-8")
    file.tracks.extend(tracks)
    file.save(path)


def rallentando(from_beat: float, to_beat: float, from_bpm: float, to_bpm: float) -> list[tuple[float, Any]]:
    """Return a tempo that falls evenly, in steps of an eighth."""
    steps = round((to_beat - from_beat) * 2)
    return [
        (from_beat + step / 2, tempo(from_bpm + (to_bpm - from_bpm) * step / steps))
        for step in range(1, steps + 1)
    ]


MARCH_A = """
D5:2 E5:2~ | F#5:1.5 G5:.5 F#5:1^ E5:1 | D5:1 E5:1 F#5:1 E5:.5 D5:.5 | E5:1 A4:1 A4:1 A4:1' |
D5:2 E5:2~ | F#5:1.5 G5:.5 F#5:1^ E5:1 | D5:.5 E5:.5 D5:.5 E5:.5 E5:1.5~ D5:.5 | D5:3 r:1 |"""
MARCH_B = """
F#5:2 G#5:1.5~ F#5:.25 G#5:.25 | A5:1.5 B5:.5 A5:1^ G5:1 | F#5:1 D5:1 D5:1 A4:1 | D5:1 A4:1 F#4:1 D4:1' |
F#5:2 G#5:1.5~ F#5:.25 G#5:.25 | A5:1.5 B5:.5 A5:1^ G5:1 | F#5:1.5 D5:.5 D5:.5 E5:.5 F#5:.5 G5:.5 |
E5:3 r:1 |"""
MARCH_C = """
A4:1 F#4:.5 G4:.5 A4:1 D5:1 | A4:1 F#4:.5 G4:.5 A4:1 D5:1 | A4:1 D5:.5 E5:.5 F#5:1 D5:1 |
C#5:1.5 B4:.5 A4:2' |
E5:1 C#5:.5 D5:.5 E5:1 F#5:1 | E5:1 C#5:.5 D5:.5 E5:1 F#5:1 | E5:1 D5:.5 C#5:.5 B4:1.5~ A4:.5 | A4:3 r:1 |"""
MARCH_CHORDS = {
    "A": """D:2 A:2 | D:3 A:1 | Bm:1 A:1 D:1 G:1 | A:4 | D:2 A:2 | D:3 A:1 | Bm:1 G:1 A:2 | D:4""",
    "B": """D:2 E:2 | A:4 | D:4 | D:4 | D:2 E:2 | A:4 | D:2 Bm:1 D:1 | A:4""",
    "C": """D:4 | D:4 | D:4 | A:4 | A:3 D:1 | A:3 D:1 | A:2 E:2 | A:4""",
}
MARCH_BASS = {
    "A": """D3:2 C#3:2 | D3:1.5 E3:.5 D3:1 C#3:1 | B2:1 C#3:1 D3:1 G2:1 | A2:1 A2:1 B2:1 C#3:1 |
            D3:2 C#3:2 | D3:1.5 E3:.5 D3:1 C#3:1 | B2:1 G2:1 A2:2 | D3:1 A2:1 D2:2""",
    "B": """D3:2 E3:2 | A2:1 C#3:1 E3:1 A2:1 | D3:1 D3:1 F#3:1 D3:1 | D3:1 A2:1 F#2:1 D2:1 |
            D3:2 E3:2 | A2:1 C#3:1 E3:1 A2:1 | D3:2 B2:1 D3:1 | A2:1 E3:1 A2:2""",
    "C": """D3:2 F#3:2 | D3:2 F#3:2 | D3:1 F#3:1 D3:1 F#3:1 | A2:2 C#3:2 |
            A2:2 C#3:1 D3:1 | A2:2 C#3:1 D3:1 | A2:2 E3:2 | A2:1 E3:1 A2:2""",
}
MARCH_DRUMS = {
    "A": """D3:1 r:3 | D3:1 r:3 | r:4 | A2:1 A2:.5 A2:.5 A2:1 A2:1 | D3:1 r:3 | D3:1 r:3 | r:2 A2:2~ |
    D3:1 A2:1 D3:2""",
    "B": """D3:1 r:3 | A2:1 r:1 A2:1 r:1 | D3:1 r:3 | D3:1 A2:1 D3:1 r:1 | D3:1 r:3 | A2:1 r:1 A2:1 r:1 |
    D3:1 r:3 | A2:1 A2:1 A2:2""",
    "C": """D3:1 r:3 | D3:1 r:3 | D3:1 r:3 | A2:1 r:1 A2:2 | r:4 | r:4 | r:4 | A2:1 A2:1 A2:2""",
}
ORGAN = {
    "D": "A3 D4 F#4",
    "A": "A3 C#4 E4",
    "E": "G#3 B3 E4",
    "G": "B3 D4 G4",
    "Bm": "B3 D4 F#4",
}


def prince_of_denmarks_march(path: Path) -> None:
    """Clarke's march: refrain, two episodes, refrain; trumpet, organ, basses and timpani."""
    melodies = {"A": MARCH_A, "B": MARCH_B, "C": MARCH_C}
    loudness = [("A", 92), ("B", 98), ("C", 80), ("A", 104)]
    trumpet: list[Note] = []
    organ: list[Note] = []
    bass: list[Note] = []
    timpani: list[Note] = []
    at = 0.0
    for section, velocity in loudness:
        notes, end = tune(melodies[section], start=at, velocity=velocity)
        trumpet += notes
        organ += chords(MARCH_CHORDS[section], ORGAN, start=at, velocity=velocity - 34)
        bass += tune(MARCH_BASS[section], start=at, velocity=velocity - 26, hold=0.85)[0]
        timpani += tune(MARCH_DRUMS[section], start=at, velocity=velocity - 24, hold=0.6, scale=(9, 10))[0]
        at = end
    last = conductor(
        "Prince of Denmark's March",
        (0.0, metre(4, 4)),
        (0.0, tempo(112)),
        *rallentando(at - 8, at - 4, 112, 88),
    )
    save(
        path,
        last,
        track("Trumpet", 0, 56, trumpet, 64),
        track("Organ", 1, 19, organ, 50),
        track("Basses", 2, 43, bass, 80),
        track("Timpani", 3, 47, timpani, 90),
    )


DUET_SECONDS = {
    # The second enters late in the refrain, answers the first's call in B, and has the tune first in C.
    "A": """r:4 | r:4 | r:4 | r:1 E4:1 E4:1 E4:1' |
            F#4:1 A4:1 C#5:2 | A4:1.5 B4:.5 A4:1 A4:1 | B4:.5 C#5:.5 B4:1 C#5:1.5 A4:.5 | F#4:3 r:1 |""",
    "B": """D5:2 B4:1.5 A4:.25 B4:.25 | C#5:1.5 D5:.5 C#5:1 E5:1 | D5:1 r:3 | F#5:1 D5:1 A4:1 F#4:1' |
            D5:2 B4:1.5 A4:.25 B4:.25 | C#5:1.5 D5:.5 C#5:1 E5:1 |
            D5:1.5 F#4:.5 F#4:.5 G4:.5 A4:.5 B4:.5 | C#5:3 r:1 |""",
    "C": """A4:1 F#4:.5 G4:.5 A4:1 D5:1 | F#4:1 D4:.5 E4:.5 F#4:2 | F#4:1 F#4:.5 G4:.5 A4:1 F#4:1 |
            E4:1.5 D4:.5 C#4:2' |
            E5:1 C#5:.5 D5:.5 E5:1 F#5:1 | C#5:1 A4:.5 B4:.5 C#5:1 A4:1 |
            A4:1 B4:.5 A4:.5 G#4:1.5 E4:.5 | E4:1 C#4:.5 C#4:.5 E4:1 r:1 |""",
    "end": """F#4:1 A4:1 C#5:2 | A4:1.5 B4:.5 A4:1 A4:1 | B4:1 A4:1 A4:1 B4:1 | C#5:1 E4:1 E4:1 E4:1' |
              F#4:1 A4:1 C#5:2 | A4:1.5 B4:.5 A4:1 A4:1 | B4:.5 C#5:.5 B4:1 C#5:1.5 A4:.5 |
              F#4:3 r:1 |""",
}
DUET_FIRST_C = """
r:4 | A4:1 F#4:.5 G4:.5 A4:1 D5:1 | A4:1 D5:.5 E5:.5 F#5:1 D5:1 | C#5:1.5 B4:.5 A4:2' |
r:4 | E5:1 C#5:.5 D5:.5 E5:1 F#5:1 | E5:1 D5:.5 C#5:.5 B4:1.5~ A4:.5 | A4:3 r:1 |"""
DUET_BASS = {
    "A": """D3:2 A2:2 | D3:2 D3:1 C#3:1 | B2:1 C#3:1 D3:1 B2:1 | A2:2 A2:1 C#3:1 |
            D3:2 A2:2 | D3:2 D3:1 C#3:1 | B2:1 G2:1 A2:2 | D3:1 A2:1 D2:2 |""",
    "B": """D3:2 E3:2 | A2:1 C#3:1 E3:1 A2:1 | D3:2 F#3:2 | D3:2 D2:2 |
            D3:2 E3:2 | A2:1 C#3:1 E3:1 A2:1 | D3:2 B2:1 F#2:1 | A2:1 E3:1 A2:2 |""",
    "C": """D3:2 F#3:2 | D3:4 | D3:2 D3:2 | A3:2 A2:2 |
            A2:2 C#3:1 D3:1 | A2:2 A2:1 D3:1 | C#3:1 A2:1 E3:2 | A2:2 A2:1 C#3:1 |""",
}


def trumpet_duet(path: Path) -> None:
    """Clarke's march for two trumpets and continuo; the second trumpet's part is our own.

    They go in thirds and sixths, and apart where one calls and the other answers.
    """
    firsts = {"A": MARCH_A, "B": MARCH_B, "C": DUET_FIRST_C}
    sections = [("A", "A", 90), ("B", "B", 98), ("C", "C", 82), ("A", "end", 104)]
    first: list[Note] = []
    second: list[Note] = []
    organ: list[Note] = []
    bass: list[Note] = []
    at = 0.0
    for section, ending, velocity in sections:
        notes, end = tune(firsts[section], start=at, velocity=velocity)
        first += notes
        second += tune(DUET_SECONDS[ending], start=at, velocity=velocity - 6)[0]
        organ += chords(MARCH_CHORDS[section], ORGAN, start=at, velocity=velocity - 40)
        bass += tune(DUET_BASS[section], start=at, velocity=velocity - 34, hold=0.85)[0]
        at = end
    title = conductor(
        "Prince of Denmark's March for two trumpets",
        (0.0, metre(4, 4)),
        (0.0, tempo(120)),
        *rallentando(at - 8, at - 4, 120, 92),
    )
    save(
        path,
        title,
        track("Trumpet 1", 0, 56, first, 52),
        track("Trumpet 2", 1, 56, second, 76),
        track("Organ", 2, 19, organ, 50),
        track("Basses", 3, 43, bass, 80),
    )


TAPS = """
G4:.75 G4:.25 | C5:3 G4:.75 C5:.25 | E5:3 G4:.5 C5:.5 | E5:1 G4:.5 C5:.5 E5:1 G4:.5 C5:.5 |
E5:3 C5:.75 E5:.25 |
G5:2 E5:1 C5:1 | G4:3 G4:.75 G4:.25 | C5:4 |"""


def taps(path: Path) -> None:
    """The bugle call, with no valve moved: written G4 to G5 on the open horn; it begins with a pickup."""
    notes, _ = tune(TAPS, velocity=76, hold=0.96)
    sounding = [Note(note.onset, note.duration, note.pitch - 2, note.velocity) for note in notes]
    first = conductor("Taps", (0.0, metre(1, 4)), (0.0, tempo(54)), (1.0, metre(4, 4)))
    save(path, first, track("Bugle", 0, None, sounding))


CARNIVAL_THEME = """
Bb4:.5 | C5:1 Bb4:.5 Ab4:1 G4:.5 | Ab4:.5 F4:1 r:1 F4:.25 G4:.25 | Ab4:1 Bb4:.5 C5:1 Bb4:.5 |
G4:2 r:.5 Bb4:.5 |
Eb5:1 Bb4:.5 Bb4:.5 Ab4:.5 G4:.5 | Ab4:.5 F4:1 r:1 F4:.25 G4:.25 | Ab4:1 Bb4:.5 C5:1 Bb4:.5 | Eb4:2 r:.5 """
CARNIVAL_VARIATION = """
5:2 | 6 5 +4 5 6 5  4 3 +2 3 4 3 | 4 2 +1 2 3 2  7, 2 4 6 5 +4 | 4 +4 5 +5 6 7  8 7 6 5 4 2 |
3 5 8 5 3 5  8 10 8 5 3 5 |
8 5 3 5 8 10  12 10 8 5 3 +2 | 4 2 7, 2 4 2  5 4 2 4 5 +5 | 6 5 4 5 6 7  8 9 10 9 8 7 |
8 5 3 5 8 +9  10 +9 10 +9 10 +9 |
10 +9 10 +9 10 +9  10 9 8 7 8 9 | 8:12 """
CARNIVAL_CHORDS = """Eb:3 | Bb:3 | Bb:3 | Eb:3 | Eb:3 | Bb:3 | Bb:3 | Eb:3"""
E_FLAT_MAJOR = (0, 2, 4, 5, 7, 9, 11)


def degree(word: str, tonic: int) -> int:
    """Return the pitch of a scale degree: ``8`` lies above ``1``, ``7,`` below; ``+4`` is raised."""
    number = int(word.strip("+,")) - 1
    octave, step = divmod(number, 7)
    return tonic + 12 * octave + E_FLAT_MAJOR[step] + word.count("+") - 12 * word.count(",")


def carnival_of_venice(path: Path) -> None:
    """The canzonetta that Arban wrote variations on, then a variation in running sixteenths, our own."""
    theme, end = tune(CARNIVAL_THEME, velocity=78, bar=3.0)
    at = end + 0.0
    variation: list[Note] = []
    for word in CARNIVAL_VARIATION.replace("|", " ").split():
        name, _, length = word.partition(":")
        beats = 0.25 * float(length or 1)
        accent = 8 if (at - end - 0.5) % 1.5 < 1e-9 else 0
        variation.append(Note(at, beats * 0.9, degree(name, pitch_of("Eb4")), 84 + accent))
        at += beats
    voicing = {"Eb": "G3 Bb3 Eb4", "Bb": "Ab3 Bb3 D4"}
    strings: list[Note] = []
    basses: list[Note] = []
    bars = [word.split(":")[0] for word in CARNIVAL_CHORDS.replace("|", " ").split()]
    for verse, bar_names in ((0.5, bars), (end + 0.5, [*bars, "Eb", "Eb"])):
        for bar, name in enumerate(bar_names):
            for half in (0.0, 1.5):
                beat = verse + 3 * bar + half
                basses.append(Note(beat, 0.45, pitch_of("Eb3" if name == "Eb" else "Bb2"), 66))
                strings += [
                    Note(beat + after, 0.4, pitch_of(voice), 54)
                    for after in (0.5, 1.0)
                    for voice in voicing[name].split()
                ]
    first = conductor(
        "Carnival of Venice",
        (0.0, metre(1, 8)),
        (0.0, tempo(96)),
        (0.5, metre(6, 8)),
        (end, tempo(126)),
    )
    save(
        path,
        first,
        track("Cornet solo", 0, 56, theme + variation),
        track("Strings", 1, 45, strings, 50),
        track("Basses", 2, 32, basses, 76),
    )


def chromatic_scale(path: Path) -> None:
    """Every playable pitch, up and down."""
    pitches = [*range(52, 90), *range(88, 51, -1)]
    notes = [Note(0.5 * place, 0.47, pitch, 80) for place, pitch in enumerate(pitches)]
    save(
        path,
        conductor("Chromatic scale", (0.0, metre(4, 4)), (0.0, tempo(100))),
        track("Trumpet in Bb", 0, 56, notes),
    )


ODE = """
E4:1 E4:1 F4:1 G4:1 | G4:1 F4:1 E4:1 D4:1 | C4:1 C4:1 D4:1 E4:1 | E4:1.5 D4:.5 D4:2 |
E4:1 E4:1 F4:1 G4:1 | G4:1 F4:1 E4:1 D4:1 | C4:1 C4:1 D4:1 E4:1 | D4:1.5 C4:.5 C4:2 |
D4:1 D4:1 E4:1 C4:1 | D4:1 E4:.5 F4:.5 E4:1 C4:1 | D4:1 E4:.5 F4:.5 E4:1 D4:1 | C4:1 D4:1 G3:1 E4:1 |
E4:1 E4:1 F4:1 G4:1 | G4:1 F4:1 E4:1 D4:1 | C4:1 C4:1 D4:1 E4:1 | D4:1.5 C4:.5 C4:2 |"""
ODE_BASS = """
Bb2:4 | F2:4 | Bb2:4 | F2:4 | Bb2:4 | F2:4 | Bb2:4 | F2:2 Bb2:2 |
F2:4 | F2:4 | F2:4 | Bb2:2 F2:2 | Bb2:4 | F2:4 | Bb2:4 | F2:2 Bb2:2 |"""


def ode_to_joy(path: Path) -> None:
    """Beethoven's tune as a Reina score; the trumpet's part is written in B flat, as it lies on the stand."""
    melody, _ = tune(ODE, velocity=84, hold=0.9)
    bass, _ = tune(ODE_BASS, velocity=60, hold=0.97)

    def entries(notes: Iterable[Note]) -> list[dict[str, Any]]:
        return [
            {
                "beat": note.onset,
                "duration": round(note.duration, 4),
                "pitch": note.pitch,
                "velocity": round(note.velocity / 127, 3),
            }
            for note in notes
        ]

    document = {
        "format": "reina-score",
        "version": 1,
        "title": "Ode to Joy",
        "tempos": [{"beat": 0, "bpm": 116}],
        "time_signatures": [{"beat": 0, "numerator": 4, "denominator": 4}],
        "parts": [
            {"name": "Trumpet in B♭", "program": 56, "transposition": -2, "notes": entries(melody)},
            {"name": "Cello", "program": 42, "notes": entries(bass)},
        ],
    }
    write_json(path, document)


GRACE = """
C4:1 | F4:2 A4:.5 F4:.5 | A4:2 G4:1 | F4:2 D4:1 | C4:2 C4:1 | F4:2 A4:.5 F4:.5 | A4:2 G4:1 | C5:3 |
C5:2 A4:1 |
C5:2 A4:.5 F4:.5 | A4:2 G4:1 | F4:2 D4:1 | C4:2 C4:1 | F4:2 A4:.5 F4:.5 | A4:2 G4:1 | F4:3 | F4:2 """


def amazing_grace(path: Path) -> None:
    """The hymn, as Tone.js's converter writes a MIDI file."""
    bpm = 84.0
    melody, _ = tune(
        GRACE.replace("C5:3 | C5:2", "C5:5").replace("F4:3 | F4:2", "F4:5"), velocity=78, hold=0.95, bar=3.0
    )
    document = {
        "header": {
            "keySignatures": [{"ticks": 0, "key": "F", "scale": "major"}],
            "meta": [],
            "name": "Amazing Grace",
            "ppq": TICKS,
            "tempos": [{"bpm": bpm, "ticks": 0}],
            "timeSignatures": [
                {"ticks": 0, "timeSignature": [1, 4], "measures": 0},
                {"ticks": TICKS, "timeSignature": [3, 4], "measures": 1},
            ],
        },
        "tracks": [
            {
                "channel": 0,
                "controlChanges": {},
                "pitchBends": [],
                "instrument": {"family": "brass", "number": 56, "name": "trumpet"},
                "name": "Trumpet",
                "notes": [
                    {
                        "midi": note.pitch,
                        "ticks": round(note.onset * TICKS),
                        "time": note.onset * 60 / bpm,
                        "durationTicks": round(note.duration * TICKS),
                        "duration": round(note.duration * TICKS) / TICKS * 60 / bpm,
                        "velocity": note.velocity / 127,
                    }
                    for note in melody
                ],
            }
        ],
    }
    write_json(path, document)


SAINTS = """
r:1 F4:1 A4:1 Bb4:1 | C5:3.5 r:.5 | r:1 F4:1 A4:1 Bb4:1 | C5:3.5 r:.5 | r:1 F4:1 A4:1 Bb4:1 | C5:2 A4:2 |
F4:2 A4:2 | G4:3.5 r:.5 | A4:1 A4:1' G4:2 | F4:3 F4:1 | A4:2 C5:1 C5:1 | C5:1 Bb4:2.5 r:.5 | r:2 A4:1 Bb4:1 |
C5:2 A4:2 | F4:2 G4:2 | F4:3 r:1 |"""
SAINTS_JAZZ = """
r:1 F4:.5 A4:.5 Bb4:.5 B4:.5 C5:1' | D5:.5 C5:1 A4:.5 C5:1' r:1 |
r:.5 F4:.5 A4:.5 Bb4:.5 C5:.5 D5:.5 C5:1' | F5:1 D5:.5 C5:.5 A4:1' r:1 |
r:1 F4:.5 A4:.5 Bb4:1 B4:1 | C5:1.5 D5:.5 C5:.5 A4:.5 F4:1' | A4:.5 C5:.5 A4:1 G4:.5 F4:.5 D4:1' |
G4:1 r:.5 D5:.5 E5:.5 C5:.5 G4:1' |
A4:.5 C5:.5 A4:1' G4:1.5 E4:.5 | F4:.5 A4:.5 C5:.5 D5:1 C5:.5 A4:1' | A4:.5 C5:.5 Eb5:1.5 D5:.5 C5:1' |
Bb4:.5 D5:.5 F5:1 D5:.5 Bb4:.5 r:1 | r:1 Bb4:.5 A4:.5 G4:.5 A4:.5 Bb4:.5 B4:.5 |
C5:1.5 D5:.5 C5:.5 A4:.5 F4:1' | G4:.5 A4:.5 Bb4:.5 A4:.5 G4:.5 F4:.5 E4:1' | F4:2.5 r:1.5 |"""
SAINTS_LAST = """
r:1 F5:1 A5:1 Bb5:1 | C6:3 A5:1' | r:1 F5:1 A5:1 Bb5:1 | C6:2.5 A5:.5 F5:1' | r:1 F5:1 A5:1 Bb5:1 |
C6:2 A5:2 | F5:2 A5:2 | G5:2.5 E5:.5 C5:1' | A5:1 A5:1' G5:2 | F5:3 F5:1 | A5:2 C6:1 C6:1 |
C6:1 Bb5:2.5 r:.5 | r:2 A5:1 Bb5:1 | C6:2 A5:2 | F5:2 G5:2 | F5:1' F5:1' r:.5 C5:.5 D5:.5 E5:.5 |
F5:3.5 r:.5 |"""
SAINTS_CHORDS = ["F", "F", "F", "F", "F", "F", "F", "C", "C", "F", "F7", "Bb", "Bb", "F", "C", "F"]
SAINTS_VOICINGS = {"F": "A3 C4 F4", "F7": "A3 C4 Eb4", "Bb": "Bb3 D4 F4", "C": "G3 Bb3 E4"}
SAINTS_BASS = {
    "F": ("F2:2 C2:2", "F2:1 A2:1 C3:1 A2:1"),
    "F7": ("F2:2 Eb2:2", "F2:1 G2:1 A2:1 F2:1"),
    "Bb": ("Bb2:2 F2:2", "Bb2:1 A2:1 G2:1 F2:1"),
    "C": ("C2:2 G2:2", "C2:1 D2:1 E2:1 G2:1"),
}
DRUM_KEYS = {"k": 36, "s": 38, "x": 37, "h": 42, "o": 46, "f": 44, "r": 51, "b": 53, "c": 49, "d": 57}
DRUM_KEYS |= {"1": 50, "2": 47, "3": 43}
STREET = {
    # Two bars each, an eighth a place: capitals are accents, lower case lies under them.
    "beat": {
        "s": "SssSssSs ssSsSsss",
        "k": "k..k..k. k.....K.",
        "f": "..f...f. ..f...f.",
    },
    "ride": {
        "r": "R.rrR.rr R.rrR.rr",
        "s": "...s..S. .s....Ss",
        "k": "k...k... k..k..K.",
        "f": "..f...f. ..f...f.",
    },
    "hats": {
        "h": "H.hhH.h. H.hhH...",
        "o": "........ ......o.",
        "x": "..x...x. ..x...x.",
        "k": "k..kk... k..k..k.",
    },
    "fill": {
        "s": "SssSssSs Sss.....",
        "k": "k..k..k. k...k.K.",
        "1": "........ ...1.1..",
        "2": "........ ....2...",
        # The last eighth is left to come from the floor tom to the crash.
        "3": "........ ......3.",
    },
}
SWUNG = 2.0 / 3.0
"""Where in its beat the second of two eighths falls."""


def swing(beat: float) -> float:
    """Return where a place in even eighths falls when it is swung."""
    whole, part = divmod(beat, 1.0)
    return whole + (part * 2.0 * SWUNG if part <= 0.5 else SWUNG + (part - 0.5) * 2.0 * (1.0 - SWUNG))


def swung(notes: Iterable[Note]) -> list[Note]:
    """Return notes with swung eighths, ends and all."""
    return [
        Note(swing(n.onset), swing(n.onset + n.duration) - swing(n.onset), n.pitch, n.velocity) for n in notes
    ]


def street_beat(groove: str, start: float, velocity: int = 88) -> list[Note]:
    """Return two bars of a groove on the drums; every place has its own small weight, as hands have."""
    notes: list[Note] = []
    for piece, places in STREET[groove].items():
        for place, letter in enumerate(places.replace(" ", "")):
            if letter == ".":
                continue
            accent = 20 if letter.isupper() else (-40 if piece == "s" else 0)
            weight = (3 * place + 5 * DRUM_KEYS[piece]) % 7 - 3
            loudness = max(1, min(127, velocity + accent + weight))
            notes.append(Note(start + 0.5 * place, 0.2, DRUM_KEYS[piece], loudness))
    return notes


def when_the_saints(path: Path) -> None:
    """The hymn as a band takes it through the streets: a drummer's call, three choruses, a last word."""
    call, bar = 16.0, 4.0
    choruses = ((SAINTS, "beat", 92, 0), (SAINTS_JAZZ, "ride", 88, 1), (SAINTS_LAST, "beat", 104, 0))
    trumpet: list[Note] = []
    banjo: list[Note] = []
    bass: list[Note] = []
    drums = street_beat("beat", 0.0, 80) + street_beat("fill", 8.0, 92)
    at = call
    for melody, groove, velocity, walking in choruses:
        trumpet += tune(melody, start=at, velocity=velocity)[0]
        drums.append(Note(at, 0.2, DRUM_KEYS["c"], velocity + 10))
        for pair in range(8):
            kind = "fill" if pair in (3, 7) else "hats" if groove == "ride" and pair < 2 else groove
            drums += street_beat(kind, at + 2 * bar * pair, velocity - 4)
        drums.append(Note(at + 8 * bar, 0.2, DRUM_KEYS["d"], velocity + 6))
        for place, chord in enumerate(SAINTS_CHORDS):
            begin = at + bar * place
            bass += tune(SAINTS_BASS[chord][walking], start=begin, velocity=velocity - 14, hold=0.8)[0]
            banjo += [
                Note(begin + beat, 0.35, pitch_of(voice), velocity - 30 + (8 if beat % 2 else 0))
                for beat in range(4)
                for voice in SAINTS_VOICINGS[chord].split()
            ]
        at = at + 16 * bar
    drums += [
        Note(at, 0.2, DRUM_KEYS[piece], loudness) for piece, loudness in (("c", 118), ("d", 116), ("k", 116))
    ]
    bass.append(Note(at, 3.4, pitch_of("F1"), 100))
    banjo += [Note(at, 3.2, pitch_of(voice), 84) for voice in ["F3", "A3", "C4", "F4"]]
    title = conductor("When the Saints Go Marching In", (0.0, metre(4, 4)), (0.0, tempo(196)))
    save(
        path,
        title,
        track("Trumpet", 0, 56, swung(trumpet), 64),
        track("Banjo", 1, 105, swung(banjo), 44),
        track("Sousaphone", 2, 58, swung(bass), 84),
        track("Drums", 9, None, swung(drums), 64),
    )


def write_json(path: Path, document: dict[str, Any]) -> None:
    """Write a document, each of its innermost objects on one line."""
    text = json.dumps(document, indent=1, ensure_ascii=False)
    text = re.sub(r"\{[^{}\[\]]*\}", lambda found: " ".join(found[0].split()), text)
    path.write_text(text + "\n", encoding="utf-8")


SCORES = {
    "prince-of-denmarks-march.mid": prince_of_denmarks_march,
    "trumpet-duet.mid": trumpet_duet,
    "taps.mid": taps,
    "carnival-of-venice.mid": carnival_of_venice,
    "chromatic-scale.mid": chromatic_scale,
    "ode-to-joy.json": ode_to_joy,
    "amazing-grace.json": amazing_grace,
    "when-the-saints.mid": when_the_saints,
}
"""Each score's file and what writes it."""


def main(folder: Path) -> None:
    """Write every score."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, write in SCORES.items():
        write(folder / name)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER)
