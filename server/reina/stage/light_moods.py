"""Lights to choose without programming: each sets what a show would, from its beginning to its end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True)
class LightMood:
    """A light for a whole piece.

    Attributes:
        name: For programs.
        title: For people.
        values: Parameters, each with the value that it has throughout, as JSON writes it.
    """

    name: str
    title: str
    values: Mapping[str, Any]


def _dark(**lights: tuple[str | None, float]) -> dict[str, Any]:
    """The lights that are named by colour and strength; the sun, the room's light and the rest are off."""
    off = {f"lights/{name}/intensity": 0.0 for name in ("key", "fill", "rim", "ambient", "back_wash")}
    levels = {f"lights/{name}/intensity": level for name, (_, level) in lights.items()}
    colors = {f"lights/{name}/color": color for name, (color, _) in lights.items() if color is not None}
    return {**off, **levels, **colors}


MOOD_REST = ("lights", "stage/fog/density")
"""What goes back to rest where a mood says nothing of it: parameters, or beginnings of their paths."""

LIGHT_MOODS: tuple[LightMood, ...] = (
    LightMood(
        "afternoon",
        "Afternoon",
        {
            "lights/key/intensity": 3.2,
            "lights/key/color": "#FFDFBE",
            "lights/fill/intensity": 0.55,
            "lights/rim/intensity": 2.2,
            "lights/environment/intensity": 0.66,
        },
    ),
    LightMood(
        "last_sun",
        "Last sun",
        {
            "lights/key/intensity": 5.0,
            "lights/key/color": "#FFBC7C",
            "lights/key/position": [-3.4, 1.6, 1.1],
            "lights/fill/intensity": 0.9,
            "lights/rim/intensity": 1.0,
            "lights/environment/intensity": 0.55,
            "stage/fog/density": 0.015,
        },
    ),
    LightMood(
        "cool",
        "Cool morning",
        {
            "lights/key/intensity": 2.5,
            "lights/key/color": "#D8E2FF",
            "lights/fill/intensity": 0.8,
            "lights/fill/color": "#6E8FD6",
            "lights/rim/intensity": 3.6,
            "lights/rim/color": "#A9C4FF",
            "lights/back_wash/intensity": 2.6,
            "lights/back_wash/color": "#2A55B8",
            "lights/environment/intensity": 0.4,
        },
    ),
    LightMood(
        "concert",
        "Concert",
        {
            **_dark(
                fill=(None, 0.25),
                ambient=(None, 0.05),
                environment=(None, 0.14),
                back_wash=(None, 3.0),
                **{"spots/1": (None, 7.0), "spots/2": (None, 5.0), "spots/3": (None, 6.0)},
            ),
            "lights/haze": 1.0,
        },
    ),
    LightMood(
        "one_spot",
        "One spot",
        {**_dark(environment=(None, 0.12), **{"spots/1": (None, 7.0)}), "lights/haze": 1.0},
    ),
    LightMood(
        "night",
        "Night",
        {
            **_dark(
                fill=("#7C9AD9", 0.9),
                rim=("#AAC4FF", 3.6),
                environment=(None, 0.28),
                **{"spots/1": ("#FFCE99", 1.6)},
            ),
            "lights/haze": 0.3,
        },
    ),
)
"""In the order in which they are offered."""
