"""What a camera of a show has in its picture."""

import numpy as np
from numpy.typing import NDArray

from reina.curves import ParameterRegistry

# Where fingers, bell, head and mouth of a trumpeter 1.6 m tall are, metres.
VALVES = np.array([[0.03, 1.50, 0.37], [0.03, 1.49, 0.42], [-0.04, 1.52, 0.38], [-0.06, 1.46, 0.36]])
BELL_AND_HEAD = np.array([[0.05, 1.40, 0.66], [0.0, 1.64, 0.0], [0.01, 1.48, 0.12]])


def furthest_out(
    values: NDArray[np.float64], points: NDArray[np.float64], registry: ParameterRegistry
) -> NDArray[np.float64]:
    """The greatest of |x|, |y| of the points in each frame, the edge of a 16:9 picture being 1; (F,)."""
    layout = registry.layout()

    def column(path: str) -> NDArray[np.float64]:
        offset, length = layout[path]
        return values[:, offset : offset + length]

    position, target, fov = column("camera/position"), column("camera/target"), column("camera/fov")
    forward = target - position
    forward /= np.linalg.norm(forward, axis=1, keepdims=True)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right, axis=1, keepdims=True)
    up = np.cross(right, forward)
    away = points[None] - position[:, None]
    depth = np.einsum("fpi,fi->fp", away, forward)
    assert np.all(depth > 0.2)
    half = np.tan(fov / 2.0)
    x = np.einsum("fpi,fi->fp", away, right) / depth / (half * 16 / 9)
    y = np.einsum("fpi,fi->fp", away, up) / depth / half
    return np.maximum(np.abs(x), np.abs(y)).max(axis=1)
