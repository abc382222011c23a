"""Ways of standing under the playing: a rig's clips, laid over the hold, and poses in its place."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.player.body_table import TRUNK
from reina.instruments.player.posed_stance import retarget_pose
from reina.rotations import conjugate, log, multiply, product
from reina.skeleton import retarget

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.player.held_pose import HeldPose
    from reina.rotations.arrays import FloatArray
    from reina.skeleton import HumanPose, Rig

STANCES: tuple[str, ...] = ("none", "breathing", "swaying", "shifting")
"""Choices of ``player/stance`` that there always are: none, or a clip of the rig by its name; one that the
rig has not is none. A session's own stances come after them."""

_SEAM = 1e-3
"""How far a clip's last frame may be from its first, radians and metres, for the clip to be a loop."""


LEGS = 6
"""Rows that a pose has after trunk and hips: feet, their turns, knees, left and right."""


class Stances:
    """The clips of a rig as turns of its trunk and a shift of its hips, at any time, each looped; and poses.

    An additive layer: of each frame the difference from the clip's first counts, so that the hold stays the
    posture and hands, horn and feet are brought back to their places by the solvers. A pose is the difference
    from the hold, and takes the feet along.

    Args:
        rig: Its clips and the joints of `TRUNK`.
        poses: Further stances, after `STANCES`.
        held: The playing position, which poses differ from; not needed without any.

    Raises:
        ValueError: A clip does not end where it begins.
    """

    def __init__(self, rig: Rig, poses: Sequence[HumanPose] = (), held: HeldPose | None = None) -> None:
        self.joints = tuple(name for name in TRUNK if name in rig.skeleton)
        """Columns of the turns."""
        self._tables = {
            choice: (_table(rig, name, self.joints), rig.clips[name].frame_time_s)
            for choice, name in enumerate(STANCES)
            if name in rig.clips
        }
        self.count = len(STANCES) + len(poses)
        """How many stances there are."""
        rows = [] if held is None else [retarget_pose(pose, rig, held).row for pose in poses]
        self._poses: FloatArray = np.array(rows).reshape(len(rows), 3 * (len(self.joints) + 1 + LEGS))

    def evaluate(self, times_s: FloatArray, weights: FloatArray) -> FloatArray | None:
        """Rotation vectors of the joints, in their own frames, then the hips' shift in metres.

        Args:
            times_s: Song times, ``(F,)``.
            weights: How much of each stance, ``(F, count)``; of a pose no more than all.

        Returns:
            ``(F, len(joints) + 1, 3)``; where there is something of a pose, `LEGS` more rows each, as
            `PosedStance.row` has them; None where nothing is to be added.
        """
        total: FloatArray | None = None
        for choice, (table, frame_time_s) in self._tables.items():
            weight = weights[:, choice]
            if not weight.any():
                continue
            place, share = _taps(times_s, frame_time_s, len(table))
            moved = np.einsum("ft,ftc->fc", share * weight[:, None], table[place])
            total = moved if total is None else total + moved
        posed = weights[:, len(STANCES) :]
        if posed.any():
            added = product(np.minimum(posed, 1.0), self._poses)
            if total is not None:
                added[:, : total.shape[1]] += total
            total = added
        return None if total is None else total.reshape(len(times_s), -1, 3)


@lru_cache(maxsize=32)
def _table(rig: Rig, name: str, joints: tuple[str, ...]) -> FloatArray:
    """Turns and shift of a clip's frames but the last, which is the first again, ``(F - 1, 3 J + 3)``.

    All sessions whose player is of one rig share it.
    """
    clip = rig.clips[name]
    rotations, roots = retarget(clip, rig.skeleton, {joint: joint for joint in clip.names})
    moved = rotations[:, [rig.skeleton.index(joint) for joint in joints]]
    turns = log(multiply(conjugate(moved[0]), moved))
    table = np.concatenate([turns.reshape(len(clip), -1), roots - roots[0]], axis=1)
    if len(table) < 2 or np.abs(table[-1]).max() > _SEAM:
        raise ValueError(f"the clip {name!r} does not end where it begins, so it cannot be looped")
    table.flags.writeable = False
    return table[:-1]


def _taps(times_s: FloatArray, frame_time_s: float, frames: int) -> tuple[np.ndarray, FloatArray]:
    """The four frames about each time, ``(F, 4)``, and their shares by Catmull and Rom's spline (1974)."""
    at = times_s / frame_time_s
    whole = np.floor(at)
    u = (at - whole)[:, None]
    place = (whole.astype(np.int64)[:, None] + np.arange(-1, 3)) % frames
    share = np.concatenate(
        [
            ((2.0 - u) * u - 1.0) * u,
            (3.0 * u - 5.0) * u * u + 2.0,
            ((4.0 - 3.0 * u) * u + 1.0) * u,
            (u - 1.0) * u * u,
        ],
        axis=1,
    )
    return place, 0.5 * share
