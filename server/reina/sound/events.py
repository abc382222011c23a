"""What a synthesizer is to play: notes and controls on channels, at samples."""

import hashlib
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

SAMPLE_RATE = 48000
"""What the synthesizer renders at; one tick of a plan is one sample."""
CHANNELS_OF_PORT = 16
DRUM_CHANNEL = 9

NOTE_DTYPE = np.dtype(
    [("on", "<u4"), ("off", "<u4"), ("port", "u1"), ("channel", "u1"), ("key", "u1"), ("velocity", "u1")]
)
CONTROL_DTYPE = np.dtype(
    [("tick", "<u4"), ("port", "u1"), ("status", "u1"), ("data1", "u1"), ("data2", "u1")]
)


@dataclass(frozen=True, eq=False)
class SoundPlan:
    """What is to be rendered.

    Attributes:
        notes: (N,) of NOTE_DTYPE, sorted by `on`; ticks are samples from the score's time 0. On one port,
            channel and key notes never overlap.
        controls: (C,) of CONTROL_DTYPE, sorted by `tick`, in the order in which they take effect; `status` is
            the MIDI status byte with the channel.
        parts: (N,) which part of the score each note is of; the sound does not depend on it.
    """

    notes: NDArray[np.void]
    controls: NDArray[np.void]
    parts: NDArray[np.int32]

    @property
    def duration_s(self) -> float:
        """End of the last note in seconds."""
        return float(self.notes["off"].max()) / SAMPLE_RATE

    def digest(self, *about: str) -> str:
        """SHA-256 of the plan and of what else decides the sound, in hexadecimal."""
        state = hashlib.sha256(repr((len(self.notes), len(self.controls), *about)).encode())
        state.update(self.notes.tobytes())
        state.update(self.controls.tobytes())
        return state.hexdigest()
