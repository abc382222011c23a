"""Camera shots of a drummer whose stool stands at the origin, facing +Z: no cymbal is before the face.

The bass drum is at +Z, the hi-hat at +X; heights are above what the stool stands on.
"""

from types import MappingProxyType

from reina.stage.shots import Pose, Shot

DRUM_SHOTS: dict[str, Shot] = {
    shot.name: shot
    for shot in (
        Shot(
            "hi-hat side",
            Pose((1.90, 1.55, 1.75), (-0.05, 0.88, 0.37), 0.56),
            Pose((1.80, 1.50, 1.67), (-0.05, 0.88, 0.37), 0.56),
        ),
        Shot(
            "ride side",
            Pose((-1.75, 1.72, 1.47), (-0.18, 1.00, 0.30), 0.47),
            Pose((-1.64, 1.66, 1.41), (-0.16, 1.00, 0.30), 0.47),
        ),
        Shot(
            "kit from above",
            Pose((-0.10, 3.05, 1.45), (-0.12, 0.65, 0.40), 0.62),
            Pose((-0.10, 2.90, 1.39), (-0.12, 0.66, 0.39), 0.62),
        ),
        Shot(
            "kit from below",
            Pose((1.95, 0.42, 1.80), (-0.08, 0.78, 0.35), 0.58),
            Pose((1.78, 0.52, 1.60), (-0.06, 0.82, 0.33), 0.58),
        ),
        Shot(
            "drummer",
            Pose((-0.30, 1.75, 1.80), (0.00, 0.97, 0.20), 0.58),
            Pose((-0.26, 1.72, 1.70), (0.00, 0.97, 0.20), 0.58),
        ),
    )
}

INSTEAD = MappingProxyType(
    {
        "figure": "hi-hat side",
        "portrait": "drummer",
        "hands": "ride side",
        "bell": "drummer",
        "crane": "kit from above",
        "low": "kit from below",
    }
)
"""What of a drummer is shown where the shot of somebody who stands is asked for."""
