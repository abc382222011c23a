"""What happens very often is told once in a period, and counted."""

from __future__ import annotations

from reina.system.log_rate import MOST_KINDS, Seldom


def test_each_kind_is_told_once_in_a_period() -> None:
    now = 0.0
    seldom = Seldom(60, lambda: now)
    assert [seldom.count("a"), seldom.count("a"), seldom.count("b"), seldom.count("a")] == [0, None, 0, None]
    now = 59.9
    assert seldom.count("a") is None
    now = 60.0
    assert seldom.count("a") == 3
    assert seldom.count("a") is None


def test_not_every_kind_there_ever_was_is_remembered() -> None:
    seldom = Seldom(now=lambda: 0.0)
    for number in range(3 * MOST_KINDS):
        assert seldom.count(number) == 0
    assert seldom.count(3 * MOST_KINDS - 1) is None
    assert seldom.count(0) == 0
