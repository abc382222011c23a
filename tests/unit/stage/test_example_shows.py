import json
from pathlib import Path

import numpy as np
import pytest
from tests.unit.stage.framing import BELL_AND_HEAD, VALVES, furthest_out

from reina.show import Show, TimeMap
from reina.stage import stage_registry

SHOWS = sorted((Path(__file__).parents[3] / "examples" / "shows").glob("*.json"))
ALONE = [path for path in SHOWS if path.stem not in {"trumpet-duet", "when-the-saints"}]
"""Made for one player; the cameras of the others are tested in tests/integration/test_framing.py."""
REGISTRY = stage_registry()
TIME_MAP = TimeMap.steady(120.0)


def _show(path: Path) -> Show:
    return Show.from_document(json.loads(path.read_text(encoding="utf-8")), REGISTRY)


def test_there_are_shows() -> None:
    names = {path.stem for path in SHOWS}
    assert names >= {"default", "prince-of-denmarks-march", "carnival-of-venice", "trumpet-duet"}
    assert "when-the-saints" in names


@pytest.mark.parametrize("path", SHOWS, ids=lambda path: path.stem)
def test_an_example_is_a_show_and_comes_back_as_it_was(path: Path) -> None:
    show = _show(path)
    assert show.unknown_parameters == ()
    assert show.to_document() == json.loads(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("path", ALONE, ids=lambda path: path.stem)
def test_the_fingers_never_leave_the_picture(path: Path) -> None:
    values, _ = _show(path).plan(REGISTRY, TIME_MAP).evaluate(np.arange(80 * 60) / 60.0)
    assert furthest_out(values, VALVES, REGISTRY).max() < 0.85


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
    points = np.concatenate([VALVES, BELL_AND_HEAD, elbows_and_hips])
    assert furthest_out(values, points, REGISTRY).max() < 0.9
