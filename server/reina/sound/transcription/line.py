"""The likeliest single line of notes in what the network hears."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.sound.transcription.posteriors import LOWEST_PITCH

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from reina.sound.transcription.posteriors import Posteriors

ATTACK = 4
"""Frames that a note lasts at least, beside its first: 58 ms in all, a fast trill's."""
SOUNDING_BIAS, SOUNDING_MOST, SOUNDING_LEAST = 0.8, 1.0, -4.0
"""What a frame speaks for a note with, at most and at least, and how far towards it: in reverberation and in
fast runs the network is unsure of notes that are there."""
ONSET_WEIGHT, ONSET_COST, REPEAT_COST = 2.0, 1.0, 1.0
"""A beginning speaks for itself by its log odds, so many times; a note of the pitch before needs more."""
REST_COST = 3.0
"""Of a rest: a short weakness is none."""
NO_ONSET = -9.0
NEAR = 2
"""Frames within which the two signs of a beginning, the network's and the spectrum's, are one."""
LEAST_ONSET = 0.05
UNSURE = 0.01
"""Nothing is surer than this, nor surer that it is not."""
NEVER = -1e9


@dataclass(frozen=True, eq=False)
class FoundLine:
    """N notes, one after the other.

    Attributes:
        begin: (N,) int64, the frame in which each begins.
        end: (N,) int64, the frame before which it ends; not after the next one's `begin`.
        pitch: (N,) int64, MIDI numbers.
    """

    begin: NDArray[np.int64]
    end: NDArray[np.int64]
    pitch: NDArray[np.int64]


def likeliest_line(heard: Posteriors, novelty: NDArray[np.float64], lowest: int, highest: int) -> FoundLine:
    """Find the line that explains best what is heard, by dynamic programming.

    At any time there is a rest or one note. A note begins where the network hears it begin, at the peak of
    that or at one of `novelty`, and lasts as long as it sounds. It follows a rest, another note, or, for a
    further cost, one of its own pitch.

    Args:
        heard: What the network hears, T frames.
        novelty: (T,) how much begins in each frame.
        lowest: The lowest MIDI pitch that is looked for.
        highest: The highest.
    """
    span = slice(lowest - LOWEST_PITCH, highest - LOWEST_PITCH + 1)
    sounds = np.clip(_log_odds(heard.note[:, span], 1e-3) + SOUNDING_BIAS, SOUNDING_LEAST, SOUNDING_MOST)
    begins, repeats = _beginnings(heard.onset[:, span], novelty)
    trellis = _Trellis(*sounds.shape)
    for frame in range(len(sounds)):
        trellis.go_on(frame, sounds[frame], begins[frame], repeats[frame])
    begin, end, pitch = (np.array(column, dtype=np.int64) for column in trellis.followed_back())
    return FoundLine(begin, end, pitch + lowest)


def largest_near(values: NDArray[np.floating], reach: int) -> NDArray[np.float64]:
    """The largest of each frame's values and those of `reach` frames before and after it; (T, ...)."""
    padded = np.pad(values, ((reach, reach),) + ((0, 0),) * (values.ndim - 1))
    return np.max([padded[step : step + len(values)] for step in range(2 * reach + 1)], axis=0)


def _log_odds(share: NDArray[np.floating], unsure: float) -> NDArray[np.float64]:
    bounded = np.clip(share.astype(np.float64), unsure, 1 - unsure)
    return np.log(bounded / (1 - bounded))


def _beginnings(
    onset: NDArray[np.float32], novelty: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(T, P) twice: how much speaks for a note that begins in a frame, and for one of the pitch before.

    A note of the pitch before begins at the network's own peaks alone: else one beginning would be taken for
    two.
    """
    strongest = largest_near(onset, NEAR)
    peaks = (onset >= strongest) & (onset > LEAST_ONSET)
    rising = novelty >= largest_near(novelty, NEAR)
    told = ONSET_WEIGHT * _log_odds(strongest, UNSURE)
    begins = np.where(peaks | rising[:, None], told, NO_ONSET) - ONSET_COST
    return begins, np.where(peaks, begins, NO_ONSET) - REPEAT_COST


class _Trellis:
    """What the best way to each state earns, frame by frame, and how it came there.

    The states of a pitch are the frames of its attack, which follow one another, and being held.
    """

    def __init__(self, frames: int, pitches: int) -> None:
        self._rest = 0.0
        self._attack = np.full((ATTACK, pitches), NEVER)
        self._held = np.full(pitches, NEVER)
        self._own = np.arange(pitches)
        # What was held before a note began and before a rest, -1 for a rest.
        self._before_note = np.full((frames, pitches), -1, dtype=np.int16)
        self._before_rest = np.full(frames, -1, dtype=np.int16)
        self._attack_ends = np.zeros((frames, pitches), dtype=bool)

    def go_on(
        self,
        frame: int,
        sounds: NDArray[np.float64],
        begins: NDArray[np.float64],
        repeats: NDArray[np.float64],
    ) -> None:
        """Take in one more frame."""
        best = int(self._held.argmax())
        most = float(self._held[best])
        earned, before = self._of_another(best, most)
        earned = earned + begins
        again = self._held + repeats
        self._before_note[frame] = np.where(again > earned, self._own, before)
        if most - REST_COST > self._rest:
            self._rest, self._before_rest[frame] = most - REST_COST, best
        ended = self._attack[-1]
        self._attack_ends[frame] = ended > self._held
        self._held = np.maximum(ended, self._held) + sounds
        self._attack[1:] = self._attack[:-1] + sounds
        self._attack[0] = np.maximum(again, earned) + sounds

    def _of_another(self, best: int, most: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """What the best of a rest and all other pitches has earned, for each pitch, and which it is."""
        earned = np.full(len(self._held), max(self._rest, most))
        before = np.full(len(self._held), best if most > self._rest else -1)
        self._held[best] = NEVER
        second = int(self._held.argmax())
        earned[best] = max(self._rest, float(self._held[second]))
        before[best] = second if self._held[second] > self._rest else -1
        self._held[best] = most
        return earned, before

    def followed_back(self) -> tuple[list[int], list[int], list[int]]:
        """The notes of the best way: where each begins, where it ends, and its pitch's number."""
        begins: list[int] = []
        ends: list[int] = []
        pitches: list[int] = []
        frame = end = len(self._before_rest)
        last = int(self._held.argmax())
        pitch = last if self._held[last] > self._rest else -1
        while (frame := frame - 1) >= 0:
            if pitch < 0:
                pitch, end = int(self._before_rest[frame]), frame
            elif self._attack_ends[frame, pitch]:
                frame -= ATTACK
                begins.append(frame)
                ends.append(end)
                pitches.append(pitch)
                pitch, end = int(self._before_note[frame, pitch]), frame
        return begins[::-1], ends[::-1], pitches[::-1]
