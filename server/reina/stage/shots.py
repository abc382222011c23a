"""Camera shots of a trumpeter who stands at the origin and faces +Z: from where, at what, through which lens.

Every shot shows the fingers on the valves, about (0.03, 1.49, 0.39), and leaves air in front of the bell,
about (0.05, 1.40, 0.66). All stand at her right, where the light comes from and where no notes come by.
"""

from dataclasses import dataclass

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Pose:
    """A camera's place and lens.

    Attributes:
        position: Metres.
        target: What is in the middle of the picture, metres.
        fov: Vertical angle of view, radians.
    """

    position: Point
    target: Point
    fov: float


@dataclass(frozen=True)
class Shot:
    """A slow move from one pose to another, from cut to cut.

    Attributes:
        name: What it shows.
        start: Its first pose.
        end: Its last.
    """

    name: str
    start: Pose
    end: Pose


SHOTS: dict[str, Shot] = {
    shot.name: shot
    for shot in (
        Shot(
            "room",
            Pose((-2.30, 1.66, 3.30), (0.25, 1.18, 0.35), 0.56),
            Pose((-2.12, 1.64, 3.10), (0.23, 1.20, 0.35), 0.56),
        ),
        Shot(
            "figure",
            Pose((-1.62, 1.56, 2.40), (0.06, 1.29, 0.28), 0.50),
            Pose((-1.50, 1.54, 2.28), (0.06, 1.31, 0.30), 0.50),
        ),
        Shot(
            "portrait",
            Pose((-1.22, 1.58, 1.72), (0.03, 1.47, 0.32), 0.38),
            Pose((-1.16, 1.60, 1.64), (0.03, 1.47, 0.33), 0.38),
        ),
        Shot(
            "fingers",
            Pose((-0.78, 1.80, 1.06), (0.02, 1.47, 0.37), 0.42),
            Pose((-0.84, 1.72, 1.02), (0.02, 1.47, 0.38), 0.42),
        ),
        Shot(
            "valves",
            Pose((-0.60, 1.63, 0.93), (0.02, 1.475, 0.38), 0.31),
            Pose((-0.52, 1.69, 0.90), (0.02, 1.475, 0.385), 0.31),
        ),
        Shot(
            "bell",
            Pose((-0.62, 1.32, 1.56), (0.03, 1.45, 0.34), 0.37),
            Pose((-0.50, 1.29, 1.46), (0.03, 1.46, 0.35), 0.37),
        ),
        Shot(
            "crane",
            Pose((-0.62, 2.50, 1.16), (0.02, 1.40, 0.36), 0.46),
            Pose((-0.46, 2.40, 1.02), (0.02, 1.43, 0.37), 0.46),
        ),
        Shot(
            "shoulder",
            Pose((-1.02, 1.70, -0.60), (0.10, 1.41, 0.58), 0.60),
            Pose((-0.90, 1.74, -0.56), (0.10, 1.42, 0.55), 0.60),
        ),
        Shot(
            "profile",
            Pose((-2.46, 1.50, 0.86), (0.00, 1.35, 0.34), 0.50),
            Pose((-2.40, 1.52, 1.10), (0.00, 1.36, 0.34), 0.50),
        ),
        Shot(
            "low",
            Pose((-1.16, 0.98, 2.20), (0.05, 1.34, 0.30), 0.52),
            Pose((-1.30, 1.04, 2.14), (0.05, 1.35, 0.30), 0.52),
        ),
    )
}
