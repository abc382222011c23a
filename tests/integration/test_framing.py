"""What the cameras of shows have in their pictures, from frames alone: her fingers, wherever she leans."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.integration.scores import song
from tests.integration.server import upload
from tests.integration.stranger import button, take

if TYPE_CHECKING:
    import httpx
    from numpy.typing import NDArray
    from tests.integration.stranger import Take

EXAMPLES = Path(__file__).parents[2] / "examples"
SCORES = [path for path in sorted((EXAMPLES / "scores").iterdir()) if path.suffix in {".mid", ".json"}]
SHOWS = sorted((EXAMPLES / "shows").glob("*.json"))
CASES = [
    *((score, None) for score in SCORES),
    *((score, show) for score in SCORES for show in SHOWS if show.stem == score.stem),
    (EXAMPLES / "scores/ode-to-joy.json", EXAMPLES / "shows/default.json"),
]
WITHIN = 0.8
"""Of the way from the middle of the picture to its edge."""


def furthest_out(frames: Take, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The greatest of |x|, |y| of points (F, P, 3) in each frame, 1 being a 16:9 picture's edge; (F,)."""
    position, target = frames.parameters["camera/position"], frames.parameters["camera/target"]
    forward = target - position
    forward /= np.linalg.norm(forward, axis=1, keepdims=True)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right, axis=1, keepdims=True)
    up = np.cross(right, forward)
    roll = frames.parameters["camera/roll"]
    right, up = np.cos(roll) * right + np.sin(roll) * up, np.cos(roll) * up - np.sin(roll) * right
    away = points - position[:, None]
    depth = np.einsum("fpi,fi->fp", away, forward)
    assert np.all(depth > 0.1), "no camera stands in her"
    half = np.tan(frames.parameters["camera/fov"] / 2.0)
    x = np.einsum("fpi,fi->fp", away, right) / depth / (half * 16 / 9)
    y = np.einsum("fpi,fi->fp", away, up) / depth / half
    return np.maximum(np.abs(x), np.abs(y)).max(axis=1)


@pytest.mark.parametrize(
    ("score", "show"), CASES, ids=[f"{s.stem}, {show.stem if show else 'first show'}" for s, show in CASES]
)
def test_while_she_plays_her_fingers_are_in_the_picture(
    client: httpx.Client, score: Path, show: Path | None
) -> None:
    form: dict[str, Any] = {"show": ("show.json", show.read_bytes())} if show else {}
    session = upload(client, score.read_bytes(), score.name, song=("song.wav", song()), **form)
    try:
        frames = take(client, session.id, 0.0, min(session.body["duration_s"], 120.0), fps=10)
        player, instrument = frames.skeleton("trumpeter"), frames.skeleton("trumpet")
        tips = [player.named("effectors", f"right{finger}Tip") for finger in ("Index", "Middle", "Ring")]
        buttons = [button(instrument, frames, valve) for valve in (1, 2, 3)]
        out = furthest_out(frames, np.stack([*tips, *buttons], axis=1))
        beyond = frames.sounding & (out > WITHIN)
        assert frames.sounding.any()
        assert not beyond.any(), f"{out[beyond].max():.2f}, first at {frames.song_time_s[beyond][0]:.1f} s"
    finally:
        session.change("DELETE")
