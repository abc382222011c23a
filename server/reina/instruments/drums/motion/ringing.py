"""What swings or shivers after it was struck: a damped oscillation that each hit adds to.

The sum over all hits before a time is kept exactly as one size and phase a hit, so a time costs one look-up
however many hits there were, and is a function of the hits before it alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.rotations.arrays import BoolArray, FloatArray, IntArray


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
        self.at_s = at_s
        self.most = most
        held = np.zeros(len(at_s), dtype=np.bool_) if gripped is None else gripped
        self.decay: FloatArray = np.where(held, grip_decay, decay)
        """By which it dies away after each stroke, ``(K,)``."""
        self.turn = 2.0 * np.pi * frequency_hz
        rate = 1j * self.turn - self.decay
        amplitude = np.zeros(len(at_s), dtype=np.complex128)
        now = 0.0 + 0.0j
        faded = np.exp(rate[:-1] * np.diff(at_s)) if len(at_s) else amplitude
        for index, more in enumerate(strength.tolist()):
            now = (now * faded[index - 1] if index else now) + more
            amplitude[index] = now
        self.size: FloatArray = np.abs(amplitude)
        """How far it would go after each stroke if it did not die away, ``(K,)``."""
        # What only dies away is at its farthest at once.
        self.phase: FloatArray = np.angle(amplitude) + (0.0 if frequency_hz > 0.0 else 0.5 * np.pi)
        """Where in its swing it is at each stroke, radians, ``(K,)``."""

    def evaluate(self, times_s: FloatArray) -> FloatArray:
        """How far it is, ``(F,)``: 0 before the first stroke."""
        return Ringings([self]).evaluate(times_s)[0]


class Ringings:
    """C things that ring, evaluated together.

    Args:
        things: Each of them; those struck at the very same array of times are looked up once.
    """

    def __init__(self, things: Sequence[Ringing]) -> None:
        self._count = len(things)
        # What is never struck is never evaluated.
        struck = [row for row, thing in enumerate(things) if len(thing.at_s)]
        self._struck: IntArray = np.array(struck, dtype=np.intp)
        own = [things[row] for row in struck]
        apart = {id(thing.at_s): thing.at_s for thing in own}
        order = list(apart)
        self._starts = list(apart.values())
        self._looked_up: IntArray = np.array([order.index(id(thing.at_s)) for thing in own], dtype=np.intp)
        # A stroke of no size before the first, so that every time lies after some stroke.
        lengths = [0, *(len(thing.at_s) + 1 for thing in own)]
        self._offsets: IntArray = np.cumsum(lengths, dtype=np.intp)[: len(own), None]
        self._at = _led([thing.at_s for thing in own])
        self._decay = _led([-thing.decay for thing in own])
        self._size = _led([thing.size for thing in own])
        self._phase = _led([thing.phase for thing in own])
        self._turn: FloatArray = np.array([thing.turn for thing in own]).reshape(-1, 1)
        self._most: FloatArray = np.array([thing.most for thing in own]).reshape(-1, 1)

    def evaluate(self, times_s: FloatArray) -> FloatArray:
        """How far each is, ``(C, F)``: 0 before its first stroke."""
        value = np.zeros((self._count, len(times_s)))
        if not len(self._starts):
            return value
        found = np.empty((len(self._starts), len(times_s)), dtype=np.intp)
        for row, starts in enumerate(self._starts):
            found[row] = starts.searchsorted(times_s, side="right")
        place = found[self._looked_up]
        place += self._offsets
        since = times_s - self._at[place]
        swing = np.sin(self._turn * since + self._phase[place])
        far = self._size[place] * np.exp(self._decay[place] * since) * swing
        value[self._struck] = self._most * np.tanh(far / self._most)
        return value


def _led(columns: Sequence[FloatArray]) -> FloatArray:
    """Columns one after another, each led by a 0."""
    return np.concatenate([part for column in columns for part in ([0.0], column)] or [np.zeros(0)])
