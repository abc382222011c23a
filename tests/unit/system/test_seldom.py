"""One line a minute and kind."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

from reina.system.seldom import Seldom, SeldomFilter, SeldomLog

if TYPE_CHECKING:
    import pytest


class Clock:
    def __init__(self) -> None:
        self.at = 0.0

    def __call__(self) -> float:
        return self.at


def test_of_each_kind_one_line_a_minute(caplog: pytest.LogCaptureFixture) -> None:
    clock = Clock()
    log = SeldomLog("a.log", Seldom(60.0, clock))
    for number in range(1000):
        log.warning("full", "full of %s", number)
        log.warning("slow", "slow")
        clock.at += 0.01
    assert caplog.messages == ["full of 0", "slow"]
    clock.at = 60.0
    log.warning("full", "full of %s", "them")
    assert caplog.messages[2:] == ["full of them (and 999 more since the last such line)"]


def test_kinds_are_forgotten_when_there_are_very_many() -> None:
    clock = Clock()
    seldom = Seldom(60.0, clock)
    for number in range(5000):
        assert seldom.count(str(number)) == 0
    assert seldom.count("4999") is None
    assert seldom.count("0") == 0


def test_another_loggers_warnings_but_none_of_its_errors(caplog: pytest.LogCaptureFixture) -> None:
    clock = Clock()
    logger = logging.getLogger("another")
    added = SeldomFilter(Seldom(60.0, clock))
    logger.addFilter(added)
    for _ in range(3):
        logger.warning("no request")
        logger.error("failed")
    clock.at = 61.0
    logger.warning("no request")
    logger.removeFilter(added)
    assert caplog.messages == [
        "no request",
        "failed",
        "failed",
        "failed",
        "no request (and 2 more since the last such line)",
    ]
