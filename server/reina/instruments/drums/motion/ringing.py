"""What swings or shivers after it was struck: a damped oscillation that each hit adds to.

The sum over all hits before a time is kept exactly as one complex amplitude a hit, so a time costs one
look-up however many hits there were, and is a function of the hits before it alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from reina.rotations.arrays import BoolArray, FloatArray


class Ringing:
    """One thing that rings.

    Args:
        at_s: (K,) when it is struck or gripped, seconds, ascending.
        strength: (K,) what each stroke adds; 0 where it is gripped.
        frequency_hz: How often it swings in a second; 0 only dies away.
        decay: By which it dies away: exp(-decay t).
        gripped: (K,) where a hand holds it, so that it is still at once; nowhere if None.
        grip_decay: By which it then dies away.
        most: The farthest that it goes.
    """

    def __init__(
        self,
        at_s: FloatArray,
        strength: FloatArray,
        *,
        frequency_hz: float,
        decay: float,
        gripped: BoolArray | None = None,
        grip_decay: float = 30.0,
        most: float = 1.0,
    ) -> None:
        self._at = at_s
        self._most = most
        self._is_swing = frequency_hz > 0.0
        held = np.zeros(len(at_s), dtype=np.bool_) if gripped is None else gripped
        turn = 2.0j * np.pi * frequency_hz
        self._rate = np.where(held, -grip_decay, -decay) + turn
        amplitude = np.zeros(len(at_s), dtype=np.complex128)
        now = 0.0 + 0.0j
        faded = np.exp(self._rate[:-1] * np.diff(at_s)) if len(at_s) else amplitude
        for index, more in enumerate(strength.tolist()):
            now = (now * faded[index - 1] if index else now) + more
            amplitude[index] = now
        self._amplitude = amplitude

    def evaluate(self, times_s: FloatArray) -> FloatArray:
        """How far it is, ``(F,)``: 0 before the first stroke."""
        if not len(self._at):
            return np.zeros(len(times_s))
        place = np.searchsorted(self._at, times_s, side="right") - 1
        known = np.maximum(place, 0)
        since = np.maximum(times_s - self._at[known], 0.0)
        value = self._amplitude[known] * np.exp(self._rate[known] * since)
        far = value.imag if self._is_swing else value.real
        return np.where(place >= 0, self._most * np.tanh(far / self._most), 0.0)
