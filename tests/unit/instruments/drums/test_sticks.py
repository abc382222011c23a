"""Sticks: on the surface at the onset and never late, high before loud strokes, no faster than a hand."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.instruments.drums.charted import charts, hits_of, kit_places

from reina.instruments.drums.drum_part import Choke, DrumFingering
from reina.instruments.drums.hit import DrumHit
from reina.instruments.drums.motion.contacts import EDGE_OUT_M
from reina.instruments.drums.motion.hand_shapes import CHOKE, OPEN_RAD, PLAY, TWIRL
from reina.instruments.drums.motion.kit_answers import SWINGS, KitAnswers
from reina.instruments.drums.motion.stick_paths import StickPaths, turned
from reina.instruments.drums.motion.stick_plan import CONTACT_RAD, GRIP_M, REST_TIP, TWIRL_S
from reina.instruments.drums.motion.twirls import plan_twirls
from reina.rotations import conjugate, rotate
from reina.rotations.arrays import ArrayLike, FloatArray
from reina.skeleton import RigError

PLACES = kit_places()
CHARTS = charts()
GROOVES = (
    "crash_then_hats", "ghosted_funk_dense", "sixteenth_hats_shared_fast", "round_the_toms_fast",
    "double_strokes_32nds_180", "metal_china", "snare_16ths_with_crash_end", "cowbell_rock",
)  # fmt: skip
FPS = 60.0
TOUCH_M = 0.002
FASTEST_TIP, FASTEST_HAND = 30.0, 15.0
"""Metres a second."""
DISCS = {"snare": 0.178, "tom_high": 0.127, "tom_mid": 0.152, "tom_floor": 0.203}
"""How far each head reaches, metres."""


def sticks(hits: list[DrumHit]) -> StickPaths:
    return StickPaths(hits, PLACES, KitAnswers(hits))


def strokes(*at: tuple[float, float], piece: str = "snare", zone: str = "centre") -> list[DrumHit]:
    """Strokes of the right hand: onset and velocity."""
    return [DrumHit(onset, onset, piece, zone, "right_hand", velocity) for onset, velocity in at]


def drums_of(hits: list[DrumHit]) -> DrumFingering:
    return DrumFingering(
        (), np.zeros(0, dtype=np.bool_), (), tuple(hits), tuple(range(len(hits))), (), "right"
    )


def height(hits: list[DrumHit], times: ArrayLike) -> FloatArray:
    """How high the right tip is above the snare's head."""
    tip = sticks(hits).evaluate(np.asarray(times, dtype=np.float64)).tip[:, 0]
    return tip[:, 1] - PLACES["snare", "centre"].position[1]


def off_zone(hit: DrumHit, at_s: float, answers: KitAnswers, paths: StickPaths) -> tuple[float, float]:
    """How far a hit's tip is off the surface, and off the zone's middle in it, in the kit as it then is."""
    zone = PLACES[hit.piece, hit.zone]
    position, normal = zone.position, zone.normal
    if hit.piece in SWINGS:
        tilt = answers.tilt(np.array([at_s]))[0, list(SWINGS).index(hit.piece)]
        turn = turned(zone.outward[None], tilt[None])[0]
        position = zone.pivot + rotate(turn, position - zone.pivot)
        normal = rotate(turn, normal)
    tip = paths.evaluate(np.array([at_s])).tip[0, 0 if hit.limb == "right_hand" else 1]
    above = float((tip - position) @ normal)
    return abs(above), float(np.linalg.norm(tip - position - above * normal))


@pytest.mark.parametrize("name", GROOVES)
def test_every_tip_is_on_its_zone_at_the_onset_and_in_the_frame_at_or_before_it(name: str) -> None:
    hits = hits_of(CHARTS[name])
    answers, paths = KitAnswers(hits), sticks(hits)
    last: dict[str, float] = {}
    seen = 0
    for hit in hits:
        if not hit.limb.endswith("hand"):
            continue
        gap = hit.onset_s - last.get(hit.limb, -np.inf)
        last[hit.limb] = hit.onset_s
        zone = PLACES[hit.piece, hit.zone]
        frame = np.floor(hit.onset_s * FPS + 1e-9) / FPS
        # A double's second stroke may come down within the frame.
        for at in (hit.onset_s, frame) if gap > 0.05 else (hit.onset_s,):
            above, aside = off_zone(hit, float(at), answers, paths)
            assert above <= TOUCH_M, (hit, at)
            assert aside <= zone.radius + 1e-6, (hit, at)
            seen += 1
    assert seen > 20


@pytest.mark.parametrize("name", GROOVES)
def test_nothing_jumps_and_nothing_is_faster_than_a_hand(name: str) -> None:
    hits = hits_of(CHARTS[name])
    rate = 1000.0
    frames = sticks(hits).evaluate(np.arange(-2.0, hits[-1].onset_s + 4.0, 1.0 / rate))
    tip = np.linalg.norm(np.diff(frames.tip, axis=0), axis=-1) * rate
    hand = np.linalg.norm(np.diff(frames.grip, axis=0), axis=-1) * rate
    assert tip.max() < FASTEST_TIP
    assert hand.max() < FASTEST_HAND
    assert np.allclose(np.linalg.norm(frames.direction, axis=-1), 1.0)
    assert np.allclose(np.linalg.norm(frames.tip - frames.grip, axis=-1), GRIP_M)


@pytest.mark.parametrize("name", GROOVES)
def test_no_stick_goes_through_a_drum(name: str) -> None:
    hits = hits_of(CHARTS[name])
    frames = sticks(hits).evaluate(np.arange(-1.0, hits[-1].onset_s + 2.0, 0.004))
    for part in (0.0, 0.5, 1.0):
        points = frames.tip * (1.0 - part) + frames.grip * part
        for piece, radius in DISCS.items():
            zone = PLACES[piece, "centre"]
            above = (points - zone.position) @ zone.normal
            aside = np.linalg.norm(points - zone.position - above[..., None] * zone.normal, axis=-1)
            inside = (aside < radius) & (above < -TOUCH_M) & (above > -0.15)
            assert not inside.any(), (piece, part)


def test_louder_strokes_begin_higher() -> None:
    tops = [
        height(strokes((1.0, 0.5), (1.6, velocity)), np.arange(1.05, 1.6, 0.005)).max()
        for velocity in (0.1, 0.4, 0.7, 1.0)
    ]
    assert all(low < high for low, high in pairwise(tops))
    assert 0.03 <= tops[0] <= 0.08
    assert 0.3 <= tops[-1] <= 0.5


def test_in_fast_runs_strokes_are_smaller_and_not_later() -> None:
    def top(gap: float) -> float:
        hits = strokes(*[(1.0 + gap * k, 0.9) for k in range(6)])
        assert height(hits, [hit.onset_s for hit in hits]) == pytest.approx(0.0, abs=1e-9)
        return float(height(hits, np.arange(1.0 + 3 * gap, 1.0 + 4 * gap, 0.001)).max())

    assert top(0.1) < 0.5 * top(0.4)


def test_before_an_accent_the_stick_rises_higher_than_it_fell_from() -> None:
    hits = strokes((1.0, 0.2), (1.3, 0.2), (1.6, 1.0))
    taps = height(hits, np.arange(1.05, 1.28, 0.005)).max()
    assert height(hits, np.arange(1.35, 1.58, 0.005)).max() > 3.0 * taps


def test_a_double_is_one_motion_with_two_contacts() -> None:
    hits = strokes((1.0, 0.7), (1.045, 0.6), (1.5, 0.7))
    between = height(hits, np.arange(1.006, 1.04, 0.001)).max()
    after = height(hits, np.arange(1.06, 1.49, 0.005)).max()
    assert 0.005 < between < 0.05 < after


def test_the_tip_falls_faster_and_faster_and_the_hand_is_ahead_of_it() -> None:
    hits = strokes((1.0, 0.9), (2.2, 0.9))
    times = np.arange(2.08, 2.18, 0.005)
    frames = sticks(hits).evaluate(times)
    falling = -np.diff(frames.tip[:, 0, 1])
    assert (np.diff(falling) > -1e-6).all()
    hand = frames.grip[:, 0, 1]
    tip = frames.tip[:, 0, 1]
    assert (hand[0] - hand[6]) / np.ptp(hand) > (tip[0] - tip[6]) / np.ptp(tip)


def test_a_loose_floor_tom_gives_less_back_than_the_snare() -> None:
    def rebound(piece: str) -> float:
        hits = strokes((1.0, 0.9), (3.0, 0.2), piece=piece)
        tip = sticks(hits).evaluate(np.arange(1.0, 1.25, 0.005)).tip[:, 0]
        zone = PLACES[piece, "centre"]
        return float(((tip - zone.position) @ zone.normal).max())

    assert rebound("tom_floor") < 0.8 * rebound("snare")


def test_in_long_rests_the_sticks_lie_over_the_snare() -> None:
    hits = strokes((1.0, 0.8), (9.0, 0.8), piece="crash_right", zone="edge")
    tips = sticks(hits).evaluate(np.array([-5.0, 5.0, 20.0])).tip[:, 0]
    assert tips == pytest.approx(np.tile(PLACES["snare", "centre"].position + REST_TIP[0], (3, 1)), abs=0.01)


def test_a_stroke_on_a_crash_goes_through_its_edge() -> None:
    hits = strokes((1.0, 0.9), piece="crash_left", zone="edge")
    zone = PLACES["crash_left", "edge"]
    tip = sticks(hits).evaluate(np.arange(1.0, 1.12, 0.01)).tip[:, 0] - zone.position
    assert (tip @ zone.outward).max() > 0.04
    assert tip[:, 1].min() < -0.005


def test_a_hand_that_chokes_a_cymbal_holds_its_edge_on_its_own_side() -> None:
    hits = strokes((1.0, 0.9), piece="crash_left", zone="edge")
    choke = Choke(1.6, "crash_left", "left_hand")
    answers = KitAnswers(hits, [choke])
    times = np.array([0.8, 1.6, 1.7])
    frames = StickPaths(hits, PLACES, answers, chokes=[choke]).evaluate(times)
    zone = PLACES["crash_left", "edge"]
    tilt = answers.tilt(times)[:, list(SWINGS).index("crash_left")]
    back = conjugate(turned(np.tile(zone.outward, (3, 1)), tilt))
    held = rotate(back, frames.grip[:, 1] - zone.pivot)
    across = held - (held @ zone.axis)[:, None] * zone.axis
    arm = zone.position - zone.pivot
    radius = np.linalg.norm(arm - (arm @ zone.axis) * zone.axis) + EDGE_OUT_M
    away = np.hypot(np.linalg.norm(across, axis=1) - radius, (held - arm) @ zone.axis)
    assert away[0] > 0.15
    assert away[1:].max() < TOUCH_M
    assert frames.grip[1, 1, 2] < zone.pivot[2]
    assert frames.hands is not None
    assert (frames.hands.shape[1:, 1] == CHOKE).all()
    assert frames.share[1:, 1] == pytest.approx(1.0)
    assert frames.hands.placed[1:, 1] == pytest.approx(1.0)


def test_fingers_open_as_the_stick_goes_up_and_are_closed_at_the_stroke() -> None:
    hits = strokes((1.0, 0.9), (2.2, 0.9))
    frames = sticks(hits).evaluate(np.array([1.0, 2.05, 2.2]))
    assert frames.hands is None
    assert frames.share[[0, 2], 0] == pytest.approx(0.0, abs=0.02)
    assert frames.share[1, 0] > 0.5


def test_a_tap_is_the_fingers_and_an_accent_the_wrists() -> None:
    def wrist(velocity: float) -> float:
        """Which part of how far the stick turns is not the fingers'."""
        hits = strokes((1.0, velocity), (1.6, velocity))
        frames = sticks(hits).evaluate(np.arange(1.1, 1.58, 0.005))
        turned_rad = np.arcsin(frames.direction[:, 0, 1]) + CONTACT_RAD
        top = int(turned_rad.argmax())
        return 1.0 - OPEN_RAD * float(frames.share[top, 0]) / float(turned_rad[top])

    assert wrist(0.1) < 0.35
    assert wrist(1.0) > 0.6


def test_sticks_are_twirled_in_rests_by_the_seed_and_never_near_a_stroke() -> None:
    hits = [
        DrumHit(onset, onset, "snare", "centre", limb, 0.7)
        for onset in np.cumsum(np.tile([0.5, 0.5, 6.0], 30)).tolist()
        for limb in ("right_hand", "left_hand")
    ]
    fingering = drums_of(hits)
    ways = [plan_twirls(fingering, seed) for seed in range(8)]
    assert len(set(map(str, ways))) > 4
    assert str(plan_twirls(fingering, 3)) == str(ways[3])
    onsets = np.unique([hit.onset_s for hit in hits])
    for way in ways:
        every = np.sort(np.concatenate([np.array(side) for side in way]))
        assert 2 <= len(every) <= 13
        assert np.diff(every).min() >= 16.0
        for at in every:
            assert at - onsets[onsets <= at].max() >= 0.9
            assert onsets[onsets > at].min() - at - TWIRL_S >= 1.0


def test_a_busy_hand_twirls_nothing() -> None:
    hits = strokes(*[(0.5 * k, 0.7) for k in range(200)])
    assert plan_twirls(drums_of(hits), 1) == ([], [])


def test_a_twirl_is_high_over_the_kit() -> None:
    hits = strokes((1.0, 0.7), (9.0, 0.7))
    paths = StickPaths(hits, PLACES, KitAnswers(hits), twirls=((4.0,), ()))
    frames = paths.evaluate(np.array([3.99, 4.0 + 0.5 * TWIRL_S, 4.01 + TWIRL_S, 9.0]))
    assert frames.hands is not None
    assert (frames.hands.shape[:3, 0] == TWIRL).all()
    assert frames.share[:3, 0] == pytest.approx([0.0, 0.5, 1.0])
    assert frames.grip[:3, 0, 1].min() > PLACES["snare", "centre"].position[1] + 0.35
    assert frames.hands.shape[3, 0] == PLAY
    assert (frames.hands.shape[:, 1] == PLAY).all()


def test_two_sticks_have_room_on_one_drum() -> None:
    left = DrumHit(1.0, 1.0, "snare", "centre", "left_hand", 0.7)
    tips = sticks([left, replace(left, limb="right_hand")]).evaluate(np.array([1.0])).tip[0]
    assert 0.03 < np.linalg.norm(tips[0] - tips[1]) < 0.1
    assert tips[0, 0] < tips[1, 0]


def test_a_left_handed_players_kit_is_the_mirror() -> None:
    hits = hits_of(CHARTS["rock_on_ride"])
    other = {"right_hand": "left_hand", "left_hand": "right_hand"}
    mirrored = [replace(hit, limb=other.get(hit.limb, hit.limb)) for hit in hits]
    times = np.arange(0.0, 4.0, 0.05)
    right = StickPaths(hits, PLACES, KitAnswers(hits)).evaluate(times)
    left = StickPaths(mirrored, PLACES.mirrored(), KitAnswers(mirrored, mirrored=True)).evaluate(times)
    assert left.tip[:, ::-1] * (-1.0, 1.0, 1.0) == pytest.approx(right.tip, abs=1e-9)


def test_a_time_is_the_same_whatever_is_asked_with_it() -> None:
    paths = sticks(hits_of(CHARTS["round_the_toms"]))
    times = np.arange(-60, 600) / FPS
    whole = paths.evaluate(times).tip
    assert all(np.array_equal(paths.evaluate(times[k : k + 1]).tip[0], whole[k]) for k in range(0, 660, 37))


def test_the_future_beyond_the_next_stroke_changes_nothing() -> None:
    hits = hits_of(CHARTS["ghosted_funk"])
    cut = [hit for hit in hits if hit.onset_s < 4.0]
    times = np.arange(0.0, 3.0, 0.02)
    assert np.array_equal(sticks(hits).evaluate(times).tip, sticks(cut).evaluate(times).tip)


def test_a_piece_that_the_kit_lacks_is_named() -> None:
    with pytest.raises(RigError, match="the kit has no gong; it has china"):
        sticks(strokes((1.0, 0.5), piece="gong"))


@given(
    gaps=st.lists(st.floats(0.05, 4.0), min_size=1, max_size=12),
    seed=st.integers(0, 2**32 - 1),
)
def test_any_strokes_of_one_hand_touch_at_their_onsets(gaps: list[float], seed: int) -> None:
    chance = np.random.default_rng(seed)
    at = np.cumsum(gaps)
    hits = strokes(*[(float(time), float(chance.uniform(0.05, 1.0))) for time in at])
    assert height(hits, at) == pytest.approx(0.0, abs=1e-9)
    assert height(hits, np.arange(-1.0, at[-1] + 3.0, 0.01)).min() > -1e-9
