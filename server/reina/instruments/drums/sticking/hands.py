"""The hands of a whole part: grace notes, what is struck at once, sticking, and what no two hands can do."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.hit import PIECES, SPOKEN
from reina.instruments.drums.sticking.beat import FORCED, Beat, Setting
from reina.instruments.drums.sticking.cheapest_way import Sticking, stick
from reina.instruments.drums.sticking.figures import TRIPLES, Graces, find_graces
from reina.instruments.drums.sticking.habits import (
    BOUNCE_S,
    DISTANCE_M,
    HIGHEST_RATE,
    LEFT,
    REACH_S,
    RIGHT,
)
from reina.instruments.drums.sticking.reasons import Neighbours, why_hand
from reina.instruments.drums.sticking.setting import setting_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.sticking.figures import Rudiment
    from reina.instruments.drums.sticking.struck import Struck
    from reina.rotations.arrays import BoolArray, FloatArray, IntArray

AT_ONCE_S: Final = 0.012
"""Hits within this time are struck at once."""

FASTEST_M_S: Final = 8.0
"""Of a hand on its way between two pieces, at most and on average."""

SOONEST_GRACE_S: Final = 0.05
"""What a hand has at least between a stroke and a grace note."""

ROUNDS: Final = 8
"""How often the sticking is done anew without what could not be played."""

UNPLAYED: Final = -1


@dataclass(frozen=True, eq=False)
class Hands:
    """Which hand strikes each of N hits.

    Attributes:
        hand: (N,) 0 right, 1 left, -1 neither: it cannot be played.
        reasons: Of each hit.
        graces: Which of them are grace notes.
    """

    hand: IntArray
    reasons: tuple[str, ...]
    graces: Graces


def choose_hands(
    struck: Struck,
    kick_s: FloatArray,
    *,
    named: Sequence[Rudiment | None] = (),
    written: Sequence[int | None] = (),
) -> Hands:
    """Choose the hands of a part, right-handed.

    Args:
        struck: N hits, of hands alone.
        kick_s: When the bass drum is struck, seconds, ascending.
        named: Of each hit the rudiment that a name or a marker asks for; nothing if none does.
        written: Of each hit the hand that stands in the score: 0 right, 1 left, None; nothing if none does.
    """
    count = len(struck)
    graces = find_graces(struck)
    if not count:
        return Hands(np.zeros(0, dtype=np.int64), (), graces)
    hand = np.full(count, UNPLAYED, dtype=np.int64)
    reasons = [""] * count
    playable = graces.main < 0
    graced = np.bincount(graces.main[graces.main >= 0], minlength=count)
    beats, setting, sticking = _stick(struck, playable, graced, kick_s, named, written, reasons)
    for _ in range(ROUNDS):
        impossible = _impossible(struck, beats, setting, sticking, reasons)
        if not impossible:
            break
        playable[impossible] = False
        beats, setting, sticking = _stick(struck, playable, graced, kick_s, named, written, reasons)
    else:
        for hit in _impossible(struck, beats, setting, sticking, reasons):
            playable[hit] = False
    neighbours = Neighbours(beats, setting, sticking)
    for index, beat in enumerate(beats):
        for hit, side in zip(beat.hits, _hands_of(beat, sticking, index), strict=True):
            if playable[hit]:
                hand[hit] = side
                reasons[hit] = why_hand(neighbours, index, side)
    _strike_graces(struck, graces, hand, reasons)
    return Hands(hand, tuple(reasons), graces)


def _stick(
    struck: Struck,
    playable: BoolArray,
    graced: IntArray,
    kick_s: FloatArray,
    named: Sequence[Rudiment | None],
    written: Sequence[int | None],
    reasons: list[str],
) -> tuple[list[Beat], Setting, Sticking]:
    beats = _beats(struck, playable, graced, kick_s, reasons)
    setting = setting_of(beats, [named[beat.hits[0]] if named else None for beat in beats])
    if written:
        for index, beat in enumerate(beats):
            side = written[beat.hits[0]]
            if len(beat.hits) == 1 and side is not None:
                setting.cost[index] = 0.0
                setting.cost[index, 1 - side] = FORCED
                setting.place[index] = "written"
    return beats, setting, stick(beats, setting)


def _beats(
    struck: Struck, playable: BoolArray, graced: IntArray, kick_s: FloatArray, reasons: list[str]
) -> list[Beat]:
    """Gather what is struck at once; of more than two the softest are left out."""
    at: list[float] = struck.onset_s.tolist()
    pieces: list[int] = struck.piece.tolist()
    loud: list[float] = struck.velocity.tolist()
    kicks_before = np.searchsorted(kick_s, struck.onset_s + AT_ONCE_S).tolist()
    chosen: list[int] = np.flatnonzero(playable).tolist()
    beats: list[Beat] = []
    begin = 0
    kicks = 0
    while begin < len(chosen):
        end = begin + 1
        while end < len(chosen) and at[chosen[end]] - at[chosen[begin]] <= AT_ONCE_S:
            end += 1
        hits = chosen[begin:end]
        if len(hits) > 2:
            hits = _two_of(hits, pieces, loud)
            for hit in chosen[begin:end]:
                if hit not in hits:
                    reasons[hit] = "both hands are taken by what is louder at this time"
        first = hits[0]
        beats.append(
            Beat(
                onset_s=at[first],
                beat=float(struck.beat[first]),
                hits=tuple(hits),
                pieces=tuple(pieces[hit] for hit in hits),
                velocity=max(loud[hit] for hit in hits),
                is_cross_stick=len(hits) == 1 and bool(struck.is_cross_stick[first]),
                graces=int(max(graced[hit] for hit in hits)),
                after_kick=kicks_before[first] > kicks,
            )
        )
        kicks = kicks_before[first]
        begin = end
    return beats


def _two_of(hits: list[int], pieces: list[int], loud: list[float]) -> list[int]:
    """The two that are struck of more: one of each piece first, then the louder."""
    seen: set[int] = set()
    ranked: list[tuple[bool, float, int]] = []
    for hit in sorted(hits, key=lambda hit: -loud[hit]):
        ranked.append((pieces[hit] in seen, -loud[hit], hit))
        seen.add(pieces[hit])
    return sorted(hit for _, _, hit in sorted(ranked)[:2])


def _hands_of(beat: Beat, sticking: Sticking, index: int) -> list[int]:
    """The hand of each of a beat's hits."""
    hand = int(sticking.hand[index])
    if len(beat.hits) == 1:
        return [hand]
    right = int(sticking.pieces[index, RIGHT])
    return [RIGHT, LEFT] if beat.pieces[0] == right else [LEFT, RIGHT]


def _impossible(
    struck: Struck, beats: Sequence[Beat], setting: Setting, sticking: Sticking, reasons: list[str]
) -> list[int]:
    """Hits that the hand which has them cannot do in time: of two the softer; their reasons are told."""
    last: list[tuple[int, int, bool] | None] = [None, None]
    impossible: list[int] = []
    for index, beat in enumerate(beats):
        for hit, side in zip(beat.hits, _hands_of(beat, sticking, index), strict=True):
            before = last[side]
            bounced = False
            if before is not None:
                other, other_index, was_bounce = before
                gap = float(struck.onset_s[hit] - struck.onset_s[other])
                same = struck.piece[hit] == struck.piece[other]
                bounced = bool(same and gap < 1.0 / HIGHEST_RATE)
                in_a_row = other_index == index - 1
                if bounced and setting.rudiment[index] is TRIPLES:
                    fault = ""
                elif bounced and (was_bounce or gap < BOUNCE_S[0] or not in_a_row):
                    fault = (
                        f"no hand strikes {SPOKEN[PIECES[struck.piece[hit]]]} again after {gap * 1000:.0f} ms"
                    )
                elif not same and gap < _way_s(int(struck.piece[other]), int(struck.piece[hit])):
                    fault = (
                        f"no hand gets from {SPOKEN[PIECES[struck.piece[other]]]} to "
                        f"{SPOKEN[PIECES[struck.piece[hit]]]} in {gap * 1000:.0f} ms"
                    )
                else:
                    fault = ""
                if fault:
                    softer = hit if struck.velocity[hit] <= struck.velocity[other] else other
                    if softer not in impossible:
                        impossible.append(softer)
                        reasons[softer] = fault
                    if softer == hit:
                        continue
            last[side] = (hit, index, bounced)
    return impossible


def _way_s(piece: int, other: int) -> float:
    return max(float(DISTANCE_M[piece, other]) / FASTEST_M_S + REACH_S, 1.0 / HIGHEST_RATE)


def _strike_graces(struck: Struck, graces: Graces, hand: IntArray, reasons: list[str]) -> None:
    """The other hand strikes a stroke's grace notes, if it is free."""
    played = np.flatnonzero(hand >= 0)
    own = [played[hand[played] == side] for side in (RIGHT, LEFT)]
    for grace in np.flatnonzero(graces.main >= 0).tolist():
        main = int(graces.main[grace])
        name = "drag" if graces.drag[grace] else "flam"
        if hand[main] < 0:
            reasons[grace] = f"the stroke of this {name} cannot be played"
            continue
        other = 1 - int(hand[main])
        if not _is_free(struck, own[other], grace):
            reasons[grace] = f"no hand is free for this grace note of a {name}"
            continue
        hand[grace] = other
        side, main_side = ("left", "right") if other == LEFT else ("right", "left")
        reasons[grace] = f"{side}: grace note of a {name}, before the {main_side} hand's stroke"


def _is_free(struck: Struck, strokes: IntArray, grace: int) -> bool:
    """Whether a hand that has strokes to make has the time for a grace note, and for the way there."""
    at, piece = struck.onset_s, struck.piece
    place = int(np.searchsorted(at[strokes], float(at[grace])))
    for stroke in strokes[max(0, place - 1) : place + 1].tolist():
        gap = abs(float(at[stroke] - at[grace]))
        if gap < max(SOONEST_GRACE_S, _way_s(int(piece[stroke]), int(piece[grace]))):
            return False
    return True
