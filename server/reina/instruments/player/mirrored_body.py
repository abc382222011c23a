"""Who leads with the left hand: a right-handed player's poses, reflected."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.player.body_table import TRUNK
from reina.instruments.player.instrument_body import BodyFrames, FramewiseBody
from reina.skeleton import ACROSS, Mirror, RigError, other_side

if TYPE_CHECKING:
    from reina.instruments.player.engagement import Engagement
    from reina.instruments.player.instrument_body import BodyMotion, InstrumentBody
    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import Skeleton

SIDEWAYS = frozenset(
    {
        "sway_side",
        "sway_turn",
        "turn",
        "gaze_left",
        "torso_turn",
        "torso_tip",
        "head_turn",
        "head_tip",
        "eyes_left",
    }
)
"""Of `body_table.SIGNALS` what goes to a side."""


class MirroredBody:
    """Plays the reflection of what a right-handed body does.

    What moves the body from outside, as a show's turns and ways of standing, keeps its sides: it is reflected
    before.

    Args:
        body: The right-handed body.
        engagement: Who leads with the left hand; `Engagement.right_handed` is whose body that is.

    Raises:
        RigError: The player or the instrument is not the mirror image.
    """

    def __init__(self, body: InstrumentBody, engagement: Engagement) -> None:
        if engagement.right_handed is None:
            raise RigError("nobody is mirrored who leads with the right hand", location="handedness")
        self._body = body
        self.is_framewise = isinstance(body, FramewiseBody) and body.is_framewise
        """See `FramewiseBody`."""
        of, to = _skeletons(engagement.right_handed), _skeletons(engagement)
        starts = dict(
            zip(of, np.cumsum([0, *(len(one.names) for one in of.values())]).tolist(), strict=False)
        )
        mirrors = {name: Mirror(of[_partner(name, of)], skeleton) for name, skeleton in to.items()}
        partners = [mirror.partners + starts[_partner(name, of)] for name, mirror in mirrors.items()]
        self._partners: IntArray = np.concatenate(partners)[:, None]
        self._columns: IntArray = np.concatenate([mirror.columns for mirror in mirrors.values()])
        self._signs = np.concatenate([mirror.signs for mirror in mirrors.values()]).astype(np.float32)
        places = {name: place for place, name in enumerate(of)}
        self._roots: IntArray = np.array([places[_partner(name, of)] for name in to], dtype=np.intp)
        player = engagement.player_rig.skeleton
        trunk = [name for name in TRUNK if name in player]
        self._trunk: IntArray = np.array([player.index(name) for name in trunk], dtype=np.intp)
        self._trunk_partners: IntArray = np.array([trunk.index(other_side(name)) for name in trunk])
        self._player = mirrors["player"]

    def solve(self, motion: BodyMotion) -> BodyFrames:
        """The poses of F frames."""
        signals = {name: -row if name in SIDEWAYS else row for name, row in motion.signals.items()}
        stance = None if motion.stance is None else self._stance(motion.stance)
        frames = self._body.solve(replace(motion, signals=signals, stance=stance))
        return BodyFrames(
            rotations=frames.rotations[:, self._partners, self._columns] * self._signs,
            root_positions=frames.root_positions[:, self._roots] * ACROSS,
            parameters=frames.parameters,
        )

    def _stance(self, stance: FloatArray) -> FloatArray:
        """A way of standing, as `Stances.evaluate` gives it, reflected."""
        count = len(self._trunk)
        result = stance.copy()
        result[:, :count] = self._player.turns(self._trunk, stance[:, self._trunk_partners])
        result[:, count] *= ACROSS
        if stance.shape[1] > count + 1:
            # The feet, their turns and the knees, each left and right.
            for first, factors in ((1, ACROSS), (3, -ACROSS), (5, -ACROSS)):
                left = count + first
                result[:, left : left + 2] = stance[:, [left + 1, left]] * factors
        return result


def _skeletons(engagement: Engagement) -> dict[str, Skeleton]:
    """The skeletons of a performer's frames, in their order."""
    rigs = engagement.instrument_rigs
    return {"player": engagement.player_rig.skeleton, **{name: rig.skeleton for name, rig in rigs.items()}}


def _partner(name: str, of: dict[str, Skeleton]) -> str:
    """The skeleton that one of the left-handed player's reflects."""
    other = other_side(name)
    return other if other in of else name
