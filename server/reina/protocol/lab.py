"""The bodies of the laboratory's calls. Angles are radians, lengths metres, quaternions x y z w."""

from typing import Annotated, Literal

from pydantic import BaseModel, Field, Strict

from reina.protocol.model import RequestModel, WireModel
from reina.protocol.resources import Warned

EulerOrder = Literal["xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"]
SolverName = Literal[
    "planar_three_bone", "coupled_three_bone", "two_bone", "ccd", "fabrik", "damped_least_squares"
]
SolveStatusName = Literal["reached", "out_of_reach", "at_limit", "not_converged"]
WayName = Literal["slerp", "matrix", "euler", "rotation_vector"]
PlaneName = Literal["xy", "yz", "xz"]
ChainKind = Literal["finger", "limb"]

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

_Angle = Annotated[float, Field(ge=-12.6, le=12.6)]
_Metres = Annotated[float, Field(ge=-10.0, le=10.0)]
_Target = Annotated[tuple[_Metres, _Metres, _Metres], Strict(strict=False)]
"""JSON's list is read as a tuple; the numbers in it are numbers all the same."""
_AngleTriple = Annotated[tuple[_Angle, _Angle, _Angle], Strict(strict=False)]


class EulerOrientation(RequestModel):
    """An orientation by three angles; `zyx` is Rz Ry Rx."""

    kind: Literal["euler"]
    order: EulerOrder
    angles_rad: _AngleTriple


class AxisAngleOrientation(RequestModel):
    """An orientation by an axis of any length and an angle about it."""

    kind: Literal["axis_angle"]
    axis: _Target
    angle_rad: _Angle


class QuaternionOrientation(RequestModel):
    """An orientation by a quaternion of any length."""

    kind: Literal["quaternion"]
    quaternion: Annotated[tuple[_Metres, _Metres, _Metres, _Metres], Strict(strict=False)]


WireOrientation = Annotated[
    EulerOrientation | AxisAngleOrientation | QuaternionOrientation, Field(discriminator="kind")
]


class InterpolationRequest(RequestModel):
    """Two orientations, and how to go from one to the other.

    Angles that are given are interpolated as they are given, in the order that is interpolated: 270° goes
    another way than -90°.
    """

    start: WireOrientation
    end: WireOrientation
    euler_order: EulerOrder = "zyx"
    """Of the Euler angles that are interpolated."""
    samples: Annotated[int, Field(ge=2, le=481)] = 121
    tip: _Target = (1.0, 0.0, 0.0)
    """The point of the turned body whose path is told."""


class InterpolationWay(WireModel):
    """One way, sampled at the answer's fractions."""

    name: WayName
    quaternions: list[Quaternion]
    """The rotations; of `matrix` those nearest to its matrices."""
    axes: list[tuple[Vector, Vector, Vector]]
    """Where the body's x, y and z go: the matrices' columns, as they were interpolated."""
    tip: list[Vector]
    """Where the tip goes."""
    speed: list[float]
    """Angular speed between samples, radians a unit of the fraction: one fewer than samples."""
    determinant: list[float]
    """Of the matrices; 1 for a rotation."""
    orthogonality_error: list[float]
    """Frobenius norm of RᵀR - I; 0 for a rotation."""
    length_rad: float
    """How far the body turns on the way."""
    slowest: float
    """The least speed."""
    fastest: float
    """The greatest speed."""


class OrientationForms(WireModel):
    """One orientation in every form."""

    quaternion: Quaternion
    axis: Vector
    angle_rad: float
    euler_rad: Vector
    """In the order that is interpolated."""


class InterpolationComparison(WireModel):
    """Four ways between two orientations."""

    start: OrientationForms
    end: OrientationForms
    angle_rad: float
    """The angle between them: no way is shorter."""
    fractions: list[float]
    ways: list[InterpolationWay]


class LabHinge(WireModel):
    """One angle of a chain."""

    joint: str
    axis: Literal["x", "y", "z"]
    minimum_rad: float
    """From rest."""
    maximum_rad: float
    """From rest."""


class HingeState(WireModel):
    """One hinge of a posed chain."""

    angle_rad: float
    """From rest."""
    beyond_rad: float
    """By how much it is beyond the rig's limits; 0 within."""
    origin: Vector
    axis: Vector
    fan: list[Vector]
    """Unit directions from the least to the greatest angle."""
    direction: Vector
    """The present one among them."""
    radius_m: float
    """How large to draw the fan."""


class FingerAngles(WireModel):
    """A finger's angles as the planar arm counts them; flexion is negative."""

    abduction_rad: float
    theta_rad: Vector
    phi_rad: float
    """The last bone's direction, θ1 + θ2 + θ3."""


class LabPose(WireModel):
    """A posed chain in the frame of the joint that carries it."""

    positions: list[Vector]
    """Of the joints, then of the end."""
    orientations: list[Quaternion]
    """Of the joints."""
    hinges: list[HingeState]
    finger: FingerAngles | None


class LabChain(WireModel):
    """A chain that can be posed."""

    rig: str
    name: str
    kind: ChainKind
    carrier: str
    """The joint that carries it: all positions are in its frame."""
    joints: list[str]
    end: str
    """What is brought to the target."""
    bone_lengths_m: list[float]
    reach_m: float
    solvers: list[SolverName]
    """Those that can solve it; the first is the one that the rig plays with."""
    hinges: list[LabHinge]
    rest: LabPose
    around: list[tuple[Vector, Vector]]
    """The rig's other bones at rest."""


class LabChainList(WireModel):
    """Every chain of every player's rig that can be posed."""

    chains: list[LabChain]


class ForwardRequest(RequestModel):
    """Angles for every hinge of a chain."""

    rig: str = "trumpeter"
    chain: str
    angles_rad: Annotated[list[_Angle], Field(max_length=32)]
    """From rest, in the order of the chain's hinges."""
    limits: bool = True
    """Whether an angle beyond the rig's limits is refused."""


class SolverChoice(RequestModel):
    """Which solver, and how."""

    solver: SolverName
    limits: bool = True
    """Whether joints stop at the rig's limits."""
    iterations: Annotated[int, Field(ge=1, le=200)] = 60
    """The bound of an iterative solver's rounds."""
    tolerance_m: Annotated[float, Field(ge=1e-7, le=0.1)] = 1e-4
    """How near the end must come."""
    phi_rad: _Angle = -2.007128639793479
    """Direction of the last bone for `planar_three_bone`."""
    kappa: Annotated[float, Field(ge=0.05, le=2.0)] = 1.0 / 3.0
    """θ3 / θ2 for `coupled_three_bone`."""
    swivel_rad: _Angle | None = None
    """For `two_bone`: turn of the elbow or knee about the line to the target; null to have one chosen."""


class InverseRequest(RequestModel):
    """A target for the end of a chain, in the frame of the joint that carries it."""

    rig: str = "trumpeter"
    chain: str
    target: _Target
    choice: SolverChoice
    start_rad: Annotated[list[_Angle], Field(max_length=32)] | None = None
    """Hinge angles that an iterative solver begins from; rest where null."""


class SolverRound(WireModel):
    """Where an iterative solver's chain was after a round."""

    error_m: float
    positions: list[Vector]


class InverseAnswer(WireModel):
    """What a solver found."""

    status: SolveStatusName
    error_m: float
    """Distance of the end from the target, by forward kinematics of the angles."""
    iterations: int
    """0 for closed forms."""
    rounds: list[SolverRound]
    """Of an iterative solver, the start first."""
    pose: LabPose


class ReachRequest(RequestModel):
    """A plane through a point, to be asked cell by cell."""

    rig: str = "trumpeter"
    chain: str
    choice: SolverChoice
    plane: PlaneName = "xy"
    through: _Target


class ReachCells(WireModel):
    """Which cells of a plane the end of a chain comes to, each solved from rest."""

    corner: Vector
    """Centre of the first cell."""
    right: Vector
    """From a cell to the next in its row."""
    up: Vector
    """From a row to the next."""
    columns: int
    rows: int
    reached: str
    """Row by row, `1` where the solver comes to the cell's centre, `0` where not."""
    share: float
    """Part of the cells that it comes to."""


class LabClip(WireModel):
    """A motion clip that ships with a rig."""

    rig: str
    name: str
    href: str
    joints: int
    frames: int
    duration_s: float


class LabClipList(WireModel):
    """The shipped clips."""

    clips: list[LabClip]


class ClipJoint(WireModel):
    """One joint of a clip."""

    name: str
    parent: int | None
    """Its index, None for the root."""
    offset: Vector
    channels: list[str]


class ParsedClip(WireModel):
    """A BVH file, read, with everything's place in the world frame by frame."""

    joints: list[ClipJoint]
    frames: int
    """In the file; 0 for a skeleton without motion."""
    frame_time_s: float
    duration_s: float
    warnings: list[Warned]
    """What is not as the file says, and what was made of it."""
    points: list[str]
    """Names: joints in their order, then end sites."""
    point_parents: list[int]
    """The point that each hangs from; -1 for the root."""
    frame_step: int
    """Every frame_step-th frame has positions; 1 means all."""
    sampled_frames: int
    """How many have; of a file without frames one, at rest."""
    minimum: Vector
    """Corner of the box around all positions, in the file's unit."""
    maximum: Vector
    positions: str
    """Base64 of little-endian float32 (sampled_frames, points, 3), in the file's unit."""


LAB_SENT: tuple[type[BaseModel], ...] = (
    InterpolationComparison,
    LabChainList,
    LabPose,
    InverseAnswer,
    ReachCells,
    LabClipList,
    ParsedClip,
)
LAB_RECEIVED: tuple[type[BaseModel], ...] = (
    InterpolationRequest,
    ForwardRequest,
    InverseRequest,
    ReachRequest,
)
