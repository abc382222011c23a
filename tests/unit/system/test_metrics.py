"""What is counted, as Prometheus reads it."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

import pytest

from reina.system.disk_metrics import FRESH_S, DiskMetrics
from reina.system.loop_delay import LONG_DELAY_S, TOO_LONG_S, LoopDelay
from reina.system.metrics import QUEUES, REGISTRY, in_queue, limit_hit, tally

if TYPE_CHECKING:
    from pathlib import Path


def sample(name: str, **labels: str) -> float:
    value = REGISTRY.get_sample_value(name, labels)
    return 0.0 if value is None else value


def test_the_tally_is_told() -> None:
    before = sample("reina_frames_sent_total")
    tally.frames_sent += 5
    assert sample("reina_frames_sent_total") == before + 5


@pytest.mark.parametrize("queue", QUEUES)
def test_work_is_counted_while_it_is_there_and_measured_when_it_is_done(queue: str) -> None:
    done = sample("reina_work_seconds_count", queue=queue)
    with in_queue(queue):
        assert sample("reina_work", queue=queue) == 1
    with pytest.raises(ValueError, match="x"), in_queue(queue):
        raise ValueError("x")
    assert sample("reina_work", queue=queue) == 0
    assert sample("reina_work_seconds_count", queue=queue) == done + 2


def test_limits_are_counted_by_their_names() -> None:
    before = sample("reina_limits_hit_total", limit="a-limit")
    limit_hit("a-limit")
    assert sample("reina_limits_hit_total", limit="a-limit") == before + 1


def test_a_loop_is_too_late_only_when_it_is_so_for_long() -> None:
    now = 0.0
    delay = LoopDelay(lambda: now)
    delay.note(LONG_DELAY_S * 2)
    now = TOO_LONG_S - 0.1
    delay.note(LONG_DELAY_S * 2)
    assert not delay.is_too_long
    now = TOO_LONG_S
    assert delay.is_too_long
    delay.note(0.01)
    assert not delay.is_too_long
    assert delay.long_s == 0


def test_a_loop_that_is_held_up_is_seen() -> None:
    now = 0.0

    async def scenario() -> float:
        nonlocal now
        delay = LoopDelay(lambda: now)
        delay.start()
        await asyncio.sleep(0)
        # It sleeps now; when it wakes so much more has gone by than it asked for.
        now = 100.0
        while not delay.long_s and now < 1000.0:
            now += 1.0
            await asyncio.sleep(0.02)
        late_s = delay.long_s
        await delay.aclose()
        return late_s

    assert asyncio.run(scenario()) > 0


def test_folders_are_measured_now_and_then(tmp_path: Path) -> None:
    now = 0.0
    disk = DiskMetrics(tmp_path, ("songs", "staging"), now=lambda: now)

    def told() -> dict[str, float]:
        sizes, free = disk.collect()
        assert free.samples[0].value > 0
        return {one.labels["part"]: one.value for one in sizes.samples}

    assert told() == {"songs": 0, "staging": 0}
    (tmp_path / "songs" / "a").mkdir(parents=True)
    (tmp_path / "songs" / "a" / "b").write_bytes(bytes(1234))
    assert told() == {"songs": 0, "staging": 0}
    now = FRESH_S
    assert told() == {"songs": 1234, "staging": 0}
