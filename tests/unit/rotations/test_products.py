"""Rows of several blocks times a matrix."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from reina.rotations import BLOCK_FRAMES, product


@given(
    seed=st.integers(0, 2**32 - 1),
    blocks=st.integers(1, 6),
    inner=st.integers(1, 4),
    width=st.integers(1, 30),
    columns=st.integers(1, 40),
)
def test_a_block_has_the_bits_that_it_has_alone(
    seed: int, blocks: int, inner: int, width: int, columns: int
) -> None:
    random = np.random.default_rng(seed)
    rows = random.normal(size=(blocks * BLOCK_FRAMES, inner, width))
    matrix = random.normal(size=(width, columns))
    found = product(rows, matrix)
    np.testing.assert_allclose(found, rows @ matrix, atol=1e-12)
    for block in range(blocks):
        own = slice(block * BLOCK_FRAMES, (block + 1) * BLOCK_FRAMES)
        np.testing.assert_array_equal(found[own], product(rows[own], matrix))


def test_any_number_of_rows_will_do() -> None:
    random = np.random.default_rng(1)
    matrix = random.normal(size=(3, 2))
    for shape in ((0, 3), (1, 3), (59, 3), (61, 3), (7, 2, 3), (0, 2, 3)):
        rows = random.normal(size=shape)
        np.testing.assert_allclose(product(rows, matrix), rows @ matrix, atol=1e-14)
