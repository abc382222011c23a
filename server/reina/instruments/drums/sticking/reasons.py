"""Why a hit is played with the hand that plays it, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from reina.instruments.drums.hit import PIECES, SPOKEN
from reina.instruments.drums.sticking.habits import FASTEST_SINGLES, LEFT, RIGHT, TIMEKEEPERS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.sticking.beat import Beat, Setting
    from reina.instruments.drums.sticking.cheapest_way import Sticking

SIDES: Final = ("right", "left")

NEAR_S: Final = 0.62
"""Strokes that are farther apart are not said to alternate."""


@dataclass(frozen=True, eq=False)
class Neighbours:
    """What the beats of a part are, what goes on there, and which hands were chosen."""

    beats: Sequence[Beat]
    setting: Setting
    sticking: Sticking


def why_hand(neighbours: Neighbours, index: int, side: int) -> str:
    """Say why a hand strikes at a beat.

    Args:
        neighbours: The part.
        index: Which beat.
        side: Which hand: 0 right, 1 left.
    """
    beats, setting, sticking = neighbours.beats, neighbours.setting, neighbours.sticking
    beat, hand = beats[index], SIDES[side]
    piece = PIECES[int(sticking.pieces[index, side])]
    on = SPOKEN[piece]
    if setting.place[index] == "written":
        return f"{hand}: so it is written"
    rudiment = setting.rudiment[index]
    if rudiment is not None:
        return f"{hand}: {rudiment.name}, {rudiment.hands}"
    if len(beat.hits) > 1:
        other = SPOKEN[PIECES[int(sticking.pieces[index, 1 - side])]]
        return f"{hand} on {on}, as the {SIDES[1 - side]} hand is on {other}"
    gap = beat.onset_s - beats[index - 1].onset_s if index else float("inf")
    before = int(sticking.hand[index - 1]) if index else -1
    if setting.place[index] == "roll" and before != side:
        return f"{hand}: a roll of doubles, as it is too fast for single strokes"
    if before == side and gap <= 0.1:
        rate = f"{1.0 / gap:.0f} a second"
        if 1.0 / gap > FASTEST_SINGLES:
            return f"{hand}: double, as {rate} is too fast for single strokes"
        return f"{hand}: double, one motion with two strokes"
    if beat.is_cross_stick:
        return f"{hand}: the cross-stick lies in the left hand" if side == LEFT else f"{hand}: cross-stick"
    if setting.place[index] == "fast hat" and before == 1 - side:
        rate = f" at {1.0 / gap:.0f} a second" if gap < 1.0 else ""
        return f"{hand}: the hands share the hi-hat{rate}"
    if piece in TIMEKEEPERS and side == RIGHT:
        return f"right leads on {on}"
    if setting.place[index] == "run" and 1 - side == before and gap <= NEAR_S:
        return f"{hand} alternates"
    if setting.place[index] == "run":
        first = index == 0 or setting.place[index - 1] != "run" or gap > NEAR_S
        return f"{hand} begins the run" if first else f"{hand}: natural sticking, as the beat falls"
    if piece == "snare" and side == LEFT:
        return "left keeps the snare while the right keeps the time"
    if setting.cost[index, side] <= setting.cost[index, 1 - side]:
        return f"{hand}: usual on {on}"
    if 1 - side == before:
        return f"{hand} on {on}, as the {SIDES[1 - side]} hand has just struck"
    return f"{hand} on {on}: the shorter way"
