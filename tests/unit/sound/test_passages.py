import importlib
import io
import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.sound.material import Row, a_controller, a_part, a_score

from reina.music import Control, Part
from reina.sound.events import SAMPLE_RATE, SoundPlan
from reina.sound.passages import (
    BLOCK,
    LONGEST,
    LONGEST_PEDAL,
    RELEASE,
    SHORTEST,
    Passage,
    cut_into_passages,
    write_passage,
)
from reina.sound.plan import plan_sound

NOTE_ON, CONTROLLER, PROGRAM, BEND = 0x90, 0xB0, 0xC0, 0xE0
Event = tuple[int, list[int]]
"""Tick and the message's bytes."""


def events(plan: SoundPlan, passage: Passage, gain: float = 1.0) -> list[Event]:
    """The messages of a passage with their ticks from the passage's begin, as another program reads them."""
    mido: Any = importlib.import_module("mido")
    file = mido.MidiFile(file=io.BytesIO(write_passage(plan, passage, gain=gain)))
    (track,) = file.tracks
    ticks = list(itertools.accumulate(int(message.time) for message in track))
    assert ticks[-1] == passage.length
    assert mido.tick2second(1, file.ticks_per_beat, track[0].tempo) * SAMPLE_RATE == pytest.approx(1)
    return [
        (tick, message.bytes()) for tick, message in zip(ticks, track, strict=True) if not message.is_meta
    ]


def of_kind(found: Sequence[Event], kind: int) -> list[Event]:
    """The events of one kind, on whatever channel."""
    return [(tick, message) for tick, message in found if message[0] & 0xF0 == kind]


def plan_of(rows: Sequence[Row], parts: Sequence[Part] = (), controls: Sequence[Control] = ()) -> SoundPlan:
    return plan_sound(a_score(rows, parts, controls))


def test_events_fall_into_the_nearest_block() -> None:
    plan = plan_of([(0, at, 0.3, 60, 0.8) for at in np.arange(0.0, 15.0, 0.34567)])
    (passage,) = cut_into_passages(plan)
    heard = [tick for tick, _ in of_kind(events(plan, passage), NOTE_ON)]
    # The synthesizer acts at the first block that begins at or after a tick.
    acted = -(-np.array(heard) // BLOCK) * BLOCK + passage.start
    assert np.abs(acted - plan.notes["on"]).max() <= BLOCK // 2


ONSETS = st.lists(st.floats(0, 400), min_size=1, max_size=80)


@given(ONSETS, st.lists(st.integers(0, 40), min_size=1, max_size=3))
def test_every_note_is_in_exactly_one_passage(onsets: Sequence[float], parts: Sequence[int]) -> None:
    rows: list[Row] = [(index % 20, at, 0.5, 60, 0.8) for index, at in enumerate(onsets)]
    plan = plan_of(rows, [a_part(index, "Part", index) for index in range(20)])
    passages = cut_into_passages(plan)
    assert sorted(index for passage in passages for index in passage.notes.tolist()) == list(
        range(len(plan.notes))
    )
    assert [passage.start for passage in passages] == sorted(passage.start for passage in passages)
    for passage in passages:
        notes = plan.notes[passage.notes]
        assert passage.start % BLOCK == 0
        assert passage.length % BLOCK == 0
        assert passage.start <= notes["on"].min()
        assert notes["on"].max() < passage.end
        assert passage.start + passage.length >= notes["off"].max() + RELEASE
        assert notes["on"].max() - passage.start < LONGEST
        assert set(notes["port"].tolist()) == {passage.port}


def test_a_cut_falls_where_least_sounds() -> None:
    rows: list[Row] = [
        (0, float(second), 5.0, 40 + second % 40, 0.8) for second in range(60) if second not in range(23, 29)
    ]
    plan = plan_of(rows)
    second = cut_into_passages(plan)[1]
    assert second.start == 29 * SAMPLE_RATE // BLOCK * BLOCK
    assert SHORTEST <= second.start <= LONGEST


def test_a_long_rest_is_not_rendered() -> None:
    plan = plan_of([(0, 0.0, 1.0, 60, 0.8), (0, 1000.0, 1.0, 60, 0.8)])
    assert [passage.length for passage in cut_into_passages(plan)] == [SAMPLE_RATE + RELEASE] * 2


def test_a_later_passage_begins_as_the_controls_before_left_it() -> None:
    controls = [
        a_controller(7, 90, 1.0),
        a_controller(7, 40, 2.0),
        a_controller(11, 60, 3.0),
        a_controller(121, 0, 4.0),
        *(a_controller(number, value, 5.0) for number, value in ((101, 0), (100, 0), (6, 12))),
        Control("pitch_bend", 6.0, 6.0, 0, 0, 100),
        a_controller(10, 20, 101.0),
    ]
    plan = plan_of([(0, 0.0, 1.0, 60, 0.8), (0, 100.0, 5.0, 60, 0.8)], [a_part(program=56)], controls)
    found = events(plan, cut_into_passages(plan)[1])
    begin = [event for event in found if event[0] == 0]
    assert begin[-1][1][0] == NOTE_ON
    numbers = [(message[1], message[2]) for _, message in of_kind(begin, CONTROLLER)]
    assert numbers[:3] == [(101, 0), (100, 0), (6, 12)]
    assert numbers[3:] == [(7, 40)]
    assert of_kind(begin, PROGRAM) == [(0, [PROGRAM, 56])]
    assert of_kind(begin, BEND) == [(0, [BEND, (8192 + 100) & 0x7F, (8192 + 100) >> 7])]
    assert found[len(begin)][1] == [CONTROLLER, 10, 20]


def test_the_pedal_prolongs_a_passage_within_bounds() -> None:
    notes: list[Row] = [(0, 0.0, 1.0, 60, 0.8), (0, 8.0, 1.0, 62, 0.8)]
    lifted = [a_controller(64, 127, 7.0), a_controller(64, 0, 12.0)]
    assert cut_into_passages(plan_of(notes, [a_part()], lifted))[0].length == 12 * SAMPLE_RATE + RELEASE
    before_the_end = [a_controller(64, 127, 7.0), a_controller(64, 0, 8.5)]
    assert (
        cut_into_passages(plan_of(notes, [a_part()], before_the_end))[0].length == 9 * SAMPLE_RATE + RELEASE
    )
    for_ever = plan_of(notes, [a_part()], [a_controller(64, 127, 0.0)])
    assert cut_into_passages(for_ever)[0].length == 9 * SAMPLE_RATE + LONGEST_PEDAL + RELEASE


def test_gain_is_set_by_every_volume() -> None:
    plan = plan_of(
        [(0, 0.0, 2.0, 60, 0.8)], [a_part()], [a_controller(7, 64, 1.0), a_controller(39, 32, 1.0)]
    )
    (passage,) = cut_into_passages(plan)
    volumes: dict[int, list[int]] = {}
    coarse = [0] * 16
    for _, (status, number, value) in of_kind(events(plan, passage, gain=0.25), CONTROLLER):
        if number == 7:
            coarse[status & 0x0F] = value
        elif number == 39:
            volumes.setdefault(status & 0x0F, []).append(coarse[status & 0x0F] * 128 + value)
    # The synthesizer squares the volume: a quarter of the amplitude is half the volume.
    assert volumes[5] == [100 * 128 // 2]
    assert volumes[0] == [100 * 128 // 2, 64 * 128 // 2, (64 * 128 + 32) // 2]


def test_a_closed_hi_hat_of_the_next_passage_chokes_the_open_one() -> None:
    kit = a_part(0, "Kit", None, is_drums=True)
    rows: list[Row] = [(0, float(at), 0.1, 46 if at == 19 else 36, 0.8) for at in range(20)]
    rows += [(0, 20.5 + at, 0.1, 42, 0.8) for at in range(45)]
    plan = plan_of(rows, [kit])
    passage = cut_into_passages(plan)[0]
    late = [
        (tick, key) for tick, (_, key, velocity) in of_kind(events(plan, passage), NOTE_ON) if velocity == 1
    ]
    assert late
    assert {key for _, key in late} == {42}
    assert late[0][0] + passage.start >= passage.end - BLOCK
