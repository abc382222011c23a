import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.music import BarPosition, MetreMap, TimeSignature

signatures = st.lists(
    st.builds(
        TimeSignature,
        st.integers(0, 200).map(lambda eighths: eighths / 2),
        st.integers(1, 13),
        st.sampled_from([2, 4, 8, 16]),
    ),
    max_size=6,
)
pickups = st.sampled_from([0.0, 0.5, 1.0, 3.0])


def test_without_a_signature_bars_have_four_beats():
    assert MetreMap().bar_lines(9).tolist() == [0, 4, 8]
    assert MetreMap().bar_lines(8).tolist() == [0, 4]


def test_a_signature_begins_a_new_bar_even_inside_one():
    metre = MetreMap([TimeSignature(0, 4, 4), TimeSignature(6, 6, 8)])
    assert metre.bar_lines(13).tolist() == [0, 4, 6, 9, 12]


def test_a_pickup_is_bar_0():
    metre = MetreMap([TimeSignature(0, 3, 4)], pickup_beats=1)
    assert metre.bar_lines(8).tolist() == [0, 1, 4, 7]
    assert metre.position(0.5) == BarPosition(0, 0.5)
    assert metre.position(1) == BarPosition(1, 0)
    assert metre.beats(BarPosition(3, 2)) == 9


def test_a_pickup_as_midi_files_write_it():
    metre = MetreMap([TimeSignature(0, 1, 4), TimeSignature(1, 4, 4)])
    assert metre.pickup_beats == 1
    assert metre.bar_lines(10).tolist() == [0, 1, 5, 9]
    assert metre.position(5) == BarPosition(2, 0)
    assert MetreMap([TimeSignature(0, 3, 4), TimeSignature(3, 3, 4)]).pickup_beats == 0
    assert MetreMap([TimeSignature(0, 2, 4), TimeSignature(8, 4, 4)]).pickup_beats == 0


@given(signatures, pickups, st.floats(0, 300))
def test_positions_and_beats_are_inverse(entries: list[TimeSignature], pickup: float, beats: float):
    metre = MetreMap(entries, pickup_beats=pickup)
    position = metre.position(beats)
    assert position.beat >= 0
    assert metre.beats(position) == pytest.approx(beats, abs=1e-9)


@given(signatures, pickups, st.floats(0.1, 300))
def test_bar_lines_grow_and_no_bar_is_longer_than_its_metre(
    entries: list[TimeSignature], pickup: float, until: float
):
    metre = MetreMap(entries, pickup_beats=pickup)
    lines = metre.bar_lines(until)
    assert lines[0] == 0
    assert np.all(np.diff(lines) > 0)
    assert lines[-1] < until
    for line, following in pairwise(lines.tolist()):
        in_force = [s for s in metre.signatures if s.onset_beats <= line][-1]
        assert following - line <= max(in_force.bar_beats, metre.pickup_beats) + 1e-9
    assert abs(metre.bar_count(until) - len(lines)) <= len(metre.signatures) + pickup / 0.25 + 1


@pytest.mark.parametrize(
    "wrong",
    [TimeSignature(-1, 4, 4), TimeSignature(math.inf, 4, 4), TimeSignature(0, 0, 4), TimeSignature(0, 4, 0)],
)
def test_what_is_no_metre_is_refused(wrong: TimeSignature):
    with pytest.raises(ValueError, match=r"metre|signature"):
        MetreMap([wrong])
    with pytest.raises(ValueError, match="pickup"):
        MetreMap(pickup_beats=-1)
    with pytest.raises(ValueError, match="before the first"):
        MetreMap().beats(BarPosition(0, 0))
