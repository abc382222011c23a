"""Recordings as M4A and WebM, which the server does not decode."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import av
import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

RATE = 48_000
CODECS = {"webm": "libopus", "mp4": "aac"}


def as_coded(samples: NDArray[np.float32], rate: int, container: str) -> bytes:
    """One channel of sound in a container, ``"webm"`` or ``"mp4"``, without a picture."""
    file = io.BytesIO()
    # Its types say little of what is made of a codec's name.
    with av.open(file, "w", format=container) as opened:
        output: Any = opened
        stream: Any = output.add_stream(CODECS[container], rate=RATE, layout="mono")
        whole = (np.clip(samples, -1, 1) * 32_767).astype(np.int16)[None]
        frame = av.AudioFrame.from_ndarray(whole, format="s16", layout="mono")
        frame.sample_rate = rate
        resampler = av.AudioResampler(format=stream.format, layout="mono", rate=RATE, frame_size=960)
        for piece in (*resampler.resample(frame), *resampler.resample(None)):
            output.mux(stream.encode(piece))
        output.mux(stream.encode(None))
    return file.getvalue()
