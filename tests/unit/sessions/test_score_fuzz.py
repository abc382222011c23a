"""Scores made worse at random can be played, described, heard and staged, or are refused by the reader.

tests/benchmarks/fuzz_readers.py does more of it.
"""

import random
import zlib

from tests.unit.music.mutations import json_seeds, midi_seeds, mutate_json, mutate_midi
from tests.unit.sessions.score_checks import STAGED_OF, check_score_played


def test_every_seed_is_played() -> None:
    assert all(check_score_played(seed) for seed in (*midi_seeds(), *json_seeds()))


def test_mutated_midi_files_are_played_or_refused() -> None:
    rng = random.Random(20_261_130)
    assert 150 < sum(check_score_played(mutate_midi(rng.choice(midi_seeds()), rng)) for _ in range(300)) < 300


def test_mutated_documents_are_played_or_refused() -> None:
    rng = random.Random(20_261_130)
    assert 50 < sum(check_score_played(mutate_json(rng.choice(json_seeds()), rng)) for _ in range(300)) < 250


def test_one_of_many_is_staged() -> None:
    data = midi_seeds()[0]
    # What stands behind the last chunk tells nothing but which file it is.
    staged = next(made for n in range(10_000) if zlib.crc32(made := data + b"%d" % n) % STAGED_OF == 0)
    assert check_score_played(staged)
