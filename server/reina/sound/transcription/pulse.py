"""The beats that a line of notes is played to, as far as its onsets tell."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.sound.alignment.beats import fit_beats

if TYPE_CHECKING:
    from numpy.typing import NDArray

GRID_S = 0.01
"""Beats are looked for on a grid of so many seconds, and put between its places afterwards."""
ONSET_WIDTH_S = 0.02
LONGEST_WEIGHT_S = 1.0
"""A note weighs the more, the longer it is until the next, up to this."""
FASTEST_S, SLOWEST_S = 0.3, 1.2
USUAL_S, USUAL_OCTAVES = 0.55, 0.8
"""Most beats last about so long; one of twice or half of that has to be clearer."""
ECHOES = ((1, 1.0), (2, 0.6), (3, 0.3), (4, 0.4))
"""Onsets so many beats apart speak for a beat, so much."""
STEADINESS = 60.0
FEWEST_NOTES = 8
SUBDIVISIONS = (1, 2, 3, 4)
FINER_COST = 0.03
"""An onset is taken for one of a finer division only where that is nearer by so many beats for each step."""
UNCLEAR = 0.105
"""Four times the mean distance of onsets from what they are taken for, in beats. Of onsets by chance it is
0.09 to 0.16, of the examples' solos, played 10 ms off, at most 0.10."""
DEFAULT_BEAT_S = 0.5
BARS = (4, 3)
BAR_LEAD = 1.1
"""A bar of three beats has to be clearer than one of four by this."""


@dataclass(frozen=True, eq=False)
class Pulse:
    """Beats, and how they make bars.

    Attributes:
        beats_s: (K,) ascending seconds, from 0 or after it to after the last note's end; the first is not
            later than the first onset.
        bar_beats: How many make a bar.
        pickup_beats: How many stand before the first bar line.
        is_clear: False where the onsets tell no beat: then there are 120 a minute.
    """

    beats_s: NDArray[np.float64]
    bar_beats: int
    pickup_beats: int
    is_clear: bool


def find_pulse(onset_s: NDArray[np.float64], end_s: float) -> Pulse:
    """Find the beats of a line.

    Args:
        onset_s: (N,) where its notes begin, ascending, 0 or later; one at least.
        end_s: Where the last note ends.
    """
    lengths = np.diff(onset_s, append=max(end_s, float(onset_s[-1]) + GRID_S))
    weight = 0.3 + np.minimum(lengths, LONGEST_WEIGHT_S)
    if len(onset_s) >= FEWEST_NOTES:
        beats = _tracked(onset_s, weight, end_s)
        beats, onset_beats, is_clear = _smoothed(beats, onset_s, end_s)
        if is_clear:
            bar, phase = _bars(onset_beats, lengths)
            return _begun(beats, float(onset_s[0]), bar, phase, is_clear=True)
    count = int((end_s - onset_s[0]) / DEFAULT_BEAT_S) + 2
    return _begun(onset_s[0] + DEFAULT_BEAT_S * np.arange(count), float(onset_s[0]), 4, 0, is_clear=False)


def _tracked(onset_s: NDArray[np.float64], weight: NDArray[np.float64], end_s: float) -> NDArray[np.float64]:
    """Beats through the onsets (Ellis, "Beat tracking by dynamic programming", 2007)."""
    times = np.arange(0.0, end_s + 2 * SLOWEST_S, GRID_S)
    strength = np.zeros(len(times))
    reach = round(4 * ONSET_WIDTH_S / GRID_S)
    for at_s, mass in zip(onset_s.tolist(), weight.tolist(), strict=True):
        place = round(at_s / GRID_S)
        near = slice(max(0, place - reach), place + reach + 1)
        strength[near] += mass * np.exp(-0.5 * ((times[near] - at_s) / ONSET_WIDTH_S) ** 2)
    beat = _usual_beat(strength) / GRID_S
    steps = np.arange(round(beat / 1.6), round(beat * 1.6) + 1)
    cost = STEADINESS * float(np.mean(weight)) * 0.1 * np.log(steps / beat) ** 2
    earned = strength.copy()
    before = np.full(len(times), -1)
    for place in range(steps[0], len(times)):
        usable = steps[steps <= place]
        ways = earned[place - usable] - cost[: len(usable)]
        best = int(np.argmax(ways))
        if ways[best] > 0:
            earned[place] += ways[best]
            before[place] = place - usable[best]
    last = round(float(onset_s[-1]) / GRID_S)
    near = slice(max(0, last - round(beat / 2)), last + round(beat / 2) + 1)
    place = near.start + int(np.argmax(earned[near]))
    beats: list[float] = []
    while place >= 0:
        beats.append(place * GRID_S)
        place = int(before[place])
    return np.array(beats[::-1])


def _usual_beat(strength: NDArray[np.float64]) -> float:
    """The length of a beat in seconds, for most of a line."""
    size = 2 * len(strength)
    alike = np.fft.irfft(np.abs(np.fft.rfft(strength, size)) ** 2, size)[: len(strength)]
    lengths = np.arange(FASTEST_S, SLOWEST_S, GRID_S / 4)
    places = lengths / GRID_S
    clear = sum(
        share * np.interp(places * times, np.arange(len(alike)), alike, right=0.0) for times, share in ECHOES
    )
    usual = np.exp(-0.5 * (np.log2(lengths / USUAL_S) / USUAL_OCTAVES) ** 2)
    return float(lengths[np.argmax(np.asarray(clear) * usual)])


def _smoothed(
    beats: NDArray[np.float64], onset_s: NDArray[np.float64], end_s: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], bool]:
    """Beats moved to go smoothly through onsets; the onsets in beats, as they are meant; if that is clear."""
    usual = float(np.median(np.diff(beats))) if len(beats) > 1 else DEFAULT_BEAT_S
    beats = _reaching(beats, usual, float(onset_s[0]), max(end_s, float(onset_s[-1])) + usual)
    numbers = np.arange(len(beats), dtype=np.float64)
    meant, off = _meant(np.interp(onset_s, beats, numbers))
    for again in (True, False):
        beats = fit_beats(numbers, meant, onset_s, np.ones(len(onset_s)))
        beats = beats + np.arange(len(beats)) * 1e-9
        if again:
            meant, off = _meant(np.interp(onset_s, beats, numbers))
    return beats, meant, bool(np.mean(off) < UNCLEAR)


def _reaching(beats: NDArray[np.float64], usual: float, from_s: float, until_s: float) -> NDArray[np.float64]:
    before = int(np.ceil(max(0.0, beats[0] - from_s) / usual - 0.25))
    after = int(np.ceil(max(0.0, until_s - beats[-1]) / usual)) + 1
    return np.concatenate(
        (
            beats[0] - usual * np.arange(before, 0, -1),
            beats,
            beats[-1] + usual * np.arange(1, after + 1),
        )
    )


def _meant(played: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Onsets on the divisions of a beat that they are nearest to, and four times how far off they are."""
    whole = np.floor(played)
    best = np.full(len(played), np.inf)
    meant = played.copy()
    for division in SUBDIVISIONS:
        place = whole + np.round((played - whole) * division) / division
        distance = np.abs(played - place) + FINER_COST * division
        nearer = distance < best
        best, meant = np.where(nearer, distance, best), np.where(nearer, place, meant)
    return meant, 4 * np.abs(played - meant)


def _bars(onset_beats: NDArray[np.float64], lengths: NDArray[np.float64]) -> tuple[int, int]:
    """How many beats make a bar, and which beat is the first of one: where long notes begin."""
    beats = np.round(onset_beats).astype(int)
    on_beat = np.abs(onset_beats - beats) < 1e-6
    accent = np.zeros(int(beats.max(initial=0)) + 1)
    np.add.at(accent, beats[on_beat], np.minimum(lengths[on_beat], 2 * LONGEST_WEIGHT_S))
    first = int(beats[0])
    found: list[tuple[float, int, int]] = []
    for bar in BARS:
        sums = [float(np.mean(accent[phase::bar])) if phase < len(accent) else 0.0 for phase in range(bar)]
        # Where two are alike, the bar begins with the music.
        sums[first % bar] *= 1.05
        phase = int(np.argmax(sums))
        others = np.mean([each for index, each in enumerate(sums) if index != phase])
        found.append((sums[phase] / max(1e-9, float(others)), bar, phase))
    four, three = found
    return (three if three[0] > BAR_LEAD * four[0] else four)[1:]


def _begun(beats: NDArray[np.float64], first_s: float, bar: int, phase: int, *, is_clear: bool) -> Pulse:
    """Beats from the first that is wanted on: not before 0, and none that is later than the first note."""
    begin = max(0, int(np.searchsorted(beats, first_s + GRID_S, side="right")) - 1)
    while begin > 0 and beats[begin] < 0:
        begin += 1
    kept = beats[begin:].copy()
    # The first note is never before the first beat, nor this before the recording.
    kept[0] = max(0.0, min(float(kept[0]), first_s))
    return Pulse(kept, bar, (phase - begin) % bar, is_clear)
