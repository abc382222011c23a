"""Turns go round by owner."""

from __future__ import annotations

import asyncio

from reina.system.turns import Turns


def test_who_asks_often_waits_for_himself() -> None:
    done: list[str] = []

    async def work(turns: Turns, owner: str) -> None:
        async with turns.of(owner):
            await asyncio.sleep(0)
            done.append(owner)

    async def all_at_once() -> None:
        turns = Turns()
        async with asyncio.TaskGroup() as group:
            for owner in ["many"] * 6 + ["one", "two"]:
                group.create_task(work(turns, owner))

    asyncio.run(all_at_once())
    assert done == ["many", "many", "one", "two", "many", "many", "many", "many"]


def test_no_more_work_at_once_than_may_and_who_gives_up_leaves_his_turn() -> None:
    async def work() -> tuple[int, int]:
        turns, now, most, worked = Turns(2), 0, 0, 0

        async def one(number: int) -> None:
            nonlocal now, most, worked
            async with turns.of(number % 3):
                now += 1
                most = max(most, now)
                try:
                    await asyncio.sleep(0.001)
                    worked += 1
                finally:
                    now -= 1

        tasks = [asyncio.create_task(one(number)) for number in range(12)]
        await asyncio.sleep(0)
        for task in tasks[1::4]:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        async with asyncio.timeout(1), turns.of("last"), turns.of("last"):
            return most, worked

    assert asyncio.run(work()) == (2, 9)


def test_a_turn_that_was_given_to_who_has_just_gone_is_given_on() -> None:
    async def work() -> None:
        turns = Turns()
        async with turns.of("first"):
            gone = asyncio.create_task(turns.of("gone").__aenter__())
            await asyncio.sleep(0)
        gone.cancel()
        await asyncio.gather(gone, return_exceptions=True)
        async with asyncio.timeout(1), turns.of("next"):
            pass

    asyncio.run(work())
