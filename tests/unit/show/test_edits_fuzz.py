"""Whatever is asked of a show, it comes to another whole show or to an error that says what was wrong."""

import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.curves.interpolation import BUILT_IN
from reina.show import EDITS, Show, ShowError, ShowHistory, TimeMap, with_edits
from reina.stage import stage_registry

REGISTRY = stage_registry()
TIME_MAP = TimeMap(
    beats=lambda seconds: np.where(seconds < 4, seconds * 2, 8 + (seconds - 4) * 3),
    seconds=lambda beats: np.where(beats < 8, beats / 2, 4 + (beats - 8) / 3),
    bar_lines_beats=np.array([0.0, 1.0, 5.0, 8.0, 12.0]),
)
PATHS = (
    "camera/fov",
    "camera/position",
    "blocks/color",
    "look/style",
    "blocks/visible",
    "camera/roll",
    "no/such",
)
SHOW = Show.from_document(
    {
        "version": 1,
        "time": "beats",
        "markers": [{"time": 2, "name": "A"}],
        "tracks": [
            {
                "parameter": "camera/fov",
                "time": "bars",
                "keyframes": [
                    {"time": 0, "value": 0.5},
                    {"time": 1, "value": 0.6, "interpolation": "cubic_spline", "in_tangent": 0.1},
                    {"time": 3, "value": 0.4, "interpolation": "automatic"},
                ],
            },
            {"parameter": "camera/position", "keyframes": [{"time": 0, "value": [0, 1, 2]}]},
            {"parameter": "blocks/color", "keyframes": [{"time": 0, "value": "#123456"}]},
            {"parameter": "look/style", "keyframes": [{"time": 1, "value": "toon"}]},
            {"parameter": "camera/roll", "events": {"on": "bars", "decay": 1, "amount": 0.1}},
            {"parameter": "no/such", "keyframes": [{"time": 0, "value": 1}]},
        ],
    },
    REGISTRY,
)

paths = st.sampled_from(PATHS)
keys = st.sampled_from(["k1", "k2", "k3", "new", "k 1", ""])
numbers = st.one_of(
    st.integers(-3, 9),
    st.floats(-10, 10),
    st.sampled_from([1e308, -1e308, 1e-320, float("nan"), float("inf")]),
)
odd: list[Any] = ["#AABBCC", "toon", "bright", True, None, [], {}]
values: st.SearchStrategy[Any] = st.one_of(
    numbers,
    st.lists(numbers, min_size=3, max_size=3),
    st.sampled_from(odd),
)
times = st.sampled_from(["seconds", "beats", "bars", "days", None])
keyframes: st.SearchStrategy[Any] = st.fixed_dictionaries(
    {"time": numbers},
    optional={
        "key": keys,
        "value": values,
        "interpolation": st.sampled_from([*BUILT_IN, "sideways"]),
        "in_tangent": values,
        "out_tangent": values,
    },
)
tracks: st.SearchStrategy[Any] = st.fixed_dictionaries(
    {"parameter": paths, "keyframes": st.lists(keyframes, max_size=3)},
    optional={"time": times, "after": st.sampled_from(["loop", "hold", "stop"]), "solo": st.booleans()},
)
FIELDS: dict[str, st.SearchStrategy[Any]] = {
    "parameter": paths,
    "to": paths,
    "key": keys,
    "keyframe": keyframes,
    "replace": st.booleans(),
    "track": tracks,
    "keyframes": st.dictionaries(paths, st.lists(keys, max_size=3), max_size=3),
    "look": st.fixed_dictionaries(
        {},
        optional={
            "values": st.dictionaries(paths, values, max_size=3),
            "tracks": st.lists(tracks, max_size=2),
            "rest": st.lists(st.sampled_from(["camera", "look/style", "no", ""]), max_size=2),
        },
    ),
    "at": st.one_of(st.none(), numbers),
    "by": numbers,
    "time": times,
    "value_by": values,
    "stretch": st.fixed_dictionaries({}, optional={"about": numbers, "factor": numbers}),
    "changes": st.fixed_dictionaries(
        {},
        optional={
            "time": st.one_of(numbers, times),
            "value": values,
            "muted": st.booleans(),
            "after": st.sampled_from(["loop", "ping_pong", "extrapolate", None]),
            "events": st.sampled_from([None, {"on": "beats", "hold": 1, "amount": 0.2}, 3]),
            "title": st.text(max_size=5),
            "markers": st.lists(
                st.fixed_dictionaries({"time": numbers, "name": st.text(max_size=3)}), max_size=2
            ),
        },
    ),
}


def edit_of(name: str) -> st.SearchStrategy[dict[str, Any]]:
    declared = EDITS[name].model_fields
    needed = {field: FIELDS[field] for field in declared if field != "edit" and declared[field].is_required()}
    return st.fixed_dictionaries(
        {"edit": st.just(name), **needed},
        optional={field: FIELDS[field] for field in declared if not declared[field].is_required()},
    )


@given(st.lists(st.sampled_from(list(EDITS)).flatmap(edit_of), min_size=1, max_size=4))
def test_edits_come_to_a_show_or_to_an_error(edits: list[dict[str, Any]]) -> None:
    before = SHOW.to_document()
    edited = said = None
    try:
        edited = with_edits(SHOW, edits, REGISTRY, TIME_MAP)
    except ShowError as error:
        said = str(error)
    assert SHOW.to_document() == before
    if edited is None:
        assert said
        return
    text = json.dumps(edited.to_document(), allow_nan=False)
    assert Show.from_document(json.loads(text), REGISTRY) == edited
    found, _ = edited.plan(REGISTRY, TIME_MAP).evaluate(np.arange(120) / 15.0)
    assert np.all(np.isfinite(found))
    assert ShowHistory(SHOW).then(edited).undone().show is SHOW


@pytest.mark.parametrize(
    ("edits", "message"),
    [
        (
            [{"edit": "add_keyframe", "parameter": "camera/roll", "keyframe": {"time": 1e13, "value": 0}}],
            "is too large; numbers lie within",
        ),
        (
            [
                {
                    "edit": "move_keyframes",
                    "keyframes": {"camera/fov": ["k2"]},
                    "by": 1e12,
                    "time": "bars",
                    "stretch": {"factor": 1e6},
                }
            ],
            "beyond",
        ),
        (
            [
                {
                    "edit": "add_keyframe",
                    "parameter": "camera/position",
                    "keyframe": {"time": 1e-12, "value": [0, 0, 0]},
                }
            ],
            "already",
        ),
    ],
)
def test_what_no_music_reaches_is_refused(edits: list[dict[str, Any]], message: str) -> None:
    with pytest.raises(ShowError, match=message):
        with_edits(SHOW, edits, REGISTRY, TIME_MAP)


def test_moving_no_keys_changes_nothing() -> None:
    edits: list[dict[str, Any]] = [{"edit": "move_keyframes", "keyframes": {"camera/fov": []}, "by": 2}]
    assert with_edits(SHOW, edits, REGISTRY, TIME_MAP) == SHOW
