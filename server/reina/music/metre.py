"""Beats and bars: the metre map."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.music.arrays import FloatArray, read_only

SAME_BEAT = 1e-9
"""Beats nearer than this are the same."""


@dataclass(frozen=True)
class TimeSignature:
    """A metre from a beat on, as 6 over 8 from beat 12.

    Attributes:
        onset_beats: Where it begins, quarter notes from the score's beginning.
        numerator: How many notes of the denominator's value make a bar.
        denominator: The value: 4 for quarters, 8 for eighths.
    """

    onset_beats: float
    numerator: int
    denominator: int

    @property
    def bar_beats(self) -> float:
        """Length of a bar in quarter notes."""
        return self.numerator * 4.0 / self.denominator


@dataclass(frozen=True)
class BarPosition:
    """A place in the score as musicians say it.

    Attributes:
        bar: Number of the bar: the first whole one is 1, a pickup before it is bar 0.
        beat: Quarter notes since the beginning of that bar, from 0.
    """

    bar: int
    beat: float


class MetreMap:
    """Where the bars begin. A new signature begins a new bar, even where it cuts the one before short.

    A pickup (an incomplete first bar) is either given as `pickup_beats` or, as MIDI files write it, as a
    first signature that lasts one bar and is shorter than the bar of the signature after it.
    """

    def __init__(self, signatures: Sequence[TimeSignature] = (), *, pickup_beats: float = 0.0) -> None:
        """Make a map from signatures in any order; at one beat the last holds; 4/4 until the first.

        Raises:
            ValueError: If a signature begins before beat 0 or is of no positive number, or a pickup is
            negative.
        """
        for signature in signatures:
            if not (math.isfinite(signature.onset_beats) and signature.onset_beats >= 0):
                raise ValueError(
                    f"a signature must begin at a finite beat, 0 or later, not {signature.onset_beats}"
                )
            if signature.numerator < 1 or signature.denominator < 1:
                raise ValueError(f"{signature.numerator}/{signature.denominator} is no metre")
        if not (math.isfinite(pickup_beats) and pickup_beats >= 0):
            raise ValueError(f"a pickup lasts 0 beats or more, not {pickup_beats}")
        by_beat = {0.0: TimeSignature(0.0, 4, 4)}
        by_beat.update((s.onset_beats, s) for s in sorted(signatures, key=lambda s: s.onset_beats))
        self.signatures: tuple[TimeSignature, ...] = tuple(by_beat[beat] for beat in sorted(by_beat))
        self.pickup_beats = pickup_beats or self._written_pickup()

    def _written_pickup(self) -> float:
        if len(self.signatures) < 2:
            return 0.0
        first, second = self.signatures[:2]
        lasts = second.onset_beats
        return lasts if lasts <= first.bar_beats and lasts < second.bar_beats else 0.0

    def bar_lines(self, until_beats: float) -> FloatArray:
        """Return the beats at which bars begin, (B,) float64: from 0 up to, not including, `until_beats`."""
        pieces: list[FloatArray] = []
        if self.pickup_beats > 0:
            pieces.append(np.zeros(1))
        for index, signature in enumerate(self.signatures):
            begin = max(signature.onset_beats, self.pickup_beats)
            later = index + 1 < len(self.signatures)
            end = min(self.signatures[index + 1].onset_beats, until_beats) if later else until_beats
            count = math.ceil((end - begin) / signature.bar_beats - SAME_BEAT)
            if count > 0:
                pieces.append(np.arange(count, dtype=np.float64) * signature.bar_beats + begin)
        lines = np.concatenate(pieces) if pieces else np.zeros(0)
        return read_only(lines[lines < until_beats])

    def bar_count(self, until_beats: float) -> float:
        """Return about how many bars begin before `until_beats`, without making them."""
        ends = [*(s.onset_beats for s in self.signatures[1:]), math.inf]
        return sum(
            max(0.0, (min(end, until_beats) - s.onset_beats) / s.bar_beats)
            for s, end in zip(self.signatures, ends, strict=True)
        )

    def position(self, beats: float) -> BarPosition:
        """Return the bar and the beat in it at `beats` (0 or later)."""
        return self.positions(np.array([beats]))[0]

    def positions(self, beats: FloatArray) -> list[BarPosition]:
        """Return the bar and the beat in it at each of `beats` (0 or later)."""
        if not len(beats):
            return []
        lines = self.bar_lines(float(np.max(beats)) + 1.0)
        bars = np.maximum(np.searchsorted(lines, beats + SAME_BEAT, side="right") - 1, 0)
        first_bar = 0 if self.pickup_beats > 0 else 1
        in_bar = np.maximum(beats - lines[bars], 0.0)
        return [
            BarPosition(bar + first_bar, beat)
            for bar, beat in zip(bars.tolist(), in_bar.tolist(), strict=True)
        ]

    def beats(self, position: BarPosition) -> float:
        """Return the place of a bar position in beats; the inverse of `position`.

        Raises:
            ValueError: If the bar is before the first.
        """
        index = position.bar - (0 if self.pickup_beats > 0 else 1)
        if index < 0:
            raise ValueError(f"bar {position.bar} is before the first")
        longest = max(s.bar_beats for s in self.signatures)
        until = self.signatures[-1].onset_beats + self.pickup_beats + longest * (index + 2)
        return float(self.bar_lines(until)[index]) + position.beat
