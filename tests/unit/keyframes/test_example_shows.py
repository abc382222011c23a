import json
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reina.keyframes import Show, TimeMap, stage_registry

SHOWS = sorted((Path(__file__).parents[3] / "examples" / "shows").glob("*.json"))
REGISTRY = stage_registry()
TIME_MAP = TimeMap.steady(120.0)

# Where the fingers and the bell of a trumpeter 1.6 m tall are, metres; her mouth is at (0, 1.42, 0.1).
VALVES = np.array([[-0.01, 1.42, 0.34], [0.0, 1.41, 0.37], [0.0, 1.41, 0.40], [-0.06, 1.44, 0.36]])
BELL_AND_HEAD = np.array([[0.0, 1.35, 0.75], [0.0, 1.6, 0.0], [0.0, 1.42, 0.1]])


def _in_picture(values: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The greatest of |x|, |y| of the points in each frame, the edge of a 16:9 picture being 1; (F,)."""
    layout = REGISTRY.layout()

    def column(path: str) -> NDArray[np.float64]:
        offset, length = layout[path]
        return values[:, offset : offset + length]

    position, target, fov = column("camera/position"), column("camera/target"), column("camera/fov")
    forward = target - position
    forward /= np.linalg.norm(forward, axis=1, keepdims=True)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right, axis=1, keepdims=True)
    up = np.cross(right, forward)
    away = points[None] - position[:, None]
    depth = np.einsum("fpi,fi->fp", away, forward)
    assert np.all(depth > 0.2)
    half = np.tan(fov / 2.0)
    x = np.einsum("fpi,fi->fp", away, right) / depth / (half * 16 / 9)
    y = np.einsum("fpi,fi->fp", away, up) / depth / half
    return np.maximum(np.abs(x), np.abs(y)).max(axis=1)


def _show(path: Path) -> Show:
    return Show.from_document(json.loads(path.read_text(encoding="utf-8")), REGISTRY)


def test_there_are_shows() -> None:
    assert {path.name for path in SHOWS} >= {"default.json", "prince-of-denmarks-march.json"}


@pytest.mark.parametrize("path", SHOWS, ids=lambda path: path.stem)
def test_an_example_is_a_show_and_comes_back_as_it_was(path: Path) -> None:
    show = _show(path)
    assert show.unknown_parameters == ()
    assert show.to_document() == json.loads(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("path", SHOWS, ids=lambda path: path.stem)
def test_the_fingers_never_leave_the_picture(path: Path) -> None:
    values, _ = _show(path).plan(REGISTRY, TIME_MAP).evaluate(np.arange(80 * 60) / 60.0)
    assert _in_picture(values, VALVES).max() < 0.85


@pytest.mark.parametrize("path", SHOWS, ids=lambda path: path.stem)
def test_cuts_fall_on_bar_lines(path: Path) -> None:
    times = np.arange(80 * 60) / 60.0
    _, cuts = _show(path).plan(REGISTRY, TIME_MAP).evaluate(times)
    bars = times[cuts] / 2.0
    assert bars.size >= 8
    np.testing.assert_allclose(bars, np.rint(bars), atol=1e-9)


@pytest.mark.parametrize("path", SHOWS, ids=lambda path: path.stem)
def test_the_note_blocks_change_colour(path: Path) -> None:
    values, _ = _show(path).plan(REGISTRY, TIME_MAP).evaluate(np.arange(60 * 60) / 60.0)
    offset, length = REGISTRY.layout()["blocks/color"]
    assert np.ptp(values[:, offset : offset + length], axis=0).max() > 0.2


def test_the_default_camera_shows_the_whole_upper_body() -> None:
    values = REGISTRY.defaults()[None]
    elbows_and_hips = np.array([[-0.35, 1.1, 0.1], [0.35, 1.1, 0.1], [0.0, 0.9, 0.0]])
    assert _in_picture(values, np.concatenate([VALVES, BELL_AND_HEAD, elbows_and_hips])).max() < 0.9
