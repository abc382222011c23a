"""Work in other processes: what goes there and comes back, and what becomes of a process that fails."""

from __future__ import annotations

import asyncio
import operator
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, cast

import numpy as np
import pytest

from reina.errors import InputError
from reina.sessions.workers.pool import PROGRAM, WorkerPool
from reina.show import ShowError
from reina.system.own_process import NICENESS

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine

    from numpy.typing import NDArray

SERVER = Path(__file__).parents[3] / "server"


def with_pool(
    scenario: Callable[[WorkerPool], Coroutine[Any, Any, None]], *shared: object, **options: Any
) -> None:
    async def run() -> None:
        pool = WorkerPool(shared, **options)
        try:
            await scenario(pool)
        finally:
            await pool.aclose()

    asyncio.run(run())


def test_work_is_done_in_another_process_that_is_kept_and_yields() -> None:
    async def scenario(pool: WorkerPool) -> None:
        first = await pool.run(os.getpid)
        assert first != os.getpid()
        assert await pool.run(os.getpid) == first
        assert await pool.run(os.nice, 0) == os.nice(0) + NICENESS

    with_pool(scenario)


def test_arrays_come_back_as_they_were() -> None:
    async def scenario(pool: WorkerPool) -> None:
        sent = np.arange(12.0).reshape(3, 4)
        sent.flags.writeable = False
        got: NDArray[np.float64] = await pool.run(np.asfortranarray, sent)
        assert got.tolist() == sent.tolist()
        assert got.flags.f_contiguous
        assert got.flags.writeable
        assert not (await pool.run(operator.itemgetter(0), [sent])).flags.writeable

    with_pool(scenario)


def test_equal_arrays_that_nobody_writes_to_come_back_as_one() -> None:
    async def scenario(pool: WorkerPool) -> None:
        sent = [np.arange(1000.0), np.arange(1000.0), np.arange(1000.0), np.ones(10), np.arange(1000.0)]
        for array in (*sent[:2], sent[3], sent[4]):
            array.flags.writeable = False
        got = cast("list[NDArray[np.float64]]", await pool.run(list, sent))
        for one, other in zip(got, sent, strict=True):
            np.testing.assert_array_equal(one, other)
        assert [np.shares_memory(got[0], other) for other in got] == [True, True, False, False, True]
        assert got[2].flags.writeable

    with_pool(scenario)


def test_what_is_shared_stays_one() -> None:
    shared = InputError("shared")

    async def scenario(pool: WorkerPool) -> None:
        assert (await pool.run(list, [shared, 1]))[0] is shared

    with_pool(scenario, shared)


def test_errors_of_the_input_keep_what_they_tell() -> None:
    async def scenario(pool: WorkerPool) -> None:
        from reina.sessions.workers.reader import read_written_show

        with pytest.raises(ShowError, match="no JSON"):
            await pool.run(read_written_show, b"{", None)
        with pytest.raises(RuntimeError, match="ZeroDivisionError"):
            await pool.run(divmod, 1, 0)
        assert await pool.run(divmod, 7, 2) == (3, 1), "neither ends the process"

    with_pool(scenario)


def test_work_that_takes_too_long_is_stopped() -> None:
    async def scenario(pool: WorkerPool) -> None:
        with pytest.raises(InputError, match=r"took over 0\.2 s"):
            await pool.run(time.sleep, 60)

    with_pool(scenario, timeout_s=0.2)


def test_a_process_that_ends_is_told_and_another_takes_its_place() -> None:
    async def scenario(pool: WorkerPool) -> None:
        with pytest.raises(InputError, match="has ended"):
            await pool.run(os._exit, 3)
        assert await pool.run(divmod, 7, 2) == (3, 1)

    with_pool(scenario)


def test_a_program_that_is_none_is_told() -> None:
    async def scenario(pool: WorkerPool) -> None:
        with pytest.raises(InputError, match="has ended"):
            await pool.run(os.getpid)

    with_pool(scenario, program=(sys.executable, "-c", "pass"))


def test_work_under_way_ends_with_the_server() -> None:
    async def run() -> None:
        pool = WorkerPool()
        waiting = asyncio.create_task(pool.run(time.sleep, 60))
        await asyncio.sleep(0.3)
        await pool.aclose()
        with pytest.raises(InputError):
            await waiting

    begin = time.monotonic()
    asyncio.run(run())
    assert time.monotonic() - begin < 30, "it was not waited for"


def test_a_worker_ends_when_its_server_is_gone() -> None:
    process = subprocess.Popen(
        PROGRAM,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=os.environ | {"PYTHONPATH": str(SERVER)},
    )
    from reina.system.parcel import send

    assert process.stdin is not None
    assert process.stdout is not None
    asked = cast("BinaryIO", process.stdin)
    send(asked, ())
    send(asked, (time.sleep, (60,)))
    process.stdin.close()
    assert process.wait(20) == 2
    process.stdout.close()


def test_a_pool_knows_whether_its_processes_start() -> None:
    async def works(pool: WorkerPool) -> None:
        with pytest.raises(InputError, match="has ended"):
            await pool.run(os._exit, 3)
        assert pool.fails, "its first work was its end"
        assert await pool.run(divmod, 7, 2) == (3, 1)
        assert not pool.fails
        with pytest.raises(InputError, match="has ended"):
            await pool.run(os._exit, 3)
        assert not pool.fails, "it had worked before"

    async def starts_not(pool: WorkerPool) -> None:
        with pytest.raises(InputError):
            await pool.run(os.getpid)
        assert pool.fails

    with_pool(works)
    with_pool(starts_not, program=(sys.executable, "-c", "pass"))
    with_pool(starts_not, program=("/nowhere/python",))
