"""Which module plans the gestures of which instrument."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from reina.instruments.trumpet.gestures import plan_gestures as plan_trumpet

if TYPE_CHECKING:
    from collections.abc import Mapping

    from reina.instruments import PlayedPart
    from reina.instruments.trumpet.gestures import Curve


class GesturePlanner(Protocol):
    """Plans what a player does: curves by name, as `reina.kinematics.MotionCurves` takes them."""

    def __call__(self, played: PlayedPart, *, seed: int = 0) -> dict[str, Curve]:
        """Plan a part."""
        ...


GESTURE_PLANNERS: Mapping[str, GesturePlanner] = {
    "trumpet": plan_trumpet,
    "cornet": plan_trumpet,
    "flugelhorn": plan_trumpet,
}
"""By the instrument's name: what is held and blown as a trumpet is planned as one."""
