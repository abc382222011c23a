"""A show's text, its validators, and its history."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.curves import Keyframe
from reina.sessions import show_revision
from reina.sessions.show_revision import REFERENCE_BYTES, STEP_BYTES, ShowRevision, changed_paths
from reina.sessions.show_text import NO_TRACK_ETAG, ShowText
from reina.show import Show, Track
from reina.stage import stage_registry

REGISTRY = stage_registry()
LIGHT, FOV = "lights/key/intensity", "camera/fov"


def track(path: str, *values: float, **fields: Any) -> Track:
    """A track with a keyframe a second."""
    keyframes = tuple(Keyframe(float(n), value, f"k{n}") for n, value in enumerate(values))
    return Track(path, keyframes, **fields)


def edited(kept: ShowRevision, show: Show) -> ShowRevision:
    return kept.then(lambda history: history.then(show))


def undone(kept: ShowRevision) -> ShowRevision:
    return kept.then(lambda history: history.undone())


def redone(kept: ShowRevision) -> ShowRevision:
    return kept.then(lambda history: history.redone())


@pytest.mark.parametrize(
    "show",
    [
        Show(),
        Show(title="Abend“\n", description="…", schema="https://example.org/s.json"),
        Show((track(LIGHT, 1.0, 2.0), track(FOV, 0.5, time="beats")), time="bars"),
        Show.from_document({"version": 1, "tracks": [{"parameter": "no/such", "ö": [1, None]}]}, REGISTRY),
    ],
    ids=["empty", "words", "two tracks", "unknown track"],
)
def test_the_text_reads_as_the_same_show(show: Show) -> None:
    text = ShowText.of(show)
    assert json.loads(text.text()) == show.to_document()
    again = Show.from_document(json.loads(text.text()), REGISTRY)
    assert again == show
    assert ShowText.of(again).etag == text.etag, "a validator outlives the server"


def test_validators_change_with_what_they_stand_for_and_nothing_else() -> None:
    light, fov = track(LIGHT, 1.0), track(FOV, 0.5)
    before = ShowText.of(Show((light, fov), title="A"))
    after = ShowText.of(Show((light, track(FOV, 0.6)), title="A"), before)
    renamed = ShowText.of(Show((light, fov), title="B"), before)
    assert len({before.etag, after.etag, renamed.etag}) == 3
    assert after.track_etag(LIGHT) == before.track_etag(LIGHT) != after.track_etag(FOV)
    assert after.track_etag(FOV) != before.track_etag(FOV)
    assert before.track_etag("camera/roll") == NO_TRACK_ETAG
    assert ShowText.of(Show((fov, light), title="A")).etag != before.etag, "the order is the person's"


def test_tracks_that_did_not_change_are_not_written_again() -> None:
    light = track(LIGHT, 1.0)
    before = ShowText.of(Show((light,), time="bars"))
    after = ShowText.of(Show((light, track(FOV, 0.5)), time="bars"), before)
    assert after.tracks[LIGHT] is before.tracks[LIGHT]
    # A track's own unit is only written where it is not the show's.
    other_unit = ShowText.of(Show((light,), time="seconds"), after)
    assert other_unit.tracks[LIGHT] is not before.tracks[LIGHT]


@given(st.lists(st.sampled_from(["edit", "undo", "redo"]), max_size=30))
def test_undo_and_redo_walk_through_the_edits(steps: list[str]) -> None:
    kept = ShowRevision.begin(Show((track(LIGHT, 0.0),)))
    past: list[Show] = []
    future: list[Show] = []
    for number, step in enumerate(steps, start=1):
        before = kept.show
        if step == "edit":
            kept, past, future = edited(kept, Show((track(LIGHT, float(number)),))), [*past, before], []
            assert kept.show.track(LIGHT).keyframes[0].value == number
        elif step == "undo":
            kept = undone(kept)
            if past:
                assert kept.show is past.pop()
                future.append(before)
        else:
            kept = redone(kept)
            if future:
                assert kept.show is future.pop()
                past.append(before)
        assert (kept.state.undo, kept.state.redo) == (len(past), len(future))
        assert kept.state.etag == ShowText.of(kept.show).etag


def test_what_changes_nothing_is_no_step() -> None:
    kept = ShowRevision.begin(Show((track(LIGHT, 1.0),)))
    assert edited(kept, Show((track(LIGHT, 1.0),))) is kept
    assert undone(kept) is kept
    assert redone(kept) is kept
    assert edited(kept, Show()).revision == kept.revision + 1


def test_the_history_is_bounded_by_steps_and_by_what_it_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    kept = ShowRevision.begin(Show())
    for number in range(300):
        kept = edited(kept, Show((track(LIGHT, float(number)),)))
    assert kept.state.undo == kept.history.longest == 200
    hundred = len(ShowText.of(Show((track(LIGHT, *[1.0] * 100),))).tracks[LIGHT].text)
    monkeypatch.setattr(show_revision, "MAX_BYTES_KEPT", int(2.5 * hundred))
    kept = ShowRevision.begin(Show())
    for number in range(10):
        kept = edited(kept, Show((track(LIGHT, *[float(number)] * 100),)))
    assert kept.state.undo == 2, "two of 100 keyframes each beside the show's own"
    # A track that is shared costs nothing.
    shared = track(LIGHT, *[1.0] * 100)
    kept = ShowRevision.begin(Show((shared,)))
    for number in range(10):
        kept = edited(kept, Show((shared, track(FOV, float(number)))))
    assert kept.state.undo == 10


def test_a_large_track_that_is_edited_key_by_key_keeps_its_past(monkeypatch: pytest.MonkeyPatch) -> None:
    kept = ShowRevision.begin(Show((track(LIGHT, *[1.0] * 1000),)))
    whole = len(kept.text.tracks[LIGHT].text)
    monkeypatch.setattr(show_revision, "MAX_BYTES_KEPT", whole)
    for number in range(100):
        own = kept.show.track(LIGHT)
        changed = (Keyframe(0.0, float(number), "k0"), *own.keyframes[1:])
        kept = edited(kept, Show((replace(own, keyframes=changed),)))
    # A step weighs its keyframe's text, itself, and the references to 1,000.
    assert kept.state.undo == whole // (whole // 1000 + STEP_BYTES + 1000 * REFERENCE_BYTES)
    assert kept.state.undo > 40, "where a whole copy a step would leave one"


@pytest.mark.parametrize(
    "fields",
    [{"tracks": [{"parameter": "no/such", "x": "1" * 1000}]}, {"tracks": [], "description": "1" * 1000}],
    ids=["an unknown track", "a description"],
)
def test_what_is_no_keyframe_weighs_its_text_too(
    monkeypatch: pytest.MonkeyPatch, fields: dict[str, Any]
) -> None:
    monkeypatch.setattr(show_revision, "MAX_BYTES_KEPT", 5000)
    kept = ShowRevision.begin(Show())
    for number in range(20):
        document = json.loads(json.dumps({"version": 1, **fields}).replace("1111", f"{number:04}"))
        kept = edited(kept, Show.from_document(document, REGISTRY))
    assert kept.revision == 20
    assert kept.state.undo == 4


def test_what_was_taken_back_weighs_as_before(monkeypatch: pytest.MonkeyPatch) -> None:
    kept = ShowRevision.begin(Show((track(LIGHT, *[0.0] * 100),)))
    monkeypatch.setattr(show_revision, "MAX_BYTES_KEPT", int(2.5 * len(kept.text.tracks[LIGHT].text)))
    for number in (1.0, 2.0):
        kept = edited(kept, Show((track(LIGHT, *[number] * 100),)))
    for _ in range(2):
        kept = undone(kept)
    assert (kept.state.undo, kept.state.redo) == (0, 2)
    kept = redone(redone(kept))
    assert (kept.state.undo, kept.state.redo) == (2, 0)
    kept = edited(kept, Show((track(LIGHT, *[3.0] * 100),)))
    assert kept.state.undo == 2
    kept = edited(undone(undone(kept)), Show((track(LIGHT, *[4.0] * 100),)))
    assert (kept.state.undo, kept.state.redo) == (1, 0)


def test_the_paths_of_a_change_are_told_when_only_tracks_changed() -> None:
    light, fov = track(LIGHT, 1.0), track(FOV, 0.5)
    both = Show((light, fov))
    assert changed_paths(both, Show((light, track(FOV, 0.6)))) == [FOV]
    assert changed_paths(both, Show((light,))) == [FOV]
    assert changed_paths(Show((light,)), both) == [FOV]
    assert changed_paths(both, Show((track(LIGHT, 2.0), track(FOV, 0.6)))) == [LIGHT, FOV]
    assert changed_paths(both, Show((light, track(FOV, 0.6)), title="Other")) is None
    assert changed_paths(both, Show((fov, light))) is None


def test_some_tracks_are_read_alone() -> None:
    text = ShowText.of(Show((track(LIGHT, 1.0), track(FOV, 0.5)), title="A"))
    some = json.loads(text.text([FOV, "camera/roll", FOV]))
    assert [entry["parameter"] for entry in some["tracks"]] == [FOV]
    assert some["title"] == "A"
    assert json.loads(text.text([]))["tracks"] == []
