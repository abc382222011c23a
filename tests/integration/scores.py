"""Scores and songs made for the tests."""

from __future__ import annotations

import io
import json
import math
import struct
import wave

import mido

TICKS = 480


def scale(notes: int = 16, *, beats: float = 0.5, bpm: float = 120.0) -> bytes:
    """A trumpet walks up and down between B♭3 and B♭5, each note as long."""
    midi = mido.MidiFile(ticks_per_beat=TICKS)
    track = mido.MidiTrack()
    midi.tracks.append(track)
    track.append(mido.MetaMessage("track_name", name="Trumpet"))
    track.append(mido.MetaMessage("set_tempo", tempo=mido.bpm2tempo(bpm)))
    track.append(mido.Message("program_change", program=56))
    length = round(beats * TICKS)
    for number in range(notes):
        pitch = 58 + abs((number + 24) % 48 - 24)
        track.append(mido.Message("note_on", note=pitch, velocity=90, time=0))
        track.append(mido.Message("note_off", note=pitch, time=length))
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


def duet() -> bytes:
    """A flute above a trumpet."""
    midi = mido.MidiFile(ticks_per_beat=TICKS)
    for name, program, pitch in (("Flute", 73, 84), ("Trumpet", 56, 65)):
        track = mido.MidiTrack()
        midi.tracks.append(track)
        track.append(mido.MetaMessage("track_name", name=name))
        track.append(mido.Message("program_change", program=program, channel=len(midi.tracks) - 1))
        for step in (0, 2, 4, 5):
            channel = len(midi.tracks) - 1
            track.append(mido.Message("note_on", note=pitch + step, velocity=80, channel=channel))
            track.append(mido.Message("note_off", note=pitch + step, time=TICKS, channel=channel))
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


def trumpets(count: int = 4, *, notes: int = 30) -> bytes:
    """So many trumpets, one entering after the other, each a third lower, with a long rest in the middle."""
    midi = mido.MidiFile(ticks_per_beat=TICKS)
    for channel in range(count):
        track = mido.MidiTrack()
        midi.tracks.append(track)
        track.append(mido.MetaMessage("track_name", name=f"Trumpet {channel + 1}"))
        track.append(mido.Message("program_change", program=56, channel=channel))
        for number in range(notes):
            note = {"note": 76 - 4 * channel + 5 * number % 7, "channel": channel}
            rest = {0: 2 * TICKS + channel * TICKS, notes // 2: 16 * TICKS}.get(number, 0)
            track.append(mido.Message("note_on", velocity=90, time=rest, **note))
            track.append(mido.Message("note_off", time=TICKS // 2, **note))
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


def relay() -> bytes:
    """A melody that goes from a trumpet to a muted one; a flute and drums beside it, two notes each."""
    midi = mido.MidiFile(ticks_per_beat=TICKS)
    for channel, name, program, start, length, pitches in (
        (0, "Trumpet", 56, 0, 1, (65, 67)),
        (1, "Trumpet (muted)", 59, 2, 1, (69, 70)),
        (2, "Flute", 73, 0, 2, (86, 88)),
        (9, "Drums", 0, 0, 2, (36, 38)),
    ):
        track = mido.MidiTrack()
        midi.tracks.append(track)
        track.append(mido.MetaMessage("track_name", name=name))
        track.append(mido.Message("program_change", program=program, channel=channel))
        for number, pitch in enumerate(pitches):
            rest = 0 if number else start * TICKS
            track.append(mido.Message("note_on", note=pitch, velocity=90, channel=channel, time=rest))
            track.append(mido.Message("note_off", note=pitch, channel=channel, time=length * TICKS))
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


def collection() -> bytes:
    """A file of format 2: three pieces, of four, eight and two trumpet notes; each track is a piece."""
    midi = mido.MidiFile(type=2, ticks_per_beat=TICKS)
    for name, pitches in (("Call", (58, 62, 65, 70)), ("Walk", range(60, 68)), ("End", (63, 58))):
        track = mido.MidiTrack()
        midi.tracks.append(track)
        track.append(mido.MetaMessage("track_name", name=name))
        track.append(mido.Message("program_change", program=56))
        for pitch in pitches:
            track.append(mido.Message("note_on", note=pitch, velocity=90))
            track.append(mido.Message("note_off", note=pitch, time=TICKS))
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


def two_duets() -> bytes:
    """A file of format 2: two pieces, each of a trumpet and a flute that goes on where it ends."""
    midi = mido.MidiFile(type=2, ticks_per_beat=TICKS)
    for base in (58, 65):
        track = mido.MidiTrack()
        midi.tracks.append(track)
        for channel, program in enumerate((56, 73)):
            track.append(mido.Message("program_change", program=program, channel=channel))
        for number in range(4):
            note = {"note": base + number, "channel": number // 2}
            track.append(mido.Message("note_on", velocity=90, **note))
            track.append(mido.Message("note_off", time=TICKS, **note))
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


def chords() -> bytes:
    """A trumpet part that no trumpet can play as it stands: a third, then a note that is still held."""
    midi = mido.MidiFile(ticks_per_beat=TICKS)
    track = mido.MidiTrack()
    midi.tracks.append(track)
    track.append(mido.MetaMessage("track_name", name="Trumpet"))
    track.append(mido.Message("program_change", program=56))
    for kind, pitch, time in (
        ("note_on", 60, 0),
        ("note_on", 64, 0),
        ("note_off", 60, TICKS),
        ("note_off", 64, 0),
        ("note_on", 62, 0),
        ("note_on", 65, TICKS),
        ("note_off", 62, TICKS // 2),
        ("note_off", 65, TICKS),
    ):
        track.append(mido.Message(kind, note=pitch, time=time))
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


def sung() -> bytes:
    """Chords for a voice, low, and no trumpet; a guitar beside it."""
    midi = mido.MidiFile(ticks_per_beat=TICKS)
    for channel, name, chords in ((0, "Vocals", [(52, 55, 60)] * 3 + [(48,), (47,)]), (1, "Guitar", [(52,)])):
        track = mido.MidiTrack()
        midi.tracks.append(track)
        track.append(mido.MetaMessage("track_name", name=name))
        track.append(mido.Message("program_change", program=(53, 24)[channel], channel=channel))
        for chord in chords:
            track.extend(mido.Message("note_on", note=pitch, velocity=90, channel=channel) for pitch in chord)
            for place, pitch in enumerate(chord):
                length = 0 if place else TICKS
                track.append(mido.Message("note_off", note=pitch, channel=channel, time=length))
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


def song(seconds: float = 1.0, rate: int = 8000) -> bytes:
    """A sine as WAV."""
    file = io.BytesIO()
    with wave.open(file, "wb") as audio:
        audio.setnchannels(1)
        audio.setsampwidth(2)
        audio.setframerate(rate)
        samples = (round(8000 * math.sin(2 * math.pi * 440 * n / rate)) for n in range(round(seconds * rate)))
        audio.writeframes(b"".join(struct.pack("<h", sample) for sample in samples))
    return file.getvalue()


def show(intensity: float = 1.0) -> bytes:
    """A show that holds one light."""
    keyframes = [{"key": "k1", "time": 0.0, "value": intensity, "interpolation": "step"}]
    tracks = [{"parameter": "lights/key/intensity", "keyframes": keyframes}]
    return json.dumps({"version": 1, "title": "One light", "time": "seconds", "tracks": tracks}).encode()


def clap(*, at_s: float = 1.0, seconds: float = 2.5) -> bytes:
    """Silence, then a trumpet's short note with a clap of hands."""
    midi = mido.MidiFile(ticks_per_beat=TICKS)
    ticks_s = 2 * TICKS
    for channel, name, program, pitch in ((0, "Trumpet", 56, 70), (9, "Drums", 0, 39)):
        track = mido.MidiTrack()
        midi.tracks.append(track)
        track.append(mido.MetaMessage("track_name", name=name))
        track.append(mido.Message("program_change", program=program, channel=channel))
        track.append(
            mido.Message("note_on", note=pitch, velocity=127, channel=channel, time=round(at_s * ticks_s))
        )
        track.append(mido.Message("note_off", note=pitch, channel=channel, time=round(0.2 * ticks_s)))
        track.append(mido.MetaMessage("end_of_track", time=round((seconds - at_s - 0.2) * ticks_s)))
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()
