"""The shots of a first show for a cast with a drummer."""

from dataclasses import replace

import numpy as np
import pytest
from tests.unit.stage.framing import furthest_out

from reina.show import TimeMap
from reina.stage import CastForm, MusicForm, Place, stage_registry, write_default_show
from reina.stage.cast_shots import cast_shot
from reina.stage.drum_shots import DRUM_SHOTS, INSTEAD
from reina.stage.shots import Pose

REGISTRY = stage_registry()
STOOL = Place(0.0, -2.15, 0.0, 0.2, at_drums=True)
MIDDLE = Place(0.0, 0.0, 0.0)
HEAD_AND_HANDS = STOOL.put(np.array([[0.0, 1.3, 0.1], [-0.3, 0.85, 0.45], [0.3, 0.85, 0.45]]))
"""Of who sits on the stool, metres."""


def _values(*poses: Pose) -> np.ndarray:
    values = np.repeat(REGISTRY.defaults()[None], len(poses), axis=0)
    for path, part in (("position", "position"), ("target", "target"), ("fov", "fov")):
        offset, length = REGISTRY.layout()[f"camera/{path}"]
        values[:, offset : offset + length] = [np.atleast_1d(getattr(pose, part)) for pose in poses]
    return values


@pytest.mark.parametrize("name", DRUM_SHOTS)
def test_head_and_hands_are_in_every_shot_of_a_drummer(name: str) -> None:
    shot = cast_shot(name, 0, (MIDDLE, STOOL))
    assert furthest_out(_values(shot.start, shot.end), HEAD_AND_HANDS, REGISTRY).max() < 0.9


@pytest.mark.parametrize("name", DRUM_SHOTS)
def test_a_left_handed_drummer_is_seen_from_the_other_side(name: str) -> None:
    right, left = (cast_shot(name, 0, (MIDDLE, replace(STOOL, mirrored=left))) for left in (False, True))
    across = np.array([-1.0, 1.0, 1.0])
    for one, other in ((right.start, left.start), (right.end, left.end)):
        assert other.position == pytest.approx(across * one.position)
        assert other.target == pytest.approx(across * one.target)
        assert other.fov == one.fov
    whole = cast_shot("everybody", 0, (replace(STOOL, mirrored=True),))
    assert whole.end.target[0] == pytest.approx(-cast_shot("everybody", 0, (STOOL,)).end.target[0])


def test_a_drummer_who_leads_is_shown_at_the_drums() -> None:
    for name, instead in INSTEAD.items():
        assert cast_shot(name, 1, (MIDDLE, STOOL)) == cast_shot(instead, 0, (MIDDLE, STOOL))


def test_the_drummer_has_a_shot_where_the_tune_rests() -> None:
    onset_s = np.concatenate([np.arange(0.0, 8.0, 0.5), np.arange(16.0, 24.0, 0.5)])
    notes = (onset_s, onset_s + 0.45, np.full_like(onset_s, 67.0), np.full_like(onset_s, 0.7))
    phrases_s = np.array([[0.0, 8.0], [8.0, 16.0], [16.0, 24.0]])
    form = MusicForm(*notes, bar_lines_s=np.arange(0.0, 24.0, 2.0), duration_s=24.0, phrases_s=phrases_s)
    cast = CastForm(places=(MIDDLE, STOOL), tune=((0.0, 0),))
    plan = write_default_show(form, cast=cast).plan(REGISTRY, TimeMap.steady(120.0))
    values, _ = plan.evaluate(np.array([9.0]))
    offset, length = REGISTRY.layout()["camera/target"]
    assert values[0, offset + length - 1] < -1.0
