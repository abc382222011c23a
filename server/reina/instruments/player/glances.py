"""Players of a cast look at each other where somebody enters: gestures on the time axis, planned once.

A glance turns trunk, head and eyes to the other, the horn with them. All three together stay within what a
show may key (`pose_keys`): within that no lip leaves its mouthpiece, no hand and no foot its place.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.curves import Parameter
from reina.instruments.player.pose_keys import LARGEST_GAZE_RAD, LARGEST_TURN_RAD

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.curves import ParameterRegistry
    from reina.instruments.played import PlayedPart
    from reina.instruments.player.seats import Seat
    from reina.kinematics import Curve
    from reina.music.arrays import BoolArray
    from reina.rotations.arrays import FloatArray

GLANCE_PARAMETER = Parameter(
    path="player/glance",
    type="number",
    default=1.0,
    minimum=0.0,
    maximum=1.5,
    documentation="How far the player looks to the others as somebody enters; 0 keeps to the part.",
)
"""Of each player in a cast of several."""

ENTRY_REST_S = 1.0
"""Who has rested for so long enters; who has not goes on."""

TOGETHER_S = 0.25
"""Entries no further apart are one entry, of several."""

APART_S = 4.0
"""A player looks up again this long after the last time at the earliest."""

BEFORE_S, TURNING_S, LINGERING_S, RETURNING_S = 0.9, 0.35, 0.25, 0.5
"""A glance begins so long before an entry, takes so long, ends so long after it, and takes so long to end."""

SHARES = {"torso": 0.35, "head": 0.9, "eyes": 0.9}
"""How much of its bound each turns by at most, at amount 1."""

WHILE_PLAYING = {"torso": 0.0, "head": 0.35, "eyes": 0.9}
"""By what share who plays meanwhile does so: with the eyes above all."""

BOUNDS_RAD = {
    "torso": LARGEST_TURN_RAD["torso"],
    "head": LARGEST_TURN_RAD["head"],
    "eyes": LARGEST_GAZE_RAD["left"],
}

CURVES = tuple(f"glance/{name}" for name in SHARES)
"""Turns to the left, radians, at amount 1."""


def plan_glances(played: Sequence[PlayedPart], seats: Sequence[Seat]) -> tuple[dict[str, Curve], ...]:
    """Plan who looks at whom, and when.

    Before every entry those who enter look at each other, and who rests looks at who enters; so does who
    plays, with the eyes.

    Args:
        played: Each player's part as it is played, in the cast's order.
        seats: Where each stands.

    Returns:
        For each player the `CURVES`; none where one plays alone.
    """
    if len(played) < 2:
        return tuple({} for _ in played)
    sounding = [_sounding(one) for one in played]
    entries = _entries([onset[_enters(onset, end)] for onset, end in sounding])
    return tuple(_curves(_glances(player, entries, sounding, seats)) for player in range(len(played)))


def add_glances(
    keyed: dict[str, FloatArray], glances: FloatArray, amount: FloatArray
) -> dict[str, FloatArray]:
    """Signals of a body with glances over what a show keys, within the bounds of what it may key.

    Args:
        keyed: Signals of `PoseKeys.read`, ``(F,)`` each.
        glances: The `CURVES`, ``(3, F)``.
        amount: How much of them, ``(F,)``.
    """
    torso, head, eyes = glances * amount
    turned = dict(keyed)
    for name, turn in (("torso", torso), ("head", head)):
        bow, tip = keyed[f"{name}_bow"], keyed[f"{name}_tip"]
        room = np.sqrt(np.maximum(BOUNDS_RAD[name] ** 2 - bow * bow - tip * tip, 0.0))
        # What is keyed is within the bounds already, whatever rounding says of what is left beside it.
        room = np.maximum(room, np.abs(keyed[f"{name}_turn"]))
        turned[f"{name}_turn"] = np.minimum(np.maximum(keyed[f"{name}_turn"] + turn, -room), room)
    bound = BOUNDS_RAD["eyes"]
    turned["eyes_left"] = np.minimum(np.maximum(keyed["eyes_left"] + eyes, -bound), bound)
    return turned


class GlanceAmount:
    """Reads how much of a player's glances a show wants.

    Args:
        registry: The show's parameters; where it has not this one, it stays at its default.
        prefix: What the player's paths begin with.
    """

    def __init__(self, registry: ParameterRegistry, prefix: str = "") -> None:
        place = registry.layout().get(prefix + GLANCE_PARAMETER.path)
        self._column = None if place is None else place[0]

    def read(self, values: FloatArray) -> FloatArray:
        """The amount ``(F,)`` from values ``(F, P)``; never below 0."""
        if self._column is None:
            return np.ones(len(values))
        return np.maximum(values[:, self._column], 0.0)


def _sounding(played: PlayedPart) -> tuple[FloatArray, FloatArray]:
    """Where the notes that are played begin and end."""
    playable = played.fingering.playable
    return played.line.onset_s[playable], played.line.end_s[playable]


def _enters(onset_s: FloatArray, end_s: FloatArray) -> BoolArray:
    """Which notes come after a rest, or first."""
    return onset_s - np.concatenate([[-np.inf], end_s[:-1]])[: len(onset_s)] >= ENTRY_REST_S


def _entries(starts_s: Sequence[FloatArray]) -> list[tuple[float, frozenset[int]]]:
    """When somebody enters, and who, in order of time."""
    times = np.concatenate(starts_s)
    players = np.repeat(np.arange(len(starts_s)), [len(one) for one in starts_s])
    entries: list[tuple[float, frozenset[int]]] = []
    for place in np.argsort(times, kind="stable").tolist():
        at_s, player = float(times[place]), int(players[place])
        if entries and at_s - entries[-1][0] <= TOGETHER_S:
            entries[-1] = (entries[-1][0], entries[-1][1] | {player})
        else:
            entries.append((at_s, frozenset({player})))
    return entries


def _glances(
    player: int,
    entries: Sequence[tuple[float, frozenset[int]]],
    sounding: Sequence[tuple[FloatArray, FloatArray]],
    seats: Sequence[Seat],
) -> list[tuple[float, float, bool]]:
    """A player's glances: when, how far the other stands to the left, and whether the player is playing."""
    onset_s, end_s = sounding[player]
    glances: list[tuple[float, float, bool]] = []
    for at_s, entering in entries:
        others = sorted(entering - {player})
        if player in entering and not others:
            continue  # alone: the others look, the player breathes
        if (glances and at_s - glances[-1][0] < APART_S) or at_s < BEFORE_S:
            continue
        nearest = min(others, key=lambda other: _distance_m(seats[player], seats[other]))
        before = int(np.searchsorted(onset_s, at_s - TOGETHER_S)) - 1
        playing = player not in entering and before >= 0 and end_s[before] > at_s - BEFORE_S
        glances.append((at_s, seats[player].bearing_rad(seats[nearest]), bool(playing)))
    return glances


def _curves(glances: Sequence[tuple[float, float, bool]]) -> dict[str, Curve]:
    """Movements to each glance and back again."""
    tables: dict[str, list[tuple[float, float, float]]] = {name: [] for name in SHARES}
    for at_s, bearing_rad, playing in glances:
        begin_s, back_s = at_s - BEFORE_S, at_s + LINGERING_S
        # The head first gives what it can, then the eyes; who stands nearer ahead needs less of both.
        left_rad = bearing_rad
        for name, share in SHARES.items():
            bound = BOUNDS_RAD[name] * share * (WHILE_PLAYING[name] if playing else 1.0)
            turn = float(np.clip(left_rad, -bound, bound))
            left_rad -= turn
            tables[name] += [
                (begin_s, begin_s + TURNING_S, turn),
                (back_s, back_s + RETURNING_S, 0.0),
            ]
    return {f"glance/{name}": (np.array(table).reshape(-1, 3), 0.0) for name, table in tables.items()}


def _distance_m(seat: Seat, other: Seat) -> float:
    return float(np.hypot(other.x_m - seat.x_m, other.z_m - seat.z_m))
