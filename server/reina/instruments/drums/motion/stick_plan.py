"""The strokes of one hand, planned once: where each lands, how it is prepared, how it goes on.

Louder strokes begin higher: the tip is lifted about 5 cm for a tap and up to 40 cm for an accent (Dahl 2000,
2004), and less where there is no time. It falls faster and faster, is on the surface at the onset, and
rebounds into what comes next.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.hit import DrumHit
from reina.instruments.drums.motion.contacts import Placing, choke, cross_stick, rim_shot, twirl
from reina.instruments.drums.motion.hand_shapes import CHOKE
from reina.instruments.drums.motion.kit_places import UP

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.motion.kit_places import KitPlaces
    from reina.rotations.arrays import FloatArray

GRIP_M: Final = 0.27
"""From the tip to where the stick is held: about a third from the butt of 406 mm."""

CONTACT_RAD: Final = 0.27
"""How steeply the stick points down where it lands."""

GRIP_S: Final = 0.18
"""How long a hand holds a cymbal that it chokes, at most."""

EARLY_S: Final = 0.0168
"""The tip is on the surface this long before the onset: so the last frame of a 60th
before the onset shows it there, and none is late."""

CONTACT_S: Final = 0.005
"""And this long after."""

EARLY_SHARE, CONTACT_SHARE = 0.35, 0.15
"""Neither takes more than this part of the time between two strokes."""

LIFT_M: Final = (0.035, 0.40)
"""How high the tip is lifted for the softest and for the loudest stroke."""

LIFT_POWER: Final = 1.5

CROSS_STICK_LIFT_M: Final = 0.05
"""The tip stays on the head; so high over the hoop is the shaft lifted."""

LIFT_SPEED_M_S: Final = 1.1
"""How high a stick gets in the time that it has: so many metres a second."""

FALL_S: Final = 0.13
"""What a stroke takes from its top to the surface, at most."""

FALL_SHARE: Final = 0.45

LONG_S: Final = 0.9
"""In a longer gap the stick waits above the piece."""

RISE_S: Final = 0.26
REBOUND_S: Final = 0.2
SETTLE_S: Final = 0.25
WAIT_M: Final = 0.09
"""Where it waits."""

GO_M_S: Final = (0.25, 1.6)
"""What it takes to go there: the first, and at the second so many metres a second."""

HOMEWARD_M: Final = 0.1

FAR_OUT_M: Final = 0.4
CLOSE_S: Final = 0.2
UNDER_ARM_M: Final = 0.05
"""From farther out on its own side to the middle, in a shorter time, a stick is lifted no higher than the
last: the other hand has just come over, and its arm is above."""

REST_S: Final = 2.6
"""In a gap of this length the stick goes to its place of rest."""

GO_REST_S: Final = 0.9
LEAVE_AFTER_S: Final = 0.45
GO_SOON_S: Final = 0.7
OVER_SIDE_M: Final = 0.15
"""From farther than this over to the other's side it leaves and goes sooner."""
OVER_M: Final = 0.16
"""On its way to rest a stick goes at least so high over what it leaves: the other may lie there already."""

FIRST_UP: Final = 0.35
"""By this part of its time a stick that comes from rest to the other's side goes up before it goes over."""

REBOUND: Final = {"tom_floor": 0.35, "tom_mid": 0.45, "tom_high": 0.5, "snare": 0.6, "cowbell": 0.35}
"""How much of a stroke's height the stick gets back by itself; a loose head gives less."""

CYMBAL_REBOUND: Final = 0.5

CLEARANCE_M: Final = 0.09
"""A stick passes at least so high above the higher of the two pieces that it goes between."""

APART_M: Final = 0.03
"""Each hand strikes a head this far to its own side of the middle, so that two sticks have room."""

APART_SHARE: Final = 0.55
"""And no farther than this part of the zone's radius."""

NARROW_M: Final = 0.02
"""Zones no wider than this are struck in their middle."""

FAR_M: Final = 0.38
NEARER_PART: Final = 0.8
"""Farther over to the other's side than the first a hand strikes nearer, by this part of the zone's
radius."""

THROUGH_M: Final = 0.07
"""How far a stroke on a crash's edge goes on beyond it, past the edge and down."""

THROUGH: Final = ("crash_left", "crash_right", "china", "splash")

PLACED: Final = ("cross_stick", "rim_shot")
"""Techniques that say how the stick lies."""

HEADROOM_M: Final = {"cowbell": 0.07, "tom_mid": 0.3}
"""So high a stick may be lifted where a cymbal hangs over what it strikes."""

LOW_M: Final = 0.07
"""And so high where a hand lies on a head: the other arm may be over the drum."""

EDGE_ROOM_M: Final = 0.12
"""And so far off a cymbal's edge where a hand will take it."""

LOW_AFTER: Final = 0.4
"""After this part of its way a hand comes down to that."""

OVER_CHINA_M: Final = 0.2
"""The edge of a china turns up: a stick that comes or goes passes so high above."""

AROUND_M: Final = np.array([0.0, 0.0, -0.2])
"""From beneath to a cymbal, and anywhere where that is less than `CLEARANCE_M`, it goes on the player's side:
so far from the straight way at its middle."""

FROM_EDGE_M: Final = np.array([0.0, -0.2, -0.12])
"""A hand that has choked a cymbal goes so far beneath the straight way: the other's arm may be over it."""

INSIDE_M: Final = 0.15
"""Between the ride and the china, which hangs over it, it goes so far on the inner side."""

CLEAR_SHARE: Final = 0.5
"""It is out from beneath after this part of the way."""

SAME_PLACE_M: Final = 0.02

TRAVEL: Final = (0.04, 0.86)
"""In which part of the time between two strokes the hand goes from one piece to the other."""

LATE_S: Final = 0.5
TRAVEL_LATE: Final = 0.3
"""In a longer time than the first it begins so late away from its own side: the other may be at work
there."""

ELBOW: Final = ((-0.28, 0.06), (0.28, 0.06))
"""About where the elbows are, X and Z: from there a stick points to what it strikes."""

REST_TIP: Final = ((-0.075, 0.13, -0.05), (0.075, 0.13, -0.05))
"""Where the tips rest, from the middle of the snare."""


@dataclass(frozen=True)
class Grip(DrumHit):
    """A hand goes to a cymbal's edge and holds it."""


TWIRL_S: Final = 0.62
"""How long a stick is twirled."""


@dataclass(frozen=True)
class Twirl(DrumHit):
    """A hand goes up and lets its stick run round a finger."""


@dataclass(frozen=True, eq=False)
class Station:
    """Where a stick is for a while: over a zone, or at rest.

    Attributes:
        point: (3,) where the tip lands.
        normal: (3,) the way that it is lifted.
        heading: (3,) which way the stick points from above, level, a unit vector.
        through: (3,) where the tip goes on to after a stroke.
        swings: Row of `SWINGS` whose tilt moves the point; -1 if it does not move.
        pivot: (3,) what it turns about.
        is_hi_hat: Whether it goes down as the hi-hat is closed.
        headroom_m: How high the stick may be lifted there.
        piece: What is struck; nothing at rest.
        placing: How stick and hand lie there, where the tip alone does not say it.
    """

    point: FloatArray
    normal: FloatArray
    heading: FloatArray
    through: FloatArray
    swings: int
    pivot: FloatArray
    is_hi_hat: bool = False
    headroom_m: float = np.inf
    piece: str = ""
    placing: Placing | None = None


@dataclass(frozen=True, eq=False)
class StickPlan:
    """The strokes of one hand.

    Attributes:
        stations: Where it is, in their order; the first and the last are its rest.
        moves: (M, 2) from when to when it goes from station m to m + 1.
        around: (M, 3) how far from the straight way it goes at its middle.
        heights: (H, 4) what the tip's height above its station does: from, to, height at the end, and `RISE`,
            `FALL` or `GLIDE`.
        strokes_s: (K,) the onsets.
        through: (K,) how far each goes on beyond the edge, in parts of the station's `through`.
        twirls_s: (W,) when twirls begin.
    """

    stations: list[Station]
    moves: FloatArray
    around: FloatArray
    heights: FloatArray
    strokes_s: FloatArray
    through: FloatArray
    twirls_s: FloatArray


RISE, FALL, GLIDE = 0.0, 1.0, 2.0
"""Fast at first; faster and faster; from rest to rest."""


def plan_sticks(hits: Sequence[DrumHit], places: KitPlaces, side: int, swings: Sequence[str]) -> StickPlan:
    """Plan all strokes of one hand.

    Args:
        hits: That hand's, by time.
        places: The kit.
        side: 0 on the player's right (-X), 1 on the left.
        swings: Names of the pieces that turn, in the order of the rows of their tilts.

    Raises:
        RigError: The kit lacks a piece.
    """
    maker = _PlanMaker(_rest(places, side), side)
    known: dict[tuple[str, str, str], Station] = {}
    for place, hit in enumerate(hits):
        after = hits[place + 1].onset_s - hit.onset_s if place + 1 < len(hits) else np.inf
        key = (hit.piece, hit.zone, hit.technique if hit.technique in PLACED else type(hit).__name__)
        if key not in known:
            known[key] = _station(hit, places, side, swings)
        maker.strike(hit, known[key], after)
    maker.finish()
    return StickPlan(
        maker.stations,
        np.array(maker.moves).reshape(-1, 2),
        np.array([_around(*way) for way in pairwise(maker.stations)]).reshape(-1, 3),
        np.array(maker.heights).reshape(-1, 4),
        np.array([hit.onset_s for hit in hits]),
        np.array([_through(hit) for hit in hits]),
        np.array([hit.onset_s for hit in hits if isinstance(hit, Twirl)]),
    )


class _PlanMaker:
    """Makes the plan of one hand, stroke by stroke."""

    def __init__(self, rest: Station, side: int) -> None:
        self._rest = rest
        self._own_side = 1.0 if side else -1.0
        self._before: DrumHit | None = None
        self._free_s = -np.inf  # since when the tip is off what it struck last
        self.stations = [rest]
        self.moves: list[tuple[float, float]] = []
        self.heights: list[tuple[float, float, float, float]] = []

    def strike(self, hit: DrumHit, station: Station, after_s: float) -> None:
        """Add a stroke; `after_s` is the time up to the next one."""
        before = self._before
        gap = hit.onset_s - before.onset_s if before else np.inf
        lands_s = hit.onset_s - min(EARLY_S, EARLY_SHARE * gap)
        room = lands_s - self._free_s
        lift = _lift(hit, room)
        far = float(np.linalg.norm(station.point - self.stations[-1].point))
        if far > SAME_PLACE_M and gap < REST_S:
            rise = abs(float(station.point[1] - self.stations[-1].point[1]))
            clearance = OVER_CHINA_M if self._is_china(hit) else CLEARANCE_M
            lift = max(lift, 0.5 * rise + min(clearance, 0.5 * far))
            if room < CLOSE_S and self._is_under_arm(station):
                lift = 0.5 * rise + UNDER_ARM_M
        high, lift = lift, min(lift, station.headroom_m)
        if before is None or gap >= REST_S:
            homeward = self._is_homeward(station)
            clear = CLEARANCE_M if homeward else OVER_M
            fall_s = self._from_rest(min(max(lift, clear), station.headroom_m), lands_s, homeward=homeward)
        elif room > LONG_S:
            fall_s = self._waiting(hit, station, lift, lands_s)
        else:
            fall_s = lands_s - min(FALL_S, FALL_SHARE * room)
            is_late = room > LATE_S and not self._is_homeward(station)
            first = TRAVEL_LATE if is_late else TRAVEL[0]
            begin_s, end_s = self._free_s + first * room, self._free_s + TRAVEL[1] * room
            self.moves.append((begin_s, end_s))
            if station.placing and high > lift:
                # Up first, as over anything else, and soon down to where a hand lies.
                low_s = self._free_s + LOW_AFTER * (fall_s - self._free_s)
                self.heights.append((self._free_s, low_s, 0.5 * (lift + high), RISE))
                self.heights.append((low_s, fall_s, lift, GLIDE))
            else:
                self._rise(begin_s + CLEAR_SHARE * (end_s - begin_s), fall_s, lift)
        self.heights.append((fall_s, lands_s, 0.0, FALL))
        self.stations.append(station)
        self._free_s = hit.onset_s + _held_s(hit, after_s)
        self._before = hit

    def _rise(self, clear_s: float, top_s: float, lift: float) -> None:
        """From the surface to the top of the next stroke; from beneath a cymbal, once it is clear of it."""
        headroom = self.stations[-1].headroom_m
        if lift <= headroom or clear_s >= top_s:
            self.heights.append((self._free_s, top_s, min(lift, headroom), RISE))
            return
        self.heights += [(self._free_s, clear_s, headroom, GLIDE), (clear_s, top_s, lift, GLIDE)]

    def finish(self) -> None:
        """Add the way to rest after the last stroke."""
        if self._before is not None:
            self._to_rest(self._before)

    def _to_rest(self, before: DrumHit) -> None:
        is_over = float(self.stations[-1].point[0]) * self._own_side < -OVER_SIDE_M
        leave_s = self._free_s + (RISE_S if is_over else LEAVE_AFTER_S)
        back = min(_rebound(before), self.stations[-1].headroom_m)
        over = min(max(OVER_M, back), self.stations[-1].headroom_m)
        self.heights += [
            (self._free_s, self._free_s + RISE_S, back, RISE),
            (leave_s, leave_s + 0.3, over, GLIDE),
            (leave_s + 0.65, leave_s + 1.1, 0.0, GLIDE),
        ]
        self.moves.append((leave_s, leave_s + (GO_SOON_S if is_over else GO_REST_S)))
        self.stations.append(self._rest)

    def _from_rest(self, lift: float, lands_s: float, *, homeward: bool) -> float:
        """Rest since the stroke before, then come to this one; returns when the stroke falls.

        Over to the other's side a stick is lifted first.
        """
        fall_s = lands_s - FALL_S
        start_s = fall_s - GO_REST_S
        if self._before is not None:
            self._to_rest(self._before)
        else:
            # What begins with the song is prepared when it does, if there is time.
            start_s = max(start_s, min(0.0, fall_s - RISE_S))
        way_s = 0.0 if homeward else FIRST_UP * (fall_s - start_s)
        self.heights.append((start_s, fall_s - way_s, lift, GLIDE))
        self.moves.append((start_s + way_s, fall_s + 0.4 * FALL_S))
        return fall_s

    def _is_china(self, hit: DrumHit) -> bool:
        """Whether a way leads to the china or from it."""
        return "china" in (hit.piece, self._before.piece if self._before else "")

    def _is_homeward(self, station: Station) -> bool:
        """Whether a way goes to the hand's own side, or straight: then it leaves the other room at once."""
        return float(station.point[0] - self.stations[-1].point[0]) * self._own_side > -HOMEWARD_M

    def _is_under_arm(self, station: Station) -> bool:
        """Whether a way leads from a drum on the hand's own side to one in the middle."""
        before = self.stations[-1]
        far_out = float(before.point[0]) * self._own_side > FAR_OUT_M
        return far_out and before.swings < 0 and station.swings < 0 and not self._is_homeward(station)

    def _waiting(self, hit: DrumHit, station: Station, lift: float, lands_s: float) -> float:
        """Rebound, wait above a piece, and rise again; returns when the stroke falls.

        Away from its own side a hand goes as late as it can: the other may be at work there.
        """
        free_s, fall_s = self._free_s, lands_s - FALL_S
        far = float(np.linalg.norm(station.point - self.stations[-1].point))
        least = OVER_CHINA_M if self._is_china(hit) else WAIT_M
        wait = max(least, lift - 0.15) if far > SAME_PLACE_M else min(WAIT_M, lift)
        wait = min(wait, station.headroom_m)
        begin_s, end_s = free_s + 0.15, max(free_s + 0.5, fall_s - RISE_S)
        takes_s = min(GO_M_S[0] + far / GO_M_S[1], end_s - begin_s)
        if self._is_homeward(station):
            end_s = begin_s + takes_s
        else:
            begin_s = end_s - takes_s
        self.moves.append((begin_s, end_s))
        back = max(_rebound(self._before or hit), wait if far > SAME_PLACE_M else 0.0)
        if self.stations[-1].headroom_m < back:
            clear_s = begin_s + CLEAR_SHARE * (end_s - begin_s)
            self._rise(clear_s, end_s, wait)
            self.heights.append((fall_s - RISE_S, fall_s, lift, GLIDE))
            return fall_s
        self.heights += [
            (free_s, free_s + REBOUND_S, back, RISE),
            (free_s + REBOUND_S, free_s + REBOUND_S + SETTLE_S, wait, GLIDE),
            (fall_s - RISE_S, fall_s, lift, GLIDE),
        ]
        return fall_s


def _held_s(hit: DrumHit, after_s: float) -> float:
    """How long a stick stays where a stroke has brought it."""
    if isinstance(hit, Twirl):
        return TWIRL_S
    return min(GRIP_S, 0.5 * after_s) if isinstance(hit, Grip) else min(CONTACT_S, CONTACT_SHARE * after_s)


def _lift(hit: DrumHit, room_s: float) -> float:
    """How high the tip is lifted for a stroke, metres."""
    if hit.technique == "cross_stick":
        return min(CROSS_STICK_LIFT_M, LIFT_SPEED_M_S * room_s)
    wanted = LIFT_M[0] + (LIFT_M[1] - LIFT_M[0]) * hit.velocity**LIFT_POWER
    if hit.technique in ("flam_grace", "drag_grace", "ghost"):
        wanted = min(wanted, 0.05)
    return min(wanted, LIFT_SPEED_M_S * room_s)


def _rebound(hit: DrumHit) -> float:
    share = REBOUND.get(hit.piece, CYMBAL_REBOUND)
    return max(0.04, share * _lift(hit, np.inf))


def _through(hit: DrumHit) -> float:
    is_through = hit.piece in THROUGH and hit.zone == "edge" and not isinstance(hit, Grip)
    return hit.velocity if is_through else 0.0


def _station(hit: DrumHit, places: KitPlaces, side: int, swings: Sequence[str]) -> Station:
    if isinstance(hit, Twirl):
        return _placed(twirl(side))
    zone = places[hit.piece, hit.zone]
    if isinstance(hit, Grip):
        return _placed(choke(zone, side), swings.index(hit.piece), zone.pivot, EDGE_ROOM_M)
    placing: Placing | None = None
    if hit.technique == "cross_stick":
        placing = cross_stick(places, hit.piece, side)
        if placing is not None:
            return _placed(placing, -1, zone.pivot, LOW_M)
    if hit.technique == "rim_shot":
        head = places[hit.piece, "centre"]
        apart = min(APART_M, APART_SHARE * head.radius) * (1.0 if side else -1.0)
        point = head.position + apart * _left_of(_heading(head.position, side), head.normal)
        placing = rim_shot(places, hit.piece, point, side)
        if placing is not None:
            return _placed(placing, -1, zone.pivot)
    heading = _heading(zone.position, side)
    apart = min(APART_M, APART_SHARE * zone.radius) if zone.radius > NARROW_M else 0.0
    apart *= 1.0 if side else -1.0
    through = THROUGH_M * (zone.outward - 0.8 * UP) if hit.piece in THROUGH else np.zeros(3)
    headroom = HEADROOM_M.get(hit.piece, np.inf)
    # As near to the player as the zone goes, if there is so little room, or so far to go.
    is_far = float(zone.position[0]) * (1.0 if side else -1.0) < -FAR_M
    part = 0.9 if headroom < CLEARANCE_M else NEARER_PART * is_far
    nearer = part * zone.radius * heading
    nearer = nearer - zone.normal * float(nearer @ zone.normal)
    return Station(
        zone.position + apart * _left_of(heading, zone.normal) - nearer,
        zone.normal,
        heading,
        through,
        swings.index(hit.piece) if hit.piece in swings else -1,
        zone.pivot,
        hit.piece == "hi_hat",
        headroom,
        hit.piece,
    )


def _around(before: Station, after: Station) -> FloatArray:
    """How far from the straight way between two stations a stick goes at its middle."""
    far = float(np.linalg.norm(after.point - before.point))
    # A hand that lies on a head has its own way there.
    headroom = min(np.inf if one.placing else one.headroom_m for one in (before, after))
    is_cymbal = max(before.swings, after.swings) >= 0
    is_beneath = headroom < (np.inf if is_cymbal else CLEARANCE_M)
    if {before.piece, after.piece} == {"ride", "china"}:
        return INSIDE_M * np.array([-np.sign(after.point[0]), 0.0, 0.0])
    if before.placing and before.placing.shape == CHOKE and far > SAME_PLACE_M:
        return FROM_EDGE_M
    return AROUND_M if is_beneath and far > SAME_PLACE_M else np.zeros(3)


def _placed(
    placing: Placing, swings: int = -1, pivot: FloatArray | None = None, headroom_m: float = np.inf
) -> Station:
    return Station(
        placing.point,
        placing.normal,
        placing.heading,
        np.zeros(3),
        swings,
        placing.point if pivot is None else pivot,
        headroom_m=headroom_m,
        placing=placing,
    )


def _left_of(heading: FloatArray, normal: FloatArray) -> FloatArray:
    """To the stick's left, in the plane of what it strikes (3,)."""
    across = np.cross(UP, heading)
    across = across - normal * float(across @ normal)
    return across / np.linalg.norm(across)


def _heading(point: FloatArray, side: int) -> FloatArray:
    elbow = np.array([ELBOW[side][0], 0.0, ELBOW[side][1]])
    level = (point - elbow) * (1.0, 0.0, 1.0)
    return level / np.linalg.norm(level)


def _rest(places: KitPlaces, side: int) -> Station:
    snare = places["snare", "centre"]
    point = snare.position + np.array(REST_TIP[side])
    return Station(point, UP, _heading(point, side), np.zeros(3), -1, point)
