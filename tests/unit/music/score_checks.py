"""What may come of a score file: a sound score, or the reader's own error."""

from __future__ import annotations

import numpy as np

from reina.music import DEFAULT_LIMITS, Limits, Score, ScoreError, read_score


def check_score(data: bytes, *, limits: Limits = DEFAULT_LIMITS) -> Score | None:
    """Read a file and check that what comes out is a score; None if it is refused."""
    try:
        score = read_score(data, limits=limits)
    except ScoreError as error:
        told = error
    else:
        _check_sound(score, limits)
        return score
    assert told.detail
    assert len(str(told)) < 2_000
    return None


def _check_sound(score: Score, limits: Limits) -> None:
    notes = score.notes
    assert len(notes) > 0
    assert np.all(np.diff(notes.onset_s) >= 0)
    assert np.all(
        np.isfinite(notes.onset_s) & np.isfinite(notes.duration_s) & np.isfinite(notes.duration_beats)
    )
    assert np.all(notes.onset_s >= 0)
    assert np.all(notes.duration_s > 0)
    assert np.all((notes.sounding_pitch >= 0) & (notes.sounding_pitch <= 127))
    assert np.all((notes.velocity >= 0) & (notes.velocity <= 1))
    assert set(notes.part.tolist()) == set(range(len(score.parts)))
    assert score.duration_s == float(np.max(notes.end_s)) <= limits.duration_s + 1
    assert len(score.metre_map.bar_lines(score.duration_beats)) <= limits.bars + 100
    np.testing.assert_allclose(
        score.tempo_map.seconds(notes.onset_beats), notes.onset_s, rtol=1e-9, atol=2e-3
    )
