"""Where hands have far to go the trunk helps: it turns, leans and brings a shoulder forward, by iteration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import cross

if TYPE_CHECKING:
    from collections.abc import Mapping

    from reina.instruments.player.body import PlayerBody
    from reina.instruments.player.body_table import Vector
    from reina.rotations.arrays import FloatArray

SHOULDERS: Mapping[str, Mapping[str, Vector]] = {
    "left_forward": {"leftShoulder": (0.0, -1.0, 0.0)},
    "right_forward": {"rightShoulder": (0.0, 1.0, 0.0)},
}
"""Signals that bring a shoulder forward: the joint's turn, radians, as `body_table.TURNS`."""

SIGNALS: tuple[str, ...] = ("torso_bow", "torso_turn", "torso_tip", *SHOULDERS)
"""What moves, in the order of the columns of `reach_out`."""

ROUNDS = 6
"""How many steps of damped least squares; fixed, so that a trunk is a function of its target alone."""

COMFORT = 0.86
"""A hand that is further away than this part of the arm's reach pulls the trunk along."""

SOFTNESS_M = 0.03
"""Over how long a way that begins."""

DAMPING_M = 0.12
"""λ of damped least squares: a lever of this length is worth half of its step."""

TURNED_TO = 0.35
"""How much of the way to the middle of both hands the trunk turns in any case."""

LIMITS = np.array([[-0.08, -0.55, -0.22, -0.15, -0.15], [0.45, 0.55, 0.22, 0.32, 0.32]])
"""From and to, radians, of each of `SIGNALS`."""


STRAIGHT = 0.95
"""No arm is to be straighter than this part of its reach where `reach_further` can help."""


def reach_out(
    body: PlayerBody, wrists: FloatArray, pivot: FloatArray, signals: Mapping[str, FloatArray]
) -> FloatArray:
    """How a trunk helps hands to where they are to be.

    Damped least squares (Nakamura and Hanafusa 1986) on how far each wrist is beyond a comfortable reach,
    over three turns of the trunk and one of each collarbone, from a start that turns to the middle of both
    hands.

    Args:
        body: Made with the signals `SHOULDERS`.
        wrists: Where left and right are to be, ``(F, 2, 3)``, metres.
        pivot: What the trunk turns about, ``(3,)``, metres.
        signals: All of the body's signals, ``(F,)`` each.

    Returns:
        Radians, ``(F, 5)``, of `SIGNALS`.
    """
    middle = wrists.mean(axis=1) - pivot
    turned = np.zeros((len(wrists), len(SIGNALS)))
    turned[:, 1] = TURNED_TO * np.arctan2(middle[:, 0], np.maximum(middle[:, 2], 0.2))
    return _nearer(body, wrists, pivot, signals, turned, COMFORT, SOFTNESS_M)


def reach_further(
    body: PlayerBody,
    wrists: FloatArray,
    pivot: FloatArray,
    signals: Mapping[str, FloatArray],
    turned: FloatArray,
) -> FloatArray:
    """How a trunk helps hands further that it leaves too far from where they are to be.

    Args:
        body: As `reach_out`.
        wrists: As `reach_out`.
        pivot: As `reach_out`.
        signals: As `reach_out`, without what the trunk does already.
        turned: That, ``(F, 5)``, of `SIGNALS`.

    Returns:
        What it does then, ``(F, 5)``; the same where the arms reach.
    """
    return _nearer(body, wrists, pivot, signals, turned, STRAIGHT, 0.0)


def _nearer(
    body: PlayerBody,
    wrists: FloatArray,
    pivot: FloatArray,
    signals: Mapping[str, FloatArray],
    turned: FloatArray,
    comfort: float,
    softness_m: float,
) -> FloatArray:
    comfortable = comfort * body.arm_reach
    for _ in range(ROUNDS):
        turned = np.minimum(np.maximum(turned, LIMITS[0]), LIMITS[1])
        moved = {name: signals[name] + turned[:, column] for column, name in enumerate(SIGNALS)}
        shoulders = body.stand({**signals, **moved}).limbs[:, :2]
        line = wrists - shoulders
        distance = np.sqrt(np.einsum("fki,fki->fk", line, line))
        along = line / distance[..., None]
        beyond = distance - comfortable
        lacking = 0.5 * (beyond + np.sqrt(beyond * beyond + softness_m * softness_m))
        jacobian = _jacobian(along, shoulders - pivot)
        square = jacobian @ jacobian.swapaxes(-1, -2) + DAMPING_M**2 * np.eye(2)
        step: FloatArray = np.asarray(np.linalg.solve(square, lacking[..., None]), dtype=np.float64)
        turned = turned + np.matmul(jacobian.swapaxes(-1, -2), step)[..., 0]
    return np.minimum(np.maximum(turned, LIMITS[0]), LIMITS[1])


def _jacobian(along: FloatArray, levers: FloatArray) -> FloatArray:
    """How each signal shortens each arm's way, metres a radian, ``(F, 2, 5)``."""
    jacobian = np.zeros((len(along), 2, len(SIGNALS)))
    for axis in range(3):  # bow about x, turn about y, tip about z
        unit = np.eye(3)[axis]
        jacobian[:, :, axis] = np.einsum(
            "fki,fki->fk", along, cross(np.broadcast_to(unit, levers.shape), levers)
        )
    collarbone = levers.copy()
    collarbone[..., 1:] = 0.0  # from the breastbone to the shoulder
    for side, sign in enumerate((-1.0, 1.0)):
        swing = cross(np.broadcast_to([0.0, sign, 0.0], levers.shape), collarbone)
        jacobian[:, side, 3 + side] = np.einsum("fi,fi->f", along[:, side], swing[:, side])
    return jacobian
