"""One chain for other libraries' solvers: the same joints, limits and targets as Reina has them.

Each solver begins at rest or where it is told to, or (warm) at what it found for the target before; it stops
within `TOLERANCE_M` of a target and has `ROUNDS` rounds, as Reina's iterative ones do. A library that is not
installed is said to be missing, and left out.
"""

from __future__ import annotations

import importlib
import importlib.util
import json
import math
import shutil
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from machine import node_version, version

from reina.rotations import to_euler, to_matrix

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from reina.kinematics import JointChain

TOLERANCE_M = 1e-4
ROUNDS = 100
THREE = Path(__file__).parents[2] / "web" / "node_modules" / "three"


@dataclass(frozen=True)
class Hinge:
    """One angle of a chain: a link from the hinge before it, a fixed turn, the axis that it turns about."""

    name: str
    link_m: NDArray[np.float64]
    rest: NDArray[np.float64]
    axis: NDArray[np.float64]
    low: float
    high: float


@dataclass(frozen=True)
class Finger:
    """Hinges from the base on, and where the pad or other tip is beyond the last one, ``(3,)``, metres."""

    hinges: list[Hinge]
    pad_m: NDArray[np.float64]


@dataclass(frozen=True)
class Measured:
    """What a solver did: how far off it ended, ``(N,)`` metres, and the time of one solve."""

    error_m: NDArray[np.float64]
    took_us: float

    @property
    def reached(self) -> float:
        """How many targets it came within the tolerance of, 0..1."""
        return float(np.mean(self.error_m <= TOLERANCE_M))


def finger_of(chain: JointChain) -> Finger:
    """A chain's hinges as other libraries take them."""
    hinges: list[Hinge] = []
    for number, (joint, place) in enumerate(chain.hinges):
        first = number == 0 or chain.hinges[number - 1][0] != joint
        hinges.append(
            Hinge(
                name=f"hinge{number}",
                link_m=chain.links[joint] if first else np.zeros(3),
                rest=chain.rest[joint] if first else np.array([0.0, 0.0, 0.0, 1.0]),
                axis=np.eye(3)["xyz".index(chain.limits[joint].order[place])],
                low=float(chain.low[joint, place]),
                high=float(chain.high[joint, place]),
            )
        )
    return Finger(hinges, chain.links[-1])


def _timed(solve: Callable[[Any], float], targets: Any) -> Measured:
    """One solve after another, in the processor's time, which other work on the machine does not lengthen."""
    solve(targets[0])
    start = time.process_time()
    errors = [solve(target) for target in targets]
    took = (time.process_time() - start) / len(targets) * 1e6
    return Measured(np.array(errors), took)


class _Start:
    """The angles that a solver begins with: always the same, or (warm) those it came to the last time."""

    def __init__(self, angles: NDArray[np.float64], *, warm: bool) -> None:
        self._angles, self._warm = angles, warm

    def get(self) -> NDArray[np.float64]:
        return self._angles

    def came_to(self, angles: NDArray[np.float64]) -> None:
        if self._warm:
            self._angles = np.array(angles)


def _begin(finger: Finger, start: NDArray[np.float64] | None, warm: bool) -> _Start:
    angles = np.zeros(len(finger.hinges)) if start is None else start
    return _Start(angles, warm=warm)


def by_ikpy(
    finger: Finger,
    targets: NDArray[np.float64],
    start: NDArray[np.float64] | None = None,
    *,
    warm: bool = False,
) -> Measured:
    """ikpy: nonlinear least squares by SciPy on a chain of URDF links."""
    chain: Any = importlib.import_module("ikpy.chain")
    link: Any = importlib.import_module("ikpy.link")
    links: list[Any] = [link.OriginLink()]
    for hinge in finger.hinges:
        roll, pitch, yaw = to_euler(hinge.rest, "zyx")[::-1].tolist()
        links.append(
            link.URDFLink(
                name=hinge.name,
                origin_translation=hinge.link_m.tolist(),
                origin_orientation=[roll, pitch, yaw],
                rotation=hinge.axis.tolist(),
                bounds=(hinge.low, hinge.high),
            )
        )
    pad = link.URDFLink("pad", finger.pad_m.tolist(), [0.0, 0.0, 0.0], joint_type="fixed", rotation=None)
    mask = [False, *([True] * len(finger.hinges)), False]
    whole = chain.Chain([*links, pad], active_links_mask=mask)
    begin = _begin(finger, start, warm)

    def solve(target: NDArray[np.float64]) -> float:
        initial = np.concatenate([[0.0], begin.get(), [0.0]])
        found = whole.inverse_kinematics(target, initial_position=initial, max_iter=ROUNDS)
        begin.came_to(found[1:-1])
        return float(np.linalg.norm(whole.forward_kinematics(found)[:3, 3] - target))

    return _timed(solve, targets)


def by_pink(
    finger: Finger,
    targets: NDArray[np.float64],
    start: NDArray[np.float64] | None = None,
    *,
    warm: bool = False,
) -> Measured:
    """Pink: quadratic programs on Pinocchio's kinematics."""
    pin: Any = importlib.import_module("pinocchio")
    pink: Any = importlib.import_module("pink")
    model = pin.Model()
    parent = 0
    for hinge in finger.hinges:
        placement = pin.SE3(to_matrix(hinge.rest), hinge.link_m)
        joint = pin.JointModelRevoluteUnaligned(hinge.axis)
        bounds = [np.array([value]) for value in (1e3, 1e3, hinge.low, hinge.high)]
        parent = model.addJoint(parent, joint, placement, hinge.name, *bounds)
        model.appendBodyToJoint(parent, pin.Inertia.Random(), pin.SE3.Identity())
    place = pin.SE3(np.eye(3), finger.pad_m)
    model.addFrame(pin.Frame("pad", parent, parent, place, pin.FrameType.OP_FRAME))
    data = model.createData()
    task = pink.tasks.FrameTask("pad", position_cost=1.0, orientation_cost=0.0, lm_damping=1e-6)
    begin = _begin(finger, start, warm)

    def solve(target: NDArray[np.float64]) -> float:
        configuration = pink.Configuration(model, data, begin.get())
        task.set_target(pin.SE3(np.eye(3), target))
        for _ in range(ROUNDS):
            if _apart(configuration.get_transform_frame_to_world("pad").translation, target) <= TOLERANCE_M:
                break
            velocity = pink.solve_ik(configuration, [task], 1.0, solver="daqp", safety_break=False)
            configuration.integrate_inplace(velocity, 1.0)
        begin.came_to(configuration.q)
        return _apart(configuration.get_transform_frame_to_world("pad").translation, target)

    return _timed(solve, targets)


def by_mink(
    finger: Finger,
    targets: NDArray[np.float64],
    start: NDArray[np.float64] | None = None,
    *,
    warm: bool = False,
) -> Measured:
    """Mink: quadratic programs on MuJoCo's kinematics."""
    mujoco: Any = importlib.import_module("mujoco")
    mink: Any = importlib.import_module("mink")
    spec = mujoco.MjSpec()
    body = spec.worldbody
    for hinge in finger.hinges:
        x, y, z, w = hinge.rest.tolist()
        body = body.add_body(name=hinge.name, pos=hinge.link_m, quat=[w, x, y, z])
        limits = [hinge.low, hinge.high]
        kind = mujoco.mjtJoint.mjJNT_HINGE
        body.add_joint(name=hinge.name, type=kind, axis=hinge.axis, range=np.degrees(limits), limited=True)
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.003, 0.0, 0.0])
    body.add_site(name="pad", pos=finger.pad_m)
    model = spec.compile()
    task = mink.FrameTask("pad", "site", position_cost=1.0, orientation_cost=0.0, lm_damping=1e-6)
    limits = [mink.ConfigurationLimit(model)]
    begin = _begin(finger, start, warm)

    def solve(target: NDArray[np.float64]) -> float:
        configuration = mink.Configuration(model, q=begin.get())
        task.set_target(mink.SE3.from_translation(target))
        for _ in range(ROUNDS):
            if (
                _apart(configuration.get_transform_frame_to_world("pad", "site").translation(), target)
                <= TOLERANCE_M
            ):
                break
            velocity = mink.solve_ik(configuration, [task], 1.0, solver="daqp", limits=limits)
            configuration.integrate_inplace(velocity, 1.0)
        begin.came_to(configuration.q)
        return _apart(configuration.get_transform_frame_to_world("pad", "site").translation(), target)

    return _timed(solve, targets)


def by_three(finger: Finger, targets: NDArray[np.float64]) -> Measured:
    """three.js's CCDIKSolver, in Node."""
    document = {
        "tolerance": TOLERANCE_M,
        "rounds": ROUNDS,
        "hinges": [
            {
                "link": hinge.link_m.tolist(),
                "rest": hinge.rest.tolist(),
                "axis": hinge.axis.tolist(),
                "low": hinge.low,
                "high": hinge.high,
            }
            for hinge in finger.hinges
        ],
        "pad": finger.pad_m.tolist(),
        "targets": targets.tolist(),
    }
    script = Path(__file__).with_name("ccd_ik_solver.mjs")
    done = subprocess.run(
        ["node", str(script)],
        input=json.dumps(document),
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    said = json.loads(done.stdout)
    return Measured(np.array(said["error_m"]), float(said["took_us"]))


def by_plain_python(finger: Finger, targets: NDArray[np.float64]) -> Measured:
    """The same closed form for the tip alone, in Python's own numbers, one finger at a time."""
    l1, l2 = (float(hinge.link_m[0]) for hinge in finger.hinges[2:])
    l3 = float(finger.pad_m[0])
    low = [hinge.low for hinge in finger.hinges]
    high = [hinge.high for hinge in finger.hinges]
    bend2, bend3 = (2.0 * math.atan2(hinge.rest[2], hinge.rest[3]) for hinge in finger.hinges[2:])
    to_rest: list[list[float]] = to_matrix(finger.hinges[0].rest).T.tolist()
    ox, oy, oz = finger.hinges[0].link_m.tolist()
    least, greatest = low[2] + bend2, min(high[2] + bend2, 0.0)
    fixed = l1 * l1 + l2 * l2 + l3 * l3

    def distance(theta2: float) -> float:
        theta3 = theta2 / 3.0
        bent = l1 * l2 * math.cos(theta2) + l2 * l3 * math.cos(theta3) + l1 * l3 * math.cos(theta2 + theta3)
        return fixed + 2.0 * bent

    near, far = distance(least), distance(greatest)
    u_low, u_high = math.cos(least / 3.0), math.cos(greatest / 3.0)
    c4, c3, c1 = 16.0 * l1 * l3, 8.0 * l1 * l2, 2.0 * l2 * l3 - 6.0 * l1 * l2

    def angles(target: list[float]) -> tuple[float, float, float, float]:
        dx, dy, dz = target[0] - ox, target[1] - oy, target[2] - oz
        x, y, z = (row[0] * dx + row[1] * dy + row[2] * dz for row in to_rest)
        aside = min(max(math.atan2(-z, x) if x >= 0.0 else math.atan2(z, -x), low[0]), high[0])
        x = x * math.cos(aside) - z * math.sin(aside)
        squared = min(max(x * x + y * y, near), far)
        u = u_low + (squared - near) / (far - near) * (u_high - u_low)
        c0 = 2.0 * l1 * l3 + fixed - squared
        for _ in range(5):
            value = (((c4 * u + c3) * u - c4) * u + c1) * u + c0
            u = min(u - value / (((4.0 * c4 * u + 3.0 * c3) * u - 2.0 * c4) * u + c1), u_high)
        theta2 = -3.0 * math.acos(min(max(u, u_low), u_high))
        both = theta2 * 4.0 / 3.0
        along = l1 + l2 * math.cos(theta2) + l3 * math.cos(both)
        theta1 = math.atan2(y, x) - math.atan2(l2 * math.sin(theta2) + l3 * math.sin(both), along)
        return aside, min(max(theta1, low[1]), high[1]), theta2 - bend2, theta2 / 3.0 - bend3

    listed: list[list[float]] = targets.tolist()
    start = time.process_time()
    found = [angles(target) for target in listed]
    took = (time.process_time() - start) / len(listed) * 1e6
    return Measured(np.linalg.norm(pads(finger, np.array(found)) - targets, axis=1), took)


def pads(finger: Finger, angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Where the pad is, ``(B, 3)``, for angles ``(B, hinges)``; matrices multiplied hinge by hinge."""
    turned = np.tile(np.eye(3), (len(angles), 1, 1))
    place = np.zeros((len(angles), 3))
    for number, hinge in enumerate(finger.hinges):
        place = place + turned @ hinge.link_m
        quaternion = np.concatenate(
            [np.sin(0.5 * angles[:, [number]]) * hinge.axis, np.cos(0.5 * angles[:, [number]])], axis=1
        )
        turned = turned @ to_matrix(hinge.rest) @ to_matrix(quaternion)
    return place + turned @ finger.pad_m


def _apart(place: NDArray[np.float64], target: NDArray[np.float64]) -> float:
    return float(np.linalg.norm(place - target))


@dataclass(frozen=True)
class Other:
    """A solver to stand beside.

    Attributes:
        name: How it is called.
        run: Solves.
        modules: What must be there for it.
        targets: How many it is given.
        package: Whose it is, where it is another library's.
    """

    name: str
    run: Callable[..., Measured]
    modules: tuple[str, ...]
    targets: int
    package: str = ""

    def version(self) -> str:
        """Of the package whose solver it is; empty where it is not installed."""
        return node_version(THREE) if self.package == "three.js" else version(self.package)

    def missing(self) -> str | None:
        """What is to be done before it can run, or None."""
        absent = [name for name in self.modules if importlib.util.find_spec(name) is None]
        if absent:
            return f"{', '.join(absent)} not installed: pip install -r requirements/bench.txt"
        if self.run is by_three and (shutil.which("node") is None or not THREE.exists()):
            return "Node or three.js is not there: make setup"
        return None


OTHERS: tuple[Other, ...] = (
    Other("plain Python, the same closed form", by_plain_python, (), 1000),
    Other("three.js CCDIKSolver (JavaScript)", by_three, (), 1000, "three.js"),
    Other("mink (MuJoCo)", by_mink, ("mink", "mujoco"), 200, "mink"),
    Other("pink (Pinocchio)", by_pink, ("pink", "pinocchio"), 200, "pin-pink"),
    Other("ikpy (SciPy)", by_ikpy, ("ikpy",), 100, "ikpy"),
)
"""In the order of the table."""
