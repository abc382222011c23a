"""All channels' keys are counted as each channel's would be by itself."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.curves.key_order import KeyOrder


@given(
    seed=st.integers(0, 2**32 - 1),
    sizes=st.lists(st.integers(1, 40), min_size=1, max_size=8),
    begin=st.floats(-2.0, 12.0),
    length=st.floats(0.0, 14.0),
    count=st.integers(0, 70),
    in_order=st.booleans(),
)
def test_as_many_keys_have_gone_by_as_each_channel_says(
    seed: int, sizes: list[int], begin: float, length: float, count: int, *, in_order: bool
) -> None:
    random = np.random.default_rng(seed)
    # On a coarse grid, so that keys of several channels, and times, fall together.
    keys = [np.sort(random.choice(400, size, replace=False)) / 40.0 for size in sizes]
    times = np.round(40.0 * (begin + length * random.random(count))) / 40.0
    if in_order:
        times = np.sort(times)
    passed = KeyOrder(keys).passed(times)
    assert passed.shape == (len(sizes), count)
    for found, own in zip(passed, keys, strict=True):
        np.testing.assert_array_equal(found, own.searchsorted(times, "right"))


@pytest.mark.parametrize("count", [0, 1, 60])
def test_without_channels_there_is_nothing_to_count(count: int) -> None:
    assert KeyOrder([]).passed(np.arange(float(count))).shape == (0, count)
