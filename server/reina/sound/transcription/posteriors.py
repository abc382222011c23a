"""What the neural network of Basic Pitch hears in a recording, frame by frame.

The network (`model/`, see its PROVENANCE.md) takes two seconds of sound and gives for every frame and every
semitone how likely a note sounds and how likely one begins. Its decoding into notes is not used.
"""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from reina.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

MODEL = Path(__file__).parent / "model" / "nmp.onnx"

RATE = 22_050
"""Samples a second that the network wants."""
HOP = 256
"""Samples from frame to frame."""
FRAME_RATE = RATE / HOP
WINDOW = 43_844
"""Samples that the network takes at once."""
WINDOW_FRAMES = 172
MARGIN_FRAMES = 16
"""At a window's ends the network hears less around a frame: so many are left out."""
KEPT_FRAMES = WINDOW_FRAMES - 2 * MARGIN_FRAMES
LOWEST_PITCH = 21
PITCHES = 88

INPUT, CONTOUR, NOTE, ONSET = (
    "serving_default_input_2:0",
    "StatefulPartitionedCall:0",
    "StatefulPartitionedCall:1",
    "StatefulPartitionedCall:2",
)

AUDIBLE = 0.005
"""The network listens to each window at the level that it has, however low: what is 46 dB below the loudest
is left out afterwards."""
LOUD_PERCENTILE = 95

EXTRA = 'pip install "reina[transcribe]"'


class NoRuntimeError(InputError):
    """What runs the network is not installed."""

    def __init__(self) -> None:
        super().__init__(
            f"to find the notes of a recording, Reina needs ONNX Runtime: {EXTRA}, then start it again"
        )

    def __reduce__(self) -> tuple[type[NoRuntimeError], tuple[()]]:
        return (NoRuntimeError, ())


def is_installed() -> bool:
    """Whether what runs the network is there."""
    return importlib.util.find_spec("onnxruntime") is not None


@dataclass(frozen=True, eq=False)
class Posteriors:
    """What the network hears.

    Attributes:
        note: (T, 88) float32, 0..1: how likely a note of each semitone from A0 on sounds in each frame.
        onset: (T, 88) float32, 0..1: how likely one begins there.
    """

    note: NDArray[np.float32]
    onset: NDArray[np.float32]

    def where_audible(self, samples: NDArray[np.float32]) -> Posteriors:
        """The same, with nothing heard where a recording, (S,) at `RATE`, is all but silent."""
        frames = len(self.note)
        padded = np.pad(samples, (HOP, 3 * HOP))[: (frames + 2) * HOP]
        energy = np.square(padded, dtype=np.float64).reshape(-1, HOP).sum(axis=1)
        level = np.sqrt((energy[:-2] + energy[1:-1])[:frames] / (2 * HOP))
        audible = (level > AUDIBLE * np.percentile(level, LOUD_PERCENTILE))[:, None]
        return Posteriors(np.where(audible, self.note, 0), np.where(audible, self.onset, 0))


def hear(samples: NDArray[np.float32], tell: Callable[[float], None] = lambda _: None) -> Posteriors:
    """Have the network listen to a recording.

    Args:
        samples: (S,) at `RATE`.
        tell: Called with the share that is done, 0..1.

    Returns:
        T frames, the first at 0 s, one every `HOP` samples.

    Raises:
        NoRuntimeError: ONNX Runtime is not installed.
    """
    try:
        onnxruntime: Any = importlib.import_module("onnxruntime")
    except ImportError as error:
        raise NoRuntimeError from error
    options = onnxruntime.SessionOptions()
    # One thread: the server and its pages go on beside it.
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = 3
    network = onnxruntime.InferenceSession(MODEL.read_bytes(), options, providers=["CPUExecutionProvider"])
    frames = len(samples) // HOP + 1
    windows = -(-frames // KEPT_FRAMES)
    before = MARGIN_FRAMES * HOP
    padded = np.zeros((windows - 1) * KEPT_FRAMES * HOP + WINDOW + before, dtype=np.float32)
    padded[before : before + len(samples)] = samples[: len(padded) - before]
    notes: list[NDArray[np.float32]] = []
    onsets: list[NDArray[np.float32]] = []
    for index in range(windows):
        begin = index * KEPT_FRAMES * HOP
        heard: list[NDArray[np.float32]] = network.run(
            [NOTE, ONSET], {INPUT: padded[None, begin : begin + WINDOW, None]}
        )
        for kept, whole in zip((notes, onsets), heard, strict=True):
            kept.append(np.asarray(whole)[0, MARGIN_FRAMES:-MARGIN_FRAMES])
        tell((index + 1) / windows)
    return Posteriors(np.concatenate(notes)[:frames], np.concatenate(onsets)[:frames])
