"""Cymbals that a hand grips: where the end of a crash's note says so, and a hand is free."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.drum_part import Choke
from reina.instruments.drums.hit import HANDS, PIECES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.hit import Hand, Limb
    from reina.music.arrays import FloatArray, IntArray
    from reina.music.score import Score

CHOKED: Final = tuple(PIECES.index(piece) for piece in ("crash_left", "crash_right", "china", "splash"))

RINGS_S: Final = 0.8
"""Lengths of crashes say something where half of them are at least this."""

CUT_S: Final = (0.06, 0.5)
"""A crash that is then so short is choked."""

CUT_SHARE: Final = 0.5
"""And it is at most this part of the usual length."""

FREE_S: Final = (0.25, 0.25)
"""A hand grips a cymbal if it strikes nothing this long before and after."""

PRESSED: Final = 64
"""A key's pressure that grips the cymbal, as electronic kits send it."""

LONGEST_S: Final = 2.0
"""So long after the stroke a cymbal may be choked by a key's pressure."""


def find_chokes(
    score: Score, part: int, indices: IntArray, piece: IntArray, limbs: Sequence[Limb | None]
) -> tuple[tuple[Choke, ...], list[int]]:
    """Find the cymbals that are choked.

    Args:
        score: The score.
        part: Index of the part.
        indices: (M,) its notes.
        piece: (M,) what they strike, index into `PIECES`.
        limbs: With what.

    Returns:
        The chokes by time, and which of the M notes are choked.
    """
    notes = score.notes
    onset_s, length_s = notes.onset_s[indices], notes.duration_s[indices]
    crashes = np.flatnonzero(np.isin(piece, CHOKED))
    if not len(crashes):
        return (), []
    ends: dict[int, float] = {}
    usual = float(np.median(length_s[crashes]))
    if usual >= RINGS_S:
        cut = length_s[crashes]
        is_cut = (cut >= CUT_S[0]) & (cut <= min(CUT_S[1], CUT_SHARE * usual))
        ends = {int(hit): float(onset_s[hit] + length_s[hit]) for hit in crashes[is_cut]}
    for control in score.controls:
        if control.kind != "key_pressure" or control.value < PRESSED:
            continue
        if control.channel != score.parts[part].channel:
            continue
        own = crashes[notes.sounding_pitch[indices[crashes]] == control.number]
        before = own[(onset_s[own] < control.onset_s) & (control.onset_s - onset_s[own] <= LONGEST_S)]
        if len(before):
            ends.setdefault(int(before[-1]), control.onset_s)
    busy = {hand: onset_s[[hit for hit, limb in enumerate(limbs) if limb == hand]] for hand in HANDS}
    chokes: list[Choke] = []
    choked: list[int] = []
    for hit, at_s in sorted(ends.items(), key=lambda end: end[1]):
        struck_by = limbs[hit]
        if struck_by is None:
            continue
        # The hand that did not strike is nearer to free.
        right, left = HANDS
        order: tuple[Hand, Hand] = (left, right) if struck_by == right else (right, left)
        free: Hand | None = next((hand for hand in order if _is_free(busy[hand], at_s)), None)
        if free is not None:
            chokes.append(Choke(at_s, PIECES[int(piece[hit])], free))
            choked.append(hit)
    return tuple(chokes), choked


def _is_free(busy_s: FloatArray, at_s: float) -> bool:
    place = int(np.searchsorted(busy_s, at_s))
    before = at_s - float(busy_s[place - 1]) if place else np.inf
    after = float(busy_s[place]) - at_s if place < len(busy_s) else np.inf
    return before >= FREE_S[0] and after >= FREE_S[1]
