"""The laboratory's first table: ways from one orientation to another."""

from typing import TYPE_CHECKING

import numpy as np
from fastapi import APIRouter, Request

from reina.api.http.body import BoundedRoute
from reina.api.lab.work import compute
from reina.lab import Comparison, LabError, Orientation, Way, compare_interpolations
from reina.protocol.lab import (
    AxisAngleOrientation,
    EulerOrientation,
    InterpolationComparison,
    InterpolationRequest,
    InterpolationWay,
    OrientationForms,
    QuaternionOrientation,
)
from reina.rotations import log, to_euler

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray

router = APIRouter(route_class=BoundedRoute)


@router.post("/interpolations")
async def compare(request: Request, asked: InterpolationRequest) -> InterpolationComparison:
    """Slerp, matrix, Euler and rotation-vector interpolation, with speed, path and determinant."""
    start, end = _orientation(asked.start, "start"), _orientation(asked.end, "end")

    def work() -> InterpolationComparison:
        found = compare_interpolations(
            start, end, euler_order=asked.euler_order, samples=asked.samples, tip=asked.tip
        )
        return _told(found, asked.euler_order)

    return await compute(request, work)


def _orientation(
    given: EulerOrientation | AxisAngleOrientation | QuaternionOrientation, location: str
) -> Orientation:
    try:
        match given:
            case EulerOrientation():
                return Orientation.from_euler(given.angles_rad, given.order)
            case AxisAngleOrientation():
                return Orientation.from_axis_angle(given.axis, given.angle_rad)
            case QuaternionOrientation():
                return Orientation.from_quaternion(given.quaternion)
    except LabError as error:
        raise LabError(error.detail, location=f"{location}/{error.location}") from error


def _told(found: Comparison, order: str) -> InterpolationComparison:
    return InterpolationComparison(
        start=_forms(found.start, order),
        end=_forms(found.end, order),
        angle_rad=found.angle_rad,
        fractions=found.fractions.tolist(),
        ways=[_way(way) for way in found.ways],
    )


def _forms(quaternion: "FloatArray", order: str) -> OrientationForms:
    vector = log(quaternion)
    angle = float(np.linalg.norm(vector))
    axis = vector / angle if angle > 0.0 else np.array([1.0, 0.0, 0.0])
    return OrientationForms.model_validate(
        {
            "quaternion": quaternion.tolist(),
            "axis": axis.tolist(),
            "angle_rad": angle,
            "euler_rad": to_euler(quaternion, order).tolist(),
        }
    )


def _way(way: Way) -> InterpolationWay:
    return InterpolationWay.model_validate(
        {
            "name": way.name,
            "quaternions": way.quaternions.tolist(),
            "axes": np.swapaxes(way.matrices, -1, -2).tolist(),
            "tip": way.tip.tolist(),
            "speed": way.speed.tolist(),
            "determinant": way.determinant.tolist(),
            "orthogonality_error": way.orthogonality_error.tolist(),
            "length_rad": way.length_rad,
            "slowest": float(way.speed.min()),
            "fastest": float(way.speed.max()),
        }
    )
