from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from reina.curves import Parameter, ParameterRegistry, PerformanceEventEmitter
from reina.curves.extrapolation import EXTRAPOLATIONS
from reina.curves.interpolation import interpolations
from reina.show import Show, TimeMap, with_edits
from reina.show.show_plan import ShowPlan

FPS = 60.0
REGISTRY = ParameterRegistry(
    [
        Parameter("number", "number", 0.0),
        Parameter("vector", "vector", (0, 0, 0)),
        Parameter("orientation", "orientation", (0, 0, 0, 1)),
        Parameter("color", "color", "#000000"),
        Parameter("boolean", "boolean", False, blend=False),
        Parameter("choice", "choice", "a", choices=("a", "b", "c"), blend=False),
        Parameter(
            "transform", "transform", {"position": (0, 0, 0), "orientation": (0, 0, 0, 1), "scale": (1, 1, 1)}
        ),
        Parameter("bounded", "number", 0.5, minimum=0.0, maximum=1.0),
    ]
)
LAYOUT = REGISTRY.layout()


def _plan(tracks: dict[str, list[dict[str, Any]]], *, fps: float = FPS, **common: Any) -> ShowPlan:
    entries = [{"parameter": path, "keyframes": keys, **common} for path, keys in tracks.items()]
    return Show.from_document({"version": 1, "tracks": entries}, REGISTRY).plan(REGISTRY, fps=fps)


def _column(values: NDArray[np.float64], path: str) -> NDArray[np.float64]:
    offset, length = LAYOUT[path]
    return values[:, offset : offset + length]


def _random_value(parameter: Parameter, random: np.random.Generator) -> Any:
    turn = random.normal(size=4)
    turn = (turn / np.linalg.norm(turn)).tolist()
    return {
        "number": lambda: float(random.uniform()),
        "vector": lambda: random.normal(size=3).tolist(),
        "orientation": lambda: turn,
        "color": lambda: random.uniform(size=3).tolist(),
        "boolean": lambda: bool(random.integers(2)),
        "choice": lambda: str(random.choice(["a", "b", "c"])),
        "transform": lambda: {
            "position": random.normal(size=3).tolist(),
            "orientation": turn,
            "scale": random.uniform(0.5, 2.0, 3).tolist(),
        },
    }[parameter.type]()


def random_show(seed: int, *, keys: int = 12, span: float = 8.0) -> Show:
    random = np.random.default_rng(seed)
    tracks: list[dict[str, Any]] = []
    for parameter in REGISTRY:
        names = list(interpolations()) if parameter.interpolates else ["step"]
        keyframes = [
            {
                "time": float(time),
                "value": _random_value(parameter, random),
                "interpolation": str(random.choice(names)),
            }
            for time in np.sort(random.choice(np.arange(int(span * 64)), keys, replace=False)) / 64.0
        ]
        outside = {"before": str(random.choice(EXTRAPOLATIONS)), "after": str(random.choice(EXTRAPOLATIONS))}
        unit = {"time": str(random.choice(["seconds", "beats", "bars"]))}
        tracks.append({"parameter": parameter.path, **outside, **unit, "keyframes": keyframes})
    return Show.from_document({"version": 1, "tracks": tracks}, REGISTRY)


@given(st.integers(0, 2**32 - 1), st.integers(0, 20))
def test_a_block_is_the_same_bytes_whatever_came_before(seed: int, block: int) -> None:
    show = random_show(seed)
    times = (60 * block + np.arange(60)) / FPS
    plan = show.plan(REGISTRY)
    plan.evaluate(np.arange(60) / FPS)
    values, cuts = plan.evaluate(times)
    again, cuts_again = show.plan(REGISTRY).evaluate(times)
    assert values.shape == (60, REGISTRY.size)
    assert values.tobytes() == again.tobytes()
    assert cuts.tobytes() == cuts_again.tobytes()
    assert np.all(np.isfinite(values))


@given(st.integers(0, 2**32 - 1))
def test_tracks_do_not_touch_each_other(seed: int) -> None:
    show = random_show(seed)
    times = np.arange(240) / 20.0
    together, _ = show.plan(REGISTRY).evaluate(times)
    for track in show.tracks:
        alone, _ = Show((track,), time=show.time).plan(REGISTRY).evaluate(times)
        np.testing.assert_allclose(
            _column(together, track.parameter), _column(alone, track.parameter), atol=1e-12
        )


@given(st.integers(0, 2**32 - 1))
def test_an_edit_plans_its_own_track_alone(seed: int) -> None:
    show = random_show(seed)
    plan = show.plan(REGISTRY)
    keyframe = {"time": 100.0, "value": 3.0, "interpolation": "expo_out"}
    edited = with_edits(
        show, [{"edit": "add_keyframe", "parameter": "number", "keyframe": keyframe}], REGISTRY
    )
    again = edited.plan(REGISTRY, earlier=plan)
    assert {path for path in plan.tracks if plan.tracks[path] is again.tracks[path]} == set(plan.tracks) - {
        "number"
    }
    times = np.arange(120) / 7.0
    assert again.evaluate(times)[0].tobytes() == edited.plan(REGISTRY).evaluate(times)[0].tobytes()


def test_the_emitter_and_the_plan_agree() -> None:
    keyframes = [
        {"time": 0.5, "value": -1.0},
        {"time": 1.0, "value": 2.0, "interpolation": "back_in"},
        {"time": 3.0, "value": 5.0, "interpolation": "automatic"},
        {"time": 4.0, "value": 1.0, "interpolation": "clamped"},
    ]
    plan = _plan({"number": keyframes}, after="ping_pong")
    times = np.linspace(0.0, 9.0, 100)
    values, _ = plan.evaluate(times)
    emitter = PerformanceEventEmitter(plan.tracks["number"].track.keyframes, after="ping_pong")
    np.testing.assert_allclose(_column(values, "number")[:, 0], emitter.values_at(times), atol=1e-13)


def test_a_jump_of_a_parameter_that_blends_is_a_cut_in_one_frame() -> None:
    plan = _plan(
        {
            "vector": [
                {"time": 0, "value": [0, 0, 0]},
                {"time": 1.25, "value": [1, 0, 0], "interpolation": "step"},
            ]
        }
    )
    for times in (np.arange(180) / FPS, np.arange(60, 120) / FPS):
        values, cuts = plan.evaluate(times)
        (frame,) = np.flatnonzero(cuts)
        assert times[frame] == 1.25
        np.testing.assert_array_equal(_column(values, "vector")[frame - 1 : frame + 1, 0], [0.0, 1.0])


def test_a_cut_between_two_blocks_is_in_the_later_one() -> None:
    plan = _plan({"number": [{"time": 0, "value": 0}, {"time": 0.99, "value": 1, "interpolation": "step"}]})
    assert not plan.evaluate(np.arange(60) / FPS)[1].any()
    assert np.flatnonzero(plan.evaluate(np.arange(60, 120) / FPS)[1]).tolist() == [0]


@pytest.mark.parametrize("frame", [1, 7, 59, 60, 1000, 3333, 100_003])
def test_a_step_on_a_frame_is_met_once(frame: int) -> None:
    plan = _plan(
        {"number": [{"time": 0, "value": 0}, {"time": frame / FPS, "value": 1, "interpolation": "step"}]}
    )
    around = np.arange(frame - 1, frame + 3) / FPS
    assert plan.evaluate(around)[1].tolist() == [False, True, False, False]
    for time in around:
        assert plan.evaluate(np.array([time]))[1][0] == (time == frame / FPS)


def test_a_step_to_the_same_value_or_of_what_never_blends_is_no_cut() -> None:
    plan = _plan(
        {
            "number": [{"time": 0, "value": 3}, {"time": 0.5, "value": 3, "interpolation": "step"}],
            "boolean": [{"time": 0, "value": True}, {"time": 0.5, "value": False}],
            "choice": [{"time": 0, "value": "a"}, {"time": 0.5, "value": "c"}],
        }
    )
    values, cuts = plan.evaluate(np.arange(60) / FPS)
    assert not cuts.any()
    assert _column(values, "choice")[[29, 30], 0].tolist() == [0.0, 2.0]


def test_a_loop_cuts_at_its_seam_only_where_it_does_not_meet_itself() -> None:
    open_loop = [{"time": 0, "value": 0}, {"time": 0.5, "value": 1}]
    closed_loop = [{"time": 0, "value": 0}, {"time": 0.25, "value": 1}, {"time": 0.5, "value": 0}]
    times = np.arange(180) / FPS
    cuts = _plan({"number": open_loop}, after="loop").evaluate(times)[1]
    assert np.flatnonzero(cuts).tolist() == [30, 60, 90, 120, 150]
    assert not _plan({"number": closed_loop}, after="loop").evaluate(times)[1].any()


def test_a_ping_pong_meets_its_steps_on_both_ways() -> None:
    keys = [
        {"time": 0, "value": 0},
        {"time": 0.25, "value": 1, "interpolation": "step"},
        {"time": 1, "value": 1},
    ]
    cuts = _plan({"number": keys}, before="ping_pong", after="ping_pong").evaluate(
        np.arange(-100, 240) / FPS
    )[1]
    assert (np.flatnonzero(cuts) - 100).tolist() == [-15 + 1, 15, 105 + 1, 135, 225 + 1]


@given(st.integers(0, 2**32 - 1))
def test_cuts_are_where_values_jump(seed: int) -> None:
    """Seen from outside: a step changes the value however short the time, and nothing else does."""
    fps = 64.0  # whose frames' times are exact, in a loop too
    random = np.random.default_rng(seed)
    names = ["step", "linear", "sine_in_out", "automatic", "clamped", "quad_in"]
    keys = [
        {
            "time": float(frame) / fps,
            "value": float(random.integers(0, 3)),
            "interpolation": str(random.choice(names)),
        }
        for frame in np.sort(random.choice(300, 10, replace=False))
    ]
    outside = str(random.choice(["hold", "loop"]))
    plan = _plan({"number": keys}, fps=fps, after=outside)
    times = np.arange(600) / fps
    values, cuts = plan.evaluate(times)
    just_before, _ = plan.evaluate(times - 1e-7)
    jumped = np.abs(values - just_before)[:, 0] > 1e-3
    assert np.flatnonzero(cuts).tolist() == np.flatnonzero(jumped).tolist()


def test_values_stay_within_the_parameter_s_bounds() -> None:
    keys = [{"time": 0, "value": 0.0}, {"time": 1, "value": 1.0, "interpolation": "elastic_out"}]
    values, _ = _plan({"bounded": keys}).evaluate(np.arange(60) / FPS)
    assert _column(values, "bounded").max() == 1.0


def test_a_transform_moves_each_part_in_its_own_way() -> None:
    half_turn = [0.0, 1.0, 0.0, 0.0]
    keys = [
        {"time": 0, "value": {"position": [0, 0, 0], "orientation": [0, 0, 0, 1], "scale": [1, 1, 1]}},
        {"time": 1, "value": {"position": [2, 0, 0], "orientation": half_turn, "scale": [3, 1, 1]}},
    ]
    values, _ = _plan({"transform": keys}).evaluate(np.array([0.5]))
    expected = [1, 0, 0, 0, np.sqrt(0.5), 0, np.sqrt(0.5), 2, 1, 1]
    np.testing.assert_allclose(_column(values, "transform")[0], expected, atol=1e-12)


def test_no_times_are_no_frames() -> None:
    values, cuts = random_show(1).plan(REGISTRY).evaluate(np.zeros(0))
    assert values.shape == (0, REGISTRY.size)
    assert cuts.shape == (0,)


def test_the_default_time_map_is_a_hundred_and_twenty_in_four() -> None:
    show = Show.from_document(
        {
            "version": 1,
            "time": "bars",
            "tracks": [
                {"parameter": "number", "keyframes": [{"time": 0, "value": 0}, {"time": 1, "value": 4}]}
            ],
        },
        REGISTRY,
    )
    assert show.plan(REGISTRY).evaluate(np.array([1.0]))[0][0, 0] == pytest.approx(2.0)
    slow = show.plan(REGISTRY, TimeMap.steady(60.0, 3.0))
    assert slow.evaluate(np.array([1.5]))[0][0, 0] == pytest.approx(2.0)
