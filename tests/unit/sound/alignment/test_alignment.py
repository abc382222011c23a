"""The map between a score's time and a recording's, and what a person puts right in it."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.sound.alignment import (
    Alignment,
    AlignmentError,
    Anchor,
    Gap,
    MapPoint,
    read_alignment,
    write_alignment,
)

SONG_S = 100.0


def a_map(*pairs: tuple[float, float], gaps: Sequence[Gap] = ()) -> Alignment:
    points = tuple(MapPoint(score_s, song_s, 0.8) for score_s, song_s in pairs)
    return Alignment(points, score_duration_s=pairs[-1][0], song_duration_s=SONG_S, gaps=tuple(gaps))


FOUND = a_map((0, 3), (10, 14), (20, 22), (30, 34))
CUT = a_map((0, 0), (10, 10), (22, 10), (30, 18), gaps=[Gap(10, 22, 10, 10)])
REPEATED = a_map((0, 0), (10, 10), (10, 18), (30, 38), gaps=[Gap(10, 10, 10, 18)])


@st.composite
def maps(draw: st.DrawFn) -> Alignment:
    """Maps with stretches, cuts and repeats."""
    count = draw(st.integers(2, 12))
    steps = st.lists(st.floats(0, 4), min_size=count, max_size=count)
    score_s, song_s = np.cumsum(draw(steps)), np.cumsum(draw(steps))
    pairs = list(zip(score_s.tolist(), song_s.tolist(), strict=True))
    return a_map(*pairs, (pairs[-1][0] + 1, pairs[-1][1] + 1))


@st.composite
def anchored(draw: st.DrawFn) -> Alignment:
    """Maps in which a person has put some places elsewhere."""
    found = draw(maps())
    count = draw(st.integers(0, 4))
    steps = st.lists(st.floats(0.01, 9), min_size=count, max_size=count)
    places, put = np.cumsum(draw(steps)), np.cumsum(draw(steps))
    return found.with_anchors([Anchor(*pair) for pair in zip(places.tolist(), put.tolist(), strict=True)])


@given(anchored(), st.lists(st.floats(-10, 80), min_size=2, max_size=20))
def test_neither_direction_runs_backwards(alignment: Alignment, places: list[float]):
    at = np.sort(places)
    assert np.all(np.diff(alignment.song_times(at)) >= -1e-9)
    assert np.all(np.diff(alignment.score_times(at)) >= -1e-9)


@given(anchored())
def test_anchors_are_where_they_were_put(alignment: Alignment):
    for anchor in alignment.anchors:
        assert alignment.song_times(anchor.score_s) == pytest.approx(anchor.song_s, abs=1e-6)


@given(st.lists(st.tuples(st.floats(0.1, 4), st.floats(0.1, 4)), min_size=2, max_size=12), st.floats(-5, 40))
def test_each_direction_undoes_the_other(steps: list[tuple[float, float]], place: float):
    pairs = np.cumsum(steps, axis=0)
    alignment = a_map(*((float(a), float(b)) for a, b in pairs))
    assert alignment.score_times(alignment.song_times(place)) == pytest.approx(place, abs=1e-6)


@given(anchored())
def test_a_document_holds_all_of_it(alignment: Alignment):
    again = read_alignment(write_alignment(alignment))
    at = np.linspace(-2, 50, 60)
    # Times are written to a tenth of a millisecond; where something is left out, an edge may lie on either
    # side.
    edges = np.array([point.score_s for point in alignment.points])
    at = at[np.abs(at[:, None] - edges).min(axis=1) > 1e-3]
    steep = np.diff(edges, prepend=-1) > 0.01
    if steep.all():
        assert again.song_times(at) == pytest.approx(alignment.song_times(at), abs=0.1)
    assert again.anchors == alignment.anchors
    assert len(again.points) == len(alignment.points)


def test_rounding_does_not_leave_the_recording():
    end_s = 10.00006
    points = (MapPoint(0, 0, 1), MapPoint(10, end_s, 1))
    again = read_alignment(write_alignment(Alignment(points, score_duration_s=10, song_duration_s=end_s)))
    assert again.points[-1].song_s == end_s


def test_between_points_and_beyond_them():
    assert FOUND.song_times([5, 15, 25]) == pytest.approx([8.5, 18, 28])
    assert FOUND.song_times(-1) == 2
    assert FOUND.song_times(31) == 35
    assert FOUND.score_times(8.5) == 5
    assert (FOUND.begins_s, FOUND.ends_s) == (3, 34)


def test_what_the_recording_leaves_out_is_not_heard():
    assert CUT.is_heard([9.9, 10, 15, 21.9, 22, 29]).tolist() == [True, False, False, False, True, True]
    assert CUT.song_times(22) == 10
    assert CUT.score_times([9.99, 10, 10.5]) == pytest.approx([9.99, 22, 22.5])
    assert CUT.confidence_at([5, 15]).tolist() == [0.8, 0]


def test_what_the_score_does_not_have_is_passed_over():
    assert REPEATED.is_heard([9, 10, 11]).all()
    assert REPEATED.song_times([9.99, 10]) == pytest.approx([9.99, 18])
    assert REPEATED.score_times([12, 17]) == pytest.approx([10, 10])


def test_one_anchor_moves_everything():
    moved = FOUND.with_anchors([Anchor(10, 15)])
    assert moved.song_times([0, 10, 25]) == pytest.approx([4, 15, 29])


def test_between_two_anchors_the_found_tempo_keeps_its_shape():
    moved = FOUND.with_anchors([Anchor(20, 30), Anchor(0, 2)])
    # Found, 11 of 19 seconds lie before score time 10.
    assert moved.song_times(10) == pytest.approx(2 + 28 * 11 / 19)
    assert moved.song_times(30) == pytest.approx(42)


def test_an_anchor_in_what_was_thought_left_out_has_it_heard():
    mended = CUT.with_anchors([Anchor(10, 10), Anchor(16, 13), Anchor(22, 16)])
    assert mended.song_times([13, 19, 22]) == pytest.approx([11.5, 14.5, 16])
    assert mended.is_heard([15]).all()


def test_the_offset_moves_anchors_too():
    moved = FOUND.with_anchors([Anchor(10, 15)]).with_offset(-0.02)
    assert moved.song_times([0, 10]) == pytest.approx([3.98, 14.98])


def test_the_identity():
    both = Alignment.identity(30, 20, is_same_music=False)
    assert both.song_times([0, 5, 19]) == pytest.approx([0, 5, 19])
    assert both.confidence == 0
    assert both.is_heard([19.9, 20.1]).tolist() == [True, False]


@pytest.mark.parametrize(
    ("make", "location", "says"),
    [
        (lambda: a_map((0, 3), (10, 2), (20, 5)), "points/1/song_s", "run backwards"),
        (lambda: a_map((5, 3), (4, 4), (20, 5)), "points/1/score_s", "run backwards"),
        (lambda: a_map((0, 3), (10, 101)), "points/1/song_s", "100.000 s"),
        (lambda: a_map((1, 3)), "points", "two points"),
        (lambda: a_map((1, 3), (1, 4)), "points", "one place"),
        (lambda: FOUND.with_anchors([Anchor(5, 20), Anchor(9, 19)]), "anchors/1/song_s", "20.000 s"),
        (lambda: FOUND.with_anchors([Anchor(5, 20), Anchor(5, 21)]), "anchors/1/score_s", "already"),
        (lambda: FOUND.with_anchors([Anchor(5, -1)]), "anchors/0/song_s", "within the song"),
        (lambda: FOUND.with_offset(101), "offset_s", "out of the song"),
    ],
)
def test_what_cannot_be_is_refused_with_its_place(make: object, location: str, says: str):
    assert callable(make)
    with pytest.raises(AlignmentError, match=says) as refused:
        make()
    assert refused.value.location == location


@pytest.mark.parametrize(
    ("text", "location", "says"),
    [
        (b"{", None, "no JSON"),
        (b"[]", None, "object"),
        (b'{"points":[]}', "score_duration_s", "missing"),
        (
            b'{"points":[{"score_s":0}],"score_duration_s":1,"song_duration_s":1}',
            "points/0/song_s",
            "missing",
        ),
        (b'{"points":[],"score_duration_s":1,"song_duration_s":0}', "song_duration_s", "0"),
        (b'{"points":[],"score_duration_s":1,"song_duration_s":1,"ofset_s":1}', "ofset_s", "no such field"),
        (b'{"version":2,"points":[],"score_duration_s":1,"song_duration_s":1}', "version", "version 1"),
        (b'{"points":[],"score_duration_s":1,"song_duration_s":1}', "points", "two points"),
    ],
)
def test_what_is_no_document_is_refused_with_its_place(text: bytes, location: str | None, says: str):
    with pytest.raises(AlignmentError, match=says) as refused:
        read_alignment(text)
    assert refused.value.location == location


def test_what_is_in_time_already_moves_nothing_until_a_person_does():
    points = (MapPoint(0.0, 0.0, 1.0), MapPoint(4.0, 4.0, 1.0))
    in_time = Alignment(points, score_duration_s=9.0, song_duration_s=4.0)
    assert not in_time.moves
    assert replace(in_time, offset_s=0.5).moves
    assert replace(in_time, points=(points[0], MapPoint(4.0, 3.9, 1.0))).moves
