"""Adds rendered passages up, in whatever order they come."""

from pathlib import Path
from types import TracebackType

import numpy as np
from numpy.typing import NDArray

from reina.sound.events import SAMPLE_RATE

CHANNELS = 2
FADE = SAMPLE_RATE // 4
"""The end of each passage is faded out."""
FRAME_BYTES = CHANNELS * np.dtype(np.float32).itemsize

Samples = NDArray[np.float32]


class Mix:
    """The sum of passages: a file of 32-bit floats, so that memory does not grow with the song.

    Args:
        scratch: Path of that file; it is removed at the end.
    """

    def __init__(self, scratch: Path) -> None:
        self._scratch = scratch
        self._file = scratch.open("wb+")

    def __enter__(self) -> "Mix":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()
        self._scratch.unlink(missing_ok=True)

    def add(self, start: int, samples: Samples) -> None:
        """Add a passage.

        Args:
            start: The sample at which it begins.
            samples: (F, 2), full scale 1; its end is faded out in place.
        """
        fade = min(FADE, len(samples))
        samples[len(samples) - fade :] *= np.linspace(1, 0, fade, dtype=np.float32)[:, None]
        samples += self.read(start, start + len(samples))
        self._file.seek(start * FRAME_BYTES)
        self._file.write(samples.tobytes())

    def read(self, first: int, end: int) -> Samples:
        """The sum so far from one sample to before another, (F, 2); silence where nothing was added."""
        found = np.zeros((end - first, CHANNELS), dtype=np.float32)
        begin = max(first, 0)
        self._file.seek(begin * FRAME_BYTES)
        held = np.frombuffer(self._file.read((end - begin) * FRAME_BYTES), dtype=np.float32)
        held = held.reshape(-1, CHANNELS)
        found[begin - first : begin - first + len(held)] = held
        return found
