"""Every interpolation by its name: the built-in ones, and those that installed packages bring.

A package brings one by an entry point of the group ``reina.interpolations`` that names a subclass of
`Keyframe`::

    [project.entry-points."reina.interpolations"]
    smootherstep = "my_package:SmootherstepKeyframe"
"""

import inspect
from collections.abc import Mapping
from functools import cache
from importlib.metadata import entry_points
from types import MappingProxyType
from typing import Any

from reina.curves.eased_keyframe import eased_interpolations
from reina.curves.keyframe import Keyframe
from reina.curves.options import options_of
from reina.curves.spline_keyframe import AutomaticKeyframe, ClampedKeyframe, SplineKeyframe
from reina.errors import ReinaError

ENTRY_POINT_GROUP = "reina.interpolations"

BUILT_IN: Mapping[str, type[Keyframe[Any]]] = MappingProxyType(
    {
        "step": Keyframe,
        **eased_interpolations(),
        "cubic_spline": SplineKeyframe,
        "automatic": AutomaticKeyframe,
        "clamped": ClampedKeyframe,
    }
)


class InterpolationError(ReinaError):
    """An installed package offers an interpolation that cannot be used."""


def discover_interpolations() -> dict[str, type[Keyframe[Any]]]:
    """The built-in interpolations and those of installed packages, looked for anew.

    Raises:
        InterpolationError: A package's entry point cannot be loaded, is no keyframe class, or takes a name
        that is taken.
    """
    table = dict(BUILT_IN)
    for point in sorted(entry_points(group=ENTRY_POINT_GROUP), key=lambda point: point.name):
        if point.name in table:
            raise InterpolationError(
                f"the interpolation {point.name!r} of {point.value} is there already; rename it"
            )
        try:
            loaded: object = point.load()
        except (ImportError, AttributeError) as error:
            raise InterpolationError(
                f"the interpolation {point.name!r} of {point.value} cannot be loaded: {error}"
            ) from error
        if not (inspect.isclass(loaded) and issubclass(loaded, Keyframe)):
            raise InterpolationError(
                f"the interpolation {point.name!r} of {point.value} is no subclass of Keyframe"
            )
        table[point.name] = loaded
    return table


@cache
def interpolations() -> Mapping[str, type[Keyframe[Any]]]:
    """Every interpolation by its name, looked for once in the life of the process."""
    return MappingProxyType(discover_interpolations())


def interpolation_name(keyframe: Keyframe[Any]) -> str:
    """The name of a keyframe's interpolation.

    Raises:
        InterpolationError: Its class is not among `interpolations`.
    """
    for name, interpolation in interpolations().items():
        if interpolation is type(keyframe):
            return name
    raise InterpolationError(
        f"{type(keyframe).__name__} has no name; declare it in the entry point group {ENTRY_POINT_GROUP}"
    )


def interpolations_for(*, interpolates: bool) -> tuple[str, ...]:
    """The names that keyframes may have: all, or step alone where nothing lies between two values."""
    return tuple(interpolations()) if interpolates else ("step",)


def describe_interpolations() -> list[dict[str, Any]]:
    """Every interpolation with its options and what it is, for the API."""
    return [
        {
            "name": name,
            "documentation": _documentation(interpolation),
            "options": [declared.describe() for declared in options_of(interpolation)],
            "tangents": getattr(interpolation, "tangents", None),
        }
        for name, interpolation in interpolations().items()
    ]


def _documentation(interpolation: type[Keyframe[Any]]) -> str:
    """Its own sentence, else the first line of its own docstring."""
    own: Mapping[str, Any] = vars(interpolation)
    first_line = (own.get("__doc__") or "").strip().partition("\n")[0]
    return str(own.get("documentation", first_line))
