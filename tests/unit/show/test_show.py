import importlib
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from reina.curves import EasedKeyframe, Parameter, ParameterRegistry, interpolations
from reina.curves.interpolation import InterpolationError, discover_interpolations
from reina.errors import InputError
from reina.show import KeyNotFoundError, Show, ShowError, TimeMap, Track, UnknownTrack, with_edits
from reina.show.errors import MAX_FAULTS
from reina.stage import stage_registry

REGISTRY = stage_registry()

DOCUMENT: dict[str, Any] = {
    "version": 1,
    "title": "Evening",
    "description": "Brass to dusk.",
    "time": "beats",
    "markers": [{"time": 0.0, "name": "Theme"}, {"time": 32.0, "name": "Couplet"}],
    "tracks": [
        {
            "parameter": "blocks/color",
            "after": "loop",
            "keyframes": [
                {"key": "k1", "time": 0.0, "value": "#D9A441", "interpolation": "step"},
                {"key": "k2", "time": 8.0, "value": [0.1, 0.2, 0.3], "interpolation": "quad_in"},
                {
                    "key": "dusk",
                    "time": 16.0,
                    "value": "#4C6A9A",
                    "interpolation": "cubic_bezier",
                    "handles": [0.4, 0.0, 0.2, 1.0],
                },
            ],
        },
        {
            "parameter": "camera/position",
            "time": "seconds",
            "keyframes": [
                {"key": "a", "time": 0.0, "value": [0.0, 1.0, 3.0], "interpolation": "linear"},
                {
                    "key": "b",
                    "time": 2.0,
                    "value": [1.0, 1.0, 3.0],
                    "interpolation": "cubic_spline",
                    "in_tangent": [1.0, 0.0, 0.0],
                    "out_tangent": [0.0, 0.0, 1.0],
                },
            ],
        },
        {
            "parameter": "blocks/arrangement",
            "keyframes": [
                {"key": "k1", "time": 0.0, "value": "toward_bell", "interpolation": "step"},
                {"key": "k2", "time": 4.0, "value": "lane_below", "interpolation": "step"},
            ],
        },
        {"parameter": "smoke/density", "keyframes": [{"time": 0, "value": "thick"}], "wind": [1, 2]},
    ],
}


def _show() -> Show:
    return Show.from_document(DOCUMENT, REGISTRY)


def _document(**changes: Any) -> dict[str, Any]:
    return {"version": 1, "tracks": [], **changes}


def _with_key(path: str = "camera/fov", **fields: Any) -> dict[str, Any]:
    return _document(
        tracks=[{"parameter": path, "keyframes": [{"key": "k7", "time": 0, "value": 0.5, **fields}]}]
    )


def test_a_document_comes_back_as_it_was() -> None:
    assert _show().to_document() == DOCUMENT
    assert Show.from_document(_show().to_document(), REGISTRY) == _show()
    json.dumps(_show().to_document(), allow_nan=False)


def test_an_unknown_parameter_is_kept_and_reported() -> None:
    show = _show()
    assert show.unknown_parameters == ("smoke/density",)
    assert isinstance(show.tracks[3], UnknownTrack)
    assert show.to_document()["tracks"][3] == DOCUMENT["tracks"][3]
    known = ParameterRegistry([Parameter("smoke/density", "number", 0.0)])
    with pytest.raises(ShowError, match="track smoke/density"):
        Show.from_document(show.to_document(), known)


def test_keys_that_are_not_named_get_names() -> None:
    keyframes = [{"time": 0, "value": 0.5}, {"time": 1, "value": 0.4, "key": "k1"}, {"time": 2, "value": 0.3}]
    show = Show.from_document(
        _document(tracks=[{"parameter": "camera/fov", "keyframes": keyframes}]), REGISTRY
    )
    assert [keyframe.key for keyframe in show.track("camera/fov").keyframes] == ["k2", "k1", "k3"]


def _with_track(path: str = "camera/fov", **fields: Any) -> dict[str, Any]:
    return _document(tracks=[{"parameter": path, **fields}])


FAULTS: list[tuple[Any, str | None, str | None, str | None, str]] = [
    # the document, track, key and field that the error names, and what it says
    (3, None, None, None, "JSON object"),
    ({"tracks": []}, None, None, "version", "version 1 is read here"),
    (_document(version=2), None, None, "version", "version 2"),
    (_document(trakcs=[]), None, None, "trakcs", "its fields are"),
    (_document(time="minutes"), None, None, "time", "seconds, beats, bars"),
    (_document(tracks={}), None, None, "tracks", "a list"),
    (_document(tracks=[5]), None, None, "tracks/0", "a JSON object"),
    (_document(tracks=[{}]), None, None, "tracks/0/parameter", "a parameter's path"),
    (_document(title=3), None, None, "title", "a text"),
    (_document(markers=[{"time": 0}]), None, None, "markers/0/name", "missing"),
    (_document(markers=[{"name": "A"}]), None, None, "markers/0/time", "missing"),
    (_with_track(), "camera/fov", None, "keyframes", "a list"),
    (_with_track(keyframes=[]), "camera/fov", None, "keyframes", "one keyframe"),
    (_with_track(keyframes=[3]), "camera/fov", None, "keyframes", "JSON object"),
    (_with_track(loop=1, keyframes=[{}]), "camera/fov", None, "loop", "its fields are"),
    (_with_track(muted="yes", keyframes=[{"time": 0, "value": 1}]), "camera/fov", None, "muted", "true"),
    (_with_track(after="bounce", keyframes=[{"time": 0, "value": 1}]), "camera/fov", None, "after", "loop"),
    (_with_key(value=True), "camera/fov", "k7", "value", "no number"),
    (_with_key(value=9.0), "camera/fov", "k7", "value", "at most 2 rad"),
    (_with_key(time="soon"), "camera/fov", "k7", "time", "no number"),
    (_with_key(time=float("inf")), "camera/fov", "k7", "time", "finite"),
    (_with_key(interpolation="smooth"), "camera/fov", "k7", "interpolation", "cubic_bezier"),
    (_with_key(handles=[0, 0, 1, 1]), "camera/fov", "k7", "handles", "no such field"),
    (
        _with_key(interpolation="cubic_bezier", handles=[0, 0, 1.5, 1]),
        "camera/fov",
        "k7",
        "handles",
        "0 and 1",
    ),
    (_with_key(interpolation="cubic_bezier", handles=[0, 0]), "camera/fov", "k7", "handles", "4 are needed"),
    (_with_key(in_tangent=[1, 2]), "camera/fov", "k7", "in_tangent", "no number"),
    (_with_key(key="ä"), "camera/fov", "ä", "key", "letters"),
    (_with_key("blocks/visible", interpolation="linear"), "blocks/visible", "k7", "interpolation", "step"),
    (
        _with_key("blocks/visible", value=True, in_tangent=1),
        "blocks/visible",
        "k7",
        "in_tangent",
        "only steps",
    ),
    (_with_key("blocks/arrangement", value="sideways"), "blocks/arrangement", "k7", "value", "lane_below"),
]


@pytest.mark.parametrize(("document", "track", "key", "field", "message"), FAULTS)
def test_an_error_names_track_key_and_field(
    document: Any, track: str | None, key: str | None, field: str | None, message: str
) -> None:
    with pytest.raises(ShowError, match=message) as caught:
        Show.from_document(document, REGISTRY)
    assert isinstance(caught.value, InputError)
    assert (caught.value.track, caught.value.key, caught.value.field) == (track, key, field)
    for place in (track, key, field):
        assert place is None or place in str(caught.value.location)


def test_two_keyframes_at_one_time_or_with_one_key_are_refused() -> None:
    for second, field in (({"key": "b", "time": 0.0}, "time"), ({"key": "a", "time": 1.0}, "key")):
        keyframes = [{"key": "a", "time": 0, "value": 0.5}, {"value": 0.4, **second}]
        with pytest.raises(ShowError) as caught:
            Show.from_document(
                _document(tracks=[{"parameter": "camera/fov", "keyframes": keyframes}]), REGISTRY
            )
        assert caught.value.field == field


def test_two_tracks_of_one_parameter_are_refused() -> None:
    track = {"parameter": "camera/fov", "keyframes": [{"time": 0, "value": 0.5}]}
    with pytest.raises(ShowError, match="two tracks"):
        Show.from_document(_document(tracks=[track, track]), REGISTRY)


def _edited(show: Show, **edit: Any) -> Show:
    return with_edits(show, [edit], REGISTRY)


def test_edits_give_new_shows_and_share_what_they_do_not_touch() -> None:
    show = _show()
    keyframe = {"time": 1.0, "value": [0, 2, 2], "interpolation": "sine_in"}
    edited = _edited(show, edit="add_keyframe", parameter="camera/position", keyframe=keyframe)
    added = edited.track("camera/position").keyframes[1]
    assert (added.key, added.time, added.value) == ("k1", 1.0, (0.0, 2.0, 2.0))
    assert edited.track("blocks/color") is show.track("blocks/color")
    assert len(show.track("camera/position").keyframes) == 2
    assert _edited(edited, edit="remove_keyframe", parameter="camera/position", key="k1") == show


def test_an_edit_of_a_keyframe_keeps_its_key() -> None:
    def changed(**changes: Any) -> dict[str, Any]:
        edit = {"edit": "change_keyframe", "parameter": "blocks/color", "key": "dusk", "changes": changes}
        return _edited(_show(), **edit).to_document()["tracks"][0]["keyframes"][2]

    moved = changed(time=20.0)
    assert (moved["key"], moved["time"], moved["handles"]) == ("dusk", 20.0, [0.4, 0.0, 0.2, 1.0])
    assert "handles" not in changed(interpolation="sine_out")
    assert "handles" not in changed(handles=None)
    with pytest.raises(ShowError, match="no such field"):
        changed(colour="#000000")
    with pytest.raises(ShowError) as caught:
        changed(time=8.0)
    assert caught.value.field == "time"


def test_a_track_comes_with_its_first_keyframe_and_goes_with_its_last() -> None:
    keyframe = {"time": 1.0, "value": 0.4}
    show = _edited(Show(time="bars"), edit="add_keyframe", parameter="camera/fov", keyframe=keyframe)
    assert show.track("camera/fov").time == "bars"
    assert show.track("camera/fov").keyframes[0].key == "k1"
    assert _edited(show, edit="remove_keyframe", parameter="camera/fov", key="k1") == Show(time="bars")


def test_what_is_not_there_cannot_be_edited() -> None:
    show = _show()
    for path in ("camera/roll", "smoke/density"):
        with pytest.raises(KeyNotFoundError):
            show.track(path)
    roll: dict[str, Any] = {"edit": "change_keyframe", "parameter": "camera/roll", "key": "k1", "changes": {}}
    edits: list[dict[str, Any]] = [
        {"edit": "remove_keyframe", "parameter": "camera/position", "key": "k9"},
        {"edit": "remove_track", "parameter": "camera/roll"},
        roll,
    ]
    for edit in edits:
        with pytest.raises(KeyNotFoundError):
            _edited(show, **edit)


def test_an_unknown_track_can_be_dropped_by_hand() -> None:
    dropped = _edited(_show(), edit="remove_track", parameter="smoke/density")
    assert dropped.unknown_parameters == ()


FAULTY: dict[str, Any] = {
    "version": 1,
    "tracks": [
        {"parameter": "camera/fov", "keyframes": [{"time": 0, "value": 9}, {"key": "b", "time": "x"}]},
        {"parameter": "camera/roll", "keyframes": [{"time": 0, "value": 0}], "muted": 1},
    ],
}


def test_all_faults_of_a_show_are_told_at_once() -> None:
    with pytest.raises(ShowError) as caught:
        Show.from_document(FAULTY, REGISTRY)
    told = [(error.track, error.key, error.field) for error in (caught.value, *caught.value.others)]
    assert told == [
        ("camera/fov", "k1", "value"),
        ("camera/fov", "b", "time"),
        ("camera/fov", "b", "value"),
        ("camera/roll", None, "muted"),
    ]


def test_of_many_faults_twenty_are_told() -> None:
    keyframes = [{"time": n, "value": "loud"} for n in range(1000)]
    with pytest.raises(ShowError) as caught:
        Show.from_document(_with_track(keyframes=keyframes), REGISTRY)
    assert 1 + len(caught.value.others) == MAX_FAULTS == 20


def test_a_muted_track_has_no_effect() -> None:
    muted = Track("camera/fov", (EasedKeyframe(0.0, 0.3, "k1"),), muted=True)
    values, _ = Show((muted,)).plan(REGISTRY).evaluate(np.zeros(1))
    np.testing.assert_array_equal(values[0], REGISTRY.defaults())


def test_a_show_without_tracks_is_the_resting_state() -> None:
    values, cuts = Show().plan(REGISTRY).evaluate(np.arange(60) / 60.0)
    np.testing.assert_array_equal(values, np.tile(REGISTRY.defaults(), (60, 1)))
    assert not cuts.any()


def test_a_package_brings_an_interpolation(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "smoother.py").write_text(
        "from reina.curves import Keyframe\n"
        "class SmootherstepKeyframe(Keyframe):\n"
        "    '''Smoother than smooth.'''\n"
        "    def eval(self, previous, t):\n"
        "        u = self.fraction(previous, t)\n"
        "        return previous.value + (self.value - previous.value) * (u**3 * (u * (6 * u - 15) + 10))\n",
        encoding="utf-8",
    )
    metadata = tmp_path / "smoother-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text(
        "Metadata-Version: 2.1\nName: smoother\nVersion: 1.0\n", encoding="utf-8"
    )
    points = metadata / "entry_points.txt"
    points.write_text(
        "[reina.interpolations]\nsmootherstep = smoother:SmootherstepKeyframe\n", encoding="utf-8"
    )
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    importlib.invalidate_caches()
    interpolations.cache_clear()
    assert "smootherstep" in interpolations()
    show = Show.from_document(
        _document(
            tracks=[
                {
                    "parameter": "blocks/color",
                    "color_space": "linear",
                    "keyframes": [
                        {"time": 0, "value": [0, 0, 0]},
                        {"time": 1, "value": [1, 1, 1], "interpolation": "smootherstep"},
                    ],
                }
            ]
        ),
        REGISTRY,
    )
    values, _ = show.plan(REGISTRY).evaluate(np.array([0.25, 0.5]))
    offset = REGISTRY.layout()["blocks/color"][0]
    np.testing.assert_allclose(values[:, offset], [0.103515625, 0.5], atol=1e-12)
    described = next(e for e in REGISTRY.describe()["interpolations"] if e["name"] == "smootherstep")
    assert described["documentation"] == "Smoother than smooth."
    for target, message in (("smoother:missing", "cannot be loaded"), ("smoother:__name__", "no subclass")):
        points.write_text(f"[reina.interpolations]\nbroken = {target}\n", encoding="utf-8")
        with pytest.raises(InterpolationError, match=message):
            discover_interpolations()
    points.write_text("[reina.interpolations]\nlinear = smoother:SmootherstepKeyframe\n", encoding="utf-8")
    with pytest.raises(InterpolationError, match="there already"):
        discover_interpolations()
    points.unlink()
    interpolations.cache_clear()
    assert "smootherstep" not in interpolations()


def test_beats_and_bars_follow_the_time_map() -> None:
    # 120 beats a minute for four beats, then 60; bars of four beats, then of three.
    time_map = TimeMap(
        beats=lambda seconds: np.where(seconds < 2.0, seconds * 2.0, seconds + 2.0),
        seconds=lambda beats: np.where(beats < 4.0, beats / 2.0, beats - 2.0),
        bar_lines_beats=np.array([0.0, 4.0, 8.0, 11.0]),
    )
    seconds = np.array([0.0, 1.0, 2.0, 6.0, 7.5, 9.0, 12.0])
    np.testing.assert_allclose(time_map.from_seconds(seconds, "bars"), [0, 0.5, 1, 2, 2.5, 3, 4])
    for unit in ("seconds", "beats", "bars"):
        np.testing.assert_allclose(time_map.to_seconds(time_map.from_seconds(seconds, unit), unit), seconds)
    keyframes = (EasedKeyframe(0.0, 0.2, "k1"), EasedKeyframe(2.0, 0.6, "k2"))
    show = Show((Track("camera/fov", keyframes, time="bars"),), time="bars")
    values, _ = show.plan(REGISTRY, time_map).evaluate(np.array([1.0, 2.0, 4.0, 6.0]))
    offset = REGISTRY.layout()["camera/fov"][0]
    np.testing.assert_allclose(values[:, offset], [0.3, 0.4, 0.5, 0.6])


def test_bar_lines_must_increase() -> None:
    with pytest.raises(ValueError, match="increasing"):
        TimeMap(beats=lambda s: s, seconds=lambda b: b, bar_lines_beats=np.array([0.0, 4.0, 4.0]))
