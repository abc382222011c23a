"""Inverse kinematics compared: success, error and time a solve, of closed forms and of iterative solvers.

Run as ``python tests/benchmarks/bench_ik.py``. Targets are the ends of random poses within the rig's
limits; the iterative solvers begin at rest, stop within 0.1 mm and have 100 rounds. Also says what the
paper's projection costs on this rig, and what its φ of -115° reaches.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import (
    CoupledFinger,
    FingerChains,
    JointChain,
    SolveStatus,
    TwoBoneLimbs,
    finger_tip,
    project_on_hand_planes,
    solve_ccd,
    solve_damped_least_squares,
    solve_fabrik,
    solve_planar,
)
from reina.rotations import conjugate, rotate
from reina.skeleton import forward_kinematics, load_hold, load_rig

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

RIGS = Path(__file__).parents[2] / "rigs"
PLAYER = load_rig(RIGS / "trumpeter")
TRUMPET = load_rig(RIGS / "trumpet")
HOLD = load_hold(RIGS / "trumpeter", "trumpet")
COUNT = 1000
FINGERS = ("rightIndex", "rightMiddle", "rightRing")


def best_us(run: Callable[[], object], repetitions: int = 5) -> float:
    """The best time of a run, microseconds."""
    times: list[float] = []
    for _ in range(repetitions):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return min(times) * 1e6


def share(status: NDArray[np.uint8]) -> float:
    """How many of the targets were reached, 0..1."""
    return float(np.count_nonzero(status == SolveStatus.REACHED) / status.size)


def iterative(name: str) -> None:
    """The three iterative solvers on one chain."""
    chain = JointChain.from_rig(PLAYER, name)
    angles = np.random.default_rng(0).uniform(chain.low, chain.high, size=(COUNT, *chain.low.shape))
    targets = chain.stance(angles).positions[:, -1]
    for solver in (solve_damped_least_squares, solve_ccd, solve_fabrik):
        found = solver(chain, targets)
        took = best_us(lambda solver=solver: solver(chain, targets), 1) / COUNT
        reached = share(found.status)
        row(f"{name} {solver.__name__}", reached, float(np.median(found.error)), took)


def closed_forms() -> None:
    """The closed forms on the same kind of targets."""
    rng = np.random.default_rng(0)
    fingers = FingerChains(PLAYER, FINGERS)
    for kappa in (1.0 / 3.0, 2.0 / 3.0):
        finger = CoupledFinger(fingers.lengths[0], kappa)
        bend = rng.uniform(-2.35, 0.0, COUNT)
        poses = np.stack([rng.uniform(-1.2, 1.39, COUNT), bend, np.maximum(kappa * bend, -0.785)], axis=-1)
        tips = finger_tip(poses, fingers.lengths[0])
        angles, status = finger.solve(tips)
        error = np.linalg.norm(finger_tip(angles, fingers.lengths[0]) - tips, axis=-1)
        took = best_us(lambda finger=finger, tips=tips: finger.solve(tips)) / COUNT
        row(f"finger, tip alone, κ = {kappa:.2f}", share(status), float(error.max()), took)
    poses = rng.uniform([-1.22, -2.35, -0.785], [1.39, 0.0, 0.0], size=(COUNT, 3))
    tips = finger_tip(poses, fingers.lengths[0])
    _, status = solve_planar(tips, fingers.lengths[0])
    took = best_us(lambda: solve_planar(tips, fingers.lengths[0])) / COUNT
    row("finger, the paper's, φ = -115°", share(status), 0.0, took)
    limbs = TwoBoneLimbs(PLAYER, ["rightArm"])
    directions = rng.normal(size=(COUNT, 1, 3))
    targets = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    targets *= rng.uniform(limbs.nearest, limbs.reach, size=(COUNT, 1))[..., None]
    roots, hinge = np.zeros((COUNT, 1, 3)), np.array([[0.3, 0.8, 0.5]])
    pose = limbs.solve(roots, targets, hinge)
    took = best_us(lambda: limbs.solve(roots, targets, hinge)) / COUNT
    row("arm, two bones", share(pose.status), float(np.abs(pose.ends - targets).max()), took)


def projection() -> None:
    """Tip errors of the rig's fingers on its valves, over the whole stroke."""
    positions, world = forward_kinematics(PLAYER.skeleton, HOLD.rotations(PLAYER), HOLD.hips_position)
    hand = PLAYER.skeleton.index("rightHand")
    fingers = FingerChains(PLAYER, FINGERS)
    print()
    print("on its valve, whole stroke    own plane, mm   the paper's planes, mm   φ = -115° reaches")
    for index, button in enumerate(TRUMPET.buttons):
        place = button.position + np.linspace(0, 1, 50)[:, None] * button.travel
        target = HOLD.instrument_position + rotate(HOLD.instrument_rotation, place)
        in_hand = rotate(conjugate(world[hand]), target - positions[hand])
        single = FingerChains(PLAYER, [FINGERS[index]])
        solved, _ = single.solve(in_hand[:, None])
        own = np.linalg.norm(single.tips(solved)[:, 0] - in_hand, axis=-1).max()
        # As the paper has it: abduction and planar target from the hand's planes (here at the finger's rest).
        rest = PLAYER.skeleton.rest_rotations[fingers.joints[index, 0]]
        origin = PLAYER.skeleton.rest_translations[fingers.joints[index, 0]]
        point = rotate(conjugate(rest), in_hand - origin)
        side, planar = project_on_hand_planes(point)
        angles, _ = CoupledFinger(fingers.lengths[index], 1 / 3, fingers.limits[index]).solve(planar)
        tip = finger_tip(angles, fingers.lengths[index])
        reached = np.stack([tip[:, 0] * np.cos(side), tip[:, 1], -tip[:, 0] * np.sin(side)], axis=-1)
        paper = np.linalg.norm(reached - point, axis=-1).max()
        _, status = solve_planar(planar, fingers.lengths[index], limits_rad=fingers.limits[index])
        print(f"{FINGERS[index]:38s} {own * 1e3:13.6f} {paper * 1e3:24.3f} {share(status):18.0%}")


def python_loop() -> None:
    """One finger at a time, as a program without arrays would."""
    finger = CoupledFinger(FingerChains(PLAYER, FINGERS).lengths[0])
    tips = finger_tip(
        np.random.default_rng(0).uniform([-1, -2, -0.6], [1, 0, 0], size=(COUNT, 3)), finger_lengths(finger)
    )
    took = best_us(lambda: [finger.solve(tip) for tip in tips], 1) / COUNT
    row("finger, tip alone, one call each", 1.0, 0.0, took)


def finger_lengths(finger: CoupledFinger) -> list[float]:
    """The bones of a finger."""
    return [float(finger.l1), float(finger.l2), float(finger.l3)]


def row(name: str, reached: float, error_m: float, took_us: float) -> None:
    """Print one line of the table."""
    print(f"{name:42s} {reached:7.1%} {error_m * 1e3:12.2e} {took_us:9.2f}")


def main() -> None:
    """Measure and print."""
    print(f"{'':42s} reached    error, mm  µs each   (batches of {COUNT})")
    closed_forms()
    python_loop()
    for name in ("rightIndex", "rightArm", "leftLeg"):
        iterative(name)
    projection()


if __name__ == "__main__":
    main()
