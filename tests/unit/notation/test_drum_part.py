"""Drummers' hits on paper."""

from __future__ import annotations

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.unit.notation.drum_tabs import Hit, drum_score, tab, written

from reina.notation.drums import PLACES, place_of, write_drums


def test_a_rock_beat_has_hands_above_and_feet_below() -> None:
    assert written(
        tab(
            {
                "hi_hat R": "x-x-x-x-x-x-x-o-",
                "snare L": "----X--g-g--X---",
                "kick k": "x-----x-x-x-----",
            }
        )
    ) == [
        "e_0[G5xR] e_0[G5xR] e_1[C5>L+G5xR] s_1[G5xR] s_1[(C5)L] s_2[G5xR] s_2[(C5)L] e_2[G5xR] "
        "e_3[C5>L+G5xR] e_3[G5xoR] / q[F4] re e[F4] e_0[F4] e_0[F4] rq"
    ]


def test_every_piece_has_its_place_head_and_sign() -> None:
    hits = {
        "snare L": "x", "snare L rim": "-r", "snare R": "--R", "tom_high R": "---x", "tom_mid R": "----x",
        "tom_floor R": "-----x", "ride R bow": "------x", "ride R bell": "-------x", "hi_hat R": "--------O",
        "crash_left L": "---------c", "crash_right R": "----------x", "china R": "-----------x",
        "splash L": "------------x", "cowbell R": "-------------x",
    }  # fmt: skip
    (bar,) = written(tab(hits, step=0.25))
    heads = [word.split("[")[1].rstrip("]") for word in bar.split(" / ")[0].split() if "[" in word]
    assert heads == [
        "C5L", "C5xL", "C5/R", "E5R", "D5R", "A4R", "F5xR", "F5^R", "G5xøR", "A5x!L", "B5xR", "D6@R",
        "C6^L", "E5vR",
    ]  # fmt: skip


def test_feet_alone_stand_alone_and_their_hi_hat_below_the_staff() -> None:
    assert written(tab({"kick k": "x---x---x---x---", "hi_hat p": "----x-------x---"})) == [
        " / q[F4] q[D4x+F4] q[F4] q[D4x+F4]"
    ]


def test_a_hit_lasts_until_the_next_or_the_end_of_its_beat_and_is_never_tied() -> None:
    assert written(tab({"snare R": "x---x----x----x-"})) == [
        "q[C5R] q[C5R] rs e.[C5R] re e[C5R] / ",
    ]
    # Seven eighths of a beat are no value: what is left over is a rest.
    assert written(tab({"snare R": "-x------"}, step=0.125)) == ["rt s.[C5R] re rq rh / "]


def test_triplets_hold_for_the_voice_that_has_them() -> None:
    assert written(tab({"snare R": "x-xx", "snare L": "-x--", "kick k": "x---"}, step=1 / 3)) == [
        "e3_0[C5R] e3_0[C5L] e3_0[C5R] q[C5R] rh / q[F4] rq rh"
    ]


def test_metres_and_pickups() -> None:
    six = tab({"hi_hat R": "x-x-x-x-x-x-", "snare L": "------x-----", "kick k": "x-----------"})
    assert written(six, metre=(6, 8)) == [
        "e_0[G5xR] e_0[G5xR] e_0[G5xR] e_1[C5L+G5xR] e_1[G5xR] e_1[G5xR] / q.[F4] rq."
    ]
    pickup = written(tab({"snare R": "x-x-x---"}, step=0.5), pickup=1.0)
    assert pickup == ["q[C5R] / ", "q[C5R] q[C5R] rh / "]


def test_a_voice_that_rests_in_a_bar_is_left_out_and_a_silent_bar_is_one_rest() -> None:
    beat = {"snare R": "x---x---x---x---" + 32 * "-" + "x---", "kick k": "x" + 47 * "-" + "x"}
    bars = written(tab(beat))
    assert bars[1:3] == ["rW / "] * 2
    assert [bar.split(" / ")[1] for bar in bars] == ["q[F4] rq rh", "", "", "q[F4] rq rh"]


def test_flams_and_drags_are_grace_notes() -> None:
    main = Hit(0.5, 1.0, "snare", "centre", "right_hand")
    flam = Hit(0.47, 0.94, "snare", "centre", "left_hand", technique="flam_grace")
    assert written([flam, main]) == ["rq q[gC5LC5R] rh / "]
    drag = [Hit(at, 2 * at, "snare", "centre", "left_hand", technique="drag_grace") for at in (0.42, 0.46)]
    assert written([*drag, main]) == ["rq q[gC5LgC5LC5R] rh / "]


def test_a_grace_note_belongs_to_the_next_hit_on_its_piece() -> None:
    flam = Hit(0.47, 0.94, "tom_floor", "centre", "left_hand", technique="flam_grace")
    both = [
        Hit(0.5, 1.0, "kick", "centre", "right_foot"), Hit(0.5, 1.0, "tom_floor", "centre", "right_hand"),
    ]  # fmt: skip
    assert written([flam, *both]) == ["rq q[gA4LA4R] rh / rq q[F4] rh"]


def test_hits_of_two_limbs_that_are_played_nearly_together_stand_together() -> None:
    hits = [
        Hit(0.0, 0.0, "kick", "centre", "right_foot"), Hit(0.012, 0.024, "hi_hat", "bow", "right_hand"),
        Hit(0.02, 0.04, "snare", "centre", "left_hand"), Hit(0.5, 1.0, "hi_hat", "bow", "right_hand"),
    ]  # fmt: skip
    assert written(hits) == ["q[C5L+G5xR] q[G5xR] rh / q[F4] rq rh"]


def test_what_people_play_is_written_as_it_was_meant() -> None:
    rows = {
        "hi_hat R": "x-x-x-x-x-x-x-x-" * 4,
        "snare L": "----x-------x---" * 4,
        "kick k": "x-----x-x-------" * 4,
    }
    rng = random.Random(5)
    exact = tab(rows)
    played = [
        Hit(hit.onset_s + late, hit.onset_beats + 2 * late, hit.piece, hit.zone, hit.limb)
        for hit in exact
        for late in [rng.gauss(0.0, 0.008)]
    ]
    assert written(played) == written(exact)


def test_swung_hats_are_written_even() -> None:
    swung: list[Hit] = []
    for beat in range(16):
        for off, limb in ((0.0, "right_hand"), (0.66, "right_hand")):
            at = beat + off
            swung.append(Hit(at / 2, at, "ride", "bow", limb))
    part = write_drums(drum_score(), swung)
    assert part.swing
    assert {entry.value.fraction for measure in part.measures for entry in measure.hands} == {8}


def test_no_hits_are_a_bar_of_rest() -> None:
    assert written([]) == ["rW / "]


PIECES = [
    (piece, limb)
    for piece in PLACES
    for limb in (["right_foot"] if piece == "kick" else ["right_hand", "left_hand"])
]


@settings(max_examples=150, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.integers(0, 400),
            st.sampled_from([*PIECES, ("hi_hat", "left_foot")]),
            st.sampled_from([None, "ghost", "accent", "flam_grace", "open"]),
        ),
        max_size=60,
    ),
    st.sampled_from([(4, 4), (3, 4), (6, 8), (7, 8), (2, 2)]),
)
def test_bars_are_full_in_each_voice_and_no_plain_hit_is_lost(
    chosen: list[tuple[int, tuple[str, str], str | None]], metre: tuple[int, int]
) -> None:
    hits = [
        Hit(at * 0.037, at * 0.074, piece, "centre", limb, technique=technique)
        for at, (piece, limb), technique in chosen
    ]
    part = write_drums(drum_score(metre=metre, beats=40), hits)
    seen: list[int] = []
    for measure in part.measures:
        assert measure.hands or measure.feet
        for voice in (measure.hands, measure.feet):
            at = 0
            for entry in voice:
                assert entry.begin == at
                at += entry.ticks
                seen += [stroke.hit for stroke in (*entry.graces, *entry.strokes)]
                assert all(stroke.place == place_of(hits[stroke.hit]) for stroke in entry.strokes)
            assert at in (0, measure.bar.shape.ticks)
    assert len(seen) == len(set(seen))
    assert {number for number, hit in enumerate(hits) if hit.technique != "flam_grace"} <= set(seen)


@pytest.mark.parametrize("step", [0.5, 0.25, 1 / 3, 1 / 6])
def test_single_strokes_alternate_in_one_row(step: float) -> None:
    right = "x-" * 12
    left = "-x" * 12
    bars = written(tab({"snare R": right, "snare L": left}, step=step))
    heads = [word.split("[")[1] for bar in bars for word in bar.split() if "[" in word]
    assert heads == ["C5R]", "C5L]"] * 12
