"""What may come of a score file all the way: read, ranked, played, described, planned as sound, staged."""

from __future__ import annotations

import json
import zlib
from functools import cache
from pathlib import Path

import numpy as np
from tests.unit.music.score_checks import check_score

from reina.errors import InputError
from reina.instruments import INSTRUMENTS, Cast, Casting, describe_score
from reina.music import DEFAULT_LIMITS, Limits, Score
from reina.sessions.production import Production
from reina.sessions.stage import Stage
from reina.sound.plan import LONGEST_S, PlayedParts, SoundPlan, plan_sound

RIGS = Path(__file__).parents[3] / "rigs"
STAGED_OF = 512
"""One file of so many is staged with a player, which takes most of the time."""


@cache
def stage() -> Stage:
    """Players and instrument, loaded once."""
    return Stage.load(RIGS)


def check_score_played(data: bytes, *, limits: Limits = DEFAULT_LIMITS) -> bool:
    """Do with a file what a session does with it; False if the reader refuses it.

    How it is played is told by the file's bytes, so that one file always is played in one way.

    Raises:
        AssertionError: Something that comes of it is wrong.
        Exception: Anything but the readers' own errors: a fault of ours.
    """
    score = check_score(data, limits=limits)
    if score is None:
        return False
    choice = zlib.crc32(data)
    trumpet = INSTRUMENTS["trumpet"]
    rankings = trumpet.rank_parts(score)
    assert sorted(ranking.part for ranking in rankings) == list(range(len(score.parts)))
    best = rankings[0].part
    joined = tuple(
        ranking.part for ranking in rankings[1:3] if choice & 1 and not score.parts[ranking.part].is_drums
    )
    if score.parts[best].is_drums:
        joined = ()
    played = trumpet.play(
        score,
        best,
        (choice >> 3) % 25 - 12,
        written=bool(choice & 2),
        octave_fit=bool(choice & 4),
        joined_parts=joined,
    )
    assert np.all(played.line.end_s > played.line.onset_s)
    assert np.all(played.line.onset_s[1:] >= played.line.end_s[:-1])
    described = describe_score(score, trumpet, played, rankings=rankings)
    assert json.dumps(described, ensure_ascii=False, allow_nan=False).encode()
    _check_sound(score, best, joined, played.transposition)
    if choice % STAGED_OF == 0:
        _check_staged(score, best, joined)
    return True


def _check_sound(score: Score, part: int, joined: tuple[int, ...], transposition: int) -> None:
    try:
        plan = plan_sound(score, [PlayedParts((part, *joined), transposition)])
    except InputError as error:
        told = error.detail
    else:
        _check_plan(score, plan)
        return
    assert score.duration_s > LONGEST_S or "no note of the score is a pitch" in told


def _check_plan(score: Score, plan: SoundPlan) -> None:
    notes, controls = plan.notes, plan.controls
    assert 0 < len(notes) <= len(score.notes)
    assert np.all(notes["off"] > notes["on"])
    assert np.all(np.diff(notes["on"].astype(np.int64)) >= 0)
    assert np.all(np.diff(controls["tick"].astype(np.int64)) >= 0)


def _check_staged(score: Score, part: int, joined: tuple[int, ...]) -> None:
    """Plan a performance with its default show, and evaluate its first and its last second."""
    production = Production.plan(stage(), score, cast=Cast((Casting(part=part, joined_parts=joined),)))
    json.dumps(production.show.to_document(), ensure_ascii=False, allow_nan=False).encode()
    for block in {0, int(score.duration_s)}:
        frames = production.performance.evaluate(block)
        assert np.all(np.isfinite(frames.rotations))
        assert np.all(np.isfinite(frames.root_positions))
        assert np.all(np.isfinite(frames.parameters))
