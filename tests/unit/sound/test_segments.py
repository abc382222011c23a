import io

import numpy as np
import pytest
import soundfile
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from tests.unit.sound.material import Row, a_score

from reina.sound.encode import opus
from reina.sound.events import SAMPLE_RATE
from reina.sound.passages import cut_into_passages
from reina.sound.plan import plan_sound
from reina.sound.segments import OVERLAP, SEGMENT, Segments, cut_into_segments


@given(st.integers(1, 10**9))
def test_segments_are_the_song_once_and_overlap_at_both_ends(frames: int) -> None:
    segments = Segments(frames)
    assert (segments.count - 1) * SEGMENT < frames <= segments.count * SEGMENT
    last = segments.count - 1
    for number in {0, last // 2, last}:
        held = segments.held(number)
        assert held.start == number * SEGMENT - OVERLAP
        assert held.stop == min((number + 1) * SEGMENT, frames) + OVERLAP


def test_a_segment_has_no_fraction_of_a_sample_on_any_device() -> None:
    for rate in (44_100, 48_000, 88_200, 96_000):
        assert SEGMENT * rate % SAMPLE_RATE == 0
        assert OVERLAP * rate % SAMPLE_RATE == 0


def test_a_segment_needs_what_sounds_in_it_and_the_first_needs_one_passage() -> None:
    rows: list[Row] = [(0, at * 0.5, 0.5, 60, 0.8) for at in range(240)]
    passages = cut_into_passages(plan_sound(a_score(rows)))
    segments = cut_into_segments(passages)
    assert segments.frames == max(passage.start + passage.length for passage in passages)
    assert segments.needed(0, passages) == [0]
    for number in range(segments.count):
        held = segments.held(number)
        needed = segments.needed(number, passages)
        assert 1 <= len(needed) <= 3
        for index, passage in enumerate(passages):
            sounds = passage.start < held.stop and held.start < passage.start + passage.length
            assert sounds == (index in needed)


def music(seconds: float) -> NDArray[np.int16]:
    """Gliding tones with an attack every 0.3 s, (F, 2)."""
    at = np.arange(round(seconds * SAMPLE_RATE)) / SAMPLE_RATE
    left = np.sin(2 * np.pi * (220 * at + 8 * at**2)) * np.exp(-3 * (at % 0.3))
    right = np.sin(2 * np.pi * (331 * at - 2 * at**2)) * np.exp(-2 * (at % 0.5))
    return np.rint(np.stack((left, right), axis=1) * 9000).astype(np.int16)


@pytest.fixture(scope="module")
def segmented() -> tuple[NDArray[np.float64], list[NDArray[np.float64]]]:
    """25 s of music, and its segments as they are decoded."""
    whole = music(25)
    padded = np.pad(whole, ((OVERLAP, OVERLAP), (0, 0)))
    segments = Segments(len(whole))
    decoded: list[NDArray[np.float64]] = []
    for number in range(segments.count):
        held = segments.held(number)
        samples, rate = soundfile.read(io.BytesIO(opus(padded[held.start + OVERLAP : held.stop + OVERLAP])))
        assert rate == SAMPLE_RATE
        assert len(samples) == len(held), "the decoder takes off just what the encoder put before"
        decoded.append(samples)
    return whole / 32768, decoded


def test_every_segment_is_in_its_place_to_the_sample(
    segmented: tuple[NDArray[np.float64], list[NDArray[np.float64]]],
) -> None:
    whole, decoded = segmented
    for number, samples in enumerate(decoded):
        core = samples[OVERLAP:-OVERLAP]
        meant = whole[number * SEGMENT :][: len(core)]
        shifts = range(-96, 97)
        inner = slice(SAMPLE_RATE, 2 * SAMPLE_RATE)
        alike = [float(np.sum(np.roll(core, shift, axis=0)[inner] * meant[inner])) for shift in shifts]
        assert shifts[int(np.argmax(alike))] == 0


def test_joins_are_not_heard(segmented: tuple[NDArray[np.float64], list[NDArray[np.float64]]]) -> None:
    whole, decoded = segmented
    fade = SAMPLE_RATE // 50
    rising = np.linspace(0, 1, fade)[:, None]
    joined = decoded[0][OVERLAP : OVERLAP + SEGMENT + fade // 2]
    for samples in decoded[1:]:
        begin = OVERLAP - fade // 2
        end = len(samples) - OVERLAP + (fade // 2 if samples is not decoded[-1] else 0)
        following = samples[begin:end]
        joined[-fade:] = joined[-fade:] * (1 - rising) + following[:fade] * rising
        joined = np.concatenate((joined, following[fade:]))
    assert len(joined) == len(whole), "no gap, nothing twice"
    # A click is energy at high frequencies; the error's own is compared in windows of 20 ms.
    error = np.diff(joined - whole, n=2, axis=0)
    windows = np.sqrt((error[: len(error) // fade * fade].reshape(-1, fade * 2) ** 2).mean(axis=1))
    for join in range(SEGMENT, len(whole), SEGMENT):
        around = windows[join // fade - 2 : join // fade + 2]
        assert around.max() <= np.percentile(windows, 99)
