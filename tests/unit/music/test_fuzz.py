"""Whatever the bytes, the reader gives a sound score or its own error.

tests/benchmarks/fuzz_reader.py does more of it.
"""

import json

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.unit.music.mutations import mutated, seeds

from reina.instruments import INSTRUMENTS
from reina.music import Limits, Score, ScoreError, read_score

LIMITS = Limits(size_bytes=100_000, events=5_000, notes=2_000)


def check(data: bytes) -> Score | None:
    """Read a file and check that what comes out is a score; None if it is refused."""
    try:
        score = read_score(data, limits=LIMITS)
    except ScoreError:
        return None
    notes = score.notes
    assert len(notes) > 0
    assert np.all(np.diff(notes.onset_s) >= 0)
    assert np.all(
        np.isfinite(notes.onset_s) & np.isfinite(notes.duration_s) & np.isfinite(notes.duration_beats)
    )
    assert np.all(notes.onset_s >= 0)
    assert np.all(notes.duration_s > 0)
    assert np.all((notes.sounding_pitch >= 0) & (notes.sounding_pitch <= 127))
    assert np.all((notes.velocity >= 0) & (notes.velocity <= 1))
    assert set(notes.part.tolist()) == set(range(len(score.parts)))
    assert score.duration_s == float(np.max(notes.end_s)) <= LIMITS.duration_s + 1
    assert len(score.metre_map.bar_lines(score.duration_beats)) <= LIMITS.bars + 100
    np.testing.assert_allclose(
        score.tempo_map.seconds(notes.onset_beats), notes.onset_s, rtol=1e-9, atol=2e-3
    )
    return score


def test_the_seeds_are_read():
    assert all(check(seed) for seed in seeds())


def test_mutated_files_give_a_score_or_the_readers_own_error():
    trumpet = INSTRUMENTS["trumpet"]
    read = 0
    for number, data in enumerate(mutated(10_000, seed=20_261_122)):
        score = check(data)
        if score is None:
            continue
        read += 1
        if number % 20 == 0:
            played = trumpet.play(score, trumpet.rank_parts(score)[0].part)
            assert np.all(played.line.end_s > played.line.onset_s)
            assert np.all(played.line.onset_s[1:] >= played.line.end_s[:-1])
    assert read > 3_000


@settings(max_examples=300)
@given(st.binary(max_size=300))
def test_any_bytes_after_a_header_give_a_score_or_the_readers_own_error(data: bytes):
    check(b"MThd\0\0\0\6\0\1\0\1\0\x60MTrk" + len(data).to_bytes(4, "big") + data)


KEYS = st.sampled_from(
    ["notes", "tracks", "parts", "header", "tempos", "midi", "time", "ppq", "beat", "pitch"]
)
json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=4),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(KEYS, inner, max_size=4),
    max_leaves=20,
)


@settings(max_examples=200)
@given(json_values)
def test_any_json_gives_a_score_or_the_readers_own_error(document: object):
    check(json.dumps(document).encode())
