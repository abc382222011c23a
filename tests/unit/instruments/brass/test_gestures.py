from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reina.instruments import Line, PlayedPart, ValvesFingering
from reina.instruments.brass.fingering import BrassFingering, BrassPart
from reina.instruments.brass.gestures import LOWERING_REST_S, RAISED_BEFORE_S, plan_gestures
from reina.kinematics import MotionCurves

Note = tuple[float, float, int]
"""Onset, end, sounding pitch; pitches outside 52..89 are not playable."""


def played(notes: list[Note], velocity: float = 0.7, slide: list[float] | None = None) -> PlayedPart:
    count = len(notes)
    whole = np.arange(count)
    pitch = np.array([note[2] for note in notes], dtype=np.int64)
    line = Line(
        note_index=whole,
        onset_s=np.array([note[0] for note in notes], dtype=np.float64),
        end_s=np.array([note[1] for note in notes], dtype=np.float64),
        sounding_pitch=pitch,
        velocity=np.full(count, velocity),
        phrase=np.zeros(count, dtype=np.int64),
        dropped=whole[:0],
        shortened=whole[:0],
    )
    playable = (pitch >= 52) & (pitch <= 89)
    valves = (pitch[:, None] >> np.arange(3)) & 1 == 1
    fingering = BrassFingering(
        notes=tuple(ValvesFingering(valves=()) if able else None for able in playable.tolist()),
        playable=playable,
        reasons=("",) * count,
        valves=valves & playable[:, None],
        primary=np.ones(count, dtype=np.bool_),
        cents=(0.0,) * count,
        slide=(0.0,) * count if slide is None else tuple(slide),
    )
    return BrassPart(0, 0, line, fingering, ())


class Plan:
    def __init__(self, part: PlayedPart, seed: int = 0) -> None:
        self._curves = MotionCurves(plan_gestures(part, middle_pitch=68.0, seed=seed))

    def at(self, name: str, times: np.ndarray | list[float]) -> np.ndarray:
        return self._curves.evaluate(np.asarray(times, dtype=np.float64))[self._curves.names.index(name)]


RANGES = {
    "raised": (0, 1),
    "playing": (0, 1),
    "breath": (0, 1),
    "inhale": (0, 1),
    "air": (0, 1),
    "tongue": (0, 1),
    "effort": (-1, 1),
    "lean": (-1, 1.4),
    "turn": (-1, 1),
    "vibrato": (0, 1),
    "slide/3": (0, 1),
}

GREATEST_RATE = {"raised": 2.5, "playing": 2.5, "breath": 12.0, "lean": 16.0, "effort": 25.0, "turn": 4.0}
"""Units a second. At a few hundredths of a radian a unit these are slow turns of a body."""


@st.composite
def lines(draw: st.DrawFn) -> list[Note]:
    notes: list[Note] = []
    time = draw(st.floats(0, 8))
    for _ in range(draw(st.integers(0, 14))):
        duration = draw(st.sampled_from([0.005, 0.041, 0.08, 0.139, 0.5, 2.0, 9.0]))
        rest = draw(st.sampled_from([0.0, 0.0, 0.0, 0.03, 0.2, 0.25, 0.4, 1.3, 3.0, 6.0, 3600.0]))
        notes.append((time, time + duration, draw(st.integers(48, 92))))
        time += duration + rest
    return notes


@settings(max_examples=40, deadline=None)
@given(lines())
def test_every_line_can_be_planned_and_nothing_jumps(notes: list[Note]) -> None:
    plan = Plan(played(notes))
    ends = [time for note in notes for time in note[:2]] or [0.0]
    near = np.unique(np.concatenate([np.arange(t - 3.0, t + 3.0, 1 / 60) for t in ends]))
    for name, (low, high) in RANGES.items():
        values = plan.at(name, near)
        assert values.min() >= low - 1e-9, name
        assert values.max() <= high + 1e-9, name
        if name in GREATEST_RATE:
            step = np.diff(near)
            rate = np.abs(np.diff(values))[step > 1e-3] / step[step > 1e-3]
            assert rate.max() <= GREATEST_RATE[name], name


@settings(max_examples=40)
@given(lines())
def test_the_horn_is_up_for_every_note_that_is_played(notes: list[Note]) -> None:
    plan = Plan(played(notes))
    for onset, end, pitch in notes:
        if 52 <= pitch <= 89:
            np.testing.assert_array_equal(
                plan.at("raised", np.linspace(max(onset - RAISED_BEFORE_S, 0), end, 9)), 1.0
            )
            assert plan.at("air", [(onset + end) / 2])[0] > 0.3


def test_the_horn_comes_down_in_long_rests_alone() -> None:
    rest = LOWERING_REST_S
    plan = Plan(played([(1, 2, 60), (2 + rest - 0.1, 9, 62), (9 + rest, 20, 64)]))
    assert plan.at("raised", [0.0, 4.0])[1] == 1.0
    assert plan.at("raised", [9 + rest / 2 - 0.3])[0] < 0.5
    assert plan.at("raised", [30.0])[0] == 0.0
    # It begins up when there is little time, else down and is raised.
    assert plan.at("raised", [0.0])[0] == 1.0
    assert Plan(played([(10.0, 11.0, 60)])).at("raised", [0.0, 9.3]).tolist() == [0.0, 1.0]
    assert Plan(played([])).at("raised", [0.0])[0] == 0.0


def test_breath_is_taken_in_rests_and_spent_in_phrases() -> None:
    part = played([(1, 3, 60), (3, 5, 62), (5.5, 9, 64)])
    plan = Plan(part)
    drawn = plan.at("inhale", np.linspace(0, 12, 1201))
    times = np.linspace(0, 12, 1201)
    assert np.all(drawn[(times > 1.0) & (times < 5.0)] == 0.0)
    assert drawn[(times > 5.05) & (times < 5.45)].max() == 1.0
    full = plan.at("breath", [1.0, 4.0, 5.0, 5.48, 8.5])
    assert full[0] > full[1] > full[2]
    assert full[3] > full[2] + 0.3
    assert full[4] < full[3]


def test_short_rests_in_a_young_phrase_are_no_breath() -> None:
    staccato = [(float(i), i + 0.2, 60) for i in range(8)]
    times = np.linspace(0.5, 7.5, 1401)
    drawn = Plan(played(staccato)).at("inhale", times)
    begins = np.flatnonzero((drawn[1:] > 0) & (drawn[:-1] == 0))
    assert 2 <= len(begins) <= 4


def test_vibrato_is_for_long_notes_and_the_tongue_for_those_that_are_tongued() -> None:
    plan = Plan(played([(1, 1.5, 60), (1.5, 2.0, 62), (2.0, 2.5, 62), (3.0, 6.0, 65)]))
    assert plan.at("vibrato", [1.25, 1.75])[0] == 0.0
    assert plan.at("vibrato", [4.9])[0] == 1.0
    tongued = plan.at("tongue", [0.99, 1.49, 1.99, 2.99])
    assert tongued.tolist() == pytest.approx([1.0, 0.0, 1.0, 1.0])


def test_slurs_of_the_score_say_what_is_tongued() -> None:
    part = played([(1, 1.5, 60), (1.5, 2.0, 62), (2.1, 2.6, 64), (3.0, 6.0, 65)])
    slurred = replace(part, line=replace(part.line, tongued=np.array([1, 1, 0, -1], dtype=np.int8)))
    assert Plan(slurred).at("tongue", [0.99, 1.49, 2.09, 2.99]).tolist() == pytest.approx(
        [1.0, 1.0, 0.0, 1.0]
    )


def test_effort_follows_the_pitch() -> None:
    plan = Plan(played([(1, 3, 55), (3, 5, 84)]))
    low, high = plan.at("effort", [2.0, 4.9])
    assert low < -0.3 < 0.3 < high
    assert plan.at("effort", [9.0])[0] == 0.0


def test_the_slide_is_out_for_the_notes_that_ask_for_it() -> None:
    part = played([(1, 2, 60), (2, 3, 61), (3, 4, 62)], slide=[0.0, 0.8, 0.0])
    assert Plan(part).at("slide/3", [1.5, 2.0, 2.5, 3.0]).tolist() == [0.0, 0.8, 0.8, 0.0]


def test_seeds_change_how_a_phrase_leans_and_nothing_that_sounds() -> None:
    part = played([(1, 4, 60), (5, 9, 72)])
    one, other, again = (plan_gestures(part, middle_pitch=68.0, seed=seed) for seed in (1, 2, 1))
    assert all(one[name][0].tobytes() == again[name][0].tobytes() for name in one)
    assert one["lean"][0].tobytes() != other["lean"][0].tobytes()
    for name in ("valve/1", "valve/2", "valve/3", "air", "breath", "raised"):
        assert one[name][0].tobytes() == other[name][0].tobytes()
