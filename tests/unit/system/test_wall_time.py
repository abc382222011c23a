"""Server time by the calendar."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from reina.system.wall_time import SLEWING, WallTime


class Clocks:
    """A steady clock, and a calendar that can be set."""

    def __init__(self) -> None:
        self.steady_s = 1000.0
        self.calendar_ahead_s = 1.7e9

    def steady(self) -> float:
        return self.steady_s

    def wall(self) -> float:
        return self.steady_s + self.calendar_ahead_s


def test_it_is_the_calendar_s_and_runs_as_time_does() -> None:
    clocks = Clocks()
    now = WallTime(steady=clocks.steady, wall=clocks.wall)
    assert now() == clocks.wall()
    clocks.steady_s += 12.5
    assert now() == clocks.wall()


@given(
    steps=st.lists(
        st.tuples(st.floats(0.0, 100.0), st.floats(-10.0, 10.0)),
        min_size=1,
        max_size=20,
    )
)
def test_a_calendar_that_is_set_never_makes_it_leap_or_go_back(steps: list[tuple[float, float]]) -> None:
    clocks = Clocks()
    now = WallTime(steady=clocks.steady, wall=clocks.wall)
    before = now()
    for passed_s, set_by_s in steps:
        clocks.steady_s += passed_s
        clocks.calendar_ahead_s += set_by_s
        after = now()
        assert (1 - SLEWING) * passed_s - 1e-6 <= after - before <= (1 + SLEWING) * passed_s + 1e-6
        before = after
    for _ in range(30):
        clocks.steady_s += 1000.0
        now()
    assert abs(now() - clocks.wall()) < 1e-6, "it comes to where the calendar is"
