from typing import Any

import numpy as np
import pytest

from reina.show import KeyNotFoundError, Show, ShowError, ShowHistory, TimeMap, Triggers, with_edits
from reina.stage import stage_registry

REGISTRY = stage_registry()
SHOW = Show.from_document(
    {
        "version": 1,
        "time": "beats",
        "tracks": [
            {
                "parameter": "camera/fov",
                "after": "loop",
                "keyframes": [
                    {"time": 0, "value": 0.5},
                    {"time": 4, "value": 0.4, "interpolation": "sine_in"},
                ],
            },
            {"parameter": "camera/roll", "keyframes": [{"time": 0, "value": 0.1}]},
        ],
    },
    REGISTRY,
)


def _times(show: Show, path: str) -> dict[str, float]:
    return {keyframe.key: keyframe.time for keyframe in show.track(path).keyframes}


def test_edits_are_made_one_after_another() -> None:
    edits = [
        {"edit": "add_keyframe", "parameter": "camera/fov", "keyframe": {"time": 8, "value": 0.3}},
        {"edit": "change_keyframe", "parameter": "camera/fov", "key": "k3", "changes": {"time": 9}},
        {"edit": "remove_keyframe", "parameter": "camera/fov", "key": "k1"},
        {
            "edit": "add_keyframe",
            "parameter": "stage/exposure",
            "keyframe": {"key": "now", "time": 1, "value": 2},
        },
        {"edit": "remove_track", "parameter": "camera/roll"},
    ]
    edited = with_edits(SHOW, edits, REGISTRY)
    assert _times(edited, "camera/fov") == {"k2": 4.0, "k3": 9.0}
    assert edited.track("camera/fov").after == "loop"
    assert [track.parameter for track in edited.tracks] == ["camera/fov", "stage/exposure"]
    assert _times(SHOW, "camera/fov") == {"k1": 0.0, "k2": 4.0}


def test_two_keyframes_may_change_places() -> None:
    edits = [
        {"edit": "change_keyframe", "parameter": "camera/fov", "key": "k1", "changes": {"time": 4}},
        {"edit": "change_keyframe", "parameter": "camera/fov", "key": "k2", "changes": {"time": 0}},
    ]
    edited = with_edits(SHOW, edits, REGISTRY)
    assert _times(edited, "camera/fov") == {"k2": 0.0, "k1": 4.0}
    assert edited.track("camera/roll") is SHOW.track("camera/roll")
    with pytest.raises(ShowError, match="stands at 4 beats already"):
        with_edits(SHOW, edits[:1], REGISTRY)


def test_a_track_may_be_put_whole() -> None:
    track = {"parameter": "camera/roll", "events": {"on": "bars", "cycle": [0, 0.1]}}
    edited = with_edits(SHOW, [{"edit": "put_track", "track": track}], REGISTRY)
    assert edited.track("camera/roll").keyframes == ()
    assert edited.track("camera/roll").events is not None


def test_a_track_goes_with_its_last_keyframe() -> None:
    edits = [{"edit": "remove_keyframe", "parameter": "camera/roll", "key": "k1"}]
    assert [track.parameter for track in with_edits(SHOW, edits, REGISTRY).tracks] == ["camera/fov"]


def test_what_comes_and_goes_at_once_leaves_no_trace() -> None:
    edits = [
        {
            "edit": "add_keyframe",
            "parameter": "stage/exposure",
            "keyframe": {"key": "a", "time": 1, "value": 2},
        },
        {"edit": "remove_keyframe", "parameter": "stage/exposure", "key": "a"},
    ]
    assert with_edits(SHOW, edits, REGISTRY) == SHOW


BLACK = {"time": 0, "value": "#000000"}
FAULTS: list[tuple[Any, type[ShowError], str]] = [
    ("remove", ShowError, "a list"),
    ([3], ShowError, "none of add_keyframe"),
    ([{"edit": "paint"}], ShowError, "none of add_keyframe"),
    ([{"edit": "remove_track"}], ShowError, "missing"),
    ([{"edit": "remove_track", "parameter": "camera/fov", "now": 1}], ShowError, "no such field"),
    ([{"edit": "remove_track", "parameter": "stage/exposure"}], KeyNotFoundError, "no such track"),
    (
        [{"edit": "remove_keyframe", "parameter": "camera/fov", "key": "k9"}],
        KeyNotFoundError,
        "no such key",
    ),
    ([{"edit": "remove_keyframe", "parameter": "smoke", "key": "k1"}], ShowError, "no parameter 'smoke'"),
    ([{"edit": "put_track", "track": 3}], ShowError, "JSON object"),
    (
        [{"edit": "put_track", "track": {"parameter": "camera/fov", "keyframes": [{}]}}],
        ShowError,
        "missing",
    ),
    (
        [{"edit": "change_keyframe", "parameter": "camera/fov", "key": "k1", "changes": 3}],
        ShowError,
        "object",
    ),
    (
        [
            {
                "edit": "change_keyframe",
                "parameter": "camera/fov",
                "key": "k1",
                "changes": {"key": "k7"},
            }
        ],
        ShowError,
        "key stays",
    ),
    ([{"edit": "move_keyframes", "keyframes": ["k1"]}], ShowError, "JSON object"),
    ([{"edit": "move_keyframes", "keyframes": {"camera/fov": "k1"}}], ShowError, "a list"),
    ([{"edit": "move_keyframes", "keyframes": {"camera/fov": ["k1", 3]}}], ShowError, "a text in quotes"),
    ([{"edit": "move_keyframes", "keyframes": {"camera/fov": ["k9"]}}], KeyNotFoundError, "no such key"),
    ([{"edit": "move_keyframes", "keyframes": {"smoke": []}}], ShowError, "no parameter"),
    ([{"edit": "move_keyframes", "keyframes": {}, "by": "far"}], ShowError, "edits/0/by"),
    ([{"edit": "move_keyframes", "keyframes": {}, "time": "days"}], ShowError, "none of seconds"),
    ([{"edit": "move_keyframes", "keyframes": {}, "stretch": {"factor": 0}}], ShowError, "at least 1e-06"),
    ([{"edit": "move_keyframes", "keyframes": {}, "stretch": {"by": 1}}], ShowError, "no such field"),
    (
        [{"edit": "move_keyframes", "keyframes": {"camera/fov": ["k1"]}, "value_by": [1, 2, 3]}],
        ShowError,
        "value_by",
    ),
    (
        [
            {
                "edit": "add_keyframe",
                "parameter": "blocks/color",
                "keyframe": {"time": 0, "value": "#112233"},
            },
            {"edit": "move_keyframes", "keyframes": {"blocks/color": ["k1"]}, "value_by": 1},
        ],
        ShowError,
        "only numbers and vectors",
    ),
    (
        [{"edit": "change_track", "parameter": "camera/fov", "changes": {"keyframes": []}}],
        ShowError,
        "no such field",
    ),
    (
        [{"edit": "change_track", "parameter": "camera/fov", "changes": {"after": "stop"}}],
        ShowError,
        "none of hold",
    ),
    ([{"edit": "copy_track", "parameter": "camera/fov", "to": "blocks/color"}], ShowError, "its own type"),
    ([{"edit": "copy_track", "parameter": "camera/fov", "to": "smoke"}], ShowError, "edits/0/to"),
    ([{"edit": "change_show", "changes": {"tracks": []}}], ShowError, "no such field"),
    ([{"edit": "change_show", "changes": {"markers": [{"time": 0}]}}], ShowError, "0/name: it is missing"),
]


@pytest.mark.parametrize(("edits", "error", "message"), FAULTS)
def test_a_wrong_edit_changes_nothing_and_is_named(edits: Any, error: type[ShowError], message: str) -> None:
    with pytest.raises(error, match=message):
        with_edits(SHOW, edits, REGISTRY)


STEADY = TimeMap.steady(beats_per_minute=60, beats_per_bar=3)
MIXED = Show.from_document(
    {
        "version": 1,
        "time": "beats",
        "markers": [{"time": 4, "name": "Theme"}],
        "tracks": [
            {
                "parameter": "lights/key/intensity",
                "keyframes": [
                    {"time": 0, "value": 1},
                    {
                        "time": 3,
                        "value": 2,
                        "interpolation": "cubic_spline",
                        "in_tangent": 0.5,
                        "out_tangent": 1,
                    },
                    {"time": 6, "value": 3},
                ],
            },
            {
                "parameter": "camera/position",
                "time": "bars",
                "keyframes": [{"time": 0, "value": [0, 1, 2]}, {"time": 1, "value": [1, 1, 2]}],
            },
            {"parameter": "no/such", "keyframes": [{"time": 0, "value": 1}]},
        ],
    },
    REGISTRY,
)
LIGHT, POSITION = "lights/key/intensity", "camera/position"


def _edited(*edits: dict[str, Any]) -> Show:
    return with_edits(MIXED, list(edits), REGISTRY, STEADY)


def _move(keyframes: dict[str, list[str]], **fields: Any) -> Show:
    return _edited({"edit": "move_keyframes", "keyframes": keyframes, **fields})


def test_keys_of_several_tracks_move_together_whatever_their_units() -> None:
    moved = _move({LIGHT: ["k2", "k3"], POSITION: ["k2"]}, by=1.5)
    assert _times(moved, LIGHT) == {"k1": 0.0, "k2": 4.5, "k3": 7.5}
    assert _times(moved, POSITION) == {"k1": 0.0, "k2": 1.5}, "1.5 beats are half a bar"
    assert _times(_move({POSITION: ["k2"]}, by=2, time="seconds"), POSITION)["k2"] == pytest.approx(5 / 3)
    assert moved.track(LIGHT).keyframes[0] is MIXED.track(LIGHT).keyframes[0]


def test_keys_are_stretched_and_their_slopes_become_flatter() -> None:
    stretched = _move({LIGHT: ["k1", "k2", "k3"]}, stretch={"about": 6, "factor": 2}, by=0.1)
    assert _times(stretched, LIGHT) == {"k1": -5.9, "k2": 0.1, "k3": 6.1}
    key = stretched.track(LIGHT).keyframe("k2")
    assert (key.in_tangent, key.out_tangent) == (0.25, 0.5)


def test_values_move_within_their_range() -> None:
    most = REGISTRY[LIGHT].maximum
    assert most is not None
    moved = _move({LIGHT: ["k1", "k3"]}, value_by=most - 2)
    assert [keyframe.value for keyframe in moved.track(LIGHT).keyframes] == [most - 1, 2, most]
    moved = _move({POSITION: ["k2"]}, value_by=[0, 0.1, -1])
    assert moved.track(POSITION).keyframe("k2").value == (1.0, 1.1, 1.0)


def test_a_key_that_stays_gives_way_to_one_that_comes() -> None:
    moved = _move({LIGHT: ["k1"]}, by=3)
    assert _times(moved, LIGHT) == {"k1": 3.0, "k3": 6.0}
    assert _times(_move({LIGHT: ["k1", "k2"]}, by=3), LIGHT) == {"k1": 3.0, "k2": 6.0}


def test_a_key_can_be_set_where_one_stands() -> None:
    here = {"time": 3, "value": 4}
    edit = {"edit": "add_keyframe", "parameter": LIGHT, "keyframe": here}
    with pytest.raises(ShowError, match="stands at 3 beats already"):
        _edited(edit)
    pasted = _edited(edit | {"replace": True})
    assert _times(pasted, LIGHT) == _times(MIXED, LIGHT)
    assert pasted.track(LIGHT).keyframe("k2").value == 4
    named = _edited(edit | {"replace": True, "keyframe": here | {"key": "new"}})
    assert list(_times(named, LIGHT)) == ["k1", "new", "k3"]
    again = _edited(edit | {"replace": True, "keyframe": here | {"key": "k3"}})
    assert _times(again, LIGHT) == {"k1": 0.0, "k3": 3.0}
    assert _times(_edited(edit | {"keyframe": here | {"time": 4}}), LIGHT)["k4"] == 4


def test_a_key_without_a_value_takes_the_one_that_stands_there() -> None:
    def added(parameter: str, time: float) -> Any:
        keyframe = {"key": "here", "time": time}
        edited = _edited({"edit": "add_keyframe", "parameter": parameter, "keyframe": keyframe})
        return edited.track(parameter).keyframe("here").value

    assert added(LIGHT, -1) == 1
    # 3 beats at 60 a minute; the spline leaves with 0 (no slope is given) and comes with 0.5 a beat.
    assert added(LIGHT, 1.5) == pytest.approx(1.5 - 3 * 0.5 / 8)
    assert added(POSITION, 0.25) == pytest.approx((0.25, 1, 2))
    assert added("camera/fov", 5) == pytest.approx(REGISTRY["camera/fov"].default)
    assert added("look/style", 5) == REGISTRY["look/style"].default
    assert added("blocks/visible", 5) is True
    color = added("blocks/color", 5)
    assert color == pytest.approx(REGISTRY["blocks/color"].floats(REGISTRY["blocks/color"].default).tolist())


def test_a_track_is_changed_beside_its_keys() -> None:
    def change(**changes: Any) -> Show:
        return _edited({"edit": "change_track", "parameter": POSITION, "changes": changes})

    looped = change(after="loop", muted=True).track(POSITION)
    assert (looped.after, looped.muted, looped.time) == ("loop", True, "bars")
    assert looped.keyframes == MIXED.track(POSITION).keyframes
    assert change(muted=None, after=None) == MIXED
    seconds = change(time="seconds").track(POSITION)
    assert seconds.time == "seconds"
    assert [keyframe.time for keyframe in seconds.keyframes] == [0, 3]
    assert change(time=None).track(POSITION).time == "beats", "the show's"
    answering = change(events={"on": "bars", "cycle": [[0, 1, 2]]})
    assert answering.track(POSITION).events is not None
    assert (
        with_edits(
            answering,
            [{"edit": "change_track", "parameter": POSITION, "changes": {"events": None}}],
            REGISTRY,
        )
        == MIXED
    )


@pytest.mark.parametrize("unit", ["seconds", "bars"])
def test_in_another_unit_a_track_is_the_same_curve(unit: str) -> None:
    document = {
        "version": 1,
        "time": "beats",
        "tracks": [
            {
                "parameter": LIGHT,
                "events": {
                    "on": "bars",
                    "attack": 0.25,
                    "hold": 0.5,
                    "decay": 1,
                    "amount": 2,
                    "blend": "add",
                },
                "keyframes": [
                    {"time": 0, "value": 1, "out_tangent": 3},
                    {
                        "time": 3.5,
                        "value": 2,
                        "interpolation": "cubic_spline",
                        "in_tangent": -2,
                        "out_tangent": 1,
                    },
                    {"time": 6, "value": 3, "interpolation": "cubic_spline"},
                    {"time": 8, "value": 1, "interpolation": "automatic"},
                ],
            }
        ],
    }
    before = Show.from_document(document, REGISTRY)
    time_map = TimeMap.steady(beats_per_minute=90, beats_per_bar=3)
    edit = {"edit": "change_track", "parameter": LIGHT, "changes": {"time": unit}}
    after = with_edits(before, [edit], REGISTRY, time_map)
    assert after.track(LIGHT).time == unit
    assert after.track(LIGHT) != before.track(LIGHT)
    times_s = np.arange(400) / 60.0
    triggers = Triggers(end_s=8.0)
    values = [
        show.plan(REGISTRY, time_map, triggers=triggers).evaluate(times_s)[0] for show in (before, after)
    ]
    np.testing.assert_allclose(values[0], values[1], atol=1e-6)


def test_a_track_is_copied_to_another_of_its_type() -> None:
    copied = _edited({"edit": "copy_track", "parameter": LIGHT, "to": "camera/fov"})
    assert [track.parameter for track in copied.tracks][-1] == "camera/fov"
    most = REGISTRY["camera/fov"].maximum
    assert [k.value for k in copied.track("camera/fov").keyframes] == [min(v, most or v) for v in (1, 2, 3)]
    assert _times(copied, "camera/fov") == _times(MIXED, LIGHT)
    assert copied.track(LIGHT) is MIXED.track(LIGHT)
    over = _edited({"edit": "copy_track", "parameter": POSITION, "to": "camera/target"})
    assert over.track("camera/target").keyframes == MIXED.track(POSITION).keyframes


def test_markers_and_words_of_a_show_are_edited() -> None:
    markers = [{"time": 9, "name": "Coda"}, {"time": 3, "name": "Tema"}]
    edited = _edited({"edit": "change_show", "changes": {"markers": markers, "title": "Evening"}})
    assert [(marker.time, marker.name) for marker in edited.markers] == [(3, "Tema"), (9, "Coda")]
    assert edited.title == "Evening"
    assert edited.tracks == MIXED.tracks
    assert _edited({"edit": "change_show", "changes": {"markers": None}}).markers == ()


def test_an_unknown_track_can_be_removed() -> None:
    assert _edited({"edit": "remove_track", "parameter": "no/such"}).unknown_parameters == ()


def test_what_is_not_edited_is_the_same_object() -> None:
    edited = _edited({"edit": "change_keyframe", "parameter": LIGHT, "key": "k2", "changes": {"value": 0}})
    assert edited.tracks[1:] == MIXED.tracks[1:]
    assert all(after is before for after, before in zip(edited.tracks[1:], MIXED.tracks[1:], strict=True))
    assert edited.track(LIGHT).keyframe("k1") is MIXED.track(LIGHT).keyframe("k1")


def test_the_edit_that_is_wrong_is_named() -> None:
    wrong = {"edit": "change_keyframe", "parameter": LIGHT, "key": "k2", "changes": {"value": "bright"}}
    fine = {"edit": "remove_keyframe", "parameter": LIGHT, "key": "k1"}
    with pytest.raises(ShowError) as error:
        _edited(fine, wrong)
    assert (error.value.track, error.value.key, error.value.field) == (LIGHT, "k2", "edits/1/value")


def test_a_history_is_walked_back_and_forth() -> None:
    second = with_edits(SHOW, [{"edit": "remove_track", "parameter": "camera/roll"}], REGISTRY)
    third = with_edits(second, [{"edit": "remove_track", "parameter": "camera/fov"}], REGISTRY)
    history = ShowHistory(SHOW).then(second).then(third)
    assert history.undone().show is second
    assert history.undone().undone().show is SHOW
    assert history.undone().undone().undone().show is SHOW
    assert history.undone().redone() == history
    assert history.redone() is history
    assert history.undone().then(SHOW).redone().show is SHOW
    assert history.then(third) is history


def test_a_history_forgets_the_oldest() -> None:
    history = ShowHistory(SHOW, longest=3)
    shows = [Show(title=str(number)) for number in range(5)]
    for show in shows:
        history = history.then(show)
    for _ in range(9):
        history = history.undone()
    assert history.show is shows[1]
