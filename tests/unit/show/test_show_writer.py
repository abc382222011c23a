"""Tracks as text: where their keyframes are in it, and what travels with them."""

from __future__ import annotations

import json
import pickle
from dataclasses import replace

from reina.curves.eased_keyframe import BackKeyframe, EasedKeyframe
from reina.show import Track
from reina.show.show_writer import keyframe_text, track_document, write_with, written_track

TRACK = Track(
    "camera/fov",
    (EasedKeyframe(0.0, 40, "ä"), BackKeyframe(1.5, 50.25, "k2", overshoot=2.0), EasedKeyframe(2.0, 1, "k3")),
)


def test_the_text_is_the_document_and_knows_where_each_keyframe_is() -> None:
    written = written_track(TRACK, "bars")
    assert json.loads(written.text) == track_document(TRACK, "bars")
    assert written.keyframes() == [keyframe_text(keyframe) for keyframe in TRACK.keyframes]
    empty = written_track(replace(TRACK, keyframes=()), "bars")
    assert (json.loads(empty.text)["keyframes"], empty.keyframes()) == ([], [])


def test_what_is_known_of_keyframes_is_not_written_again() -> None:
    known = {id(TRACK.keyframes[1]): b'{"known":true}'}
    assert json.loads(written_track(TRACK, "seconds", known).text)["keyframes"][1] == {"known": True}


def test_the_text_travels_with_the_track_until_it_is_taken() -> None:
    track = replace(TRACK)
    write_with(track, "seconds")
    again: Track = pickle.loads(pickle.dumps(track, protocol=5))
    assert again == track
    assert [type(keyframe) for keyframe in again.keyframes] == [type(each) for each in TRACK.keyframes]
    brought = vars(again)["_written"]
    assert written_track(again, "seconds") is brought
    # In another unit it says more; and a state of the history holds no text.
    assert "_written" not in vars(again)
    write_with(track, "seconds")
    assert json.loads(written_track(track, "bars").text)["time"] == "seconds"


def test_keyframes_have_no_dictionary() -> None:
    """A show of 480,000 would take a third more."""
    assert not any(hasattr(keyframe, "__dict__") for keyframe in TRACK.keyframes)
