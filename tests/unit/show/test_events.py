import tracemalloc
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from reina.show import Show, ShowError, ShowPlan, TimeMap, Triggers, with_edits
from reina.stage import stage_registry

REGISTRY = stage_registry()
TIME_MAP = TimeMap.steady(120.0)
TRIGGERS = Triggers(
    onset_s=np.array([0.0, 0.5, 0.5, 1.0, 2.0]),
    part=np.array([0, 0, 1, 0, 0]),
    pitch=np.array([60, 62, 48, 64, 72]),
    velocity=np.array([1.0, 0.5, 0.8, 0.25, 1.0]),
    valves=np.array([[0, 0, 0], [1, 0, 1], [0, 0, 0], [1, 1, 0], [0, 0, 0]], dtype=np.bool_),
    pieces=("kick", "snare"),
    piece=np.array([1, -1, 0, 1, 1]),
    limb=np.array([1, -1, 3, 0, 1]),
    end_s=4.0,
)


def _document(path: str, events: Any, keyframes: Any = (), **track: Any) -> dict[str, Any]:
    return {
        "version": 1,
        "tracks": [{"parameter": path, "events": events, "keyframes": list(keyframes), **track}],
    }


def _plan(path: str, events: Any, keyframes: Any = (), **track: Any) -> ShowPlan:
    show = Show.from_document(_document(path, events, keyframes, **track), REGISTRY)
    return show.plan(REGISTRY, TIME_MAP, triggers=TRIGGERS)


def _values(plan: ShowPlan, path: str, *times: float) -> NDArray[np.float64]:
    offset, length = REGISTRY.layout()[path]
    return plan.evaluate(np.array(times))[0][:, offset : offset + length]


FLASH = {"on": "notes", "amount": 4.0, "blend": "add", "attack": 0.1, "hold": 0.1, "decay": 0.2}
DARK = [{"time": 0, "value": 0}]


def test_a_swell_rises_stays_and_fades() -> None:
    plan = _plan("lights/key/intensity", {**FLASH, "where": {"pitch": [72, 72]}}, DARK)
    times = (1.99, 2.0, 2.05, 2.1, 2.2, 2.3, 2.4, 3.0)
    expected = [0, 0, 2, 4, 4, 4 * 0.25, 0, 0]
    np.testing.assert_allclose(_values(plan, "lights/key/intensity", *times)[:, 0], expected, atol=1e-12)


@pytest.mark.parametrize(
    ("where", "onsets"),
    [
        ({}, [0.0, 0.5, 1.0, 2.0]),
        ({"part": 1}, [0.5]),
        ({"pitch": [60, 62]}, [0.0, 0.5]),
        ({"velocity": [0.5, 1.0]}, [0.0, 0.5, 2.0]),
        ({"valves": []}, [0.0, 0.5, 2.0]),
        ({"valves": [1, 3]}, [0.5]),
        ({"valves": [3, 1]}, [0.5]),
        ({"valves": [1]}, []),
        ({"valves": [4]}, []),
        ({"pieces": ["snare"]}, [0.0, 1.0, 2.0]),
        ({"pieces": ["snare", "kick"], "limbs": ["left_hand", "right_foot"]}, [0.5, 1.0]),
        ({"pieces": ["gong"]}, []),
        ({"limbs": ["right_hand"]}, [0.0, 2.0]),
        ({"limbs": ["left_foot"]}, []),
        ({"part": 0, "pitch": [61, 127], "velocity": [0.0, 0.6]}, [0.5, 1.0]),
    ],
)
def test_notes_are_told_apart(where: dict[str, Any], onsets: list[float]) -> None:
    plan = _plan("lights/key/intensity", {**FLASH, "where": where}, DARK)
    found = _values(plan, "lights/key/intensity", *(onset + 0.15 for onset in (0.0, 0.5, 1.0, 2.0)))[:, 0]
    assert [onset for onset, value in zip((0.0, 0.5, 1.0, 2.0), found, strict=True) if value > 0] == onsets


def test_beats_and_bars_are_answered_to_the_end() -> None:
    flash = {"on": "beats", "amount": 1.0, "hold": 0.1}
    times = np.arange(0.05, 6.0, 0.5)
    found = _values(_plan("lights/key/intensity", flash, DARK), "lights/key/intensity", *times)[:, 0]
    assert found.tolist() == [1.0] * 8 + [0.0] * 4  # 120 beats a minute over four seconds
    flash = {"on": "bars", "amount": 1.0, "hold": 0.1}
    found = _values(_plan("lights/key/intensity", flash, DARK), "lights/key/intensity", *times)[:, 0]
    assert np.flatnonzero(found).tolist() == [0, 4]
    flash = {"on": "beats", "every": 3, "amount": 1.0, "hold": 0.1}
    found = _values(_plan("lights/key/intensity", flash, DARK), "lights/key/intensity", *times)[:, 0]
    assert np.flatnonzero(found).tolist() == [0, 3, 6]


def test_velocity_may_scale_the_swell_and_of_two_at_once_the_stronger_counts() -> None:
    events = {"on": "notes", "amount": 4.0, "hold": 0.1, "blend": "add", "by_velocity": True}
    found = _values(_plan("lights/key/intensity", events, DARK), "lights/key/intensity", 0.05, 0.55, 1.05)
    np.testing.assert_allclose(found[:, 0], [4.0, 3.2, 1.0])


@pytest.mark.parametrize(
    ("blend", "amount", "expected"),
    [("replace", 4.0, 3.0), ("add", 4.0, 4.0), ("multiply", 3.0, 4.0), ("max", 4.0, 2.0), ("max", 6.0, 3.0)],
)
def test_blends(blend: str, amount: float, expected: float) -> None:
    # Half way up, on a value of 2.
    events = {"on": "notes", "where": {"pitch": [60, 60]}, "amount": amount, "attack": 0.2, "blend": blend}
    plan = _plan("lights/key/intensity", events, [{"time": 0, "value": 2.0}])
    assert _values(plan, "lights/key/intensity", 0.1)[0, 0] == pytest.approx(expected)


def test_without_keyframes_the_default_is_what_it_returns_to() -> None:
    plan = _plan(
        "lights/key/intensity", {"on": "notes", "where": {"pitch": [60, 60]}, "amount": 9.0, "hold": 0.2}
    )
    default = REGISTRY.defaults()[REGISTRY.layout()["lights/key/intensity"][0]]
    np.testing.assert_allclose(_values(plan, "lights/key/intensity", 0.1, 0.3)[:, 0], [9.0, default])


def test_colours_swell_in_their_space() -> None:
    events = {"on": "notes", "where": {"pitch": [60, 60]}, "amount": "#000000", "attack": 0.2}
    white = [{"time": 0, "value": "#FFFFFF"}]
    plan = _plan("blocks/color", events, white)
    np.testing.assert_allclose(_values(plan, "blocks/color", 0.1, 3.0), [[0.125] * 3, [1.0] * 3], atol=1e-6)
    plan = _plan("blocks/color", events, white, color_space="linear")
    np.testing.assert_allclose(_values(plan, "blocks/color", 0.1), [[0.5] * 3], atol=1e-12)


def test_swells_stay_within_the_parameter_s_bounds_and_are_no_cuts() -> None:
    plan = _plan("blocks/opacity", {"on": "beats", "amount": 3.0, "hold": 0.2, "blend": "add"})
    values, cuts = plan.evaluate(np.arange(240) / 60.0)
    offset = REGISTRY.layout()["blocks/opacity"][0]
    assert values[:, offset].max() == 1.0
    assert not cuts.any()


def test_a_camera_cuts_on_the_bar() -> None:
    views = [[0, 1, 3], [1, 1, 3], [2, 1, 3]]
    plan = _plan("camera/position", {"on": "bars", "cycle": views})
    values, cuts = plan.evaluate(np.arange(-30, 240) / 60.0)
    assert (np.flatnonzero(cuts) - 30).tolist() == [0, 120]
    np.testing.assert_allclose(values[[29 + 1, 30 + 120, 269], 0], [0.0, 1.0, 1.0])
    np.testing.assert_allclose(values[0, :3], REGISTRY.defaults()[:3])


def test_choices_take_turns_and_are_held_but_are_no_cuts() -> None:
    turns = _plan("blocks/arrangement", {"on": "bars", "cycle": ["lane_below", "toward_bell"]})
    values, cuts = turns.evaluate(np.array([0.0, 1.0, 2.0, 3.0]))
    offset = REGISTRY.layout()["blocks/arrangement"][0]
    assert values[:, offset].tolist() == [1.0, 1.0, 0.0, 0.0]
    assert not cuts.any()
    held = _plan("blocks/visible", {"on": "bars", "amount": False, "hold": 0.5})
    assert _values(held, "blocks/visible", 0.25, 1.0, 2.25)[:, 0].tolist() == [0.0, 1.0, 0.0]


def test_lengths_follow_the_track_s_unit() -> None:
    events = {"on": "bars", "amount": 4.0, "blend": "add", "hold": 0.5}
    plan = _plan("lights/key/intensity", events, DARK, time="bars")
    assert _values(plan, "lights/key/intensity", 0.9, 1.1)[:, 0].tolist() == [4.0, 0.0]


@given(
    st.lists(st.floats(0.0, 5.0), max_size=30), st.floats(0.01, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 2.0)
)
def test_the_swell_is_the_greatest_of_each_by_itself(
    onsets: list[float], attack: float, hold: float, decay: float
) -> None:
    onset_s = np.sort(np.array(onsets))
    count = onset_s.size
    triggers = Triggers(onset_s, np.zeros(count, np.int64), np.full(count, 60), np.ones(count), end_s=6.0)
    events = {"on": "notes", "amount": 1.0, "blend": "add", "attack": attack, "hold": hold, "decay": decay}
    show = Show.from_document(_document("lights/key/intensity", events, DARK), REGISTRY)
    times = np.linspace(-0.5, 9.0, 97)
    offset = REGISTRY.layout()["lights/key/intensity"][0]
    found = show.plan(REGISTRY, TIME_MAP, triggers=triggers).evaluate(times)[0][:, offset]

    def swell(age: float) -> float:
        if age < 0 or age >= attack + hold + decay:
            return 0.0
        if age < attack:
            return age / attack
        if age < attack + hold:
            return 1.0
        return ((attack + hold + decay - age) / decay) ** 2

    expected = [max((swell(float(t - onset)) for onset in onset_s), default=0.0) for t in times]
    np.testing.assert_allclose(found, expected, atol=1e-7)


def test_swells_that_hang_over_every_note_take_little_memory() -> None:
    notes, points = 20_000, 1_000
    zeros = np.zeros(notes)
    triggers = Triggers(
        onset_s=np.linspace(0.0, 1.0, notes),
        part=zeros.astype(int),
        pitch=zeros.astype(int),
        velocity=np.linspace(0.0, 1.0, notes),
        valves=np.zeros((notes, 3), dtype=np.bool_),
        end_s=2.0,
    )
    events = {"on": "notes", "amount": 4.0, "blend": "add", "hold": 1e6, "by_velocity": True}
    show = Show.from_document(_document("lights/key/intensity", events, DARK), REGISTRY)
    plan = show.plan(REGISTRY, TIME_MAP, triggers=triggers)
    times = np.linspace(0.0, 1.0, points)
    tracemalloc.start()
    found = _values(plan, "lights/key/intensity", *times)[:, 0]
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    np.testing.assert_allclose(found, 4.0 * times, atol=4.0 / notes)
    assert peak < 20_000_000


def test_what_a_track_does_at_events_comes_back_from_json() -> None:
    events = {
        "on": "notes",
        "where": {"part": 0, "pitch": [60.0, 72.0], "velocity": [0.5, 1.0], "valves": [1, 2]}
        | {"pieces": ["snare", "kick"], "limbs": ["right_hand"]},
        "every": 2,
        "attack": 0.01,
        "hold": 0.1,
        "decay": 0.5,
        "amount": "#FFFFFF",
        "by_velocity": True,
        "blend": "max",
    }
    blend_amount = {**events, "amount": [1.0, 1.0, 1.0]}
    for document in (
        _document("blocks/color", blend_amount),
        _document("blocks/color", {"on": "bars", "cycle": ["#FF0000"]}),
    ):
        show = Show.from_document(document, REGISTRY)
        assert Show.from_document(show.to_document(), REGISTRY) == show
        assert show.to_document()["tracks"][0]["events"] == document["tracks"][0]["events"]


SWELL: dict[str, Any] = {"on": "notes", "amount": 1, "hold": 1}


@pytest.mark.parametrize(
    ("events", "field", "message"),
    [
        (3, "events", "JSON object"),
        ({"on": "notes"}, "events", "an amount"),
        ({"on": "notes", "amount": 1, "cycle": [1], "hold": 1}, "events", "an amount"),
        ({"on": "notes", "amount": 1}, "events", "longer than 0"),
        ({"on": "chords", "amount": 1}, "events/on", "notes, beats, bars"),
        ({"on": "beats", "where": {"part": 0}, "amount": 1, "hold": 1}, "events/where", "only notes"),
        ({"on": "notes", "amount": 99, "hold": 1}, "events/amount", "at most"),
        ({"on": "notes", "amount": 1, "hold": -1}, "events/hold", "at least 0"),
        ({"on": "notes", "amount": 1, "hold": 1, "every": 0}, "events/every", "at least 1"),
        (
            {"on": "notes", "amount": 1, "hold": 1, "where": {"pitch": [60]}},
            "events/where/pitch",
            "2 are needed",
        ),
        (SWELL | {"where": {"valves": 1}}, "events/where/valves", "list"),
        (SWELL | {"where": {"pieces": "snare"}}, "events/where/pieces", "list"),
        (SWELL | {"where": {"pieces": list[str]()}}, "events/where/pieces", "one value"),
        (SWELL | {"where": {"pieces": ["The Snare"]}}, "events/where/pieces", "as snare or tom_high"),
        (SWELL | {"where": {"limbs": ["hand"]}}, "events/where/limbs", "left_hand, right_hand"),
        (
            {"on": "notes", "amount": 1, "hold": 1, "where": {"colour": 1}},
            "events/where/colour",
            "no such field",
        ),
        (
            {"on": "notes", "amount": 1, "hold": 1, "blend": "screen"},
            "events/blend",
            "replace, add, multiply, max",
        ),
        ({"on": "notes", "cycle": []}, "events/cycle", "one value"),
        ({"on": "notes", "cycle": ["loud"]}, "events/cycle", "no number"),
    ],
)
def test_a_fault_in_events_is_named(events: Any, field: str, message: str) -> None:
    with pytest.raises(ShowError, match=message) as caught:
        Show.from_document(_document("lights/key/intensity", events), REGISTRY)
    assert caught.value.track == "lights/key/intensity"
    assert caught.value.field == field


def test_a_choice_is_only_replaced() -> None:
    events = {"on": "bars", "amount": "lane_below", "hold": 1, "blend": "add"}
    with pytest.raises(ShowError, match="only be replaced"):
        Show.from_document(_document("blocks/arrangement", events), REGISTRY)


def test_triggers_are_columns_in_order() -> None:
    integers = np.array([1, 2])
    with pytest.raises(ValueError, match="one length"):
        Triggers(np.zeros(3), integers, integers, np.zeros(2))
    with pytest.raises(ValueError, match="one length"):
        Triggers(np.zeros(2), integers, integers, np.zeros(2), joined_to=np.zeros(3, np.int64))
    with pytest.raises(ValueError, match="order"):
        Triggers(np.array([1.0, 0.0]), integers, integers, np.zeros(2))


def test_a_plan_of_an_edited_show_keeps_the_triggers() -> None:
    document = _document("lights/key/intensity", {"on": "notes", "amount": 4.0, "hold": 0.1}, DARK)
    show = Show.from_document(document, REGISTRY)
    plan = show.plan(REGISTRY, TIME_MAP, triggers=TRIGGERS)
    edit = {"edit": "remove_keyframe", "parameter": "lights/key/intensity", "key": "k1"}
    again = with_edits(show, [edit], REGISTRY).plan(REGISTRY, TIME_MAP, earlier=plan)
    assert _values(again, "lights/key/intensity", 0.05)[0, 0] == 4.0
