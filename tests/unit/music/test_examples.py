"""The shipped scores are read, and are what the script writes."""

import runpy
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reina.instruments import INSTRUMENTS
from reina.instruments.brass.family import FAMILY
from reina.instruments.brass.fingering import BrassPart
from reina.music import Score, read_score

EXAMPLES = Path(__file__).parents[3] / "examples"
FILES = sorted((EXAMPLES / "scores").iterdir())
TRUMPET = FAMILY["trumpet"]


def opened(name: str) -> tuple[Score, BrassPart]:
    path = EXAMPLES / "scores" / name
    score = read_score(path.read_bytes(), filename=path.name)
    return score, TRUMPET.play(score, TRUMPET.rank_parts(score)[0].part)


def test_the_script_writes_them_again_byte_by_byte(tmp_path: Path):
    runpy.run_path(str(EXAMPLES / "make_scores.py"))["main"](tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == [path.name for path in FILES]
    for path in FILES:
        assert (tmp_path / path.name).read_bytes() == path.read_bytes()


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_each_is_read_without_a_warning_and_can_be_played_whole(path: Path):
    score, played = opened(path.name)
    assert score.warnings == ()
    assert played.warnings == ()
    assert played.fingering.playable.all()
    assert len(played.line) == len(score.note_indices(played.part))
    assert TRUMPET.rank_parts(score)[0].part == 0


def test_the_band_has_no_stroke_that_no_hand_can_play():
    path = EXAMPLES / "scores" / "when-the-saints.mid"
    score = read_score(path.read_bytes(), filename=path.name)
    played = INSTRUMENTS["drums"].play(score, INSTRUMENTS["drums"].rank_parts(score)[0].part)
    assert played.warnings == ()
    assert played.fingering.playable.all()


def test_the_bundled_piece():
    score, played = opened("prince-of-denmarks-march.mid")
    assert score.title == "Prince of Denmark's March"
    assert [part.name for part in score.parts] == ["Trumpet", "Organ", "Basses", "Timpani"]
    assert 45 < score.duration_s < 75
    # In D major: the refrain begins and ends on its tonic, and every phrase leaves time to breathe.
    assert played.line.sounding_pitch[[0, -1]].tolist() == [74, 74]
    assert played.line.phrase[-1] >= 7
    assert np.ptp(score.notes.velocity[played.line.note_index]) > 0.15
    assert not played.fingering.primary.all()
    assert score.metre_map.position(124).bar == 32
    assert score.tempo_map.tempos[-1].beats_per_minute < 90


@dataclass(frozen=True)
class Voices:
    """Two voices wherever either of them begins a note, in order: pitches (I, 2), -1 in a rest, and beats."""

    pitches: NDArray[np.int64]
    beats: NDArray[np.float64]

    @classmethod
    def of(cls, score: Score, upper: int, lower: int) -> "Voices":
        notes = [score.notes.take(score.note_indices(part)) for part in (upper, lower)]
        beats = np.unique(np.concatenate([part.onset_beats for part in notes]))
        columns: list[NDArray[np.int64]] = []
        for part in notes:
            index = np.searchsorted(part.onset_beats, beats, side="right") - 1
            # Notes are played shorter than they are written.
            sounds = (index >= 0) & (beats - part.onset_beats[index] < part.duration_beats[index] * 1.05)
            columns.append(np.where(sounds, part.sounding_pitch[index], -1).astype(np.int64))
        return cls(np.column_stack(columns), beats)

    def parallels(self) -> list[float]:
        """Beats that both reach by moving from one unison, fifth or octave to another of the same kind."""
        found: list[float] = []
        kinds = (self.pitches[:, 0] - self.pitches[:, 1]) % 12
        for place in range(1, len(self.beats)):
            both = (self.pitches[place - 1 : place + 1] >= 0).all()
            moved = (self.pitches[place] != self.pitches[place - 1]).all()
            if both and moved and kinds[place] == kinds[place - 1] and kinds[place] in (0, 7):
                found.append(float(self.beats[place]))
        return found

    def on_whole_beats(self) -> "Voices":
        """Only what sounds on the beats."""
        whole = self.beats % 1.0 == 0.0
        return Voices(self.pitches[whole], self.beats[whole])


def test_the_duet_is_for_two_trumpets_that_enter_apart():
    score, first = opened("trumpet-duet.mid")
    assert [part.name for part in score.parts] == ["Trumpet 1", "Trumpet 2", "Organ", "Basses"]
    assert [part.program for part in score.parts[:2]] == [56, 56]
    assert 40 < score.duration_s < 70
    assert [entry.part for entry in TRUMPET.rank_parts(score)[:2]] == [0, 1]
    second = TRUMPET.play(score, 1)
    for played in (first, second):
        assert played.warnings == ()
        assert played.fingering.playable.all()
        # In easy range, and with a rest to breathe in every four bars and a half.
        assert played.line.sounding_pitch.min() >= 57
        assert played.line.sounding_pitch.max() <= 83
        rests = np.flatnonzero(played.line.onset_s[1:] - played.line.end_s[:-1] > 0.15)
        begins, ends = played.line.onset_s[np.r_[0, rests + 1]], played.line.end_s[np.r_[rests, -1]]
        assert np.max(ends - begins) < 9.0
    assert second.line.onset_s[0] - first.line.onset_s[0] > 4
    voices = Voices.of(score, 0, 1)
    alone = (voices.pitches < 0).sum(axis=0)
    assert (alone > 8).all(), "each is heard alone"
    # The second is answered, and answers above the first.
    crossed = (voices.pitches >= 0).all(axis=1) & (voices.pitches[:, 1] > voices.pitches[:, 0])
    assert 0 < crossed.mean() < 0.05


@pytest.mark.parametrize(("upper", "lower"), [(0, 1), (0, 3), (1, 3)])
def test_the_duet_has_no_parallel_fifths_or_octaves(upper: int, lower: int):
    score, _ = opened("trumpet-duet.mid")
    voices = Voices.of(score, upper, lower)
    assert len(voices.beats) > 100
    assert voices.parallels() == []
    assert voices.on_whole_beats().parallels() == []


def test_the_duet_goes_mostly_in_thirds_and_sixths():
    score, _ = opened("trumpet-duet.mid")
    pitches = Voices.of(score, 0, 1).on_whole_beats().pitches
    together = pitches[(pitches >= 0).all(axis=1)]
    kinds = np.abs(together[:, 0] - together[:, 1]) % 12
    assert np.isin(kinds, (3, 4, 8, 9)).mean() > 0.6
    # On no beat a unison or a second, and no seventh but a trill's upper note.
    assert np.isin(kinds, (3, 4, 5, 7, 8, 9, 10)).all()


def test_taps_moves_no_valve():
    score, played = opened("taps.mid")
    assert not played.fingering.valves.any()
    assert score.metre_map.pickup_beats == 1


def test_the_chromatic_scale_is_the_whole_range():
    _, played = opened("chromatic-scale.mid")
    assert set(played.line.sounding_pitch.tolist()) == set(range(52, 90))
    assert played.fingering.primary.all()


def test_the_carnival_is_fast():
    _, played = opened("carnival-of-venice.mid")
    assert np.min(np.diff(played.line.onset_s)) < 0.13


def test_the_ode_is_written_in_b_flat():
    score, played = opened("ode-to-joy.json")
    assert played.line.sounding_pitch[0] == 62
    assert TRUMPET.written_pitch(62) == 64
    assert score.parts[0].name == "Trumpet in B♭"


def test_amazing_grace_has_a_pickup():
    score, played = opened("amazing-grace.json")
    assert score.metre_map.pickup_beats == 1
    assert score.metre_map.position(4).bar == 2
    assert played.line.sounding_pitch[:3].tolist() == [60, 65, 69]
