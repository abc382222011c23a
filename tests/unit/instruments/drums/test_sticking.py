"""Hands: charts as drummers write them, rudiments at three tempi, and what no hand can do."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.instruments.drums.charted import Chart, charts

from reina.instruments.drums.hit import PIECES
from reina.instruments.drums.sticking.habits import HIGHEST_RATE
from reina.instruments.drums.sticking.hands import Hands, choose_hands
from reina.instruments.drums.sticking.struck import Struck

CHARTS = charts()
SNARE = PIECES.index("snare")
ASIDE = np.zeros(0)

AGREEMENT = 0.97
"""The part of a bed of charts that has to come out with the hands that are written."""

RUDIMENTS = (
    "single_strokes", "double_strokes", "triple_strokes", "paradiddle_60", "paradiddle_120", "paradiddle_200",
    "double_paradiddle", "paradiddle_diddle", "six_stroke_roll", "five_stroke_roll",
)  # fmt: skip


def chosen(chart: Chart) -> str:
    return "".join("RL-"[hand] for hand in choose_hands(chart.struck, chart.kick_s).hand.tolist())


def snare(at: list[float], velocity: list[float], beat_s: float = 0.5) -> Hands:
    onset_s = np.array(at)
    struck = Struck(
        onset_s=onset_s,
        beat=np.mod(onset_s / beat_s, 4.0),
        piece=np.full(len(at), SNARE, dtype=np.int64),
        velocity=np.array(velocity),
        is_cross_stick=np.zeros(len(at), dtype=np.bool_),
    )
    return choose_hands(struck, ASIDE)


def letters(hands: Hands) -> str:
    return "".join("RL-"[hand] for hand in hands.hand.tolist())


def test_a_bed_of_charts_comes_out_as_drummers_write_them() -> None:
    assert len(CHARTS) >= 30
    right = total = 0
    for chart in CHARTS.values():
        got = chosen(chart)
        total += len(got)
        right += sum(one == other for one, other in zip(got, chart.hands, strict=True))
    assert right / total >= AGREEMENT, f"{right} of {total}"


@pytest.mark.parametrize("name", [name for name in CHARTS if name.startswith(RUDIMENTS)])
def test_rudiments_come_out_exactly(name: str) -> None:
    assert chosen(CHARTS[name]) == CHARTS[name].hands


@pytest.mark.parametrize("tempo", [60, 120, 180])
def test_flams_alternate_and_their_grace_notes_are_the_other_hands(tempo: int) -> None:
    beat_s = 60.0 / tempo
    at = [time for k in range(8) for time in (k * beat_s, k * beat_s + 0.03)]
    hands = snare(at, [0.35, 0.8] * 8, beat_s)
    assert letters(hands) == "LRRL" * 4
    assert (hands.graces.main[::2] == np.arange(1, 16, 2)).all()
    assert "grace note of a flam" in hands.reasons[0]


@pytest.mark.parametrize("tempo", [60, 120, 180])
def test_drags_alternate_and_have_two_grace_notes_of_the_other_hand(tempo: int) -> None:
    beat_s = 60.0 / tempo
    at = [k * beat_s + late for k in range(8) for late in (0.0, 0.04, 0.08)]
    hands = snare(at, [0.3, 0.3, 0.8] * 8, beat_s)
    assert letters(hands) == "LLRRRL" * 4
    assert (hands.graces.drag.reshape(-1, 3) == [1, 1, 0]).all()


def test_softer_notes_at_an_even_gap_are_no_grace_notes() -> None:
    at = [k * 0.06 for k in range(16)]
    hands = snare(at, [0.4, 0.8] * 8)
    assert (hands.graces.main == -1).all()


def test_the_second_of_a_double_says_why() -> None:
    hands = snare([k / 24.0 for k in range(24)], [0.6] * 24)
    assert letters(hands) == "RRLL" * 6
    assert "24 a second is too fast for single strokes" in hands.reasons[1]


def test_of_three_pieces_at_once_the_softest_is_not_played() -> None:
    struck = Struck(
        onset_s=np.zeros(3),
        beat=np.zeros(3),
        piece=np.array([PIECES.index(name) for name in ("snare", "hi_hat", "crash_right")]),
        velocity=np.array([0.8, 0.4, 0.9]),
        is_cross_stick=np.zeros(3, dtype=np.bool_),
    )
    hands = choose_hands(struck, ASIDE)
    assert hands.hand.tolist() == [1, -1, 0]
    assert "both hands are taken" in hands.reasons[1]


def test_a_hand_that_cannot_get_there_is_not_sent() -> None:
    # Both hands on the hi-hat's side, then both at the other end of the kit 30 ms later.
    names = ("snare", "hi_hat", "tom_floor", "ride")
    struck = Struck(
        onset_s=np.array([0.0, 0.0, 0.03, 0.03]),
        beat=np.zeros(4),
        piece=np.array([PIECES.index(name) for name in names]),
        velocity=np.array([0.8, 0.8, 0.4, 0.4]),
        is_cross_stick=np.zeros(4, dtype=np.bool_),
    )
    hands = choose_hands(struck, ASIDE)
    assert sorted(hands.hand[:2].tolist()) == [0, 1]
    assert hands.hand[2:].tolist() == [-1, -1]
    assert all("no hand gets from" in reason for reason in hands.reasons[2:])


@given(
    gaps=st.lists(st.floats(0.01, 0.6), min_size=1, max_size=40),
    seed=st.integers(0, 2**32 - 1),
)
def test_no_hand_is_faster_than_a_hand_can_be(gaps: list[float], seed: int) -> None:
    chance = np.random.default_rng(seed)
    onset_s = np.cumsum(gaps)
    count = len(gaps)
    pieces = [place for place, piece in enumerate(PIECES) if piece != "kick"]
    struck = Struck(
        onset_s=onset_s,
        beat=np.mod(2.0 * onset_s, 4.0),
        piece=chance.choice(pieces, count),
        velocity=chance.uniform(0.1, 1.0, count),
        is_cross_stick=np.zeros(count, dtype=np.bool_),
    )
    hands = choose_hands(struck, ASIDE)
    assert all(hands.reasons)
    for side in (0, 1):
        own = np.flatnonzero((hands.hand == side) & (hands.graces.main < 0))
        between = np.diff(onset_s[own])
        quick = np.flatnonzero(between < 1.0 / HIGHEST_RATE - 1e-9)
        # Only the second of a double is nearer, on one piece, and no third follows.
        assert (struck.piece[own[quick]] == struck.piece[own[quick + 1]]).all()
        assert (np.diff(quick) > 1).all()


@pytest.mark.parametrize("name", ["rock_eighths", "train_beat", "round_the_toms", "swing_comping"])
def test_a_chart_twice_as_long_has_the_same_hands_at_its_beginning(name: str) -> None:
    chart = CHARTS[name]
    half = len(chart.struck) // 2
    first = choose_hands(chart.struck.take(np.arange(len(chart.struck)) < half), chart.kick_s)
    assert (
        first.hand[: half - 4].tolist() == choose_hands(chart.struck, chart.kick_s).hand[: half - 4].tolist()
    )
