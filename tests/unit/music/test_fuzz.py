"""Whatever the bytes, the reader gives a sound score or its own error.

tests/benchmarks/fuzz_readers.py does more of it.
"""

import json

from hypothesis import given, settings
from hypothesis import strategies as st
from tests.unit.music.mutations import mutated, seeds
from tests.unit.music.score_checks import check_score

from reina.music import Limits

LIMITS = Limits(size_bytes=100_000, events=5_000, notes=2_000)


def test_the_seeds_are_read():
    assert all(check_score(seed, limits=LIMITS) for seed in seeds())


def test_mutated_files_give_a_score_or_the_readers_own_error():
    read = sum(check_score(data, limits=LIMITS) is not None for data in mutated(8_000, seed=20_261_122))
    assert read > 2_400


@settings(max_examples=300)
@given(st.binary(max_size=300))
def test_any_bytes_after_a_header_give_a_score_or_the_readers_own_error(data: bytes):
    check_score(b"MThd\0\0\0\6\0\1\0\1\0\x60MTrk" + len(data).to_bytes(4, "big") + data, limits=LIMITS)


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
    check_score(json.dumps(document).encode(), limits=LIMITS)
