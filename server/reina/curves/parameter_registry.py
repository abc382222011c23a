"""All parameters of a performance, in the order in which a frame carries them."""

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from reina.curves.arrays import FloatArray
from reina.curves.interpolation import describe_interpolations, interpolations_for
from reina.curves.parameter import Parameter


class ParameterRegistry:
    """An ordered collection of parameters, found by their paths.

    Raises:
        ValueError: A path is declared twice.
    """

    def __init__(self, parameters: Iterable[Parameter]) -> None:
        self._parameters = tuple(parameters)
        self._by_path = {parameter.path: parameter for parameter in self._parameters}
        if len(self._by_path) != len(self._parameters):
            paths = [parameter.path for parameter in self._parameters]
            twice = sorted({path for path in paths if paths.count(path) > 1})
            raise ValueError(f"parameters are declared twice: {', '.join(twice)}")

    def __iter__(self) -> Iterator[Parameter]:
        return iter(self._parameters)

    def __len__(self) -> int:
        return len(self._parameters)

    def __contains__(self, path: object) -> bool:
        return path in self._by_path

    def __getitem__(self, path: str) -> Parameter:
        """The parameter of a path; KeyError where there is none."""
        return self._by_path[path]

    def get(self, path: str) -> Parameter | None:
        """The parameter of a path, or None."""
        return self._by_path.get(path)

    @property
    def size(self) -> int:
        """How many floats all parameters are together: P."""
        return sum(parameter.length for parameter in self._parameters)

    def layout(self) -> dict[str, tuple[int, int]]:
        """Where each parameter stands in a row of P floats: path -> (offset, length), in floats."""
        layout: dict[str, tuple[int, int]] = {}
        offset = 0
        for parameter in self._parameters:
            layout[parameter.path] = (offset, parameter.length)
            offset += parameter.length
        return layout

    def defaults(self) -> FloatArray:
        """The values where no show says others, ``(P,)``."""
        rows = [parameter.floats(parameter.default) for parameter in self._parameters]
        return np.concatenate(rows) if rows else np.zeros(0)

    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """The least and the greatest value of each float, two ``(P,)``; infinite where there is no bound."""
        lows: list[float] = []
        highs: list[float] = []
        for parameter in self._parameters:
            low, high = (0.0, 1.0) if parameter.type == "color" else (parameter.minimum, parameter.maximum)
            lows += [-np.inf if low is None else low] * parameter.length
            highs += [np.inf if high is None else high] * parameter.length
        return np.array(lows), np.array(highs)

    def extended(self, parameters: Iterable[Parameter]) -> "ParameterRegistry":
        """A registry with more parameters after these."""
        return ParameterRegistry((*self._parameters, *parameters))

    def describe(self) -> dict[str, Any]:
        """What `GET /parameters` says: ``parameters``, and the ``interpolations`` of their keyframes."""
        return {
            "parameters": [_describe(parameter) for parameter in self._parameters],
            "interpolations": describe_interpolations(),
        }


def _describe(parameter: Parameter) -> dict[str, Any]:
    default = parameter.default
    return {
        "path": parameter.path,
        "type": parameter.type,
        "unit": parameter.unit,
        "minimum": parameter.minimum,
        "maximum": parameter.maximum,
        "default": list(default) if isinstance(default, tuple) else default,
        "choices": list(parameter.choices),
        "length": parameter.length,
        "blend": parameter.blend,
        "interpolations": list(interpolations_for(interpolates=parameter.interpolates)),
        "documentation": parameter.documentation,
    }
