"""Ways of standing laid under the playing: what a rig's clips do to the trunk beside their first frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.player.body_table import TRUNK
from reina.rotations import conjugate, log, multiply
from reina.skeleton import retarget

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray
    from reina.skeleton import MotionClip, Rig

STANCES: tuple[str, ...] = ("none", "breathing", "swaying", "shifting")
"""Choices of ``player/stance``: none, or a clip of the rig by its name; one that the rig has not is none."""

_SEAM = 1e-3
"""How far a clip's last frame may be from its first, radians and metres, for the clip to be a loop."""


class Stances:
    """The clips of a rig as turns of its trunk and a shift of its hips, at any time, each looped.

    An additive layer: of each frame the difference from the clip's first counts, so that the hold stays the
    posture and hands, horn and feet are brought back to their places by the solvers.

    Args:
        rig: Its clips and the joints of `TRUNK`.

    Raises:
        ValueError: A clip does not end where it begins.
    """

    def __init__(self, rig: Rig) -> None:
        self.joints = tuple(name for name in TRUNK if name in rig.skeleton)
        """Columns of the turns."""
        self._tables = {
            choice: (_table(rig, rig.clips[name], name, self.joints), rig.clips[name].frame_time_s)
            for choice, name in enumerate(STANCES)
            if name in rig.clips
        }

    def evaluate(self, times_s: FloatArray, weights: FloatArray) -> FloatArray | None:
        """Rotation vectors of the joints, in their own frames, then the hips' shift in metres.

        Args:
            times_s: Song times, ``(F,)``.
            weights: How much of each of `STANCES`, ``(F, len(STANCES))``.

        Returns:
            ``(F, len(joints) + 1, 3)``, or None where nothing is to be added.
        """
        total: FloatArray | None = None
        for choice, (table, frame_time_s) in self._tables.items():
            weight = weights[:, choice]
            if not weight.any():
                continue
            place, share = _taps(times_s, frame_time_s, len(table))
            moved = np.einsum("ft,ftc->fc", share * weight[:, None], table[place])
            total = moved if total is None else total + moved
        return None if total is None else total.reshape(len(times_s), -1, 3)


def _table(rig: Rig, clip: MotionClip, name: str, joints: tuple[str, ...]) -> FloatArray:
    """Turns and shift of a clip's frames but the last, which is the first again, ``(F - 1, 3 J + 3)``."""
    rotations, roots = retarget(clip, rig.skeleton, {joint: joint for joint in clip.names})
    moved = rotations[:, [rig.skeleton.index(joint) for joint in joints]]
    turns = log(multiply(conjugate(moved[0]), moved))
    table = np.concatenate([turns.reshape(len(clip), -1), roots - roots[0]], axis=1)
    if len(table) < 2 or np.abs(table[-1]).max() > _SEAM:
        raise ValueError(f"the clip {name!r} does not end where it begins, so it cannot be looped")
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
