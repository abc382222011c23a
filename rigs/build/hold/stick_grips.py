"""What a hand does with a drumstick beside striking, as keyed poses of the fingers and of the stick.

Four grips begin with the closed hand of `StickGrip` and lead on from there: ``play`` opens the back fingers
as the stick turns about the fulcrum; ``cross_stick`` turns the stick end for end and lays the hand on a
drum's head; ``choke`` takes a cymbal's edge between the thumb and two fingers, the stick kept by the others;
``twirl`` lets the stick run once round the index finger.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from hold.collision import Obstacles
from hold.finger import Finger
from hold.grip import FINGERS, MM
from hold.slab import Slab
from hold.stick_grip import ACROSS_RAD, FLESH_M, FULCRUM_M, STICK_RADIUS_M, close_finger, press_thumb
from hold.thumb import Thumb

if TYPE_CHECKING:
    from collections.abc import Callable

    from hold.rig import Pose, Rig

Array = NDArray[np.float64]

TIP_M, BUTT_M = 0.2649, 0.1353
"""From where the stick is held to its ends."""
BEAD_M = 0.0048

OPEN_RAD = np.radians(np.arange(0.0, 26.0, 5.0))
"""How far the stick turns in the hand while the back fingers follow it."""

FLAT_RAD = np.radians(6.0)
"""How far a hand that lies on a head is tipped up from its heel."""
HEEL_M = -0.0285
"""So deep under the wrist is the head."""
BUTT_UP_RAD = np.arctan2(0.0172, 0.294)
"""How steeply a stick lies from the head over the hoop."""
OVER_TIP_M = 0.13
"""How far from its tip the hand holds it."""

EDGE_M = np.array([0.112, -0.022, 0.0])
"""Where a cymbal's edge begins in the hand, and its upper side."""
EDGE_RAD = np.radians(-10.0)
"""How far it is tipped in the hand."""
BRONZE_M = 0.0014
PINCHED_M = (0.022, 0.016)
"""How far in over the edge the fingers and the thumb take it."""
JAWS_M = 0.013
"""How far they open."""
KEPT_M = np.array([0.084, -0.0275, -0.0146])
"""Where the ring finger keeps the stick meanwhile."""
KEPT_RAD = np.radians([80.0, 20.0])
"""Which way it points then: from the fingers to the thumb's side, and down."""

FLIP_M = np.array([0.110, -0.037, 0.019])
"""Where the stick turns end for end, under the fingers."""
FLIP_TIPPED_RAD = np.radians(10.0)

AXLE_RAD = np.radians([0.0, 2.0, -14.0, -5.0])
"""How the index finger is bent while the stick runs round it."""
FIST_RAD = np.radians([0.0, -58.0, -105.0, -19.0])
AWAY_RAD = np.radians([0.0, -20.0, 20.0, 0.0, 0.0])

LEAST_RAD = np.array([-0.34, -1.1, -1.95, -0.34])
MOST_RAD = np.array([0.34, 1.4, 0.25, 0.35])
THUMB_LEAST_RAD = np.radians([-38.0, -52.0, -34.0, -62.0, -76.0])
THUMB_MOST_RAD = np.radians([38.0, 38.0, 34.0, 18.0, 23.0])


@dataclass
class GripKey:
    """One pose of a grip.

    Attributes:
        share: How far along the grip it is, 0 to 1.
        fulcrum: Where the stick's origin is, in the hand's frame (3,).
        direction: Which way its tip is, in the hand's frame, a unit vector (3,).
        point: What is to be at its place while the hand is so, in the hand's frame (3,).
        pose: Local rotations of the fingers and the thumb.
    """

    share: float
    fulcrum: Array
    direction: Array
    point: Array
    pose: Pose = field(default_factory=dict[str, Array])
    turn: Array = field(default_factory=lambda: np.eye(3))
    """The stick's rotation in the hand's frame (3, 3)."""
    faces: tuple[Array, Array] | None = None
    """Which ways a hand that is placed by itself goes along what it touches, and out of it, (3,) each."""

    def attachment(self, side: str) -> dict[str, object]:
        """The stick's place in the hand, as a hold's attachments have it."""
        return {
            "joint": f"{side}Hand",
            "position": self.fulcrum.tolist(),
            "rotation": Rotation.from_matrix(self.turn).as_quat().tolist(),
        }


@dataclass
class HandGrips:
    """Keys of one hand's grips; everything is worked out on the left hand's side and mirrored."""

    rig: Rig
    side: str

    def __post_init__(self) -> None:
        self.mirror = np.array([1.0, 1.0, 1.0 if self.side == "left" else -1.0])
        self.thumb_mirror = np.array([self.mirror[2], 1.0, self.mirror[2], 1.0, 1.0])
        self.fingers = {name: Finger.of(self.rig, f"{self.side}{name}") for name in FINGERS}
        self.thumb = Thumb.of(self.rig, self.side)

    def all(self) -> dict[str, list[GripKey]]:
        """The four grips."""
        play = self.play()
        closed = play[0]
        grips = {
            "play": play,
            "cross_stick": [closed, *self.flip(), self.on_head()],
            "choke": [closed, self.on_edge(0.55, JAWS_M), self.on_edge(1.0, 0.0)],
            "twirl": self.twirl(closed),
        }
        for name in ("cross_stick", "choke", "twirl"):
            keys = grips[name]
            for key in keys[1:-1]:
                key.point = keys[0].point + (keys[-1].point - keys[0].point) * key.share
        for keys in grips.values():
            _turned(keys)
        return grips

    def play(self) -> list[GripKey]:
        """Thumb and index hold the stick, the others follow it; at 0 the hand is closed."""
        fulcrum = np.array(FULCRUM_M) * self.mirror
        keys: list[GripKey] = []
        for angle in OPEN_RAD:
            level, up = np.cos(angle), np.sin(angle)
            direction = np.array([level * np.cos(ACROSS_RAD), up, level * np.sin(ACROSS_RAD)]) * self.mirror
            key = GripKey(float(angle / OPEN_RAD[-1]), fulcrum, direction, _tip(fulcrum, direction))
            for finger in self.fingers.values():
                key.pose.update(finger.local_rotations(close_finger(finger, fulcrum, direction)))
            key.pose.update(self.thumb.local_rotations(press_thumb(self.thumb, fulcrum, direction)))
            keys.append(key)
        return keys

    def on_head(self) -> GripKey:
        """The hand lies on a head over the stick's tip, the butt is ahead."""
        m = self.mirror
        normal = np.array([np.sin(FLAT_RAD), np.cos(FLAT_RAD), 0.0])
        under = np.array([0.0, HEEL_M, 0.0])
        level = np.array([np.cos(ACROSS_RAD), 0.0, np.sin(ACROSS_RAD)])
        level -= normal * (level @ normal)
        level /= np.linalg.norm(level)
        ahead = level * np.cos(BUTT_UP_RAD) + normal * np.sin(BUTT_UP_RAD)
        place = np.array(FULCRUM_M)
        place = place - normal * ((place - under) @ normal)
        tip = place - OVER_TIP_M * level + BEAD_M * normal
        place = tip + OVER_TIP_M * ahead
        front = np.cross(ahead, normal)
        front *= np.sign(front[0])
        head = Slab(under * m, normal * m)
        stick = _rod(tip * m, (tip + 0.40 * ahead) * m)
        fulcrum = (tip + TIP_M * ahead) * m
        key = GripKey(1.0, fulcrum, -ahead * m, _tip(fulcrum, -ahead * m), faces=(ahead * m, normal * m))
        for name, finger in self.fingers.items():
            if name == "Index":
                pad = (place + STICK_RADIUS_M * front + 0.005 * ahead) * m
                angles = _lay(finger, stick, head, pad, 0.3, [0.0, 0.1, -1.3, -0.3], stick.clearance)
            else:
                out = {"Middle": 0.075, "Ring": 0.062, "Little": 0.045}[name]
                beside = {"Middle": 0.0, "Ring": -0.005, "Little": -0.012}[name]
                pad = head.on(finger.knuckle + np.array([out, 0.0, beside]) * m)
                angles = _lay(finger, stick, head, pad, 0.1, [0.0, -0.2, -0.5, -0.15], head.clearance)
            key.pose.update(finger.local_rotations(angles))

        def residuals(x: Array) -> Array:
            points, looking = self.thumb.points(x)
            centres, radii = self.thumb.spheres(x, 5)
            gap = stick.clearance(centres) - radii
            along = (points[3] - place * m) @ (ahead * m)
            inward = place * m + along * (ahead * m) - points[3]
            inward /= np.linalg.norm(inward)
            return np.r_[
                gap[-1] * MM * 2.0,
                along * MM * 0.3,
                (looking - inward) * 4.0,
                np.minimum(head.clearance(centres) - radii + 0.0005, 0.0) * MM * 2.0,
                np.minimum(gap[:-1] + 0.001, 0.0) * MM * 2.0,
                x[:3] * 2.0,
                x[3:],
                _thumb_beyond(x),
            ]

        key.pose.update(self.thumb.local_rotations(_best(residuals, THUMB_STARTS)))
        return key

    def flip(self) -> list[GripKey]:
        """The stick turns end for end under straight fingers, the thumb out of its way."""
        m = self.mirror
        normal = np.array([-np.sin(FLIP_TIPPED_RAD), np.cos(FLIP_TIPPED_RAD), 0.0])
        ceiling = Slab((FLIP_M + STICK_RADIUS_M * normal) * m, normal * m)
        pose: Pose = {}
        for finger in self.fingers.values():
            pad = ceiling.on(finger.knuckle + np.array([0.06, 0.0, 0.0]) * m)
            free = _rod(pad - [0.0, 1.0, 0.0], pad - [0.0, 2.0, 0.0])
            angles = _lay(finger, free, ceiling, pad, 0.1, [0.0, -0.1, -0.4, -0.1], ceiling.clearance)
            pose.update(finger.local_rotations(angles))

        def residuals(x: Array) -> Array:
            centres, radii = self.thumb.spheres(x, 5)
            return np.r_[
                np.minimum(ceiling.clearance(centres) - radii - 0.002, 0.0) * MM * 2.0,
                (x - AWAY_RAD * self.thumb_mirror) * 3.0,
                _thumb_beyond(x),
            ]

        pose.update(self.thumb.local_rotations(_best(residuals, THUMB_STARTS)))
        keys: list[GripKey] = []
        for step in range(13):
            share, turn = 0.25 + 0.45 * step / 12, ACROSS_RAD - np.pi * step / 12
            level = np.array([np.cos(turn), 0.0, np.sin(turn)])
            direction = level - normal * (level @ normal)
            direction = direction / np.linalg.norm(direction) * m
            # It slides meanwhile to where the hand holds it near its tip.
            slid = step / 12 * (TIP_M - OVER_TIP_M)
            keys.append(GripKey(share, FLIP_M * m - slid * direction, direction, np.zeros(3), dict(pose)))
        return keys

    def on_edge(self, share: float, jaws: float) -> GripKey:
        """Thumb and two fingers about a cymbal's edge, so far from it; ring and little keep the stick."""
        m = self.mirror
        normal = np.array([-np.sin(EDGE_RAD), np.cos(EDGE_RAD), 0.0])
        inward = np.array([normal[1], -normal[0], 0.0])
        bronze = Slab(EDGE_M * m, normal * m, inward * m, BRONZE_M)
        across, down = KEPT_RAD
        direction = np.array([np.cos(across) * np.cos(down), -np.sin(down), np.sin(across) * np.cos(down)])
        fulcrum = (KEPT_M + 0.0465 * direction) * m
        direction = direction * m
        stick = _rod(fulcrum - 0.13 * direction, fulcrum + 0.27 * direction)
        point = (EDGE_M + np.array([0.0, 0.0, 0.0095])) * m
        key = GripKey(share, fulcrum, direction, point, faces=(inward * m, normal * m))
        for name, finger in self.fingers.items():
            if name in ("Ring", "Little"):
                key.pose.update(finger.local_rotations(close_finger(finger, fulcrum, direction)))
                continue
            pad = (EDGE_M + inward * PINCHED_M[0]) * m + normal * m * jaws
            pad[2] = finger.knuckle[2]

            def residuals(x: Array, finger: Finger = finger, pad: Array = pad) -> Array:
                centres, radii = finger.spheres(x, 24)
                over = (centres - EDGE_M * m) @ (normal * m) - radii - jaws
                return np.r_[
                    over[-1] * MM * 2.0,
                    (finger.points(x)[3] - pad) * MM * [0.15, 0.0, 0.15],
                    np.minimum(bronze.clearance(centres) - radii + 0.0003, 0.0) * MM * 2.0,
                    np.minimum(over[-32:] + 0.0003, 0.0) * MM * 2.0,
                    np.minimum(stick.clearance(centres) - radii + 0.001, 0.0) * MM * 2.0,
                    (x - [0.0, -0.1, -0.3, -0.1]) * 0.8,
                    _beyond(x),
                ]

            starts = [[0.0, 0.2, -0.5, -0.1], [0.0, 0.4, -0.9, -0.3], [0.0, -0.1, -0.2, -0.1]]
            key.pose.update(finger.local_rotations(_best(residuals, starts)))
        below = (EDGE_M + inward * PINCHED_M[1] - BRONZE_M * normal + np.array([0.0, 0.0, 0.012])) * m

        def pressing(x: Array) -> Array:
            points, looking = self.thumb.points(x)
            centres, radii = self.thumb.spheres(x, 24)
            under = -(centres - EDGE_M * m) @ (normal * m) - BRONZE_M - radii - jaws
            return np.r_[
                under[-1] * MM * 2.0,
                (points[3] - below) * MM * [0.3, 0.0, 0.2],
                np.minimum(stick.clearance(centres) - radii + 0.001, 0.0) * MM * 2.0,
                np.minimum(bronze.clearance(centres) - radii + 0.0003, 0.0) * MM * 2.0,
                (looking - normal * m) * 2.0,
                x * 0.8,
                _thumb_beyond(x),
            ]

        key.pose.update(self.thumb.local_rotations(_best(pressing, THUMB_STARTS)))
        return key

    def twirl(self, closed: GripKey) -> list[GripKey]:
        """The stick runs once round the straight index finger; the thumb lets go and takes it again."""
        m = self.mirror
        index = self.fingers["Index"]
        points = index.points(AXLE_RAD)
        axle = (points[3] - points[2]) / np.linalg.norm(points[3] - points[2])
        round_m = index.radii[2] + STICK_RADIUS_M
        # The line through the outer joint and the middle of the last bone.
        middle = points[2] + 0.2 * (points[3] - points[2])
        across = np.array([0.0, 0.0, 1.0]) * m
        across = across - axle * (across @ axle)
        across /= np.linalg.norm(across)
        up = np.array([0.0, 1.0, 0.0])
        up = up - axle * (up @ axle) - across * (up @ across)
        up /= np.linalg.norm(up)
        pose: Pose = dict(index.local_rotations(AXLE_RAD))
        for name in ("Middle", "Ring", "Little"):
            pose.update(self.fingers[name].local_rotations(FIST_RAD))
        away: Pose = {**pose, **self.thumb.local_rotations(AWAY_RAD * self.thumb_mirror)}
        keys = [closed]
        turns = np.radians(np.arange(0.0, 361.0, 30.0))
        for share, turn in zip(np.linspace(0.22, 0.78, len(turns)), turns, strict=True):
            direction = across * np.cos(turn) + up * np.sin(turn)
            beside = -up * np.cos(turn) + across * np.sin(turn)
            keys.append(GripKey(float(share), middle + round_m * beside, direction, np.zeros(3), dict(away)))
        under = keys[1]
        stick = _rod(under.fulcrum - BUTT_M * under.direction, under.fulcrum + TIP_M * under.direction)

        def residuals(x: Array) -> Array:
            thumb, looking = self.thumb.points(x)
            centres, radii = self.thumb.spheres(x, 5)
            gap = stick.clearance(centres) - radii
            inward = under.fulcrum - thumb[3]
            return np.r_[
                gap[-1] * MM * 2.0,
                np.minimum(gap[:-1] + FLESH_M, 0.0) * MM * 2.0,
                (thumb[3] - under.fulcrum) @ under.direction * MM * 0.3,
                (looking - inward / np.linalg.norm(inward)) * 3.0,
                x,
                _thumb_beyond(x),
            ]

        pressed = {**pose, **self.thumb.local_rotations(_best(residuals, THUMB_STARTS))}
        first = GripKey(0.14, under.fulcrum, under.direction, np.zeros(3), pressed)
        last = GripKey(0.86, under.fulcrum, under.direction, np.zeros(3), dict(pressed))
        end = GripKey(1.0, closed.fulcrum, closed.direction, closed.point, closed.pose)
        end.faces = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
        return [closed, first, *keys[1:], last, end]


THUMB_STARTS = [
    [0.0] * 5,
    [0.0, 0.3, -0.3, -0.4, -0.4],
    [-0.4, 0.3, 0.3, -0.4, 0.2],
    [0.4, -0.3, -0.3, -0.4, 0.2],
]


def _turned(keys: list[GripKey]) -> None:
    """Turn the sticks: each the shortest way from the one before, the ends with the hand's back up."""
    before: Array | None = None
    for key in keys:
        z = key.direction
        if before is None or key is keys[-1] or abs(z[1]) < 0.5:
            y = np.array([0.0, 1.0, 0.0]) - z * z[1]
            y /= np.linalg.norm(y)
            if before is not None and key is not keys[-1] and y @ before[:, 1] < 0.0:
                y = -y
        else:
            y = before[:, 1] - z * (before[:, 1] @ z)
            y /= np.linalg.norm(y)
        key.turn = before = np.column_stack([np.cross(y, z), y, z])


def _rod(start: Array, end: Array) -> Obstacles:
    return Obstacles([{"from": start, "to": end, "radius": STICK_RADIUS_M}])


def _tip(fulcrum: Array, direction: Array) -> Array:
    """The underside of the bead."""
    up = np.array([0.0, 1.0, 0.0])
    up = up - direction * (up @ direction)
    return fulcrum + 0.264916667 * direction - BEAD_M * up / np.linalg.norm(up)


def _beyond(x: Array) -> Array:
    over: Array = np.r_[np.maximum(x - MOST_RAD, 0.0), np.minimum(x - LEAST_RAD, 0.0)] * 40.0
    return over


def _thumb_beyond(x: Array) -> Array:
    over: Array = np.r_[np.maximum(x - THUMB_MOST_RAD, 0.0), np.minimum(x - THUMB_LEAST_RAD, 0.0)] * 80.0
    return over


def _best(residuals: Callable[[Array], Array], starts: list[list[float]]) -> Array:
    found = min((least_squares(residuals, start) for start in starts), key=lambda one: float(one.cost))
    return np.asarray(found.x)


def _lay(
    finger: Finger,
    stick: Obstacles,
    slab: Slab,
    pad: Array,
    weight: float,
    ease: list[float],
    touched: Callable[[Array], Array],
) -> Array:
    """Angles (4,) with the pad near a point and on what is touched, over a slab and out of the stick."""

    def residuals(x: Array) -> Array:
        centres, radii = finger.spheres(x, 6)
        return np.r_[
            np.minimum(stick.clearance(centres) - radii + 0.001, 0.0) * MM * 2.0,
            np.minimum(slab.clearance(centres) - radii + 0.0005, 0.0) * MM * 2.0,
            (touched(centres)[-1] - radii[-1]) * MM,
            (finger.points(x)[3] - pad) * MM * weight,
            (x - np.array(ease)) * 0.6,
            _beyond(x),
        ]

    return _best(residuals, [[0.0, 0.2, -0.9, -0.2], [0.0, -0.2, -1.4, -0.3], [0.0, -0.6, -0.6, -0.1], ease])
