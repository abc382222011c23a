"""What a drummer costs: the arms' solve beside other libraries, and a frame with its parts.

Run as ``python tests/benchmarks/bench_drummer.py``. All times are the processor's own, which other work on
the machine lengthens less: of each block of 60 frames the best of many runs, and the mean over the blocks.
The targets are what the drummer is asked for in an example and in the scores that the audit is made with
(tests/integration/test_drum_audit.py). Other libraries (requirements/bench.txt) are given the same arm as
one chain of hinges, and the tip's place alone, which leaves them free where Reina also keeps elbow and stick
where a drummer has them; a library that is not installed is named and left out.
"""

from __future__ import annotations

import argparse
import time
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Any
from unittest import mock

import numpy as np
from drummer_targets import (
    FRAMES,
    KIT,
    PLAYER,
    RIGS,
    SAINTS,
    Recorded,
    arm_chain,
    drummer,
    load_stage,
    record,
    scores,
)
from machine import heading, verdict
from other_solvers import OTHERS, TOLERANCE_M, Measured, by_ikpy, by_mink, by_pink, finger_of

from reina.instruments.drums.body import DEVIATION_RAD, FLEXION_RAD
from reina.instruments.drums.motion.drummer_motion import DrummerMotion
from reina.instruments.drums.motion.foot_paths import FootPaths
from reina.instruments.drums.motion.kit_answers import KitAnswers
from reina.instruments.drums.motion.kit_pose import KitPose
from reina.instruments.drums.motion.stick_paths import StickPaths
from reina.instruments.performer import Performer
from reina.instruments.player.body import LIMBS, PlayerBody
from reina.instruments.player.held_pose import HeldPose
from reina.instruments.player.trunk_reach import reach_out
from reina.kinematics import TwoBoneLimbs, solve_damped_least_squares, tool_arms
from reina.kinematics.tool_arms import ToolArms
from reina.rotations import conjugate, rotate
from reina.show import ShowPlan
from reina.skeleton import load_hold, load_rig

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

    from drummer_targets import Call

    from reina.kinematics.tool_arms import ToolPose
    from reina.kinematics.two_bone import LimbPose
    from reina.rotations.arrays import FloatArray
    from reina.sessions.stage import Stage

BOUND_US = 40.0
"""A frame of a drummer costs no more than this."""

PLANNED_EVERY = 6
"""The trunk is worked out for every so many frames."""

RIG = load_rig(RIGS / PLAYER)
ARMS = TwoBoneLimbs(RIG, LIMBS[:2])
PARTS: tuple[tuple[type, str, str], ...] = (
    (ShowPlan, "evaluate", "show"),
    (Performer, "move", "gestures"),
    (DrummerMotion, "evaluate", "sticks, feet and kit"),
    (StickPaths, "evaluate", "  sticks"),
    (FootPaths, "evaluate", "  feet"),
    (KitAnswers, "evaluate", "  what the kit answers"),
    (KitPose, "rotations", "the kit's joints"),
    (PlayerBody, "stand", "trunk"),
    (ToolArms, "solve", "arms with sticks"),
    (PlayerBody, "reach", "limbs"),
)
"""What of a frame is told apart."""


def best_us(run: Callable[[int], object], blocks: int, repetitions: int) -> FloatArray:
    """Of each block the best time in the processor, microseconds, ``(blocks,)``."""
    times = np.empty((repetitions, blocks))
    for repetition in range(repetitions):
        for block in range(blocks):
            start = time.process_time_ns()
            run(block)
            times[repetition, block] = time.process_time_ns() - start
    return times.min(axis=0) / 1e3


def whole_frame(stage: Stage, repetitions: int) -> bool:
    """A drummer as a performance evaluates one; whether the bound is kept."""
    kept = True
    for name, data in scores().items():
        performance, blocks = drummer(stage, data)
        best = best_us(performance.evaluate, blocks, repetitions) / FRAMES
        print(verdict(name, float(best.mean()), BOUND_US, "µs"), f"  dearest block {best.max():.1f}")
        kept &= bool(best.mean() <= BOUND_US)
        if name == SAINTS:
            parts(performance.evaluate, blocks, repetitions)
    return kept


def parts(evaluate: Callable[[int], object], blocks: int, repetitions: int) -> None:
    """What each part of a frame takes while the whole runs."""
    taken = {label: np.full(blocks, np.inf) for _, _, label in PARTS}
    for _ in range(repetitions):
        for block in range(blocks):
            now = dict.fromkeys(taken, 0.0)
            with ExitStack() as stack:
                for owner, name, label in PARTS:
                    stack.enter_context(_timed(owner, name, label, now))
                evaluate(block)
            for label, nanoseconds in now.items():
                taken[label][block] = min(taken[label][block], nanoseconds / 1e3 / FRAMES)
    for label, microseconds in taken.items():
        print(f"    {label:40} {microseconds.mean():9.2f} µs")


@contextmanager
def _timed(owner: type, name: str, label: str, taken: dict[str, float]) -> Generator[None]:
    real: Callable[..., Any] = getattr(owner, name)

    def run(*arguments: Any, **named: Any) -> Any:
        start = time.process_time_ns()
        result = real(*arguments, **named)
        taken[label] += time.process_time_ns() - start
        return result

    with mock.patch.object(owner, name, run):
        yield


def solve_arms(shoulders: FloatArray, pose: ToolPose) -> LimbPose:
    """The closed form from shoulders to wrists."""
    return ARMS.solve(shoulders, pose.wrists, pose.hinges)


def residual(call: Call, pose: ToolPose, limbs: LimbPose) -> FloatArray:
    """How far the tips are from their places, as the solved arms have them, metres, ``(F, 2)``."""
    _, tips, _, _, held, *_ = call.arguments
    axes = call.subject.in_basis(np.broadcast_to(np.eye(3)[:, None], (3, 2, 3)))
    in_hands = -np.einsum("ikj,fkj->fki", axes, held)
    return np.linalg.norm(limbs.ends + rotate(pose.hands, in_hands) - tips, axis=-1)


def beyond(pose: ToolPose, limbs: LimbPose, shoulders: FloatArray) -> float:
    """By how much a wrist is bent too far at most, degrees."""
    elbows = shoulders + rotate(limbs.upper, RIG.skeleton.rest_translations[ARMS.joints[:, 1]])
    forearm = rotate(conjugate(pose.hands), limbs.ends - elbows)
    flexion = np.arctan2(forearm[..., 1], forearm[..., 0])
    deviation = np.arctan2(forearm[..., 2], np.hypot(forearm[..., 0], forearm[..., 1]))
    excess = [
        np.maximum(np.maximum(low - value, value - high), 0.0)
        for value, low, high in (
            (flexion, *FLEXION_RAD),
            (deviation, DEVIATION_RAD[:, 0], DEVIATION_RAD[:, 1]),
        )
    ]
    return float(np.degrees(np.max(excess)))


def row(name: str, measured: Measured, own_us: float, bent: str = "") -> None:
    """Print one line of the comparison."""
    error = measured.error_m * 1e3
    ratio = measured.took_us / own_us
    print(
        f"{name:50} {measured.took_us:9.1f} {ratio:7.1f} {error.mean():9.4f} {error.max():9.3f}"
        f" {measured.reached:8.1%} {bent:>8}"
    )


def own_rows(recorded: list[Recorded], repetitions: int) -> float:
    """Reina's own solvers on all blocks; what the solve as it is played takes, microseconds a tip."""
    calls = [call for one in recorded for call in one.arms]
    stands = [call for one in recorded for call in one.stands]
    rest = HeldPose(RIG, load_hold(RIGS / PLAYER, KIT)).positions[ARMS.joints[:, 0]]
    still = [np.broadcast_to(rest, call.arguments[0].shape) for call in calls]
    moving = [call.arguments[0] for call in calls]

    def measured(places: list[FloatArray]) -> tuple[Measured, str]:
        def solve(block: int) -> tuple[ToolPose, LimbPose]:
            pose = calls[block].subject.solve(places[block], *calls[block].arguments[1:])
            return pose, solve_arms(places[block], pose)

        found = [solve(block) for block in range(len(calls))]
        errors = [residual(call, *one) for one, call in zip(found, calls, strict=True)]
        bent = max(beyond(*one, place) for one, place in zip(found, places, strict=True))
        took = best_us(solve, len(calls), repetitions).mean() / FRAMES / 2
        return Measured(np.concatenate(errors).ravel(), float(took)), f"{bent:.1f}°"

    planned = [one.trunk for one in recorded]
    poses = sum(len(call.arguments[1]) for call in planned)
    trunk_us = best_us(lambda k: reach_out(*planned[k].arguments), len(planned), 5).sum() / poses
    stand_us = best_us(
        lambda k: stands[k].subject.stand(*stands[k].arguments, **stands[k].named), len(stands), repetitions
    ).mean()
    with mock.patch.object(tool_arms, "ROUNDS", 0):
        closed, closed_bent = measured(still)
    alone, alone_bent = measured(still)
    arms, bent = measured(moving)
    share = trunk_us / PLANNED_EVERY / 2 + stand_us / FRAMES / 2
    played = Measured(arms.error_m, arms.took_us + float(share))
    row("Reina, closed form, stick as asked, trunk still", closed, played.took_us, closed_bent)
    row("Reina, stick as a link (FABRIK), trunk still", alone, played.took_us, alone_bent)
    row("Reina, stick as a link, trunk as it helps", arms, played.took_us, bent)
    row("Reina, all of it: trunk planned and turned, too", played, played.took_us, bent)
    print(f"    (planning the trunk, least squares: {trunk_us:.1f} µs a pose of both arms, ten a second)")
    return played.took_us


def other_rows(recorded: list[Recorded], own_us: float, frames: int) -> None:
    """The same arm as one chain, by Reina's general solver and by other libraries."""
    chains = [arm_chain(side) for side in range(2)]
    targets = [_some(recorded, side, frames) for side in range(2)]
    error: list[FloatArray] = []
    took = 0.0
    for (chain, start), wanted in zip(chains, targets, strict=True):
        begin = np.zeros((1, *chain.rest.shape[:1], 3))
        for angle, (joint, place) in zip(start, chain.hinges, strict=True):
            begin[0, joint, place] = angle
        rotations = chain.rotations(begin)[0]
        begun = time.process_time()
        blocks = [wanted[first : first + FRAMES] for first in range(0, len(wanted), FRAMES)]
        found = [solve_damped_least_squares(chain, block, rotations) for block in blocks]
        took += (time.process_time() - begun) * 1e6
        error += [one.error for one in found]
    tried = sum(len(wanted) for wanted in targets)
    row(
        "Reina, least squares on the whole chain, blocks",
        Measured(np.concatenate(error), took / tried),
        own_us,
    )
    for other in (one for one in OTHERS if one.run in (by_mink, by_pink, by_ikpy)):
        missing = other.missing()
        if missing:
            print(f"{other.name:50} {missing}")
            continue
        # As many for each hand, so that the slowest is done in time.
        own = [_some(recorded, side, min(frames, other.targets // 4)) for side in range(2)]
        for warm in (True, False):
            both = [
                other.run(finger_of(chain), wanted, start, warm=warm)
                for (chain, start), wanted in zip(chains, own, strict=True)
            ]
            joined = Measured(
                np.concatenate([one.error_m for one in both]), float(np.mean([one.took_us for one in both]))
            )
            row(f"{other.name}, {'warm' if warm else 'cold'}", joined, own_us)


def _some(recorded: list[Recorded], side: int, frames: int) -> FloatArray:
    """So many targets of one hand, in frames that follow one another, from the middle of each score."""
    each = frames // len(recorded)
    found: list[FloatArray] = []
    for one in recorded:
        tips = np.concatenate([call.arguments[1][:, side] for call in one.arms])
        first = len(tips) // 2
        found.append(tips[first : first + each])
    return np.concatenate(found)


def main() -> int:
    """Measure and print; 1 where a bound is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repetitions", type=int, default=10)
    parser.add_argument("--frames", type=int, default=60, help="targets of each hand for other libraries")
    options = parser.parse_args()
    stage = load_stage()
    print(heading(__file__))
    print("\na frame of a drummer, blocks of 60, in the processor")
    kept = whole_frame(stage, options.repetitions)
    print(
        f"\nthe same tips for everyone, to within {TOLERANCE_M * 1e3:g} mm; a solve is one tip in one frame"
    )
    everything = {name: record(stage, data) for name, data in scores().items()}
    for title, recorded in (
        (SAINTS, [everything[SAINTS]]),
        ("scores made to break a drummer", [one for name, one in everything.items() if name != SAINTS]),
    ):
        print(
            f"\n{title:50} {'µs':>9} {'ratio':>7} {'mean, mm':>9} {'worst':>9} {'reached':>8} {'wrist +':>8}"
        )
        own_us = own_rows(recorded, options.repetitions)
        other_rows(recorded, own_us, options.frames)
    return 0 if kept else 1


if __name__ == "__main__":
    raise SystemExit(main())
