"""Several players as a stage sees them: where each stands, and who has the tune when."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.curves.arrays import FloatArray
from reina.stage.music_form import MusicForm, Passage


@dataclass(frozen=True)
class Place:
    """Where somebody stands, or sits at the drums.

    Attributes:
        x_m: Metres from the middle, +x being the players' left.
        z_m: Toward the audience.
        facing_rad: How far they are turned to their left from facing the audience.
        y_m: How high above the floor.
        at_drums: Whether it is the place of the drums.
        mirrored: Whether what is played there is the mirror image, as a left-handed drummer's kit.
    """

    x_m: float
    z_m: float
    facing_rad: float
    y_m: float = 0.0
    at_drums: bool = False
    mirrored: bool = False

    def put(self, points: FloatArray) -> FloatArray:
        """Points ``(..., 3)`` of somebody in the middle who faces the audience, metres, as they are here."""
        sine, cosine = np.sin(self.facing_rad), np.cos(self.facing_rad)
        x, y, z = points[..., 0], points[..., 1], points[..., 2]
        return np.stack(
            [x * cosine + z * sine + self.x_m, y + self.y_m, z * cosine - x * sine + self.z_m], axis=-1
        )


@dataclass(frozen=True)
class CastForm:
    """A cast of several.

    Attributes:
        places: Where each player stands, in the cast's order.
        tune: From when on which player has the tune, seconds, in order; the first from the beginning.
    """

    places: tuple[Place, ...]
    tune: tuple[tuple[float, int], ...]


def leads_of(form: MusicForm, found: Sequence[Passage], cast: CastForm) -> list[int]:
    """Who has the tune for most of each passage.

    Args:
        form: The piece.
        found: Its passages.
        cast: Who has the tune when.
    """
    starts_s = np.array([start_s for start_s, _ in cast.tune])
    ends_s = np.append(starts_s[1:], np.inf)
    players = np.array([player for _, player in cast.tune])
    lines_s = np.append(form.bar_lines_s, max(form.duration_s, *form.bar_lines_s[-1:], 0.0))
    leads: list[int] = []
    for passage in found:
        first_s, last_s = lines_s[passage.start_bar], lines_s[min(passage.end_bar, len(lines_s) - 1)]
        for_s = np.maximum(np.minimum(ends_s, last_s) - np.maximum(starts_s, first_s), 0.0)
        leads.append(int(np.bincount(players, for_s, minlength=len(cast.places)).argmax()))
    return leads
