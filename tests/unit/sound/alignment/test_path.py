"""The best way through a recording and a score, with gaps in either."""

import numpy as np
from numpy.typing import NDArray

from reina.sound.alignment.features import SCALE, SOUNDING
from reina.sound.alignment.path import UNHEARD, Likeness, Path, Rules, best_path

RULES = Rules((0.4, 0.0, 0.4, 1.2), 15.0)


def some_music(frames: int, seed: int = 0) -> NDArray[np.float32]:
    """Frames that are alike only to themselves."""
    random = np.random.default_rng(seed)
    features = np.zeros((frames, 31), dtype=np.float32)
    features[:, SOUNDING] = random.random((frames, 12)) ** 3
    return features / np.linalg.norm(features, axis=1, keepdims=True) / np.float32(SCALE) * np.float32(1.5)


def follow(recording: NDArray[np.float32], score: NDArray[np.float32]) -> Path:
    return best_path(recording, score, Likeness.by_chance(recording, score, 0.7), RULES)


def test_the_same_is_followed_frame_by_frame():
    music = some_music(200)
    assert follow(music, music).at.tolist() == list(range(200))


def test_what_stands_before_and_after_is_not_heard():
    music = some_music(200)
    path = follow(np.concatenate((some_music(50, 1), music, some_music(70, 2))), music)
    assert path.at[50:250].tolist() == list(range(200))
    assert np.mean(path.at[:50] == UNHEARD) > 0.9
    assert np.mean(path.at[250:] == UNHEARD) > 0.9


def test_a_cut_is_jumped_over():
    music = some_music(300)
    path = follow(np.concatenate((music[:100], music[180:])), music)
    assert path.at.tolist() == [*range(100), *range(180, 300)]


def test_a_repeat_is_left_out():
    music = some_music(300)
    path = follow(np.concatenate((music[:150], music[60:])), music)
    heard = path.at[path.at != UNHEARD]
    assert np.array_equal(np.unique(heard), np.arange(300))
    assert abs(np.sum(path.at == UNHEARD) - 90) <= 3


def test_half_the_tempo_is_followed():
    music = some_music(150)
    path = follow(np.repeat(music, 2, axis=0), music)
    assert np.abs(path.at - np.arange(300) // 2)[1:-1].max() <= 1


def test_a_band_that_holds_the_way_changes_nothing():
    music = some_music(300)
    recording = np.concatenate((music[:100], music[150:]))
    place = np.concatenate((np.arange(100), np.arange(150, 300)))
    low = np.maximum.accumulate(np.maximum(0, np.minimum(place, np.roll(place, 10)) - 20))
    high = np.minimum(300, np.maximum(place, np.roll(place, -10)) + 20)
    low[:10], high[-10:] = 0, 300
    band = np.stack((np.minimum.accumulate(low[::-1])[::-1], np.maximum.accumulate(high)), axis=1)
    likeness = Likeness.by_chance(recording, music, 0.7)
    within = best_path(recording, music, likeness, RULES, band)
    assert within.at.tolist() == best_path(recording, music, likeness, RULES).at.tolist()
