"""What objects weigh, held to what they are made of."""

from __future__ import annotations

import tracemalloc
from dataclasses import dataclass

import numpy as np
import pytest

from reina.system.weight import weight_of


@dataclass
class Held:
    name: str
    values: tuple[float, ...]
    array: np.ndarray[tuple[int], np.dtype[np.float64]]


def test_arrays_texts_and_views_count_once() -> None:
    array = np.zeros(100_000)
    assert weight_of(array) == pytest.approx(800_000, rel=0.01)
    assert weight_of([array, array, array[10:20], {"again": array}]) == pytest.approx(800_000, rel=0.01)
    assert weight_of(array[:10]) == pytest.approx(800_000, rel=0.01), "a view keeps the whole"
    assert weight_of([array, "x" * 1000], shared=[array]) < 2000


def test_arrays_of_one_buffer_weigh_what_the_buffer_does() -> None:
    buffer = bytearray(800_000)
    arrays = [np.frombuffer(buffer, dtype=kind) for kind in (np.float64, np.int8, np.int64)]
    assert weight_of(arrays) == pytest.approx(800_000, rel=0.01)


def test_many_objects_weigh_about_what_they_take() -> None:
    tracemalloc.start()
    held = [Held(f"held {n}", (n + 0.5, n + 0.25), np.full(20, float(n))) for n in range(20_000)]
    taken, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert 0.7 < weight_of(held) / taken < 1.4


def test_what_a_function_was_made_with_counts() -> None:
    array = np.zeros(10_000)

    def told() -> float:
        return float(array[0])

    assert told() == 0.0
    assert weight_of(told) > 80_000
