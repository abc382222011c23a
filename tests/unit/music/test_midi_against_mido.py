"""Where mido reads a file rightly, the result is the same notes."""

import io
from collections import defaultdict

import mido
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from reina.music import read_score


def notes_by_mido(data: bytes) -> list[tuple[int, int, float, float, int]]:
    """Onset and end of every note by mido's own reading of events and tempos."""
    file = mido.MidiFile(file=io.BytesIO(data))
    tempos: list[tuple[int, int, int, int]] = []
    notes: list[tuple[int, int, int, int, int]] = []
    for number, track in enumerate(file.tracks):
        tick = 0
        sounding: defaultdict[tuple[int, int], list[tuple[int, int]]] = defaultdict(list)
        for order, message in enumerate(track):
            tick += int(message.time)
            if message.type == "set_tempo":
                assert isinstance(message, mido.MetaMessage)
                tempos.append((tick, number, order, message.tempo))
            elif isinstance(message, mido.Message) and message.type in {"note_on", "note_off"}:
                key = (message.channel, message.note)
                if message.type == "note_on" and message.velocity:
                    sounding[key].append((tick, message.velocity))
                elif sounding[key]:
                    onset, velocity = sounding[key].pop(0)
                    notes.append((message.channel, message.note, onset, tick, velocity))
    tempos.sort()

    def seconds(tick: int) -> float:
        at, passed, length = 0, 0.0, 500_000
        for change, _, _, new in tempos:
            if change >= tick:
                break
            passed += mido.tick2second(change - at, file.ticks_per_beat, length)
            at, length = change, new
        return passed + mido.tick2second(tick - at, file.ticks_per_beat, length)

    return sorted((c, p, seconds(on), seconds(off), v) for c, p, on, off, v in notes)


channel_events = st.tuples(
    st.integers(1, 400),
    st.sampled_from(["note_on", "note_on", "note_off"]),
    st.integers(0, 3),
    st.integers(58, 63),
    st.integers(0, 127),
)
tempo_events = st.tuples(st.integers(0, 400), st.just("set_tempo"), st.integers(100_000, 2_000_000))
tracks = st.lists(st.lists(st.one_of(channel_events, tempo_events), max_size=40), min_size=1, max_size=3)


@settings(max_examples=150)
@given(tracks, st.sampled_from([24, 96, 480, 960]))
def test_the_same_notes_as_mido(
    contents: list[list[tuple[int, str, int, int, int] | tuple[int, str, int]]], division: int
):
    file = mido.MidiFile(type=1, ticks_per_beat=division)
    for content in contents:
        track = file.add_track()
        held: set[tuple[int, int]] = set()
        for event in content:
            if len(event) == 3:
                track.append(mido.MetaMessage(event[1], time=event[0], tempo=event[2]))
                continue
            delta, kind, channel, note, velocity = event
            track.append(mido.Message(kind, time=delta, channel=channel, note=note, velocity=velocity))
            if kind == "note_on" and velocity:
                held.add((channel, note))
        for _ in range(40):
            track.extend(mido.Message("note_off", time=1, channel=c, note=n) for c, n in sorted(held))
    stream = io.BytesIO()
    file.save(file=stream)
    expected = notes_by_mido(stream.getvalue())
    if not expected:
        return
    notes = read_score(stream.getvalue()).notes
    ours = sorted(
        (note.channel, note.sounding_pitch, note.onset_s, note.end_s, round(note.velocity * 127))
        for note in notes
    )
    assert len(ours) == len(expected)
    np.testing.assert_allclose(np.array(ours), np.array(expected), rtol=0, atol=1e-9)


def test_the_same_length_as_mido():
    file = mido.MidiFile(type=1, ticks_per_beat=96)
    track = file.add_track()
    for pitch in range(40, 90):
        track.append(mido.MetaMessage("set_tempo", tempo=400_000 + 1000 * pitch, time=0))
        track.append(mido.Message("note_on", note=pitch, velocity=70, time=3))
        track.append(mido.Message("note_off", note=pitch, time=91))
    stream = io.BytesIO()
    file.save(file=stream)
    loaded = mido.MidiFile(file=io.BytesIO(stream.getvalue()))
    assert abs(read_score(stream.getvalue()).duration_s - loaded.length) < 1e-9
