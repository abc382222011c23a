"""Looks are put into a show from a time on, or throughout; what was before stays."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reina.show import Show, ShowError, TimeMap, Triggers, with_edits
from reina.stage import LIGHT_MOODS, MOOD_REST, LightMood, stage_registry

REGISTRY = stage_registry()
TIME = TimeMap.steady(120, 4)
EXPOSURE, HAZE, RIM, COLOR = "stage/exposure", "lights/haze", "lights/rim/intensity", "lights/key/color"
SHOW = Show.from_document(
    {
        "version": 1,
        "time": "bars",
        "tracks": [
            {
                "parameter": EXPOSURE,
                "keyframes": [{"key": "k1", "time": 0, "value": 1}, {"key": "k2", "time": 4, "value": 3}],
            },
            {
                "parameter": HAZE,
                "time": "seconds",
                "keyframes": [{"key": "h1", "time": 5, "value": 0.9, "interpolation": "step"}],
            },
            {"parameter": "lights/nobody", "keyframes": [{"time": 0, "value": 1}]},
        ],
    },
    REGISTRY,
)


def applied(look: dict[str, Any], show: Show = SHOW, **more: Any) -> Show:
    return with_edits(show, [{"edit": "apply_look", "look": look, **more}], REGISTRY, TIME)


def values(show: Show, path: str, *bars: float) -> list[Any]:
    plan = show.plan(REGISTRY, TIME, triggers=Triggers())
    offset, length = REGISTRY.layout()[path]
    found, _ = plan.evaluate(2.0 * np.array(bars))
    return found[:, offset : offset + length].squeeze(axis=1 if length == 1 else None).round(3).tolist()


def test_what_was_before_stays_and_each_track_goes_on_to_its_next_keyframe() -> None:
    look = {"values": {EXPOSURE: 0.5, COLOR: "#FF0000"}}
    show = applied(look, at=2)
    before = (0, 1, 1.9)
    assert values(show, EXPOSURE, *before) == pytest.approx(values(SHOW, EXPOSURE, *before), abs=1e-3)
    assert values(show, EXPOSURE, 2, 3, 4, 6) == [0.5, 1.75, 3, 3]
    # A parameter that nothing has moved rests until then.
    assert values(show, COLOR, 0, 1.99) == values(SHOW, COLOR, 0, 1.99)
    assert values(show, COLOR, 2, 9) == [[1, 0, 0], [1, 0, 0]]
    # In another unit it is the same place, and once more it changes nothing.
    assert applied(look, at=8, time="beats") == show
    assert values(applied(look, show, at=2), EXPOSURE, 1, 1.9, 2, 3) == values(show, EXPOSURE, 1, 1.9, 2, 3)


def test_at_the_beginning_there_is_nothing_before() -> None:
    show = applied({"values": {EXPOSURE: 0.5, COLOR: "#FF0000"}}, at=0)
    assert [keyframe.key for keyframe in show.track(EXPOSURE).keyframes] == ["k1", "k2"]
    assert len(show.track(COLOR).keyframes) == 1


def test_what_takes_part_and_has_no_value_goes_back_to_its_default() -> None:
    show = applied({"values": {RIM: 4}, "rest": ["lights", EXPOSURE]}, at=2)
    default = REGISTRY[HAZE].default
    # What held the value of a keyframe to come held it until then.
    assert values(show, HAZE, 0, 1.9, 2, 2.4, 2.5) == [0.9, 0.9, default, default, 0.9]
    assert values(show, EXPOSURE, 2) == [REGISTRY[EXPOSURE].default]
    assert show.unknown_parameters == ("lights/nobody",)


def test_throughout_it_takes_the_place_of_the_tracks() -> None:
    show = applied({"values": {EXPOSURE: 0.5}, "rest": ["lights"]})
    assert values(show, EXPOSURE, 0, 2, 9) == [0.5, 0.5, 0.5]
    assert [track.parameter for track in show.tracks] == [EXPOSURE, "lights/nobody"]
    whole = {"tracks": [{"parameter": EXPOSURE, "keyframes": [{"time": 1, "value": 2}]}]}
    assert values(applied(whole), EXPOSURE, 0, 1, 9) == [2, 2, 2]


def test_tracks_count_from_where_they_are_put_in_their_own_unit() -> None:
    track = {
        "parameter": EXPOSURE,
        "time": "seconds",
        "keyframes": [
            {"time": 0, "value": 2, "out_tangent": 0},
            {"time": 2, "value": 4, "interpolation": "cubic_spline", "in_tangent": 1},
        ],
    }
    show = applied({"tracks": [track]}, at=2)
    moved = show.track(EXPOSURE)
    assert moved.time == "bars"
    assert [keyframe.time for keyframe in moved.keyframes] == [0, 1.99, 2, 3, 4]
    # A bar lasts two seconds: the slope is twice as much a bar.
    assert (moved.keyframes[2].out_tangent, moved.keyframes[3].in_tangent) == (0, pytest.approx(2))
    assert values(show, EXPOSURE, 1, 2, 3, 4) == [1.5, 2, 4, 3]
    # What it stands on gives way.
    assert [keyframe.time for keyframe in applied({"tracks": [track]}, at=3.5).track(EXPOSURE).keyframes] == [
        0,
        3.49,
        3.5,
        4.5,
    ]


def test_what_the_show_does_not_know_is_left_out() -> None:
    look: dict[str, Any] = {
        "values": {"players/9/mute": 1, EXPOSURE: 2},
        "tracks": [{"parameter": "players/9/x", "keyframes": []}],
    }
    assert values(applied(look, at=1), EXPOSURE, 1) == [2]


FAULTS: list[tuple[dict[str, Any], str]] = [
    ({"values": {EXPOSURE: "bright"}}, "bright"),
    ({"tracks": [{"keyframes": []}]}, "a parameter's path is needed here"),
    ({"tracks": [{"parameter": EXPOSURE, "keyframes": []}]}, "has a keyframe at least"),
    (
        {"tracks": [{"parameter": EXPOSURE, "events": {"on": "bars", "amount": 2, "decay": 1}}]},
        "has keyframes alone",
    ),
    ({"value": {}}, "its fields are values, tracks, rest"),
]


@pytest.mark.parametrize(("look", "fault"), FAULTS)
@pytest.mark.parametrize("at", [{}, {"at": 1}])
def test_a_fault_is_named(look: dict[str, Any], fault: str, at: dict[str, Any]) -> None:
    with pytest.raises(ShowError, match=fault) as error:
        applied(look, SHOW, **at)
    assert "edits/0" in str(error.value)


@pytest.mark.parametrize("mood", LIGHT_MOODS, ids=[mood.name for mood in LIGHT_MOODS])
def test_the_moods_are_looks(mood: LightMood) -> None:
    show = applied({"values": dict(mood.values), "rest": list(MOOD_REST)})
    known = {track.parameter for track in show.tracks if track.parameter not in show.unknown_parameters}
    assert known == {*mood.values, EXPOSURE}
