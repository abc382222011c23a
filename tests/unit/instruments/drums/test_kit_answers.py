"""What the kit does: cymbals, the hi-hat, heads, pedals and the beater."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.instruments.drums.charted import kit_places
from tests.unit.instruments.drums.scores import drum_score, played

from reina.instruments.drums.drum_part import Choke
from reina.instruments.drums.hit import DrumHit, Limb, Technique
from reina.instruments.drums.motion.drummer_motion import DrummerMotion
from reina.instruments.drums.motion.foot_paths import FootPaths
from reina.instruments.drums.motion.hi_hat_pedal import HALF
from reina.instruments.drums.motion.kit_answers import FARTHEST_RAD, HEADS, SWINGS, KitAnswers
from reina.instruments.drums.motion.ringing import Ringing, Ringings
from reina.rotations.arrays import ArrayLike, FloatArray

FPS = 60.0


def hit(
    at: float,
    piece: str,
    zone: str = "edge",
    limb: Limb = "right_hand",
    velocity: float = 0.8,
    technique: Technique | None = None,
) -> DrumHit:
    return DrumHit(at, at, piece, zone, limb, velocity, technique)


def tilt(hits: list[DrumHit], piece: str, times: ArrayLike, chokes: tuple[Choke, ...] = ()) -> FloatArray:
    frames = KitAnswers(hits, chokes).tilt(np.asarray(times, dtype=np.float64))
    return frames[:, list(SWINGS).index(piece), 0]


def test_a_crash_swings_about_once_a_second_and_settles_within_some() -> None:
    times = np.arange(0.0, 8.0, 0.01)
    swing = tilt([hit(1.0, "crash_left")], "crash_left", times)
    assert not swing[times < 1.0].any()
    assert 0.08 < swing.max() < 0.3
    turns = np.count_nonzero(np.diff(np.sign(swing[(times > 1.0) & (times < 3.0)])))
    assert 4 <= turns <= 6
    assert np.abs(swing[times > 5.0]).max() < 0.02 * swing.max()


def test_a_cymbal_dips_first_where_it_is_struck_the_more_the_louder() -> None:
    soft, loud = (
        tilt([hit(1.0, "crash_right", velocity=velocity)], "crash_right", [1.05])[0]
        for velocity in (0.2, 0.9)
    )
    assert 0.0 < soft < loud


def test_a_ride_moves_less_than_a_crash_and_its_bell_the_least() -> None:
    at = np.arange(1.0, 2.0, 0.01)
    most = [
        np.abs(tilt([hit(1.0, piece, zone)], piece, at)).max()
        for piece, zone in (("crash_left", "edge"), ("ride", "bow"), ("ride", "bell"))
    ]
    assert most[0] > 3 * most[1] > 3 * most[2] > 0.0


def test_a_choked_cymbal_is_still_at_once() -> None:
    ringing, choked = (
        np.abs(tilt([hit(1.0, "crash_left")], "crash_left", np.arange(1.7, 3.0, 0.01), chokes)).max()
        for chokes in ((), (Choke(1.5, "crash_left", "left_hand"),))
    )
    assert choked < 0.02 * ringing


@given(st.lists(st.tuples(st.floats(0.0, 20.0), st.floats(0.0, 1.0)), max_size=30), st.floats(0.0, 25.0))
def test_ringing_is_the_sum_over_all_hits_before(events: list[tuple[float, float]], at: float) -> None:
    events = sorted(events)
    onset, strength = np.array([e[0] for e in events]), np.array([e[1] for e in events])
    ringing = Ringing(onset, strength, frequency_hz=1.3, decay=1.1, most=1e6)
    since = at - onset[onset <= at]
    expected = np.sum(strength[onset <= at] * np.exp(-1.1 * since) * np.sin(2.6 * np.pi * since))
    assert ringing.evaluate(np.array([at]))[0] == pytest.approx(expected, abs=1e-6)


def test_things_ring_together_as_they_do_alone() -> None:
    shared, times = np.array([1.0, 1.4, 2.2]), np.arange(0.0, 4.0, 1.0 / FPS)
    things = [
        Ringing(shared, np.array([0.3, 0.8, 0.5]), frequency_hz=1.3, decay=1.1),
        Ringing(np.zeros(0), np.zeros(0), frequency_hz=1.3, decay=1.1),
        Ringing(shared, np.array([0.2, 0.0, 0.4]), frequency_hz=2.1, decay=0.7),
        Ringing(np.array([0.5]), np.array([0.9]), frequency_hz=0.0, decay=22.0, most=1.3),
    ]
    together = Ringings(things).evaluate(times)
    assert together == pytest.approx(np.stack([thing.evaluate(times) for thing in things]), abs=1e-15)
    assert not together[1].any()
    assert not together[:, times < 0.5].any()
    assert together[3, times >= 0.5][0] > 0.7


def test_no_cymbal_turns_too_far_however_often_it_is_struck() -> None:
    hits = [hit(0.1 * k, "crash_left", velocity=1.0) for k in range(200)]
    assert np.abs(tilt(hits, "crash_left", np.arange(0.0, 25.0, 0.01))).max() <= FARTHEST_RAD


def hat(at: float, technique: Technique, limb: Limb = "right_hand") -> DrumHit:
    return hit(at, "hi_hat", "bow", limb, technique=technique)


def closed(hits: list[DrumHit], *times: float) -> list[float]:
    return KitAnswers(hits).hi_hat(np.array(times)).tolist()


def test_the_hi_hat_is_open_at_open_strokes_and_closed_at_closed_ones() -> None:
    hits = [
        hat(1.0, "closed"),
        hat(1.25, "open"),
        hat(1.5, "closed"),
        hat(2.0, "half_open"),
        hat(2.5, "closed"),
    ]
    assert closed(hits, 1.0, 1.25, 1.5, 2.0, 2.5) == pytest.approx([1.0, 0.0, 1.0, HALF, 1.0])
    assert closed(hits, 1.1)[0] == 1.0


def test_a_chick_lifts_and_closes_at_its_onset_and_a_splash_opens_again() -> None:
    chick, splash = ([hat(1.0, technique, "left_foot")] for technique in ("chick", "splash"))
    assert closed(chick, 0.95)[0] < 0.6
    assert closed(chick, 1.0, 1.3) == pytest.approx([1.0, 1.0])
    assert closed(splash, 1.0, 1.2) == pytest.approx([1.0, 0.0])


def test_nobody_holds_the_hi_hat_open_for_ever() -> None:
    assert closed([hat(1.0, "open")], 1.5, 6.0) == pytest.approx([0.0, 1.0])


def test_heads_give_at_a_hit_and_are_flat_soon_after() -> None:
    heads = KitAnswers([hit(1.0, "snare", "centre")]).evaluate(np.array([0.99, 1.0, 1.3])).heads
    snare = heads[:, HEADS.index("snare")]
    assert snare[0] == 0.0
    assert 0.4 < snare[1] <= 1.0
    assert snare[2] < 0.01
    assert not np.delete(heads, HEADS.index("snare"), axis=1).any()


def kicks(*at: float, velocity: float = 0.8) -> FootPaths:
    hits = [hit(time, "kick", "centre", "right_foot", velocity) for time in at]
    return FootPaths(hits, KitAnswers(hits))


@pytest.mark.parametrize("gap", [1.0, 0.25, 0.15])
def test_the_beater_is_on_the_head_at_the_onset_and_in_the_frame_at_or_before_it(gap: float) -> None:
    at = np.array([1.0 + gap * k for k in range(8)])
    feet = kicks(*at.tolist())
    assert feet.evaluate(at).beater == pytest.approx(1.0)
    assert feet.evaluate(np.floor(at * FPS + 1e-9) / FPS).beater == pytest.approx(1.0)
    assert feet.evaluate(at + 0.5 * gap).beater.max() < 0.9


def test_loud_strokes_lift_the_heel_and_soft_ones_do_not() -> None:
    before = np.arange(0.8, 1.0, 0.01)
    assert kicks(1.0, velocity=1.0).evaluate(before).heel[:, 0].max() > 0.8
    assert kicks(1.0, velocity=0.3).evaluate(before).heel[:, 0].max() == 0.0


def test_an_idle_foot_keeps_the_time() -> None:
    hits = [hit(0.5 * k, "ride", "bow") for k in range(16)]
    feet = FootPaths(hits, KitAnswers(hits), np.arange(0.0, 9.0, 0.5))
    heel = feet.evaluate(np.array([2.0, 2.25, 2.5])).heel
    assert heel[1].min() > 0.2 > heel[0].max() + heel[2].max()


def test_the_whole_motion_of_a_part_of_either_hand() -> None:
    score = drum_score(
        sorted([(0.25 * k, 42) for k in range(8)] + [(0.5, 38), (1.5, 38), (0.0, 36), (1.0, 36)])
    )
    times = np.arange(0.0, 3.0, 1.0 / FPS)
    right, left = (
        DrummerMotion(played(score, side).fingering, kit_places()).evaluate(times)
        for side in ("right", "left")
    )
    assert left.sticks.tip[:, ::-1] * (-1.0, 1.0, 1.0) == pytest.approx(right.sticks.tip, abs=1e-9)
    assert np.array_equal(left.feet.beater, right.feet.beater)
    assert right.feet.beater.max() == 1.0
