"""A motion clip: a skeleton without rest rotations, and its channels over time, as BVH has them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import from_euler, to_euler

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton.clip_warning import ClipWarning

POSITIONS: tuple[str, ...] = ("Xposition", "Yposition", "Zposition")
ROTATIONS: tuple[str, ...] = ("Xrotation", "Yrotation", "Zrotation")
STILL = 1e-6
"""How far a place may move that is said to keep still, in the file's unit: the last digit written."""


@dataclass(frozen=True, eq=False)
class MotionClip:
    """J joints over F frames.

    Attributes:
        names: Joints' names, parents first.
        parents: ``(J,)``; the root's is -1.
        offsets: Each joint in its parent's frame at rest, in the file's unit, ``(J, 3)``.
        end_sites: For each joint, where its end sites are in its frame; most joints have none.
        channels: For each joint the names of its channels in the file's order, of `POSITIONS` and
            `ROTATIONS`.
        values: The channels of all joints, degrees and the file's unit, ``(F, C)``. A position is the
            joint's place in its parent's frame, in place of that axis of its offset.
        frame_time_s: Seconds from frame to frame.
        warnings: What is not as the clip's file says.
    """

    names: tuple[str, ...]
    parents: IntArray
    offsets: FloatArray
    end_sites: tuple[tuple[tuple[float, float, float], ...], ...]
    channels: tuple[tuple[str, ...], ...]
    values: FloatArray
    frame_time_s: float
    warnings: tuple[ClipWarning, ...] = ()

    def __len__(self) -> int:
        return len(self.values)

    def motion(self) -> tuple[FloatArray, FloatArray]:
        """Local rotations ``(F, J, 4)`` and local translations ``(F, J, 3)``.

        Rotations apply in the channels' order about local axes; translations are the position channels,
        the offset on axes that have none.
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
                    translations[:, joint, POSITIONS.index(channel)] = values
                else:
                    order += channel[0].lower()
                    angles.append(np.radians(values))
            if order:
                rotations[:, joint] = from_euler(np.stack(angles, axis=-1), order)
        return rotations, translations

    def at_rest(self) -> MotionClip:
        """One frame in which nothing is turned and every joint is at its offset."""
        return replace(self, channels=((),) * len(self.names), values=np.zeros((1, 0)))

    def without_still_positions(self) -> MotionClip:
        """The same motion without position channels that keep one value, which becomes the offset.

        The root keeps its own. Many programs write a position for every joint that only repeats the offset;
        without them bones have their lengths at rest too, however a reader takes position channels.
        """
        offsets, channels = self.offsets.copy(), list(self.channels)
        kept = np.ones(self.values.shape[1], dtype=np.bool_)
        begin = 0
        for joint, own in enumerate(self.channels):
            columns = [begin + i for i, channel in enumerate(own) if channel in POSITIONS]
            begin += len(own)
            places = self.values[:, columns]
            if joint == 0 or not places.size or np.ptp(places, axis=0).max() > STILL:
                continue
            offsets[joint, [POSITIONS.index(one) for one in own if one in POSITIONS]] = places[0]
            channels[joint] = tuple(one for one in own if one not in POSITIONS)
            kept[columns] = False
        return replace(self, offsets=offsets, channels=tuple(channels), values=self.values[:, kept])

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
        values = np.concatenate([root_positions, angles.reshape(len(rotations), 3 * joints)], axis=1)
        return cls(
            names=names,
            parents=parents,
            offsets=offsets,
            end_sites=end_sites or ((),) * joints,
            channels=(POSITIONS + turning, *((turning,) * (joints - 1))),
            values=values,
            frame_time_s=frame_time_s,
        )
