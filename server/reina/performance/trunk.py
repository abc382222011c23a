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
        directions: Vectors that turn with these joints, each as a point's offset.

    Raises:
        RigError: A joint's parent, or a point's joint, is not among the joints.
    """

    def __init__(
        self, rig: Rig, joints: Sequence[str], points: Sequence[Point], directions: Sequence[Point] = ()
    ) -> None:
        skeleton = rig.skeleton
        self.joints: IntArray = np.array([skeleton.index(name) for name in joints], dtype=np.intp)
        place = {joint: index for index, joint in enumerate(self.joints.tolist())}
        self._parents = [place.get(int(skeleton.parents[joint]), -1) for joint in self.joints.tolist()]
        for name, parent in zip(joints[1:], self._parents[1:], strict=True):
            if parent < 0:
                raise RigError(
                    f"the parent of {name!r} must be one of {', '.join(joints)}", location="joints"
                )
        for point in (*points, *directions):
            if point.joint not in place:
                raise RigError(f"{point.name!r} must sit on one of {', '.join(joints)}", location="contacts")
        # Every joint but the root, and every point, hangs on a link; a point's place is the sum of its links.
        hung = self._parents[1:] + [place[point.joint] for point in points]
        carriers = hung + [place[direction.joint] for direction in directions]
        self._carriers: IntArray = np.array(carriers, dtype=np.intp)
        offsets = [point.offset for point in (*points, *directions)]
        self._links: FloatArray = np.concatenate([skeleton.rest_translations[self.joints[1:]], offsets])
        self._sums: FloatArray = np.zeros((len(points), len(hung)))
        for row, point in enumerate(points):
            self._sums[row, len(joints) - 1 + row] = 1.0
            joint = place[point.joint]
            while joint > 0:
                self._sums[row, joint - 1] = 1.0
                joint = self._parents[joint]
        self._levels = self._by_depth()

    def _by_depth(self) -> list[tuple[IntArray, IntArray]]:
        """Joints equally far from the root, with their parents: one product does for each such row."""
        depths = [0]
        for parent in self._parents[1:]:
            depths.append(depths[parent] + 1)
        rows = [
            [joint for joint, depth in enumerate(depths) if depth == level]
            for level in range(1, max(depths) + 1)
        ]
        return [
            (np.array(row, dtype=np.intp), np.array([self._parents[joint] for joint in row], dtype=np.intp))
            for row in rows
        ]

    def solve(
        self, local: FloatArray, root_positions: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Where the trunk is.

        Returns:
            World rotations of the joints ``(F, N, 4)``, positions of the points ``(F, K, 3)``, metres, and
            the directions in the world ``(F, D, 3)``.

        Args:
            local: Local rotations, rest included, ``(F, N, 4)``.
            root_positions: ``(F, 3)``, metres.
        """
        world = np.empty(local.shape)
        world[:, 0] = local[:, 0]
        for joints, parents in self._levels:
            world[:, joints] = multiply(world[:, parents], local[:, joints])
        turned = rotate(world[:, self._carriers], self._links)
        links = self._sums.shape[1]
        points = root_positions[:, None] + np.matmul(self._sums, turned[:, :links])
        return world, points, turned[:, links:]
