from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.music.midi_bytes import meta, midi, off, on
from tests.unit.sound.material import Row, a_controller, a_part, a_score

from reina.errors import InputError
from reina.music import Control, read_score
from reina.sound.events import DRUM_CHANNEL, SAMPLE_RATE, SoundPlan
from reina.sound.plan import LONGEST_S, SHORTEST_NOTE, PlayedParts, plan_sound
from reina.sound.programs import default_program


def programs(plan: SoundPlan) -> dict[tuple[int, int], int]:
    """The program at time 0 on each port and channel."""
    rows = plan.controls[(plan.controls["status"] & 0xF0 == 0xC0) & (plan.controls["tick"] == 0)]
    return {(int(row["port"]), int(row["status"]) & 0x0F): int(row["data1"]) for row in rows}


def test_ticks_are_samples() -> None:
    plan = plan_sound(a_score([(0, 1.23456789, 0.5, 60, 1.0)]))
    assert plan.notes["on"].tolist() == [round(1.23456789 * SAMPLE_RATE)]
    assert plan.notes["off"].tolist() == [round(1.73456789 * SAMPLE_RATE)]
    assert plan.notes["velocity"].tolist() == [127]


def test_a_tap_still_speaks() -> None:
    plan = plan_sound(a_score([(0, 1.0, 1e-6, 60, 0.0)]))
    assert plan.notes["off"][0] - plan.notes["on"][0] == SHORTEST_NOTE
    assert plan.notes["velocity"][0] == 1


def test_parts_that_collide_on_a_channel_sound_as_themselves() -> None:
    parts = [a_part(0, "Trumpet", 56), a_part(1, "Flute", 73), a_part(2, "Kit", None, is_drums=True)]
    rows: list[Row] = [(index, 0.0, 1.0, 60, 0.8) for index in range(3)]
    plan = plan_sound(a_score(rows, parts))
    seats = {int(note["channel"]) for note in plan.notes}
    assert len(seats) == 3
    assert DRUM_CHANNEL in seats
    assert sorted(programs(plan).values()) == [0, 56, 73]


def test_forty_parts_each_have_a_channel_and_no_tone_is_on_the_drums_channel() -> None:
    parts = [a_part(index, f"Part {index}", index) for index in range(40)]
    plan = plan_sound(a_score([(index, 0.0, 1.0, 60, 0.8) for index in range(40)], parts))
    assert sorted(programs(plan).values()) == list(range(40))
    assert set(plan.notes["port"].tolist()) == {0, 1, 2}
    assert DRUM_CHANNEL not in plan.notes["channel"]


def test_very_many_parts_of_one_program_share_a_channel() -> None:
    parts = [a_part(index, f"Part {index}", index % 3) for index in range(300)]
    plan = plan_sound(a_score([(index, 0.0, 1.0, index % 128, 0.8) for index in range(300)], parts))
    assert len(programs(plan)) == 3


def test_drums_of_several_tracks_share_one_kit() -> None:
    parts = [a_part(0, "Hi-hat", None, is_drums=True), a_part(1, "Bass drum", None, is_drums=True)]
    plan = plan_sound(a_score([(0, 0.0, 1.0, 42, 0.8), (1, 0.0, 1.0, 36, 0.8)], parts))
    assert programs(plan) == {(0, DRUM_CHANNEL): 0}


def test_drums_of_two_ports_have_each_their_own_volume() -> None:
    events = [
        *(port(0), volume(100), on(0, 36, channel=9), off(480, 36, 9)),
        *(port(1), volume(0), on(0, 38, channel=9), off(480, 38, 9)),
    ]
    plan = plan_sound(read_score(midi(events)))
    volumes = plan.controls[plan.controls["data1"] == 7]
    assert volumes[["port", "data2"]].tolist() == [(0, 100), (1, 0)]
    assert plan.notes[["port", "channel", "key"]].tolist() == [(0, DRUM_CHANNEL, 36), (1, DRUM_CHANNEL, 38)]


def test_drums_on_very_many_channels_share_one_kit() -> None:
    banks = [(0, bytes([0xB0 | channel, 0, 120])) for channel in range(16)]
    hits = [event for channel in range(16) for event in (on(0, 36, channel=channel), off(9, 36, channel))]
    assert list(programs(plan_sound(read_score(midi([*banks, *hits]))))) == [(0, DRUM_CHANNEL)]


def port(number: int) -> tuple[int, bytes]:
    return meta(0, 0x21, bytes([number]))


def volume(value: int) -> tuple[int, bytes]:
    return 0, bytes([0xB9, 7, value])


@pytest.mark.parametrize(
    ("name", "chosen", "program"),
    [
        ("Trompete in B", False, 56),
        ("Track 3", True, 56),
        ("Track 3", False, 0),
        ("Violin I", False, 40),
        ("Bass Trombone", False, 57),
    ],
)
def test_a_part_without_a_program_sounds_by_choice_or_name(name: str, chosen: bool, program: int) -> None:
    part = a_part(0, name)
    assert default_program(part, is_trumpet=chosen) == program
    plan = plan_sound(a_score([(0, 0.0, 1.0, 60, 0.8)], [part]), [PlayedParts((0,))] if chosen else [])
    assert list(programs(plan).values()) == [program]


def test_the_file_s_program_wins_over_choice_and_name() -> None:
    assert default_program(a_part(0, "Trumpet", 60), is_trumpet=True) == 60


def test_program_changes_within_a_piece_are_kept() -> None:
    rows: list[Row] = [(0, float(at), 0.5, 60, 0.8) for at in range(5)]
    plan = plan_sound(a_score(rows, [a_part()], programs=[None, None, 59, None, 59]))
    changes = plan.controls[plan.controls["status"] == 0xC0]
    assert [(int(row["tick"]), int(row["data1"])) for row in changes] == [(0, 56), (2 * SAMPLE_RATE, 59)]


def test_a_part_on_two_channels_sounds_by_the_controls_of_each() -> None:
    rows: list[Row] = [(0, 0.0, 1.0, 60, 0.8), (0, 1.0, 1.0, 60, 0.8)]
    controls = [a_controller(7, 100), a_controller(7, 30, channel=17)]
    plan = plan_sound(a_score(rows, [a_part()], controls, programs=[56, 59], channels=[0, 17]))
    assert plan.notes["channel"].tolist() == [0, 1]
    assert programs(plan) == {(0, 0): 56, (0, 1): 59}
    volumes = plan.controls[plan.controls["status"] & 0xF0 == 0xB0]
    assert [(int(row["status"]), int(row["data2"])) for row in volumes] == [(0xB0, 100), (0xB1, 30)]


def test_banks_that_mark_drums_and_tones_name_no_sound() -> None:
    controls = [a_controller(0, bank) for bank in (8, 120, 121, 126, 127)]
    plan = plan_sound(a_score([(0, 0.0, 1.0, 60, 0.8)], [a_part()], controls))
    banks = plan.controls[(plan.controls["status"] & 0xF0 == 0xB0) & (plan.controls["data1"] == 0)]
    assert banks["data2"].tolist() == [8]


@pytest.mark.parametrize("at_s", [21.1, 89_479.0, 1e9])
def test_what_comes_long_after_the_last_note_is_left_out(at_s: float) -> None:
    score = a_score([(0, 0.0, 1.0, 60, 0.8)], [a_part()], [a_controller(7, 1, at_s=at_s)])
    assert np.all(plan_sound(score).controls["status"] & 0xF0 == 0xC0)


def test_controls_go_with_every_part_of_their_channel() -> None:
    parts = [a_part(0, "Right hand", 0), a_part(1, "Left hand", 0)]
    controls = [
        a_controller(64, 127, 1.0),
        a_controller(123, 0, 1.0),
        a_controller(20, 5, 1.0),
        Control("pitch_bend", 1.5, 1.5, 0, 0, -8192),
    ]
    plan = plan_sound(a_score([(0, 0.0, 2.0, 60, 0.8), (1, 0.0, 2.0, 40, 0.8)], parts, controls))
    heard = [
        (int(row["status"]), int(row["data1"]), int(row["data2"]))
        for row in plan.controls
        if row["status"] & 0xF0 != 0xC0
    ]
    assert sorted(heard) == [(0xB0, 64, 127), (0xB1, 64, 127), (0xE0, 0, 0), (0xE1, 0, 0)]


def test_the_trumpet_part_alone_is_transposed() -> None:
    rows: list[Row] = [(0, 0.0, 1.0, 60, 0.8), (1, 0.0, 1.0, 60, 0.8)]
    score = a_score(rows, [a_part(0, "Trumpet"), a_part(1, "Piano")])
    plan = plan_sound(score, [PlayedParts((0,), -2)])
    assert dict(zip(plan.notes["channel"].tolist(), plan.notes["key"].tolist(), strict=True)) == {
        0: 58,
        1: 60,
    }


def test_parts_joined_to_the_trumpet_part_are_transposed_with_it_and_are_trumpets_too() -> None:
    rows: list[Row] = [(0, 0.0, 1.0, 60, 0.8), (1, 0.0, 1.0, 62, 0.8), (2, 0.0, 1.0, 64, 0.8)]
    score = a_score(rows, [a_part(number, f"Track {number}") for number in range(3)])
    plan = plan_sound(score, [PlayedParts((0, 2), -2)])
    assert plan.notes["key"].tolist() == [58, 62, 62]
    assert sorted(programs(plan).values()) == [0, 56, 56]


def test_more_than_an_hour_is_refused() -> None:
    with pytest.raises(InputError, match="at most 60"):
        plan_sound(a_score([(0, LONGEST_S, 1.0, 60, 0.8)]))


def test_digest_tells_what_sounds_different_and_nothing_else() -> None:
    row: Row = (0, 0.5, 1.0, 60, 0.8)
    plan = plan_sound(a_score([row]))
    assert plan.digest("font") == plan_sound(a_score([row], [a_part(0, "Trumpet solo")])).digest("font")
    assert plan.digest("font") != plan.digest("another font")
    assert plan.digest("font") != plan_sound(a_score([(0, 0.5, 1.0, 61, 0.8)])).digest("font")
    assert plan.digest("font") != plan_sound(a_score([row], [a_part(0, "Flute")])).digest("font")


ROWS = st.lists(
    st.tuples(
        st.integers(0, 1),
        st.integers(0, 40).map(lambda step: step * 0.1),
        st.sampled_from((0.05, 0.1, 0.3, 2.0)),
        st.integers(60, 62),
        st.sampled_from((0.2, 0.9)),
    ),
    min_size=1,
    max_size=40,
)


@given(ROWS)
def test_a_key_is_never_struck_while_it_sounds_and_nothing_falls_silent(rows: Sequence[Row]) -> None:
    plan = plan_sound(a_score(rows, [a_part(0), a_part(1, "Flute")]))
    assert np.all(np.diff(plan.notes["on"].astype(np.int64)) >= 0)
    parts = sorted({row[0] for row in rows})
    for part in parts:
        for pitch in range(60, 63):
            wanted = [(row[1], row[1] + row[2]) for row in rows if row[0] == part and row[3] == pitch]
            if not wanted:
                continue
            got = plan.notes[(plan.notes["key"] == pitch) & (plan.notes["channel"] == parts.index(part))]
            on, off = got["on"].astype(np.int64), got["off"].astype(np.int64)
            assert np.all(off > on)
            assert np.all(on[1:] >= off[:-1])
            assert set(on.tolist()) == {round(begin * SAMPLE_RATE) for begin, _ in wanted}
            assert off[-1] == max(
                max(round(end * SAMPLE_RATE), round(begin * SAMPLE_RATE) + SHORTEST_NOTE)
                for begin, end in wanted
            )
            # Wherever a note sounds in the score, its key is down in the plan.
            for begin, end in wanted:
                middle = (begin + end) / 2 * SAMPLE_RATE
                assert np.any((on <= middle) & (middle <= off))
