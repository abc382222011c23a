"""The shipped scores are read, and are what the script writes."""

import runpy
from pathlib import Path

import numpy as np
import pytest

from reina.instruments import INSTRUMENTS, PlayedPart
from reina.music import Score, read_score

EXAMPLES = Path(__file__).parents[3] / "examples"
FILES = sorted((EXAMPLES / "scores").iterdir())
TRUMPET = INSTRUMENTS["trumpet"]


def opened(name: str) -> tuple[Score, PlayedPart]:
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
