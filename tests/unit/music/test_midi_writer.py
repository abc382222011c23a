"""What is written as MIDI is read again as the same score."""

from __future__ import annotations

import io
from pathlib import Path

import mido
import numpy as np
import pytest
from tests.unit.music.mutations import midi_seeds

from reina.music import Control, MetreMap, Notes, Part, Score, TempoMap, TimeSignature, read_score
from reina.music.midi.writer import write_midi

SCORES = sorted((Path(__file__).parents[3] / "examples/scores").iterdir())
HALF_A_TICK = 0.5 / 960 + 1e-9


def again(score: Score) -> Score:
    return read_score(write_midi(score), filename="written.mid")


def rows(score: Score) -> list[tuple[int, int, int, int, int]]:
    notes = score.notes
    velocity = np.maximum(np.round(notes.velocity * 127), 1)
    columns = (notes.part, notes.channel, notes.sounding_pitch, velocity, notes.program)
    return sorted(zip(*(column.astype(int).tolist() for column in columns), strict=True))


def check_same(score: Score, written: Score) -> None:
    assert rows(written) == rows(score)
    for own, other in ((score.notes.onset_beats, written.notes.onset_beats),):
        assert np.abs(np.sort(own) - np.sort(other)).max() <= HALF_A_TICK
    assert [part.name for part in written.parts] == [part.name for part in score.parts]
    assert [part.is_drums for part in written.parts] == [part.is_drums for part in score.parts]


@pytest.mark.parametrize("path", SCORES, ids=lambda path: path.name)
def test_examples_come_back_whole(path: Path) -> None:
    score = read_score(path.read_bytes(), filename=path.name)
    written = again(score)
    check_same(score, written)
    assert written.warnings == ()
    assert written.title == score.title
    assert np.abs(written.notes.duration_beats - score.notes.duration_beats).max() <= 2 * HALF_A_TICK
    lines = score.metre_map.bar_lines(score.duration_beats)
    assert written.metre_map.bar_lines(score.duration_beats).tolist() == lines.tolist()
    assert np.abs(written.notes.onset_s - score.notes.onset_s).max() < 5e-4
    assert len(written.controls) == len(score.controls)


def test_seeds_of_every_kind_come_back() -> None:
    compared = 0
    for data in midi_seeds():
        score = read_score(data)
        written = again(score)
        assert len(written.notes) == len(score.notes)
        assert sorted(written.notes.sounding_pitch.tolist()) == sorted(score.notes.sounding_pitch.tolist())
        compared += len(score.notes)
    assert compared > 40


def a_score(
    channel: int, *, drums: bool, metre: MetreMap | None = None, controls: tuple[Control, ...] = ()
) -> Score:
    # The second part keeps the first port in use: a file's ports are counted as they are used.
    notes = Notes.from_columns(
        part=[0, 0, 1],
        channel=[channel, channel, 7],
        onset_s=[0.0, 0.5, 1.0],
        duration_s=[0.5, 0.5, 0.5],
        onset_beats=[0.0, 1.0, 2.0],
        duration_beats=[1.0, 1.0, 1.0],
        sounding_pitch=[40, 41, 60],
        velocity=[1.0, 1e-3, 0.5],
        program=[30, 31, 40],
    )
    parts = (
        Part(0, "Größe ♪", 30, is_drums=drums, channel=channel),
        Part(1, "Violin", 40, is_drums=False, channel=7),
    )
    return Score("Title", parts, notes, TempoMap(), metre or MetreMap(), controls, (), 1.5)


@pytest.mark.parametrize("channel", [0, 8, 9, 10, 15, 16, 25, 31])
@pytest.mark.parametrize("drums", [True, False])
def test_channels_ports_drums_and_programs(channel: int, drums: bool) -> None:
    score = a_score(channel, drums=drums)
    check_same(score, again(score))


@pytest.mark.parametrize("pickup", [1.0, 0.5, 0.25, 1.5])
def test_a_pickup_is_a_first_bar_of_its_own_metre(pickup: float) -> None:
    metre = MetreMap([TimeSignature(0.0, 3, 4)], pickup_beats=pickup)
    written = again(a_score(0, drums=False, metre=metre)).metre_map
    assert written.bar_lines(9.0).tolist() == metre.bar_lines(9.0).tolist()
    assert written.position(0.0).bar == 0


def test_controllers_stand_before_the_notes_of_their_time() -> None:
    kinds = (
        Control("controller", 0.5, 1.0, 3, 7, 90),
        Control("pitch_bend", 0.5, 1.0, 3, 0, -4096),
        Control("channel_pressure", 0.5, 1.0, 3, 0, 50),
        Control("key_pressure", 0.5, 1.0, 3, 41, 60),
        Control("program", 0.5, 1.0, 3, 0, 31),
    )
    score = a_score(3, drums=False, controls=kinds)
    written = again(score)
    assert set(kinds) <= set(written.controls)
    assert [control.value for control in written.controls if control.kind == "program"] == [30, 31, 40]
    messages = [message.type for message in mido.MidiFile(file=_file(score)).tracks[1]]
    last = len(messages) - 1 - messages[::-1].index("note_on")
    assert messages.index("pitchwheel") < last
    assert messages.index("note_off") < messages.index("pitchwheel")


def _file(score: Score) -> io.BytesIO:
    return io.BytesIO(write_midi(score))
