"""Everything that a drummer and the kit do in a part, at any times."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from reina.instruments.drums.hit import MIRRORED
from reina.instruments.drums.motion.foot_paths import FootFrames, FootPaths
from reina.instruments.drums.motion.kit_answers import KitAnswers, KitFrames
from reina.instruments.drums.motion.stick_paths import StickFrames, StickPaths
from reina.instruments.drums.motion.twirls import plan_twirls

if TYPE_CHECKING:
    from reina.instruments.drums.drum_part import DrumFingering
    from reina.instruments.drums.motion.kit_places import KitPlaces
    from reina.rotations.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class DrummerFrames:
    """F frames of a drummer.

    Attributes:
        sticks: Tips, directions and hands; index 0 is on the player's right.
        feet: Pedals, heels and beater; index 0 is the foot at the bass drum.
        kit: What the kit does.
    """

    sticks: StickFrames
    feet: FootFrames
    kit: KitFrames


class DrummerMotion:
    """A drummer's motion, a pure function of times.

    Args:
        fingering: What is struck.
        places: The kit of a right-handed player; a left-handed one's is its mirror.
        beats_s: When the beats fall, seconds, ascending.
        hi_hat_travel: (3,) from the open to the closed hi-hat, as the rig has it.
        seed: In which rests a stick is twirled; None for none.

    Raises:
        RigError: The kit lacks a piece that is struck.
    """

    def __init__(
        self,
        fingering: DrumFingering,
        places: KitPlaces,
        *,
        beats_s: FloatArray | None = None,
        hi_hat_travel: FloatArray | None = None,
        seed: int | None = None,
    ) -> None:
        is_left = fingering.handedness == "left"
        hits = fingering.hits
        stands = places.mirrored() if is_left else places
        feet = [replace(hit, limb=MIRRORED[hit.limb]) for hit in hits] if is_left else hits
        self._answers = KitAnswers(hits, fingering.chokes, mirrored=is_left)
        self._sticks = StickPaths(
            hits,
            stands,
            self._answers,
            hi_hat_travel=hi_hat_travel,
            chokes=fingering.chokes,
            twirls=((), ()) if seed is None else plan_twirls(fingering, seed),
        )
        self._feet = FootPaths(feet, self._answers, beats_s)

    def evaluate(self, times_s: FloatArray) -> DrummerFrames:
        """Sticks, feet and kit at times ``(F,)``."""
        kit = self._answers.evaluate(times_s)
        return DrummerFrames(self._sticks.evaluate(times_s, kit), self._feet.evaluate(times_s, kit), kit)
