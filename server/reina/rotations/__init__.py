"""Unit quaternions (x, y, z, w), and matrices, rotation vectors, Euler angles and curves made of them."""

from reina.rotations.euler import ORDERS, from_euler, to_euler
from reina.rotations.exponential import about_axis, exp, exp_matrix, from_axis_angle, log, log_matrix
from reina.rotations.interpolation import slerp, slerp_matrix, spline, squad, squad_controls
from reina.rotations.matrices import from_matrix, to_matrix
from reina.rotations.products import BLOCK_FRAMES, product
from reina.rotations.quaternions import (
    IDENTITY,
    angle_between,
    as_quaternions,
    conjugate,
    continuous,
    cross,
    dot,
    multiply,
    normalize,
    rotate,
    same_hemisphere,
)

__all__ = [
    "BLOCK_FRAMES",
    "IDENTITY",
    "ORDERS",
    "about_axis",
    "angle_between",
    "as_quaternions",
    "conjugate",
    "continuous",
    "cross",
    "dot",
    "exp",
    "exp_matrix",
    "from_axis_angle",
    "from_euler",
    "from_matrix",
    "log",
    "log_matrix",
    "multiply",
    "normalize",
    "product",
    "rotate",
    "same_hemisphere",
    "slerp",
    "slerp_matrix",
    "spline",
    "squad",
    "squad_controls",
    "to_euler",
    "to_matrix",
]
