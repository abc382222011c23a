"""Whatever JSON can say is either a show, which can be written again, or a ShowError."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reina.show import Show, ShowError, with_edits
from reina.stage import stage_registry

REGISTRY = stage_registry()
PATH = "lights/key/intensity"
HALF = "\ud800"


def _show(keyframes: Any, **fields: Any) -> dict[str, Any]:
    return {"version": 1, "tracks": [{"parameter": PATH, "keyframes": keyframes, **fields}]}


def _nested(depth: int) -> Any:
    value: Any = 1
    for _ in range(depth):
        value = [value]
    return value


ODD: dict[str, Any] = {
    "half a character in the title": {"version": 1, "title": HALF},
    "half a character in a marker": {"version": 1, "markers": [{"time": 0, "name": HALF}]},
    "half a character in an unknown path": {
        "version": 1,
        "tracks": [{"parameter": f"x/{HALF}", "keyframes": []}],
    },
    "half a character in an unknown field": {"version": 1, "tracks": [{"parameter": "x/y", HALF: 1}]},
    "half a character as a key": _show([{"time": 0, "value": 1, "key": HALF}]),
    "not a number in an unknown track": {
        "version": 1,
        "tracks": [{"parameter": "x/y", "keyframes": [float("nan")]}],
    },
    "an unknown track without a ground": {
        "version": 1,
        "tracks": [{"parameter": "x/y", "keyframes": _nested(900)}],
    },
    "a whole number that no float holds": _show([{"time": 10**400, "value": 1}]),
    "a key that is a list": _show([{"time": 0, "value": 1}, {"time": 1, "value": 1, "key": []}]),
    "a key that is an object": _show([{"time": 0, "value": 1}, {"time": 1, "value": 1, "key": {}}]),
    "keyframes that are a text": _show("abc"),
}


@pytest.mark.parametrize("case", ODD)
def test_odd_documents_are_refused(case: str) -> None:
    with pytest.raises(ShowError):
        Show.from_document(ODD[case], REGISTRY)


LONG: dict[str, Any] = {
    "a text": "x" * 100_000,
    "a list": list(range(100_000)),
    "lists in lists": [[[["x" * 1000] * 10] * 10] * 10],
    "an object": {str(n): "x" * 1000 for n in range(1000)},
    "a number": 10**4000,
    "lists as deep as JSON is read": json.loads("[" * 900 + "]" * 900),
}
FIELDS: dict[str, Callable[[Any], Any]] = {
    "the show": lambda value: value,
    "version": lambda value: {"version": value},
    "time": lambda value: {"version": 1, "time": value},
    "a marker": lambda value: {"version": 1, "markers": [{"time": value, "name": "A"}]},
    "muted": lambda value: _show([{"time": 0, "value": 1}], muted=value),
    "events": lambda value: _show([], events={"on": value, "amount": 1}),
    "a number": lambda value: _show([{"time": 0, "value": value}]),
    "interpolation": lambda value: _show([{"time": 0, "value": 1, "interpolation": value}]),
    "a tangent": lambda value: _show([{"time": 0, "value": 1, "in_tangent": value}]),
    "a colour": lambda value: {
        "version": 1,
        "tracks": [{"parameter": "blocks/color", "keyframes": [{"time": 0, "value": value}]}],
    },
    "a choice": lambda value: {
        "version": 1,
        "tracks": [{"parameter": "look/style", "keyframes": [{"time": 0, "value": value}]}],
    },
}


@pytest.mark.parametrize("value", LONG)
@pytest.mark.parametrize("field", FIELDS)
def test_an_error_quotes_little_of_what_was_sent(field: str, value: str) -> None:
    with pytest.raises(ShowError) as caught:
        Show.from_document(FIELDS[field](LONG[value]), REGISTRY)
    assert len(str(caught.value)) < 1_000


@pytest.mark.parametrize("value", LONG)
def test_an_edit_s_error_quotes_little_of_what_was_sent(value: str) -> None:
    edits = [
        {"edit": LONG[value]},
        {"edit": "remove_track", "parameter": LONG[value]},
        {"edit": "change_track", "parameter": PATH, "changes": LONG[value]},
    ]
    for edit in edits:
        with pytest.raises(ShowError) as caught:
            with_edits(Show(), [edit], REGISTRY)
        assert len(str(caught.value)) < 1_000


def test_an_error_names_a_long_field_or_path_in_short() -> None:
    name = "x" * 100_000
    for document in (
        {"version": 1, name: 1},
        _show([], **{name: 1}),
        _show([{"time": 0, "value": 1, name: 1}]),
        _show([{"time": 0, "value": 1, "key": name}]),
        {"version": 1, "tracks": [{"parameter": name}, {"parameter": name}]},
    ):
        with pytest.raises(ShowError) as caught:
            Show.from_document(document, REGISTRY)
        assert len(str(caught.value)) < 1_000


def test_unknown_tracks_are_kept_as_they_came() -> None:
    track = {"parameter": "x/y", "keyframes": [{"time": 1, "value": _nested(8), "name": "\N{TRUMPET}"}]}
    show = Show.from_document({"version": 1, "tracks": [track]}, REGISTRY)
    assert show.to_document()["tracks"] == [track]


def test_keyframes_with_and_without_keys_are_many() -> None:
    entries = [{"time": n, "value": 1} | ({"key": f"k{n}"} if n % 2 else {}) for n in range(4000)]
    show = Show.from_document(_show(entries), REGISTRY)
    keys = [keyframe.key for keyframe in show.track(PATH).keyframes]
    assert len(set(keys)) == 4000
    assert keys[1::2] == [f"k{n}" for n in range(1, 4000, 2)]


@pytest.mark.parametrize("keyframes", [5, [5], [{}], [{"time": 0}], "abc"])
def test_a_track_that_is_put_is_looked_at_before_it_is_edited(keyframes: Any) -> None:
    edits = [
        {"edit": "put_track", "track": {"parameter": PATH, "keyframes": keyframes}},
        {"edit": "add_keyframe", "parameter": PATH, "keyframe": {"time": 1, "value": 1}},
    ]
    with pytest.raises(ShowError):
        with_edits(Show(), edits, REGISTRY)


def test_a_track_that_is_put_can_be_edited_on() -> None:
    edits = [
        {
            "edit": "put_track",
            "track": {"parameter": PATH, "time": "seconds", "keyframes": [{"time": 1, "value": 1}]},
        },
        {"edit": "add_keyframe", "parameter": PATH, "keyframe": {"time": 2, "value": 0}},
        {"edit": "change_keyframe", "parameter": PATH, "key": "k1", "changes": {"value": 0.5}},
    ]
    track = with_edits(Show(time="beats"), edits, REGISTRY).track(PATH)
    assert track.time == "seconds"
    assert [(key.key, key.time, key.value) for key in track.keyframes] == [("k1", 1.0, 0.5), ("k2", 2.0, 0.0)]


def test_a_key_cannot_be_taken_away() -> None:
    edits = [
        {"edit": "add_keyframe", "parameter": PATH, "keyframe": {"time": 1, "value": 1}},
        {"edit": "change_keyframe", "parameter": PATH, "key": "k1", "changes": {"key": None}},
    ]
    with pytest.raises(ShowError):
        with_edits(Show(), edits, REGISTRY)


_scalars = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=4) | st.just(HALF)
_json = st.recursive(
    _scalars,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
)
_keyframe = st.fixed_dictionaries(
    {"time": _scalars, "value": _scalars},
    optional=dict.fromkeys(
        ("key", "interpolation", "in_tangent", "out_tangent", "points", "overshoot"), _json
    ),
)
_track = st.fixed_dictionaries(
    {"parameter": st.sampled_from((PATH, "camera/position", "blocks/color", "x/y"))},
    optional={
        "keyframes": st.lists(_keyframe, max_size=3) | _json,
        "events": _json,
        "time": st.sampled_from(("seconds", "beats", "bars")) | _json,
        "before": _json,
        "muted": _json,
    },
)


@settings(max_examples=150, deadline=None)
@given(st.fixed_dictionaries({"version": st.just(1), "tracks": st.lists(_track, max_size=2)}))
def test_any_document_is_a_show_that_can_be_written_or_an_error(document: dict[str, Any]) -> None:
    try:
        show = Show.from_document(document, REGISTRY)
    except ShowError:
        return
    json.dumps(show.to_document(), ensure_ascii=False, allow_nan=False).encode()
    show.plan(REGISTRY)
