"""How far two parts of a score play together: in unison, or only where the other rests."""

import numpy as np

from reina.music.arrays import FloatArray
from reina.music.notes import Notes

TOGETHER_S = 0.06
"""Notes whose onsets are no further apart are struck together: players and humanised files are no nearer."""


def unison_share(notes: Notes, other: Notes) -> float:
    """Which share of some notes another part has too: at the same time, at the same pitch.

    Args:
        notes: (N,) whose share is asked for.
        other: (M,) the other part's.
    """
    if not len(notes) or not len(other):
        return 0.0
    # One number a note: pitches so far apart that no two of different pitch come near to each other.
    apart_s = float(max(notes.end_s.max(), other.end_s.max())) + 1.0
    sought = notes.sounding_pitch * apart_s + notes.onset_s
    found = np.sort(other.sounding_pitch * apart_s + other.onset_s)
    after = np.searchsorted(found, sought)
    nearest = np.minimum(
        np.abs(found[np.minimum(after, len(found) - 1)] - sought),
        np.abs(found[np.maximum(after - 1, 0)] - sought),
    )
    return float(np.mean(nearest <= TOGETHER_S))


def overlap_share(notes: Notes, other: Notes) -> float:
    """Which share of the time in which some notes sound the other part sounds too, 0..1.

    Args:
        notes: (N,) whose share is asked for.
        other: (M,) the other part's.
    """
    if not len(notes) or not len(other):
        return 0.0
    edges_s, sounding_s = _sounding(other)
    heard_s = np.interp(notes.end_s, edges_s, sounding_s) - np.interp(notes.onset_s, edges_s, sounding_s)
    return float(heard_s.sum() / notes.duration_s.sum())


def _sounding(notes: Notes) -> tuple[FloatArray, FloatArray]:
    """For how long a part has sounded by some times, linear in between: (2 K,) times, (2 K,) durations."""
    until = np.maximum.accumulate(notes.end_s)
    first = np.concatenate([[True], notes.onset_s[1:] > until[:-1]])
    onset_s = notes.onset_s[first]
    end_s = until[np.concatenate([first[1:], [True]])]
    sounding_s = np.cumsum(end_s - onset_s)
    edges_s = np.column_stack([onset_s, end_s]).ravel()
    return edges_s, np.column_stack([sounding_s - (end_s - onset_s), sounding_s]).ravel()
