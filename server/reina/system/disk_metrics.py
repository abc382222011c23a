"""How large the folders of a data directory are and how much room is left, for Prometheus."""

from __future__ import annotations

import os
import shutil
import time
from typing import TYPE_CHECKING

from prometheus_client.core import GaugeMetricFamily
from prometheus_client.registry import Collector

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from pathlib import Path

    from prometheus_client import Metric

FRESH_S = 30.0
"""So long what was found is told again: to walk through very many files takes a while."""


class DiskMetrics(Collector):
    """The folders' sizes as metrics; read by whoever asks for them, on no event loop.

    Args:
        data_dir: The data directory.
        parts: Names of folders in it; one that is not there is empty.
        now: Seconds; never goes back.
    """

    def __init__(
        self, data_dir: Path, parts: Sequence[str], *, now: Callable[[], float] = time.monotonic
    ) -> None:
        self._data_dir = data_dir
        self._parts = tuple(parts)
        self._now = now
        self._found: dict[str, int] = {}
        self._found_at: float | None = None

    def collect(self) -> Iterable[Metric]:
        """As it is now, or was within `FRESH_S`."""
        if self._found_at is None or self._now() - self._found_at >= FRESH_S:
            self._found = {part: folder_bytes(self._data_dir / part) for part in self._parts}
            self._found_at = self._now()
        sizes = GaugeMetricFamily(
            "reina_disk_bytes", "Bytes in a folder of the data directory.", labels=("part",)
        )
        for part, size in self._found.items():
            sizes.add_metric((part,), size)
        yield sizes
        yield GaugeMetricFamily(
            "reina_disk_free_bytes",
            "Bytes that can still be written to the data directory.",
            value=shutil.disk_usage(self._data_dir).free,
        )


def folder_bytes(folder: Path) -> int:
    """Bytes of all files in a folder and in those below it; what goes meanwhile is left out."""
    total = 0
    for place, _, names in os.walk(folder):
        for name in names:
            try:
                total += os.lstat(os.path.join(place, name)).st_size  # noqa: PTH118 - very many
            except OSError:
                continue
    return total
