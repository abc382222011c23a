"""Feet: one as long as one can, both beyond that."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.instruments.drums.feet import HIGHEST_RATE, Feet, choose_feet

NONE = np.zeros(0)


def feet_of(onset_s: list[float], pedal_s: list[float] | None = None) -> Feet:
    at = np.array(onset_s)
    return choose_feet(at, np.mod(2.0 * at, 4.0), np.full(len(at), 0.7), np.array(pedal_s or []))


@pytest.mark.parametrize(
    ("rate", "feet"), [(3.0, "RRRRRRRR"), (6.5, "RRRRRRRR"), (8.0, "RLRLRLRL"), (16.0, "RLRLRLRL")]
)
def test_both_feet_take_turns_where_one_is_too_slow(rate: float, feet: str) -> None:
    assert "".join("RL-"[foot] for foot in feet_of([k / rate for k in range(8)]).foot) == feet


def test_two_quick_strokes_are_one_motion_of_one_foot() -> None:
    feet = feet_of([0.0, 0.12, 1.0])
    assert feet.foot.tolist() == [0, 0, 0]
    assert "double" in feet.reasons[1]


def test_a_run_that_begins_between_the_beats_begins_with_the_left_foot() -> None:
    assert feet_of([0.125, 0.25, 0.375, 0.5]).foot.tolist() == [1, 0, 1, 0]


def test_the_left_foot_stays_at_the_hi_hat_where_that_is_struck() -> None:
    assert feet_of([0.0, 0.125, 0.25, 0.375], pedal_s=[0.125]).foot.tolist()[1] == 0


def test_what_is_too_fast_for_two_feet_is_told() -> None:
    feet = feet_of([k * 0.02 for k in range(8)])
    assert (feet.foot == -1).any()
    assert all("no foot strikes" in feet.reasons[hit] for hit in np.flatnonzero(feet.foot == -1))


def test_no_bass_drum_at_all() -> None:
    assert feet_of([]).reasons == ()


@given(st.lists(st.floats(0.005, 0.5), min_size=1, max_size=50))
def test_no_foot_is_faster_than_a_foot_can_be(gaps: list[float]) -> None:
    at = np.cumsum(gaps)
    feet = feet_of(at.tolist())
    for side in (0, 1):
        assert (np.diff(at[feet.foot == side]) >= 1.0 / HIGHEST_RATE - 1e-9).all()
