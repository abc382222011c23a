"""The stretches in which recording and score go together, and a score's time bent to the recording's."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reina.sound.alignment.path import LARGEST_STEP, UNHEARD, Path
from reina.sound.alignment.score_bands import Times

SLOPE_REACH_S = 2.5
"""A tempo is measured over so long on either side."""
SLOWEST, FASTEST = 0.3, 3.3
GRID_S = 0.1
SMALLEST_GAP_S = 0.6
"""What is left out or put in for less is taken for tempo."""
SHORTEST_S = 1.5
"""A stretch that is heard for less is taken for chance."""


@dataclass(frozen=True, eq=False)
class BentTime:
    """The score's time, made longer and shorter so that it goes on as the recording does.

    Attributes:
        score_s: (K,) rising.
        bent_s: (K,) rising.
    """

    score_s: Times
    bent_s: Times

    def bend(self, score_s: Times) -> Times:
        """Score time to bent time."""
        return np.interp(score_s, self.score_s, self.bent_s)

    def straighten(self, bent_s: Times) -> Times:
        """Bent time to score time."""
        return np.interp(bent_s, self.bent_s, self.score_s)


@dataclass(frozen=True, eq=False)
class Stretch:
    """A stretch in which both go on together.

    Attributes:
        song_s: (P,) places of the recording, rising.
        score_s: (P,) where the score is at them, never falling.
    """

    song_s: Times
    score_s: Times

    def straightened(self, bent: BentTime) -> "Stretch":
        """The same with the score's own time, where that of this one is bent."""
        return Stretch(self.song_s, bent.straighten(self.score_s))


def stretches_of(path: Path, frame_s: float, *, centred: bool) -> list[Stretch]:
    """Cut a path where it jumps, and leave out what is too short.

    Args:
        path: Of frames of equal length in both.
        frame_s: That length.
        centred: Whether frame k stands for the middle of what begins at k * frame_s, or for that place.
    """
    rows = np.flatnonzero(path.at != UNHEARD)
    if not len(rows):
        return []
    at = path.at[rows]
    shift = 0.5 if centred else 0.0
    skipped_song = (np.diff(rows) - 1) * frame_s
    skipped_score = (np.diff(at) - LARGEST_STEP) * frame_s
    cuts = np.flatnonzero(np.maximum(skipped_song, skipped_score) > SMALLEST_GAP_S) + 1
    found: list[Stretch] = []
    song_s: Times = (rows.astype(np.float64) + shift) * frame_s
    score_s: Times = (at.astype(np.float64) + shift) * frame_s
    for pieces in zip(np.split(song_s, cuts), np.split(score_s, cuts), strict=True):
        stretch = Stretch(*pieces)
        if stretch.score_s[-1] - stretch.score_s[0] >= SHORTEST_S:
            found.append(stretch)
    return found


def bend_as_a_whole(stretches: list[Stretch], score_duration_s: float) -> BentTime:
    """Bend a score's time to the median tempo of stretches."""
    _, slopes = _tempos(stretches)
    whole_s = score_duration_s + 2 * GRID_S
    return BentTime(np.array([0.0, whole_s]), np.array([0.0, whole_s * float(np.median(slopes))]))


def bend_to(stretches: list[Stretch], score_duration_s: float) -> BentTime:
    """Bend a score's time to the tempo of stretches; where none is, to that of those beside."""
    places, slopes = _tempos(stretches)
    grid = np.arange(0.0, score_duration_s + 2 * GRID_S, GRID_S)
    slope = np.interp(grid, places, slopes)
    return BentTime(grid, np.concatenate(([0.0], np.cumsum(slope[:-1] * GRID_S))))


def _tempos(stretches: list[Stretch]) -> tuple[Times, Times]:
    """Places of the score, and how long a second of it lasts there."""
    places: list[Times] = []
    slopes: list[Times] = []
    for stretch in stretches:
        reach = SLOPE_REACH_S
        centres = np.arange(stretch.song_s[0], stretch.song_s[-1] + GRID_S, 0.5)
        low, high = (
            np.maximum(centres - reach, stretch.song_s[0]),
            np.minimum(centres + reach, stretch.song_s[-1]),
        )
        passed = np.interp(high, stretch.song_s, stretch.score_s) - np.interp(
            low, stretch.song_s, stretch.score_s
        )
        slopes.append(np.clip((high - low) / np.maximum(passed, 1e-3), SLOWEST, FASTEST))
        places.append(np.interp(centres, stretch.song_s, stretch.score_s))
    return np.concatenate(places), np.concatenate(slopes)


def band_around(
    stretches: list[Stretch], bent: BentTime, *, rows: int, columns: int, frames_per_s: float, reach_s: float
) -> NDArray[np.int64]:
    """Which frames of the bent score are looked at, at each of the recording: (rows, 2), never falling."""
    times = np.arange(rows) / frames_per_s
    low = np.zeros(rows)
    high = np.full(rows, columns / frames_per_s)
    for number, stretch in enumerate(stretches):
        inside = (times >= stretch.song_s[0]) & (times <= stretch.song_s[-1])
        places = bent.bend(np.interp(times[inside], stretch.song_s, stretch.score_s))
        low[inside], high[inside] = places, places
        after = times > stretch.song_s[-1]
        low[after] = bent.bend(stretch.score_s[-1:])[0]
        before = times < stretch.song_s[0]
        if number:
            before &= times > stretches[number - 1].song_s[-1]
        high[before] = bent.bend(stretch.score_s[:1])[0]
    reach = round(reach_s * frames_per_s)
    earlier = np.concatenate((np.full(reach, low[0]), low))[:rows]
    later = np.concatenate((high, np.full(reach, high[-1])))[reach:]
    edges = np.stack((earlier * frames_per_s - reach, later * frames_per_s + reach), axis=1)
    edges = np.maximum.accumulate(edges, axis=0)
    band = np.clip(np.rint(edges), (0, 1), (columns - 1, columns)).astype(np.int64)
    band[:, 1] = np.maximum(band[:, 1], band[:, 0] + 1)
    return band
