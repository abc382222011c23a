"""Players look at each other where somebody enters."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.instruments.scores import score_of

from reina.instruments import INSTRUMENTS
from reina.instruments.player import SEATS, plan_glances
from reina.instruments.player.glances import BOUNDS_RAD, CURVES, add_glances
from reina.kinematics import MotionCurves
from reina.rotations.arrays import FloatArray

TRUMPET = INSTRUMENTS["trumpet"]
DUO = [SEATS["right"], SEATS["left"]]


def line(pitch: int, start_s: float, end_s: float) -> list[tuple[float, float, int]]:
    return [(float(t), float(t) + 0.5, pitch) for t in np.arange(start_s, end_s, 0.5)]


def glances(
    *parts: list[tuple[float, float, int]], at_s: float, names: tuple[str, ...] = ("right", "left")
) -> list[FloatArray]:
    """Of each player the turns to the left of trunk, head and eyes at a time."""
    score = score_of(*parts)
    played = [TRUMPET.play(score, part) for part in range(len(parts))]
    planned = plan_glances(played, [SEATS[name] for name in names])
    return [
        MotionCurves(one).evaluate(np.array([at_s]))[MotionCurves(one).index(CURVES), 0] for one in planned
    ]


def test_alone_there_is_nobody_to_look_at() -> None:
    score = score_of(line(60, 0.0, 4.0))
    assert plan_glances([TRUMPET.play(score, 0)], [SEATS["middle"]]) == ({},)


def test_entering_together_they_look_at_each_other() -> None:
    right, left = glances(line(70, 4.0, 8.0), line(62, 4.0, 8.0), at_s=3.8)
    # The left player stands at the right one's left, and the other way round.
    assert right.min() > 0.05
    assert left.max() < -0.05
    np.testing.assert_allclose(right, -left, atol=1e-9)


def test_who_plays_looks_with_the_eyes_and_who_enters_alone_keeps_to_the_part() -> None:
    playing, entering = glances(line(70, 0.0, 12.0), line(62, 6.0, 12.0), at_s=5.9)
    torso, head, eyes = playing
    assert torso == 0.0
    assert 0.0 < head < 0.1
    assert eyes > 0.4
    assert not entering.any()
    resting, _ = glances(line(70, 0.0, 2.0), line(62, 6.0, 12.0), at_s=5.9)
    assert resting[1] > 2.0 * head


def test_between_entries_nobody_looks_and_nobody_looks_up_all_the_time() -> None:
    parts = (line(70, 4.0, 12.0), line(62, 4.0, 12.0))
    assert all(not one.any() for one in glances(*parts, at_s=8.0))
    short = [(float(t), float(t) + 0.3, 64) for t in np.arange(2.0, 60.0, 1.5)]
    score = score_of(line(70, 2.0, 60.0), short)
    first, _ = plan_glances([TRUMPET.play(score, part) for part in (0, 1)], DUO)
    table = np.asarray(first["glance/eyes"][0])
    assert np.diff(table[table[:, 2] != 0.0, 0]).min() >= 4.0


def test_of_several_who_enter_the_nearest_is_looked_at() -> None:
    parts = (line(70, 4.0, 8.0), line(66, 4.0, 8.0), line(62, 4.0, 8.0), line(60, 4.0, 8.0))
    names = ("right", "left", "far right", "far left")
    right, left, *_ = glances(*parts, at_s=3.8, names=names)
    assert right[2] < 0.0 < left[2]  # each to the far one on the own side, who stands nearer


@given(
    st.lists(st.floats(-0.5, 0.5), min_size=7, max_size=7),
    st.lists(st.floats(-0.6, 0.6), min_size=3, max_size=3),
)
def test_with_what_a_show_keys_no_bound_is_passed(keys: list[float], turns: list[float]) -> None:
    keyed: dict[str, FloatArray] = {}
    for part, values in (("torso", keys[:3]), ("head", keys[3:6])):
        size = max(np.linalg.norm(values), BOUNDS_RAD[part]) / BOUNDS_RAD[part]
        keyed |= {
            f"{part}_{axis}": np.array([v / size])
            for axis, v in zip(("bow", "turn", "tip"), values, strict=True)
        }
    keyed |= {"eyes_left": np.array([keys[6]]), "eyes_up": np.zeros(1)}
    added = add_glances(keyed, np.array(turns)[:, None], np.array([1.5]))
    for part in ("torso", "head"):
        turn = np.array([added[f"{part}_{axis}"][0] for axis in ("bow", "turn", "tip")])
        assert np.linalg.norm(turn) <= BOUNDS_RAD[part] + 1e-9
    assert abs(added["eyes_left"][0]) <= BOUNDS_RAD["eyes"] + 1e-9
    unmoved = add_glances(keyed, np.array(turns)[:, None], np.zeros(1))
    assert all(unmoved[name] == pytest.approx(keyed[name], abs=1e-12) for name in keyed)
