"""Head and trunk: a nod on the beat, a look before what is far away, and one at the band in rests."""

import numpy as np
import pytest
from tests.unit.instruments.drums.charted import kit_places

from reina.instruments.drums.hit import DrumHit
from reina.instruments.drums.motion.looks import LEAD_S, Looks, plan_looks
from reina.instruments.drums.motion.nods import nods
from reina.rotations.arrays import FloatArray

PLACES = kit_places()
RATE_HZ = 40.0
HEAD = np.array([0.0, 1.25, 0.02])
BEATS: FloatArray = np.arange(80, dtype=np.float64) * 0.5


def groove(until_s: float = 20.0, begin_s: float = 2.0, velocity: float = 0.7) -> list[DrumHit]:
    """Eighths on the hi-hat, and the snare on two and four."""
    hits: list[DrumHit] = []
    for index, at in enumerate(np.arange(begin_s, until_s, 0.25).tolist()):
        hits.append(DrumHit(at, 2 * at, "hi_hat", "bow", "right_hand", velocity))
        if index % 4 == 2:
            hits.append(DrumHit(at, 2 * at, "snare", "centre", "left_hand", velocity))
    return hits


def struck(piece: str, zone: str, at_s: float) -> DrumHit:
    return DrumHit(at_s, 2 * at_s, piece, zone, "right_hand", 0.8)


def looks(hits: list[DrumHit], bearings: tuple[float, ...] = (0.3,), seed: int = 0) -> Looks:
    bars = BEATS[::4]
    count = round(40 * RATE_HZ)
    return plan_looks(
        count, RATE_HZ, sorted(hits, key=lambda hit: hit.onset_s), PLACES, head=HEAD, bars_s=bars,
        bearings_rad=bearings, seed=seed,
    )  # fmt: skip


def at(curve: FloatArray, time_s: float) -> float:
    return float(curve[round(time_s * RATE_HZ)])


@pytest.mark.parametrize(("beat_s", "step"), [(0.5, 1), (0.8, 1), (0.3, 2), (0.15, 4)])
def test_the_nod_is_lowest_on_the_beats(beat_s: float, step: int) -> None:
    beats: FloatArray = np.arange(160, dtype=np.float64) * beat_s
    times = np.arange(4.0, 16.0, 1 / 240)
    down = nods(times, groove(), beats)
    lowest = times[1:-1][(down[1:-1] > down[:-2]) & (down[1:-1] >= down[2:]) & (down[1:-1] > 0.0)]
    nodded = beats[::step]
    assert len(lowest) == np.count_nonzero((nodded > times[1]) & (nodded < times[-2]))
    assert np.abs(lowest[:, None] - nodded).min(axis=1).max() < 0.01


def test_backbeats_are_nodded_to_more_and_loud_playing_too() -> None:
    beats = np.arange(4.0, 16.0, 0.5)
    down = nods(beats, groove(), BEATS)
    assert down[1::2].min() > 1.2 * down[::2].max()
    assert (
        nods(beats, groove(velocity=0.9), BEATS).max() > 1.15 * nods(beats, groove(velocity=0.4), BEATS).max()
    )


def test_the_nod_goes_on_in_a_rest_and_ends_with_the_part() -> None:
    hits = groove(8.0) + groove(24.0, 16.0)
    at_rest = nods(np.arange(11.0, 14.0, 0.5), hits, BEATS)
    between = nods(np.arange(11.25, 14.0, 0.5), hits, BEATS)
    assert at_rest.min() - between.max() > 0.3
    assert np.abs(nods(np.arange(27.0, 30.0, 0.05), hits, BEATS)).max() < 1e-9
    assert np.abs(nods(np.arange(0.0, 0.4, 0.05), groove(begin_s=4.0), BEATS)).max() < 1e-9


def test_nothing_is_nodded_to_without_strokes_or_beats() -> None:
    times = np.arange(0.0, 2.0, 0.1)
    assert not nods(times, [], BEATS).any()
    assert not nods(times, groove(), BEATS[:1]).any()


def test_nods_go_on_smoothly() -> None:
    times = np.arange(0.0, 22.0, 1 / 240)
    down = nods(times, groove(), BEATS)
    speed = np.diff(down) * 240
    assert np.abs(speed).max() < 7.0
    assert np.abs(np.diff(speed)).max() * 240 < 220.0


@pytest.mark.parametrize(
    ("piece", "zone", "side"),
    [("ride", "bow", -1), ("tom_floor", "centre", -1), ("crash_left", "edge", 1)],
)
def test_the_head_is_turned_to_a_far_piece_before_it_is_struck(piece: str, zone: str, side: int) -> None:
    looked = looks([*groove(), struck(piece, zone, 10.3)])
    before, calm = at(looked.left, 10.3 - 0.15), at(looked.left, 8.0)
    assert side * (before - calm) > 0.12
    turned = side * looked.left[round(9.0 * RATE_HZ) : round(12.0 * RATE_HZ)]
    most = 9.0 + float(np.argmax(turned)) / RATE_HZ
    assert 0.2 <= 10.3 - most <= 0.4
    assert 10.3 - most == pytest.approx(LEAD_S, abs=0.06)


def test_the_steady_hi_hat_asks_for_no_look() -> None:
    assert looks(groove()).share.max() < 0.2


def test_a_rest_is_for_the_band() -> None:
    hits = groove(8.0) + groove(20.0, 14.0)
    looked = looks(hits, (0.3,))
    assert at(looked.band, 11.0) == 1.0
    assert at(looked.band_left, 11.0) == pytest.approx(0.3)
    assert at(looked.band, 5.0) == 0.0
    assert at(looked.band, 14.0) == 0.0


def test_so_is_the_end_of_four_bars_but_in_a_fill() -> None:
    assert at(looks(groove()).band, 7.2) == 1.0
    fill = [struck("tom_floor", "centre", 6.5), struck("ride", "bow", 7.4), struck("crash_left", "edge", 8.0)]
    assert at(looks([*groove(), *fill]).band, 7.2) == 0.0


def test_who_is_looked_at_changes_with_the_seed_alone() -> None:
    others = (-0.3, 0.0, 0.3)
    one, again = looks(groove(), others), looks(groove(), others)
    np.testing.assert_array_equal(one.band_left, again.band_left)
    assert len({looks(groove(), others, seed).band_left.tobytes() for seed in range(6)}) > 1


def test_the_head_turns_no_faster_than_a_head() -> None:
    pieces = [("ride", "bow"), ("crash_left", "edge"), ("tom_floor", "centre"), ("hi_hat", "bow")]
    hits = [struck(*pieces[index % 4], 2.0 + 0.3 * index) for index in range(60)]
    looked = looks(hits)
    for curve in (looked.left, looked.down, looked.band):
        speed = np.diff(curve) * RATE_HZ
        assert np.abs(speed).max() < 10.0
        assert np.abs(np.diff(speed)).max() * RATE_HZ < 120.0


def test_without_strokes_nobody_is_looked_at() -> None:
    assert not looks([]).band.any()
