"""A score in another key."""

from dataclasses import replace

import numpy as np
import pytest
from tests.unit.sound.material import a_part, a_score

from reina.music import transposed
from reina.music.key_signature import KeySignature


def test_tones_and_keys_are_moved_and_drums_are_not():
    parts = (a_part(0), a_part(1, "Drums", is_drums=True))
    score = a_score([(0, 0.0, 1.0, 60, 0.8), (1, 0.0, 0.1, 38, 0.8), (0, 1.0, 1.0, 126, 0.8)], parts)
    score = replace(score, key_signatures=(KeySignature(0.0, 0), KeySignature(1.0, -3, is_minor=True)))
    moved = transposed(score, 3)
    assert dict(zip(moved.notes.sounding_pitch.tolist(), moved.notes.part.tolist(), strict=True)) == {
        63: 0,
        38: 1,
        117: 0,
    }
    assert moved.key_signatures == (KeySignature(0.0, -3), KeySignature(1.0, -6, is_minor=True))
    assert np.array_equal(moved.notes.onset_s, score.notes.onset_s)
    assert transposed(score, 0) is score


@pytest.mark.parametrize(
    ("fifths", "semitones", "moved"),
    [(0, 2, 2), (0, -2, -2), (0, 6, 6), (5, 2, -5), (-5, -2, 5), (7, 12, 7), (0, -6, 6), (4, 5, 3)],
)
def test_of_two_spellings_of_a_key_the_simpler_is_taken(fifths: int, semitones: int, moved: int):
    assert KeySignature(0.0, fifths).moved(semitones).fifths == moved
