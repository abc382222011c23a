import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reina.instruments import Line, PlayedPart, ValvesFingering
from reina.instruments.brass.fingering import BrassFingering, BrassPart
from reina.instruments.brass.strokes import (
    LARGEST_SHARE,
    LONGEST_STROKE_S,
    PRESS_S,
    RELEASE_S,
    plan_strokes,
)
from reina.kinematics import MotionCurves

Note = tuple[float, float, tuple[int, ...] | None]
"""Onset, end, pressed valves (None: not playable)."""


def played(notes: list[Note], velocity: float = 0.7) -> PlayedPart:
    count = len(notes)
    onset = np.array([note[0] for note in notes], dtype=np.float64)
    pressed = [[v in (note[2] or ()) for v in (1, 2, 3)] for note in notes]
    valves = np.array(pressed, dtype=np.bool_).reshape(count, 3)
    whole = np.arange(count)
    line = Line(
        note_index=whole,
        onset_s=onset,
        end_s=np.array([note[1] for note in notes], dtype=np.float64),
        sounding_pitch=np.full(count, 60),
        velocity=np.full(count, velocity),
        phrase=np.zeros(count, dtype=np.int64),
        dropped=whole[:0],
        shortened=whole[:0],
    )
    fingering = BrassFingering(
        notes=tuple(None if note[2] is None else ValvesFingering(valves=note[2]) for note in notes),
        playable=np.array([note[2] is not None for note in notes], dtype=np.bool_),
        reasons=("",) * count,
        valves=valves,
        primary=np.ones(count, dtype=np.bool_),
        cents=(0.0,) * count,
        slide=(0.0,) * count,
    )
    return BrassPart(0, 0, line, fingering, ())


def at(part: PlayedPart, *times: float) -> np.ndarray:
    return valves(part).evaluate(np.array(times)).T


def valves(part: PlayedPart) -> MotionCurves:
    plan = plan_strokes(part)
    return MotionCurves({name: (plan[name], 0.0) for name in ("valve/1", "valve/2", "valve/3")})


def test_a_valve_is_down_for_its_note_and_up_around_it() -> None:
    part = played([(1.0, 2.0, (1, 3))])
    np.testing.assert_array_equal(at(part, 0.0, 0.9), np.zeros((2, 3)))
    np.testing.assert_array_equal(at(part, 1.0, 1.5, 2.0), [[1, 0, 1]] * 3)
    np.testing.assert_array_equal(at(part, 2.1, 99.0), np.zeros((2, 3)))


@pytest.mark.parametrize("velocity", [0.0, 0.5, 1.0])
def test_strokes_take_the_time_that_players_take(velocity: float) -> None:
    part = played([(1.0, 2.0, ()), (2.0, 3.0, (1, 2, 3)), (3.0, 4.0, ())], velocity)
    starts: list[float] = []
    for valve in (1, 2, 3):
        press, release = plan_strokes(part)[f"valve/{valve}"]
        assert 0.025 - 1e-9 <= press[1] - press[0] <= 0.035 + 1e-9
        assert 0.030 - 1e-9 <= release[1] - release[0] <= 0.040 + 1e-9
        assert 1.96 <= press[0] < press[1] <= 2.0
        assert 2.96 <= release[0] < release[1] <= 3.0
        starts.append(press[0])
    assert max(starts) - min(starts) < 0.010
    assert PRESS_S[0] > PRESS_S[1]
    assert RELEASE_S[0] > RELEASE_S[1]


def test_valves_stay_down_through_repeats_and_short_rests() -> None:
    part = played([(0.0, 0.5, (1,)), (0.5, 0.9, (1,)), (1.1, 1.5, (1,)), (2.5, 3.0, (1,))])
    times = np.linspace(0.0, 1.5, 500)
    np.testing.assert_array_equal(valves(part).evaluate(times)[0], 1.0)
    # A rest long enough to breathe lets it up.
    assert at(part, 2.0)[0, 0] == 0.0
    assert at(part, 2.5)[0, 0] == 1.0


def test_an_unplayable_note_is_not_played_with_other_valves() -> None:
    part = played([(0.0, 1.0, (2,)), (1.0, 2.0, None), (2.0, 3.0, (2,))])
    np.testing.assert_array_equal(at(part, 0.5, 1.0, 1.5, 2.0)[:, 1], [1, 0, 0, 1])


def test_nothing_to_play() -> None:
    np.testing.assert_array_equal(at(played([]), 0.0, 1.0), np.zeros((2, 3)))
    np.testing.assert_array_equal(at(played([(0.0, 1.0, None)]), 0.0, 0.5), np.zeros((2, 3)))


FINGERINGS = st.sampled_from([None, (), (1,), (2,), (3,), (1, 2), (2, 3), (1, 3), (1, 2, 3)])


@st.composite
def lines(draw: st.DrawFn) -> list[Note]:
    notes: list[Note] = []
    time = draw(st.floats(0, 2))
    for _ in range(draw(st.integers(0, 30))):
        duration = draw(st.sampled_from([0.001, 0.02, 0.041, 0.07, 0.139, 0.5, 2.0]))
        rest = draw(st.sampled_from([0.0, 0.0, 0.0, 0.03, 0.2, 0.25, 0.4, 3.0, 3600.0]))
        notes.append((time, time + duration, draw(FINGERINGS)))
        time += duration + rest
    return notes


@settings(max_examples=60)
@given(lines(), st.floats(0, 1))
def test_every_note_has_its_valves_whatever_the_line(notes: list[Note], velocity: float) -> None:
    part = played(notes, velocity)
    strokes = valves(part)
    for index, (onset, end, fingering) in enumerate(notes):
        wanted = np.array([v in (fingering or ()) for v in (1, 2, 3)], dtype=np.float64)
        last = end
        if index + 1 < len(notes):
            following = notes[index + 1][0]
            last = min(end, following - min(LONGEST_STROKE_S, LARGEST_SHARE * (following - onset)) - 1e-9)
        times = np.linspace(onset, max(last, onset), 9)
        values = strokes.evaluate(times).T
        if fingering is not None:
            np.testing.assert_array_equal(values, np.broadcast_to(wanted, values.shape))
        else:
            np.testing.assert_array_equal(values, 0.0)


@settings(max_examples=60)
@given(lines())
def test_fingers_lift_only_off_valves_that_are_up(notes: list[Note]) -> None:
    plan = plan_strokes(played(notes))
    curves = MotionCurves({name: (table, 0.0) for name, table in plan.items()})
    edges = np.unique(np.concatenate([table[:, :2].ravel() for table in plan.values()]))
    times = np.unique(np.concatenate([edges, (edges[1:] + edges[:-1]) / 2, edges + 1e-3, edges - 1e-3]))
    values = curves.evaluate(times)
    for valve in (1, 2, 3):
        down = values[curves.names.index(f"valve/{valve}")]
        lift = values[curves.names.index(f"lift/{valve}")]
        assert np.all((down == 0.0) | (lift == 0.0))
        assert np.all((lift >= 0.0) & (lift <= 1.0))


def test_the_same_part_gives_the_same_bytes() -> None:
    part = played([(0.1 * i, 0.1 * i + 0.1, ((), (1,), (2, 3))[i % 3]) for i in range(200)])
    times = np.arange(1200) / 60
    assert valves(part).evaluate(times).tobytes() == valves(part).evaluate(times).tobytes()
