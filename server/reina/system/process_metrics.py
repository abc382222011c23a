"""Memory and processor time of the server and of the processes that work for it, for Prometheus."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily
from prometheus_client.process_collector import ProcessCollector
from prometheus_client.registry import Collector

from reina.system.metrics import REGISTRY

if TYPE_CHECKING:
    from collections.abc import Iterable

    from prometheus_client import Metric

PROC = Path("/proc")
_STATE, _USER_TICKS, _SYSTEM_TICKS, _RESIDENT_PAGES = 0, 11, 12, 21
"""Where in /proc/<pid>/stat, counted from behind the name (proc(5))."""


@dataclass(frozen=True)
class WorkerProcesses:
    """What the server's child processes take together.

    Attributes:
        count: How many are alive.
        resident_bytes: Their memory.
        cpu_s: Processor time of those that are alive and of all that there were.
    """

    count: int
    resident_bytes: int
    cpu_s: float


def worker_processes(proc: Path = PROC) -> WorkerProcesses | None:
    """Look at the child processes of this one; None where the system does not tell of them.

    Each is looked at from here, so that none has to report what it takes, not even one that is killed.
    """
    found = _children(proc)
    if found is None:
        return None
    ended = os.times()
    count = resident_bytes = 0
    cpu_s = ended.children_user + ended.children_system
    tick_s, page_bytes = 1 / os.sysconf("SC_CLK_TCK"), os.sysconf("SC_PAGESIZE")
    for child in found:
        try:
            stat = (proc / child / "stat").read_text()
        except OSError:
            continue  # it has ended meanwhile
        fields = stat.rpartition(")")[2].split()
        if fields[_STATE] == "Z":
            continue
        count += 1
        resident_bytes += int(fields[_RESIDENT_PAGES]) * page_bytes
        cpu_s += (int(fields[_USER_TICKS]) + int(fields[_SYSTEM_TICKS])) * tick_s
    return WorkerProcesses(count, resident_bytes, cpu_s)


def _children(proc: Path) -> list[str] | None:
    """The ids of the child processes of all threads."""
    try:
        lists = [task / "children" for task in (proc / "self" / "task").iterdir()]
    except OSError:
        return None
    children: list[str] = []
    for listed in lists:
        try:
            children += listed.read_text().split()
        except FileNotFoundError:
            if not listed.parent.exists():
                continue  # a thread that has ended meanwhile
            return None  # a kernel without it
        except OSError:
            continue
    return children


class _Workers(Collector):
    """The child processes as metrics."""

    def collect(self) -> Iterable[Metric]:
        """As they are now."""
        found = worker_processes()
        if found is None:
            return
        yield GaugeMetricFamily(
            "reina_worker_processes", "Processes that work for the server.", value=found.count
        )
        yield GaugeMetricFamily(
            "reina_worker_resident_memory_bytes", "Their memory together.", value=found.resident_bytes
        )
        yield CounterMetricFamily(
            "reina_worker_cpu_seconds",
            "Processor time of all of them, those included that have ended.",
            value=found.cpu_s,
        )


ProcessCollector(registry=REGISTRY)
REGISTRY.register(_Workers())
