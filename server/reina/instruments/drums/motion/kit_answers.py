"""What the kit does when it is struck: cymbals swing and settle, the hi-hat follows its pedal, heads give.

All are pure functions of the hits before a time, but for what a foot does ahead of its stroke.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.motion.hi_hat_pedal import CLOSED, hi_hat_movements
from reina.instruments.drums.motion.ringing import Ringing, Ringings
from reina.kinematics import MotionCurves

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.drum_part import Choke
    from reina.instruments.drums.hit import DrumHit
    from reina.rotations.arrays import FloatArray


@dataclass(frozen=True)
class Swing:
    """How a cymbal swings on its stand.

    Attributes:
        most_rad: How far a stroke at full velocity on its edge turns it.
        frequency_hz: How often it goes to and fro in a second.
        decay: By which it settles: exp(-decay t).
    """

    most_rad: float
    frequency_hz: float
    decay: float


SWINGS: Final = {
    "ride": Swing(0.045, 1.45, 1.9),
    "crash_left": Swing(0.20, 1.25, 1.35),
    "crash_right": Swing(0.18, 1.15, 1.25),
    "china": Swing(0.17, 1.2, 1.5),
    "splash": Swing(0.16, 1.8, 2.0),
    "hi_hat": Swing(0.012, 2.4, 4.0),
}
"""Larger cymbals swing slower and longer."""

FARTHEST_RAD: Final = 0.42
"""No cymbal turns farther, however often it is struck."""

ZONE_PUSH: Final = {"edge": 1.0, "bow": 0.5, "bell": 0.3}
"""How much of a stroke turns a cymbal, by where it lands."""

SIDE_SHARE, SIDE_DETUNE = 0.35, 1.13
"""A cymbal wobbles: about the other axis it swings by this part, so many times faster."""

HEADS: Final = ("snare", "kick", "tom_high", "tom_mid", "tom_floor")
HEAD_DECAY: Final = 22.0
"""A head's dent is half gone after 30 ms."""


@dataclass(frozen=True, eq=False)
class KitFrames:
    """What moves of the kit in F frames.

    Attributes:
        tilt: ``(F, 6, 2)`` radians, of each of `SWINGS`: towards where it was struck, and to its side.
        hi_hat: ``(F,)`` how far the hi-hat is closed: 0 open, 1 closed.
        heads: ``(F, 5)`` of each of `HEADS`, 0 at rest, 1 as far as it gives.
    """

    tilt: FloatArray
    hi_hat: FloatArray
    heads: FloatArray


class KitAnswers:
    """What a kit does in answer to the hits of a part.

    Args:
        hits: By time.
        chokes: Cymbals that are gripped, by time.
        mirrored: Whether it is a left-handed player's kit.
    """

    def __init__(
        self, hits: Sequence[DrumHit], chokes: Sequence[Choke] = (), *, mirrored: bool = False
    ) -> None:
        side = -SIDE_SHARE if mirrored else SIDE_SHARE
        swings = [about for piece in SWINGS for about in _swing(piece, hits, chokes, side)]
        self._swings = Ringings(swings)
        self._all = Ringings([*swings, *(_head(piece, hits) for piece in HEADS)])
        self._hi_hat = MotionCurves({"hi_hat": (hi_hat_movements(hits), CLOSED)})

    def tilt(self, times_s: FloatArray) -> FloatArray:
        """How far each cymbal is turned, ``(F, 6, 2)``, as `KitFrames.tilt`."""
        return _by_cymbal(self._swings.evaluate(times_s))

    def hi_hat(self, times_s: FloatArray) -> FloatArray:
        """How far the hi-hat is closed, ``(F,)``."""
        return self._hi_hat.evaluate(times_s)[0]

    def evaluate(self, times_s: FloatArray) -> KitFrames:
        """What moves of the kit at times ``(F,)``."""
        ringing = self._all.evaluate(times_s)
        heads = np.minimum(np.maximum(ringing[2 * len(SWINGS) :].T, 0.0), 1.0)
        return KitFrames(_by_cymbal(ringing[: 2 * len(SWINGS)]), self.hi_hat(times_s), heads)


def _by_cymbal(swings: FloatArray) -> FloatArray:
    """Rows ``(12, F)``, two of each cymbal, as `KitFrames.tilt`."""
    return np.ascontiguousarray(swings.reshape(len(SWINGS), 2, -1).transpose(2, 0, 1))


def _swing(
    piece: str, hits: Sequence[DrumHit], chokes: Sequence[Choke], side: float
) -> tuple[Ringing, Ringing]:
    swing = SWINGS[piece]
    struck = [
        (hit.onset_s, hit.velocity * ZONE_PUSH.get(hit.zone, 1.0), False)
        for hit in hits
        if hit.piece == piece and hit.limb.endswith("hand")
    ]
    gripped = [(choke.at_s, 0.0, True) for choke in chokes if choke.piece == piece]
    events = sorted(struck + gripped)
    at_s = np.array([at for at, _, _ in events])
    push = np.array([strength for _, strength, _ in events]) * swing.most_rad
    held = np.array([is_held for _, _, is_held in events], dtype=np.bool_)
    about = [
        Ringing(
            at_s,
            share * push,
            frequency_hz=swing.frequency_hz * detune,
            decay=swing.decay,
            gripped=held,
            most=FARTHEST_RAD * abs(share),
        )
        for share, detune in ((1.0, 1.0), (side, SIDE_DETUNE))
    ]
    return about[0], about[1]


def _head(piece: str, hits: Sequence[DrumHit]) -> Ringing:
    own = [hit for hit in hits if hit.piece == piece and hit.technique != "cross_stick"]
    return Ringing(
        np.array([hit.onset_s for hit in own]),
        np.array([hit.velocity for hit in own]),
        frequency_hz=0.0,
        decay=HEAD_DECAY,
        most=1.3,
    )
