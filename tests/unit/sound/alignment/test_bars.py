"""Bars and beats of a score, and where a recording has them."""

from __future__ import annotations

from typing import Any

import pytest
from tests.unit.sound.alignment.renditions import SCORES

from reina.music import Score, read_score
from reina.sound.alignment import Alignment, Anchor, Gap, MapPoint
from reina.sound.alignment.bars import aligned_bars

SLOWER, BEGINS_S = 2.0, 3.0


def score() -> Score:
    """The march: 4/4."""
    path = next(SCORES.glob("prince-of-denmarks-march.*"))
    return read_score(path.read_bytes(), filename=path.name)


def slower(march: Score, **more: Any) -> Alignment:
    end_s = march.duration_s
    points = (MapPoint(0.0, BEGINS_S, 0.9), MapPoint(end_s, BEGINS_S + SLOWER * end_s, 0.9))
    return Alignment(points, end_s, BEGINS_S + SLOWER * end_s + 1, **more)


def test_without_a_recording_bars_are_where_they_are_written() -> None:
    march = score()
    bars = aligned_bars(march, None)
    assert [bar.number for bar in bars] == list(range(1, len(bars) + 1))
    assert all(len(bar.beats) == 4 for bar in bars[:-1])
    assert all(beat.song_s == beat.score_s for bar in bars for beat in bar.beats)
    assert {bar.confidence for bar in bars} == {0.0}
    beats = march.tempo_map.beats([beat.score_s for bar in bars for beat in bar.beats])
    assert beats == pytest.approx(list(range(len(beats))), abs=1e-3)


def test_beats_are_where_they_are_heard() -> None:
    march = score()
    bars = aligned_bars(march, slower(march, offset_s=0.25))
    for bar in bars:
        assert bar.confidence == pytest.approx(0.9)
        for beat in bar.beats:
            assert beat.song_s == pytest.approx(BEGINS_S + 0.25 + SLOWER * beat.score_s, abs=1e-3)


def test_what_is_left_out_is_not_heard_until_it_is_anchored() -> None:
    march = score()
    lines = march.tempo_map.seconds(march.metre_map.bar_lines(march.duration_beats))
    begin_s, end_s = float(lines[4]), float(lines[8])
    song_s = BEGINS_S + SLOWER * begin_s
    gap = Gap(begin_s, end_s, song_s, song_s)
    heard = [bar.is_heard for bar in aligned_bars(march, slower(march, gaps=(gap,)))]
    assert heard[:10] == [True] * 4 + [False] * 4 + [True] * 2
    anchor = Anchor(float(lines[6]), BEGINS_S + SLOWER * float(lines[6]))
    put = aligned_bars(march, slower(march, gaps=(gap,), anchors=(anchor,)))
    assert all(bar.is_heard for bar in put)


def test_a_beat_in_six_eight_is_a_dotted_quarter_and_a_pickup_is_bar_0() -> None:
    text = """{"header": {"ppq": 480, "tempos": [{"ticks": 0, "bpm": 60}],
      "timeSignatures": [{"ticks": 0, "timeSignature": [1, 8]}, {"ticks": 240, "timeSignature": [6, 8]}]},
      "tracks": [{"name": "Trumpet", "notes": [
        {"midi": 60, "ticks": 0, "durationTicks": 240},
        {"midi": 62, "ticks": 240, "durationTicks": 2880}]}]}"""
    bars = aligned_bars(read_score(text.encode(), filename="tune.json"), None)
    assert [(bar.number, [beat.score_s for beat in bar.beats]) for bar in bars] == [
        (0, [0.0]),
        (1, [0.5, 2.0]),
        (2, [3.5, 5.0]),
        (3, [6.5]),
    ], "the last is the line where the music ends"
