from collections import Counter, defaultdict

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from reina.music.midi.pairing import Pairs, pair_notes


def pairs_of(*messages: tuple[int, bool]) -> Pairs:
    """The pairs of messages of one key, each a tick and whether it is a note-on."""
    ticks, is_on = zip(*messages, strict=True)
    return pair_notes(np.zeros(len(ticks), dtype=np.int64), np.array(is_on), np.array(ticks, dtype=np.int64))


@given(st.lists(st.tuples(st.integers(0, 3), st.booleans()), max_size=60))
def test_pairing_is_first_in_first_out_within_each_key_that_is_released(messages: list[tuple[int, bool]]):
    held = Counter[int]()
    for key, is_on in messages:
        held[key] = max(0, held[key] + (1 if is_on else -1))
    messages = [*messages, *((key, False) for key in held.elements())]
    waiting: defaultdict[int, list[int]] = defaultdict(list)
    ends: dict[int, int] = {}
    overlapping: dict[int, bool] = {}
    stray: list[int] = []
    for index, (key, is_on) in enumerate(messages):
        if is_on:
            overlapping[index] = bool(waiting[key])
            waiting[key].append(index)
            ends[index] = -1
        elif waiting[key]:
            ends[waiting[key].pop(0)] = index
        else:
            stray.append(index)
    keys = np.array([key for key, _ in messages], dtype=np.int64)
    is_on = np.array([is_on for _, is_on in messages], dtype=np.bool_)
    pairs = pair_notes(keys, is_on, np.arange(len(messages)))
    assert pairs.on.tolist() == sorted(ends)
    assert pairs.off.tolist() == [ends[on] for on in sorted(ends)]
    assert pairs.overlapping.tolist() == [overlapping[on] for on in sorted(ends)]
    assert pairs.stray.tolist() == stray


def test_a_missing_note_off_shifts_no_later_end():
    pairs = pairs_of((0, True), (4, True), (5, False), (8, True), (9, False), (12, True), (13, False))
    assert pairs.off.tolist() == [1, 2, 4, 6]
    assert not np.any(pairs.overlapping)


def test_what_was_paired_before_the_key_was_last_at_rest_stays():
    legato = [(0, True), (4, True), (5, False), (8, False)]
    pairs = pairs_of(*legato, (9, True), (12, True), (13, False))
    assert pairs.off.tolist() == [2, 3, 5, 6]
    assert pairs.overlapping.tolist() == [False, True, False, False]


LEGATO = [(0, True), (10, True), (11, False), (20, True), (21, False), (29, False)]
HELD = [(0, True), (10, True), (15, False), (20, True), (25, False), (29, False)]


def test_where_every_note_has_its_end_strokes_over_a_held_note_end_first_in_first_out():
    for messages in (LEGATO, HELD):
        assert pairs_of(*messages).off.tolist() == [2, 4, 5]
    assert pairs_of((0, True), (0, True), *HELD[2:]).off.tolist() == [2, 4, 5], "they begin together"
    assert pairs_of(*HELD[:5], (25, False)).off.tolist() == [2, 4, 5], "they end together"
    assert pairs_of(*HELD[:3], (29, False)).off.tolist() == [2, 3], "one stroke"


def test_a_key_struck_again_and_let_go_at_one_tick_keeps_the_new_note():
    pairs = pairs_of((0, True), (4, True), (4, False), (8, True), (8, False))
    assert pairs.off.tolist() == [2, 4, -1]
    assert pairs.stray.tolist() == []


def test_a_second_end_of_a_note_is_stray_where_another_end_is_missing():
    pairs = pairs_of((0, True), (1, True), (2, True), (3, False), (4, False), (9, True))
    assert pairs.off.tolist() == [1, 2, 3, -1]
    assert pairs.stray.tolist() == [4]


@given(st.lists(st.tuples(st.integers(0, 3), st.booleans(), st.integers(0, 2)), max_size=60))
def test_no_note_ends_before_it_begins_and_no_end_is_used_twice(messages: list[tuple[int, bool, int]]):
    ticks = np.cumsum([0, *(step for _, _, step in messages)])[1:]
    is_on = np.array([is_on for _, is_on, _ in messages], dtype=np.bool_)
    keys = np.array([key for key, _, _ in messages], dtype=np.int64)
    pairs = pair_notes(keys, is_on, ticks)
    ended = pairs.off >= 0
    assert np.all(pairs.off[ended] > pairs.on[ended])
    assert np.all(keys[pairs.off[ended]] == keys[pairs.on[ended]])
    note_offs = pairs.off[ended & ~is_on[pairs.off]]
    assert sorted([*note_offs.tolist(), *pairs.stray.tolist()]) == np.flatnonzero(~is_on).tolist()
    left = keys[pairs.on[~ended]].tolist()
    assert len(left) == len(set(left))
