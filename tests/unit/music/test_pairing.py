from collections import defaultdict

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from reina.music.midi.pairing import pair_notes


@given(st.lists(st.tuples(st.integers(0, 3), st.booleans()), max_size=60))
def test_pairing_is_first_in_first_out_within_each_key(messages: list[tuple[int, bool]]):
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
    pairs = pair_notes(keys, np.array([is_on for _, is_on in messages], dtype=np.bool_))
    assert pairs.on.tolist() == sorted(ends)
    assert pairs.off.tolist() == [ends[on] for on in sorted(ends)]
    assert pairs.overlapping.tolist() == [overlapping[on] for on in sorted(ends)]
    assert pairs.stray.tolist() == stray
