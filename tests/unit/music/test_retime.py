"""A score as a recording of it goes."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from tests.integration.scores import duet, scale

from reina.music import MetreMap, Score, TempoMap, TimeSignature, from_second_zero, read_score, retimed
from reina.music.arrays import BoolArray, FloatArray
from reina.music.midi.writer import write_midi


@dataclass(frozen=True)
class Heard:
    """Places that are heard, in straight lines between them, and stretches that are not heard."""

    places: tuple[tuple[float, float], ...]
    absent: tuple[tuple[float, float], ...] = ()

    @property
    def bends_s(self) -> FloatArray:
        return np.array([score_s for score_s, _ in self.places])

    def song_times(self, score_s: FloatArray, /) -> FloatArray:
        known = self.bends_s
        values: FloatArray = np.array([song_s for _, song_s in self.places])
        beyond = np.minimum(score_s - known[0], 0.0) + np.maximum(score_s - known[-1], 0.0)
        return np.interp(score_s, known, values) + beyond

    def is_heard(self, score_s: FloatArray, /) -> BoolArray:
        heard: BoolArray = np.ones(np.shape(score_s), dtype=np.bool_)
        for begin, end in self.absent:
            heard &= (score_s < begin) | (score_s >= end)
        return heard


def warp(places: list[tuple[float, float]], absent: list[tuple[float, float]] | None = None) -> Heard:
    return Heard(tuple(places), tuple(absent or []))


@pytest.fixture
def score() -> Score:
    """Sixteen eighths at 120: a note each quarter of a second, four seconds in all."""
    return read_score(scale(16), filename="scale.mid")


def falls(score: Score) -> FloatArray:
    return score.tempo_map.seconds(score.notes.onset_beats)


def test_notes_bars_and_beats_move_together(score: Score):
    heard = retimed(score, warp([(0, 3.2), (2, 5.2), (4, 9.2)]))
    assert heard.notes.onset_s[:3] == pytest.approx([3.2, 3.45, 3.7])
    assert heard.notes.onset_s[8:11] == pytest.approx([5.2, 5.7, 6.2])
    assert heard.notes.duration_s[8:] == pytest.approx(0.5)
    assert heard.notes.onset_beats.tolist() == score.notes.onset_beats.tolist()
    assert falls(heard) == pytest.approx(heard.notes.onset_s)
    assert heard.tempo_map.seconds(heard.metre_map.bar_lines(8.0)) == pytest.approx([3.2, 5.2])
    assert heard.duration_s == pytest.approx(9.2)
    assert [round(tempo.beats_per_minute) for tempo in heard.tempo_map.tempos[:2]] == [120, 60]
    assert heard.tempo_map.beats(0.0) == pytest.approx(-6.4), (
        "what is heard before the music has its beats too"
    )


def test_beyond_what_was_found_a_second_lasts_a_second(score: Score):
    heard = retimed(score, warp([(1, 2), (2, 4)]))
    assert heard.notes.onset_s[[0, 4, 8, 12]] == pytest.approx([1, 2, 4, 5])
    assert falls(heard) == pytest.approx(heard.notes.onset_s)


def test_bars_that_are_not_heard_have_no_notes_and_no_time(score: Score):
    heard = retimed(score, warp([(0, 0), (1, 1), (3, 1), (4, 2)], [(1, 3)]))
    assert heard.notes.onset_beats.tolist() == [*score.notes.onset_beats[:4], *score.notes.onset_beats[12:]]
    assert heard.notes.onset_s == pytest.approx(np.arange(8) * 0.25)
    assert heard.tempo_map.seconds(np.array([2.0, 6.0])) == pytest.approx([1, 1], abs=1e-5)
    assert falls(heard) == pytest.approx(heard.notes.onset_s, abs=1e-5)


def test_music_that_the_score_has_not_leaves_the_tempo_before_it_as_it_is(score: Score):
    heard = retimed(score, warp([(0, 0), (2, 2), (2.0001, 14.0001), (4, 16)]))
    assert heard.notes.onset_s[[4, 7, 9]] == pytest.approx([1, 1.75, 14.25])
    assert heard.tempo_map.seconds(np.array([2.0, 3.0, 3.9, 4.5])) == pytest.approx([1, 1.5, 1.95, 14.25])


def test_a_note_that_is_held_into_what_is_not_heard_ends_there():
    long = read_score(scale(2, beats=4.0), filename="scale.mid")
    heard = retimed(long, warp([(0, 0), (1, 1), (2, 1), (4, 3)], [(1, 2)]))
    assert heard.notes.onset_s == pytest.approx([0, 1])
    assert heard.notes.duration_s == pytest.approx([1, 2])


def test_the_written_tempo_stays_and_controllers_move(score: Score):
    heard = retimed(score, warp([(0, 1), (4, 9)]))
    assert heard.written_tempo_map is score.tempo_map
    assert score.written_tempo_map is score.tempo_map
    again = retimed(heard, warp([(0, 0), (9, 9)]))
    assert again.written_tempo_map is score.tempo_map
    assert [control.onset_s for control in heard.controls] == pytest.approx(
        [1 + 2 * control.onset_s for control in score.controls]
    )
    assert heard.controls


def test_as_it_is_written_it_stays_as_it_is():
    score = read_score(duet(), filename="duet.mid")
    heard = retimed(score, warp([(0, 0), (1, 1)]))
    for name, column in vars(score.notes).items():
        assert getattr(heard.notes, name) == pytest.approx(column, abs=1e-12), name
    assert heard.duration_s == pytest.approx(score.duration_s)


def test_what_is_heard_later_has_bars_of_rest_before_it_in_a_file(score: Score):
    heard = retimed(score, warp([(0, 3.2), (4, 7.2)]))
    whole = from_second_zero(heard)
    assert whole.tempo_map.seconds(0.0) == 0
    assert whole.notes.onset_beats == pytest.approx(score.notes.onset_beats + 8)
    assert falls(whole) == pytest.approx(heard.notes.onset_s)
    assert whole.metre_map.bar_lines(16.0).tolist() == [0, 4, 8, 12]
    again = read_score(write_midi(whole), filename="whole.mid")
    assert again.notes.onset_s == pytest.approx(heard.notes.onset_s, abs=1e-3)
    assert from_second_zero(score) is score


def test_a_pickup_ends_the_bars_of_rest():
    metre = MetreMap([TimeSignature(0, 1, 4), TimeSignature(1, 3, 4), TimeSignature(7, 4, 4)])
    score = replace(read_score(scale(24), filename="scale.mid"), metre_map=metre)
    whole = from_second_zero(retimed(score, warp([(0, 2.4), (4, 6.4)])))
    assert whole.metre_map.bar_lines(16.0).tolist() == [0, 3, 6, 9, 12]
    assert whole.notes.onset_beats[0] == 5
    assert [signature.numerator for signature in whole.metre_map.signatures] == [3, 4]


@pytest.mark.parametrize(
    ("beats", "seconds", "said"),
    [
        ([0, 1], [1, 1], "ascend"),
        ([0, 1, 1], [0, 1, 2], "ascend"),
        ([1, 2], [0, 1], "beat 0"),
        ([0], [0], "two places"),
    ],
)
def test_a_tempo_map_goes_through_places_that_ascend(beats: list[float], seconds: list[float], said: str):
    with pytest.raises(ValueError, match=said):
        TempoMap.through(beats, seconds)
