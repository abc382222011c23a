"""A motion clip: a skeleton without rest rotations, and its channels over time, as BVH has them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import from_euler, to_euler

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray, IntArray

POSITIONS: tuple[str, ...] = ("Xposition", "Yposition", "Zposition")
ROTATIONS: tuple[str, ...] = ("Xrotation", "Yrotation", "Zrotation")


@dataclass(frozen=True, eq=False)
class MotionClip:
    """J joints over F frames.

    Attributes:
        names: Joints' names, parents first.
        parents: ``(J,)``; the root's is -1.
        offsets: Each joint in its parent's frame, in the file's unit, ``(J, 3)``.
        end_sites: For each joint, where its end sites are in its frame; most joints have none.
        channels: For each joint the names of its channels in the file's order, of `POSITIONS` and
            `ROTATIONS`.
        values: The channels of all joints, degrees and the file's unit, ``(F, C)``.
        frame_time_s: Seconds from frame to frame.
    """

    names: tuple[str, ...]
    parents: IntArray
    offsets: FloatArray
    end_sites: tuple[tuple[tuple[float, float, float], ...], ...]
    channels: tuple[tuple[str, ...], ...]
    values: FloatArray
    frame_time_s: float

    def __len__(self) -> int:
        return len(self.values)

    def motion(self) -> tuple[FloatArray, FloatArray]:
        """Local rotations ``(F, J, 4)`` and local translations ``(F, J, 3)``.

        Rotations apply in the channels' order about local axes; translations are the offset plus the
        channels.
        """
        frames, joints = len(self.values), len(self.names)
        rotations = np.tile([0.0, 0.0, 0.0, 1.0], (frames, joints, 1))
        translations = np.broadcast_to(self.offsets, (frames, joints, 3)).copy()
        column = 0
        for joint, channels in enumerate(self.channels):
            order = ""
            angles: list[FloatArray] = []
            for channel in channels:
                values = self.values[:, column]
                column += 1
                if channel in POSITIONS:
                    translations[:, joint, POSITIONS.index(channel)] += values
                else:
                    order += channel[0].lower()
                    angles.append(np.radians(values))
            if order:
                rotations[:, joint] = from_euler(np.stack(angles, axis=-1), order)
        return rotations, translations

    @classmethod
    def from_motion(
        cls,
        names: tuple[str, ...],
        parents: IntArray,
        offsets: FloatArray,
        rotations: FloatArray,
        root_positions: FloatArray,
        frame_time_s: float,
        *,
        order: str = "zxy",
        end_sites: tuple[tuple[tuple[float, float, float], ...], ...] | None = None,
    ) -> MotionClip:
        """A clip of local rotations ``(F, J, 4)`` and root positions ``(F, 3)``; six channels for the root.

        Angles are unwrapped in time, so that a player which blends them does not spin where they pass 180°.
        """
        joints = len(names)
        turning = tuple(f"{letter.upper()}rotation" for letter in order)
        angles = np.degrees(np.unwrap(to_euler(rotations, order), axis=0))
        values = np.concatenate(
            [root_positions - offsets[0], angles.reshape(len(rotations), 3 * joints)], axis=1
        )
        return cls(
            names=names,
            parents=parents,
            offsets=offsets,
            end_sites=end_sites or ((),) * joints,
            channels=(POSITIONS + turning, *((turning,) * (joints - 1))),
            values=values,
            frame_time_s=frame_time_s,
        )
