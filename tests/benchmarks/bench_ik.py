"""Inverse kinematics compared: success, error and time a solve, of closed forms and of iterative solvers.

Run as ``python tests/benchmarks/bench_ik.py``. Targets are the ends of random poses within the rig's
limits; the iterative solvers begin at rest, stop within 0.1 mm and have 100 rounds. Also says what the
paper's projection costs on this rig, what its φ of -115° reaches, and how other libraries do with the same
finger and the same targets, as far as they are installed (requirements/bench.txt).
"""

from __future__ import annotations

import importlib
import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from machine import heading, version
from other_solvers import OTHERS, Measured, Other, finger_of
from table import SHORT, Row, alternate, figure, tell

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
from reina.rotations import about_axis, conjugate, multiply, rotate
from reina.skeleton import forward_kinematics, load_hold, load_rig, read_bvh

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

RIGS = Path(__file__).parents[2] / "rigs"
PLAYER = load_rig(RIGS / "trumpeter")
TRUMPET = load_rig(RIGS / "trumpet")
HOLD = load_hold(RIGS / "trumpeter", "trumpet")
COUNT = 1000
BLOCKS = 30
FEWER = 4 if SHORT else 1
"""By what other libraries' targets are divided."""
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


def beside_others() -> None:
    """The same finger and targets for other libraries, turn by turn."""
    chain = JointChain.from_rig(PLAYER, "rightIndex")
    finger = finger_of(chain)
    single = FingerChains(PLAYER, ["rightIndex"])
    rng = np.random.default_rng(0)
    angles = rng.uniform([h.low for h in finger.hinges], [h.high for h in finger.hinges], size=(COUNT, 4))
    # Tendons couple the last joint: targets are such as a finger takes.
    rests = [2.0 * np.arctan2(hinge.rest[2], hinge.rest[3]) for hinge in finger.hinges[2:]]
    coupled = (angles[:, 2] + rests[0]) / 3.0 - rests[1]
    angles[:, 3] = np.clip(coupled, finger.hinges[3].low, finger.hinges[3].high)
    targets = single.tips(_rotations(chain, angles)[:, None])[:, 0]
    solved, _ = single.solve(targets[:, None])
    error = np.linalg.norm(single.tips(solved)[:, 0] - targets, axis=-1)

    def by_reina() -> Measured:
        start = time.process_time()
        for _ in range(BLOCKS):
            single.solve(targets[:, None])
        return Measured(error, (time.process_time() - start) / (BLOCKS * COUNT) * 1e6)

    there = [other for other in OTHERS if not other.missing()]
    own, *best = alternate(
        2,
        by_reina,
        *(lambda other=other: other.run(finger, targets[: other.targets // FEWER]) for other in there),
        key=lambda one: one.took_us,
    )
    by_name = dict(zip([other.name for other in there], best, strict=True))
    print()
    print(f"the same finger and targets {'':18s} reached   median, mm  µs each     ratio")
    beside("Reina, closed form, one block", own, own)
    start = time.process_time()
    found = solve_damped_least_squares(chain, targets)
    took = (time.process_time() - start) / COUNT * 1e6
    beside("Reina, damped least squares, one block", Measured(found.error, took), own)
    for other in OTHERS:
        if other.name in by_name:
            beside(other.name, by_name[other.name], own)
        else:
            print(f"{other.name:45s} {other.missing()}")
        if other.package:
            tell(*rows(other, by_name.get(other.name), own))


def rows(other: Other, theirs: Measured | None, own: Measured) -> list[Row]:
    """The time of a solve, and how many targets are reached, beside another library."""
    told = partial(
        Row,
        "Inverse kinematics: a finger of four hinges, to 0.1 mm",
        peer=other.name.partition(" (")[0],
        version=other.version() if theirs else "",
    )
    if theirs is None:
        missing = partial(told, theirs=None, notes="not installed")
        return [
            missing(what="a solve", unit="µs", reina=own.took_us),
            missing(what="targets reached", unit="%", reina=100 * own.reached),
        ]
    error = [float(np.median(one.error_m)) * 1e3 for one in (theirs, own)]
    return [
        told(
            what="a solve",
            unit="µs",
            reina=own.took_us,
            theirs=theirs.took_us,
            notes="Reina in one block, the peer one by one, from rest",
        ),
        told(
            what="targets reached",
            unit="%",
            reina=100 * own.reached,
            theirs=100 * theirs.reached,
            better="higher",
            notes=f"median error {figure(error[0])} mm, Reina's {figure(error[1])}",
        ),
    ]


def _rotations(chain: JointChain, angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """A finger's local rotations ``(B, 3, 4)`` from its four hinges' angles."""
    local = np.tile(chain.rest, (len(angles), 1, 1))
    for number, (joint, place) in enumerate(chain.hinges):
        axis = "xyz".index(chain.limits[joint].order[place])
        local[:, joint] = multiply(local[:, joint], about_axis(axis, angles[:, number]))
    return local


def beside(name: str, measured: Measured, own: Measured) -> None:
    """Print one line of the comparison."""
    middle = float(np.median(measured.error_m)) * 1e3
    ratio = measured.took_us / own.took_us
    print(f"{name:45s} {measured.reached:8.1%} {middle:12.1e} {measured.took_us:8.1f} {ratio:9.0f}")


def motion_files() -> None:
    """A shipped clip read by Reina and by bvhio."""
    path = RIGS / "trumpeter" / "clips" / "shifting.bvh"
    data = path.read_bytes()
    there = version("bvhio")
    bvhio: Any = importlib.import_module("bvhio") if there else None
    own, theirs = alternate(
        2,
        lambda: best_us(lambda: read_bvh(data), 3) / 1e3,
        lambda: best_us(lambda: bvhio.readAsBvh(str(path)), 2) / 1e3 if there else 0.0,
        key=float,
    )
    what = f"BVH of {len(data) // 1024} KiB, {path.name}"
    notes = "" if there else "not installed"
    tell(Row("Reading files", what, "ms", own, "bvhio", there, theirs if there else None, notes=notes))


def finger_lengths(finger: CoupledFinger) -> list[float]:
    """The bones of a finger."""
    return [float(finger.l1), float(finger.l2), float(finger.l3)]


def row(name: str, reached: float, error_m: float, took_us: float) -> None:
    """Print one line of the table."""
    print(f"{name:42s} {reached:7.1%} {error_m * 1e3:12.2e} {took_us:9.2f}")


def main() -> None:
    """Measure and print."""
    print(heading(__file__))
    if not SHORT:
        print(f"{'':42s} reached    error, mm  µs each   (batches of {COUNT})")
        closed_forms()
        python_loop()
        for name in ("rightIndex", "rightArm", "leftLeg"):
            iterative(name)
        projection()
    beside_others()
    motion_files()


if __name__ == "__main__":
    main()
