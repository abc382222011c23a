"""What the cameras of shows have in their pictures, from frames alone: the fingers of who plays.

Of a drummer they are both hands or, in a picture of the pedals, both feet.
"""

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
    from tests.integration.server import Owned
    from tests.integration.stranger import Take

EXAMPLES = Path(__file__).parents[2] / "examples"
SCORES = [path for path in sorted((EXAMPLES / "scores").iterdir()) if path.suffix in {".mid", ".json"}]
SHOWS = sorted((EXAMPLES / "shows").glob("*.json"))
CASES = [
    *((score, None) for score in SCORES),
    *((score, show) for score in SCORES for show in SHOWS if show.stem == score.stem),
    (EXAMPLES / "scores/ode-to-joy.json", EXAMPLES / "shows/default.json"),
]
CUT = 4
"""The flag of a frame that is a cut."""
WITHIN = 0.8
"""Of the way from the middle of the picture to its edge."""
STROKE_S = 0.5
"""How long a drummer is busy with a stroke, and the way to the next."""
ALONE_S = 1.5
"""A drummer plays on in the others' short rests; from this long before and after them he plays alone."""
FPS = 10


def furthest_out(frames: Take, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The greatest of |x|, |y| of points (F, P, 3) in each frame, 1 being a 16:9 picture's edge; (F,).

    Infinite where one of them is not before the camera.
    """
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
    before = np.all(depth > 0.1, axis=1)
    depth = np.maximum(depth, 0.1)
    half = np.tan(frames.parameters["camera/fov"] / 2.0)
    x = np.einsum("fpi,fi->fp", away, right) / depth / (half * 16 / 9)
    y = np.einsum("fpi,fi->fp", away, up) / depth / half
    return np.where(before, np.maximum(np.abs(x), np.abs(y)).max(axis=1), np.inf)


def sounds(
    client: httpx.Client, session: Owned, frames: Take, player: int, *, drums: bool
) -> NDArray[np.bool_]:
    """(F,): a note that a player of the cast plays sounds; a drummer plays from stroke to stroke."""
    sounding = np.zeros(len(frames.song_time_s), bool)
    for note in client.get(f"{session.path}/score").raise_for_status().json()["notes"]:
        if note["player"] == player and (note["valves"] is not None or drums):
            after_s = frames.song_time_s - note["onset_s"]
            sounding |= (after_s >= 0.0) & (after_s < (STROKE_S if drums else note["duration_s"]))
    return sounding


def fingers_out(frames: Take, number: int) -> NDArray[np.float64]:
    """How far out a player's fingers and valves are, (F,)."""
    prefix = f"players/{number + 1}/" if number else ""
    player, instrument = frames.poses[f"{prefix}player"], frames.poses[f"{prefix}trumpet"]
    tips = [player.named("effectors", f"right{finger}Tip") for finger in ("Index", "Middle", "Ring")]
    buttons = [button(instrument, frames, valve, prefix) for valve in (1, 2, 3)]
    return furthest_out(frames, np.stack([*tips, *buttons], axis=1))


def drummer_out(frames: Take, number: int) -> NDArray[np.float64]:
    """How far out a drummer's hands are, or the feet where they are nearer to the middle, (F,)."""
    body = frames.poses[f"players/{number + 1}/player" if number else "player"].positions
    hands, feet = (
        furthest_out(frames, np.stack([body[f"{side}{limb}"] for side in ("left", "right")], axis=1))
        for limb in ("Hand", "Foot")
    )
    return np.minimum(hands, feet)


@pytest.mark.parametrize(
    ("score", "show"), CASES, ids=[f"{s.stem}, {show.stem if show else 'first show'}" for s, show in CASES]
)
def test_while_somebody_plays_the_fingers_of_who_plays_are_in_the_picture(
    client: httpx.Client, score: Path, show: Path | None
) -> None:
    form: dict[str, Any] = {"show": ("show.json", show.read_bytes())} if show else {}
    session = upload(client, score.read_bytes(), score.name, song=("song.wav", song()), **form)
    try:
        frames = take(client, session.id, 0.0, min(session.body["duration_s"], 120.0), fps=FPS)
        nobody = np.full(len(frames.song_time_s), np.inf)
        out, beheld = nobody, nobody
        playing, drumming = np.zeros((2, len(nobody)), bool)
        for number, casting in enumerate(session.body["cast"]["castings"]):
            drums = casting["instrument"] == "drums"
            of_player = drummer_out(frames, number) if drums else fingers_out(frames, number)
            heard = sounds(client, session, frames, number, drums=drums)
            out = np.where(heard, np.minimum(out, of_player), out)
            beheld = np.minimum(beheld, of_player)
            playing, drumming = playing | (heard & (not drums)), drumming | (heard & drums)
        around = np.ones(2 * round(ALONE_S * FPS) + 1)
        alone = drumming & (np.convolve(playing, around, mode="same") < 0.5)
        beyond = (playing | alone) & (out > WITHIN)
        assert np.isfinite(beheld).all(), "no camera stands in anybody, or looks away from all"
        assert frames.sounding.any()
        assert not beyond.any(), f"{out[beyond].max():.2f}, first at {frames.song_time_s[beyond][0]:.1f} s"
    finally:
        session.change("DELETE")


@pytest.mark.parametrize("score", ["carnival-of-venice.mid", "amazing-grace.json"])
def test_the_first_show_cuts_on_bar_lines_and_the_faster_the_music_the_sooner(
    client: httpx.Client, score: str
) -> None:
    data = (EXAMPLES / "scores" / score).read_bytes()
    session = upload(client, data, score, song=("song.wav", song()))
    try:
        drawn = client.get(f"{session.path}/score").json()
        frames = take(client, session.id, 0.0, session.body["duration_s"])
        cuts_s = frames.song_time_s[(frames.raw[:, 2] & CUT) > 0]
        lines_s = np.array(drawn["bar_lines_s"], dtype=np.float64)
        # The first frame at or after a bar line.
        after_s = cuts_s[:, None] - lines_s
        assert np.all(np.any((after_s > -1e-6) & (after_s < 1 / 60), axis=1))
        lengths_s = np.diff(np.concatenate([[0.0], cuts_s, [drawn["duration_s"]]]))
        assert cuts_s.size >= 3
        assert 2.9 < lengths_s.min() <= lengths_s.max() < 14.0
        assert (lengths_s.mean() < 5.0) == (score == "carnival-of-venice.mid")
    finally:
        session.change("DELETE")
