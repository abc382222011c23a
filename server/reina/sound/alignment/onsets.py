"""Where each note begins in the recording, to a few milliseconds: a chain through what rises nearby."""

import numpy as np
from numpy.typing import NDArray

from reina.sound.alignment.bands import BANDS, LOWEST_PITCH, Floats
from reina.sound.alignment.score_bands import Times

FRAMES_PER_S = 200
WINDOW_S = 0.043
REACH = 26
"""How far from where the path has it a note is looked for, frames on either side: 130 ms."""
HEARD_OVERTONES = ((0, 1.0), (12, 0.6), (19, 0.5), (24, 0.4))
SAME_TIME_S = 0.02
"""Notes nearer than this begin together."""
FIRM_S, LOOSE_PER_S = 0.012, 0.08
"""How far a note may move against the one before it at the price of one: some milliseconds, and more the
later it follows (a share of what lies between)."""
HALF = 0.25
FROM_HALF = 2.5
EVIDENCE = 3.0
"""Price of no rise at all where the strongest is near."""
FAR = 0.6
"""Price of the edge of what is looked at."""


def chords_of(onset_s: Times) -> NDArray[np.int64]:
    """The first note of each chord, indices: notes that begin together, of (N,) onsets that never fall."""
    firsts: list[int] = []
    for index, onset in enumerate(onset_s.tolist()):
        if not firsts or onset - onset_s[firsts[-1]] > SAME_TIME_S:
            firsts.append(index)
    return np.array(firsts, dtype=np.int64)


def scaled_rises(risen: Floats) -> Floats:
    """Rises beside those that are usual in their band, 2 at most; what is given is overwritten."""
    risen /= np.percentile(risen, 99, axis=0) + np.float32(1e-3 * risen.max() + 1e-9)
    return np.minimum(risen, 2, out=risen)


def refine_onsets(
    scaled: Floats, expected_s: Times, pitches: list[NDArray[np.int64]], unpitched: NDArray[np.bool_]
) -> tuple[Times, Times]:
    """Place chords where something begins, none far from its neighbours' displacement.

    Args:
        scaled: (F, BANDS) of `scaled_rises`, at FRAMES_PER_S.
        expected_s: (G,) where the path has each chord, rising.
        pitches: Of each chord, as they sound; drums left out.
        unpitched: (G,) whether drums are in it too.

    Returns:
        (G,) where they begin, and (G,) how clearly, 0..1.
    """
    broad = scaled.mean(axis=1)
    offsets = np.arange(-REACH, REACH + 1)
    evidence = np.empty((len(expected_s), len(offsets)))
    whole = len(scaled)
    for chord, (expected, sounding) in enumerate(zip(expected_s.tolist(), pitches, strict=True)):
        frames = np.clip(np.rint(expected * FRAMES_PER_S).astype(int) + offsets, 0, whole - 1)
        found = np.zeros(len(offsets))
        for semitones, strength in HEARD_OVERTONES:
            bands = sounding + semitones - LOWEST_PITCH
            bands = bands[(bands >= 0) & (bands < BANDS)]
            if len(bands):
                found += strength * scaled[frames][:, bands].mean(axis=1)
        if unpitched[chord] or not len(sounding):
            found += 2 * broad[frames]
        evidence[chord] = found
    # Beside the strongest of its own surroundings, but not where there is nothing at all.
    strongest = evidence.max(axis=1)
    usual = np.median(strongest) if len(strongest) else 1.0
    clarity = np.clip(strongest / max(usual, 1e-9), 0, 1)
    prices = EVIDENCE * clarity[:, None] * (1 - evidence / np.maximum(strongest, 1e-9)[:, None])
    prices += FAR * (offsets / REACH) ** 2
    chosen = _cheapest_chain(prices, offsets / FRAMES_PER_S, expected_s)
    placed = np.rint(expected_s * FRAMES_PER_S) + offsets[chosen] + _begins(evidence, chosen)
    peak = evidence[np.arange(len(chosen)), chosen] / np.maximum(strongest, 1e-9)
    contrast = 1 - evidence.mean(axis=1) / np.maximum(strongest, 1e-9)
    return placed / FRAMES_PER_S, clarity * peak * np.clip(contrast * 1.5, 0, 1)


def _cheapest_chain(prices: Times, offsets_s: Times, expected_s: Times) -> NDArray[np.int64]:
    """Which offset of each chord, so that prices and displacements against one another cost least."""
    moved = np.abs(offsets_s[:, None] - offsets_s)
    total = prices[0] if len(prices) else np.zeros(len(offsets_s))
    sources: list[NDArray[np.int64]] = []
    for chord in range(1, len(prices)):
        between = expected_s[chord] - expected_s[chord - 1]
        reached = total + moved / (FIRM_S + LOOSE_PER_S * between)
        source = reached.argmin(axis=1)
        sources.append(source)
        total = reached[np.arange(len(source)), source] + prices[chord]
    chosen = np.empty(len(prices), dtype=np.int64)
    if len(prices):
        chosen[-1] = total.argmin()
    for chord in range(len(prices) - 2, -1, -1):
        chosen[chord] = sources[chord][chosen[chord + 1]]
    return chosen


def _begins(evidence: Times, chosen: NDArray[np.int64]) -> Times:
    """How many frames from the chosen one what rises there has risen half as fast as at its fastest.

    A slow attack rises fastest long after the note begins.
    """
    begins = np.zeros(len(chosen))
    for chord, at in enumerate(chosen.tolist()):
        row = evidence[chord].tolist()
        half = HALF * row[at]
        place = at
        while place > 0 and row[place - 1] > half:
            place -= 1
        if place > 0 and row[place] > row[place - 1]:
            begins[chord] = place - (row[place] - half) / (row[place] - row[place - 1]) - at
    return begins + FROM_HALF
