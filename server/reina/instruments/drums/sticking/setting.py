"""What is preferred at each beat of a part."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.hit import PIECES
from reina.instruments.drums.sticking.beat import Setting
from reina.instruments.drums.sticking.habits import CROSS_STICK, IN_GROOVE, IN_RUN
from reina.instruments.drums.sticking.rolls import find_rolls
from reina.instruments.drums.sticking.runs import lead, runs_of
from reina.instruments.drums.sticking.timekeeping import find_groove, find_timekeeping, share_fast_hats

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.sticking.beat import Beat
    from reina.instruments.drums.sticking.figures import Rudiment

_GROOVE: Final = [IN_GROOVE[piece] for piece in PIECES]
_RUN: Final = [IN_RUN[piece] for piece in PIECES]


def setting_of(beats: Sequence[Beat], named: Sequence[Rudiment | None]) -> Setting:
    """Find what goes on at each beat.

    Args:
        beats: What the hands strike.
        named: Of each beat the rudiment that a part's name or a marker asks for.
    """
    count = len(beats)
    keeps = find_timekeeping(beats)
    in_groove = find_groove(beats, keeps)
    setting = Setting(
        np.zeros((count, 2)),
        ["groove"] * count,
        [None] * count,
        np.zeros(count),
        np.zeros(count, dtype=np.int64),
    )
    for index, beat in enumerate(beats):
        if beat.is_both:
            continue
        table = _GROOVE if in_groove[index] or keeps[index] else _RUN
        setting.cost[index] = CROSS_STICK if beat.is_cross_stick else table[beat.pieces[0]]
    share_fast_hats(beats, keeps, setting)
    for run in runs_of(beats, keeps, in_groove):
        lead(beats, run, setting)
    find_rolls(beats, named, setting)
    return setting
