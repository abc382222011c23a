from __future__ import annotations

import asyncio
import time
from typing import TYPE_CHECKING, Any

import pytest

from reina.sessions.ticker import TURN_S, Ticker

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine


def run(scenario: Callable[[Ticker], Coroutine[Any, Any, None]]) -> None:
    asyncio.run(scenario(Ticker()))


def test_what_is_due_is_done_in_the_order_of_its_time() -> None:
    async def scenario(ticker: Ticker) -> None:
        done: list[str] = []
        ended = asyncio.Event()
        now = asyncio.get_running_loop().time()
        ticker.at(now + 0.02, ended.set)
        ticker.at(now + 0.01, lambda: done.append("second"))
        ticker.at(now, lambda: done.append("first"))
        gone = ticker.at(now + 0.005, lambda: done.append("called off"))
        assert len(ticker) == 4
        gone.cancel()
        assert len(ticker) == 3
        assert done == [], "nothing is done at once"
        await asyncio.wait_for(ended.wait(), 10)
        assert done == ["first", "second"]
        assert len(ticker) == 0

    run(scenario)


def test_an_earlier_deadline_comes_first_though_a_later_one_is_waited_for() -> None:
    async def scenario(ticker: Ticker) -> None:
        reached = asyncio.Event()
        now = asyncio.get_running_loop().time()
        late = ticker.at(now + 3600, lambda: None)
        await asyncio.sleep(0)
        ticker.at(now + 0.01, reached.set)
        await asyncio.wait_for(reached.wait(), 10)
        late.cancel()

    run(scenario)


def test_one_that_raises_holds_up_none_of_the_others() -> None:
    async def scenario(ticker: Ticker) -> None:
        raised: list[BaseException] = []
        loop = asyncio.get_running_loop()
        loop.set_exception_handler(lambda _, context: raised.append(context["exception"]))
        reached = asyncio.Event()

        def fail() -> None:
            raise RuntimeError("broken")

        ticker.at(loop.time(), fail)
        ticker.at(loop.time(), reached.set)
        await asyncio.wait_for(reached.wait(), 10)
        assert [str(error) for error in raised] == ["broken"]

    run(scenario)


def test_others_on_the_loop_have_their_turn_between_many_deadlines() -> None:
    async def scenario(ticker: Ticker) -> None:
        done: list[str] = []
        ended = asyncio.Event()
        now = asyncio.get_running_loop().time()

        def take_long() -> None:
            time.sleep(1.5 * TURN_S)
            done.append("turn")

        for _ in range(10):
            ticker.at(now, take_long)
        ticker.at(now, ended.set)
        while not ended.is_set():
            await asyncio.sleep(0)
            done.append("other")
        assert done.count("turn") == 10
        last = len(done) - 1 - done[::-1].index("turn")
        assert done[:last].count("other") >= 9

    run(scenario)


def test_what_another_loop_left_is_forgotten() -> None:
    ticker = Ticker()

    async def leave() -> None:
        ticker.at(asyncio.get_running_loop().time() + 3600, lambda: pytest.fail("it is nobody's"))

    async def come() -> None:
        reached = asyncio.Event()
        ticker.at(asyncio.get_running_loop().time(), reached.set)
        assert len(ticker) == 1
        await asyncio.wait_for(reached.wait(), 10)

    asyncio.run(leave())
    asyncio.run(come())
