from typing import Any

import pytest

from reina.keyframes import KeyNotFoundError, Show, ShowError, ShowHistory, stage_registry, with_edits

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
]


@pytest.mark.parametrize(("edits", "error", "message"), FAULTS)
def test_a_wrong_edit_changes_nothing_and_is_named(edits: Any, error: type[ShowError], message: str) -> None:
    with pytest.raises(error, match=message):
        with_edits(SHOW, edits, REGISTRY)


def test_a_history_is_walked_back_and_forth() -> None:
    second = SHOW.without_track("camera/roll")
    third = second.without_track("camera/fov")
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
