"""The trunk: from turns of hips, spine, neck and shoulders to where arms, legs and lips begin."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import multiply, rotate
from reina.skeleton import Point, RigError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import Rig


class Trunk:
    """Forward kinematics of a few joints and of the points that hang on them, for a block at once.

    Args:
        rig: The player's rig.
        joints: Names, parents first, beginning with the root; each one's parent is among them.
        points: Places that ride on these joints.

    Raises:
        RigError: A joint's parent, or a point's joint, is not among the joints.
    """

    def __init__(self, rig: Rig, joints: Sequence[str], points: Sequence[Point]) -> None:
        skeleton = rig.skeleton
        self.joints: IntArray = np.array([skeleton.index(name) for name in joints], dtype=np.intp)
        place = {joint: index for index, joint in enumerate(self.joints.tolist())}
        self._parents = [place.get(int(skeleton.parents[joint]), -1) for joint in self.joints.tolist()]
        for name, parent in zip(joints[1:], self._parents[1:], strict=True):
            if parent < 0:
                raise RigError(f"the parent of {name!r} must be one of {', '.join(joints)}", where="joints")
        for point in points:
            if point.joint not in place:
                raise RigError(f"{point.name!r} must sit on one of {', '.join(joints)}", where="contacts")
        # Every joint but the root, and every point, hangs on a link; a point's place is the sum of its links.
        carriers = self._parents[1:] + [place[point.joint] for point in points]
        self._carriers: IntArray = np.array(carriers, dtype=np.intp)
        self._links: FloatArray = np.concatenate(
            [skeleton.rest_translations[self.joints[1:]], np.array([point.offset for point in points])]
        )
        self._sums: FloatArray = np.zeros((len(points), len(carriers)))
        for row, point in enumerate(points):
            self._sums[row, len(joints) - 1 + row] = 1.0
            joint = place[point.joint]
            while joint > 0:
                self._sums[row, joint - 1] = 1.0
                joint = self._parents[joint]

    def solve(self, local: FloatArray, root_positions: FloatArray) -> tuple[FloatArray, FloatArray]:
        """World rotations of the joints ``(F, N, 4)`` and positions of the points ``(F, K, 3)``, metres.

        Args:
            local: Local rotations, rest included, ``(F, N, 4)``.
            root_positions: ``(F, 3)``, metres.
        """
        world = np.empty(local.shape)
        world[:, 0] = local[:, 0]
        for joint in range(1, len(self._parents)):
            world[:, joint] = multiply(world[:, self._parents[joint]], local[:, joint])
        links = rotate(world[:, self._carriers], self._links)
        return world, root_positions[:, None] + np.matmul(self._sums, links)
