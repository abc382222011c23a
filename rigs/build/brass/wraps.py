"""How a horn's tube runs from the mouthpiece to the third valve."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from brass import double_wrap, front_slide, mouthpipe

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from brass.measures import Horn
    from brass.metals import Metals
    from brass.paths import Array
    from common.turning import Workpiece


@dataclass(frozen=True)
class Wrap:
    """One way.

    Attributes:
        fixed: Adds what does not move to the body.
        tuning_slide: Makes the part by which it is tuned.
        obstacles: The tube as paths and their radii, in a few straight pieces.
    """

    fixed: Callable[[Workpiece, Metals, Horn], None]
    tuning_slide: Callable[[float, Metals, Horn], Workpiece]
    obstacles: Callable[[Horn], list[tuple[Array, float]]]


WRAPS: Mapping[str, Wrap] = {
    module.__name__.rpartition(".")[2]: Wrap(module.fixed, module.tuning_slide, module.obstacles)
    for module in (front_slide, double_wrap, mouthpipe)
}
"""By name, as in the files of instruments/."""
