"""Where a kit is struck: its zones at rest.

The kit's frame has +Y up; the player faces +Z, and +X is the player's left.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.skeleton import RigError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.rotations.arrays import FloatArray

UP: Final = np.array([0.0, 1.0, 0.0])

SWINGING: Final = ("ride", "crash_left", "crash_right", "china", "splash", "hi_hat")
"""Pieces that turn about their own joint."""

INSTEAD: Final = {
    "rim": ("rim", "edge", "centre"),
    "edge": ("edge", "bow", "centre"),
    "centre": ("centre", "edge", "bow"),
    "bow": ("bow", "edge", "centre"),
    "bell": ("bell", "bow", "centre"),
}
"""What is struck where a piece lacks a zone."""


@dataclass(frozen=True, eq=False)
class ZonePlace:
    """A zone at rest, in the kit's frame.

    Attributes:
        piece: Of `PIECES`.
        zone: Its name.
        position: (3,) metres.
        normal: (3,) out of the surface, a unit vector.
        radius: How far from the position it still is the zone, metres.
        pivot: (3,) what the piece turns about: its joint.
        axis: (3,) a cymbal's own axis, up, a unit vector.
    """

    piece: str
    zone: str
    position: FloatArray
    normal: FloatArray
    radius: float
    pivot: FloatArray
    axis: FloatArray = field(default_factory=lambda: UP.copy())

    @property
    def outward(self) -> FloatArray:
        """(3,) from the pivot to the zone, level: a unit vector, or 0 over the pivot."""
        level = (self.position - self.pivot) * (1.0, 0.0, 1.0)
        far = float(np.linalg.norm(level))
        return level / far if far > 1e-6 else np.zeros(3)

    def mirrored(self) -> ZonePlace:
        """The same on a left-handed player's kit."""
        flip = np.array([-1.0, 1.0, 1.0])
        return replace(
            self,
            position=self.position * flip,
            normal=self.normal * flip,
            pivot=self.pivot * flip,
            axis=self.axis * flip,
        )


class KitPlaces:
    """The zones of a kit.

    Args:
        zones: All of them, in the kit's frame.

    Raises:
        RigError: There is none.
    """

    def __init__(self, zones: Iterable[ZonePlace]) -> None:
        self._zones = {(zone.piece, zone.zone): zone for zone in zones}
        if not self._zones:
            raise RigError(
                "a drum kit has zones, as [{piece, zone, joint, position, normal, radius}]", location="zones"
            )

    def __getitem__(self, key: tuple[str, str]) -> ZonePlace:
        piece, zone = key
        for name in INSTEAD.get(zone, (zone,)):
            if (piece, name) in self._zones:
                return self._zones[piece, name]
        raise RigError(
            f"the kit has no {piece}; it has {', '.join(sorted({piece for piece, _ in self._zones}))}",
            location="zones",
        )

    def __contains__(self, piece: str) -> bool:
        return any(piece == held for held, _ in self._zones)

    def mirrored(self) -> KitPlaces:
        """The kit of a left-handed player."""
        return KitPlaces(zone.mirrored() for zone in self._zones.values())
