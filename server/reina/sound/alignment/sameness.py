"""Whether a recording is the music of a score at all.

Any two pieces of music have something in common, most of all when one may be played in any key. So what the
way through both earns is held against what the same score earns in the other keys, where it is other music.
"""

from collections.abc import Sequence

import numpy as np

from reina.sound.alignment.bands import Floats
from reina.sound.alignment.features import activity
from reina.sound.alignment.path import Path

LEAST = 0.24
"""Sameness from which on it is the same music, as bench_alignment.py measures it."""
OUTSTANDING = 0.03
"""What each deviation counts by which the best key stands out from the others, beyond the usual three."""
USUAL_DEVIATIONS, MOST_DEVIATIONS = 3.0, 20.0
MUCH = 0.8
"""No recording of other music earns so much."""
USUAL_CONFIDENCE = 0.6
CONFIDENCE = 0.3
SOUNDS = 0.5
"""A frame is of music and not of silence from this activity on."""


def earned_share(path: Path, recording: Floats, score: Floats) -> float:
    """What a path earns by the frame of music, of the shorter of both."""
    shorter = min(int((activity(features) > SOUNDS).sum()) for features in (recording, score))
    return path.reward / max(shorter, 1)


def sameness(earned: float, in_all_keys: Sequence[float], confidence: float) -> float:
    """How much more recording and score have in common than music has by chance.

    Args:
        earned: What the finest path earns, as `earned_share` says.
        in_all_keys: What the coarse path earns in each key.
        confidence: How clearly notes begin where they are thought to, 0..1.
    """
    keys = np.sort(np.asarray(in_all_keys))
    others = keys[:-1]
    deviations = (keys[-1] - others.mean()) / max(float(others.std()), 1e-3)
    beside_others = (
        earned
        - float(np.median(keys))
        + OUTSTANDING * (min(deviations, MOST_DEVIATIONS) - USUAL_DEVIATIONS)
        + CONFIDENCE * (confidence - USUAL_CONFIDENCE)
    )
    # A scale is like itself in every key; what earns so much by itself needs no comparison.
    return max(beside_others, earned - MUCH)
