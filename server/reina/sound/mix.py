"""Adds rendered passages up, in whatever order they come."""

from collections.abc import Iterator
from pathlib import Path
from types import TracebackType

import numpy as np
from numpy.typing import NDArray

from reina.sound.events import SAMPLE_RATE

CHANNELS = 2
FADE = SAMPLE_RATE // 4
"""The end of each passage is faded out."""
FRAME_BYTES = CHANNELS * np.dtype(np.float32).itemsize
CHUNK = 10 * SAMPLE_RATE
"""Samples in a file."""

Samples = NDArray[np.float32]


class Mix:
    """The sum of passages: 32-bit floats in files, so that memory does not grow with the song.

    A file holds some seconds, so that what has been written to the song for good can be let go of: song and
    mix together never take more of the disk than the mix alone.

    Args:
        scratch: What their names end with; they are removed at the end.
    """

    def __init__(self, scratch: Path) -> None:
        self._scratch = scratch
        self._there: set[int] = set()

    def __enter__(self) -> "Mix":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for chunk in list(self._there):
            self._remove(chunk)

    def add(self, start: int, samples: Samples) -> None:
        """Add a passage.

        Args:
            start: The sample at which it begins.
            samples: (F, 2), full scale 1; its end is faded out in place.
        """
        fade = min(FADE, len(samples))
        samples[len(samples) - fade :] *= np.linspace(1, 0, fade, dtype=np.float32)[:, None]
        samples += self.read(start, start + len(samples))
        for chunk, first, end in _chunks(start, start + len(samples)):
            with self._path(chunk).open("rb+" if chunk in self._there else "wb+") as file:
                file.seek((first - chunk * CHUNK) * FRAME_BYTES)
                file.write(samples[first - start : end - start].tobytes())
            self._there.add(chunk)

    def read(self, first: int, end: int) -> Samples:
        """The sum so far from one sample to before another, (F, 2); silence where nothing was added."""
        found = np.zeros((end - first, CHANNELS), dtype=np.float32)
        for chunk, begin, until in _chunks(max(first, 0), end):
            if chunk not in self._there:
                continue
            with self._path(chunk).open("rb") as file:
                file.seek((begin - chunk * CHUNK) * FRAME_BYTES)
                held = np.frombuffer(file.read((until - begin) * FRAME_BYTES), dtype=np.float32)
            held = held.reshape(-1, CHANNELS)
            found[begin - first : begin - first + len(held)] = held
        return found

    def forget(self, end: int) -> None:
        """Let go of what lies before a sample: it is not read again."""
        for chunk in [chunk for chunk in self._there if (chunk + 1) * CHUNK <= end]:
            self._remove(chunk)

    def _path(self, chunk: int) -> Path:
        return self._scratch.with_name(f"{chunk}-{self._scratch.name}")

    def _remove(self, chunk: int) -> None:
        self._there.discard(chunk)
        self._path(chunk).unlink(missing_ok=True)


def _chunks(first: int, end: int) -> Iterator[tuple[int, int, int]]:
    """The files that hold a span, each with the samples of it that it holds."""
    for chunk in range(first // CHUNK, -(-end // CHUNK)):
        yield chunk, max(first, chunk * CHUNK), min(end, (chunk + 1) * CHUNK)
