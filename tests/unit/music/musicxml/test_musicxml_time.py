"""What stretches time in MusicXML: *rit.* and *accel.*, "a tempo", fermatas, breaths and caesuras."""

from __future__ import annotations

import math

import pytest
from tests.unit.music.musicxml.musicxml_text import (
    REPEAT_BEGINS,
    articulations,
    attributes,
    barline,
    direction,
    document,
    ending,
    measures,
    notations,
    note,
    tempo,
    words,
)

from reina.music import Limits, Score, ScoreLimitError, read_score

FOUR = note("C4") * 4


def read(*parts: str) -> Score:
    return read_score(document(*parts), filename="Test.musicxml")


def bpm_at(score: Score, beat: float) -> float:
    return next(t for t in reversed(score.tempo_map.tempos) if t.onset_beats <= beat).beats_per_minute


def onsets(score: Score) -> list[float]:
    return [round(one.onset_s, 4) for one in score.notes]


def fermata(shape: str = "") -> str:
    return notations(f'<fermata type="upright">{shape}</fermata>')


def test_a_ritardando_brakes_evenly_and_a_tempo_ends_it() -> None:
    score = read(measures(attributes() + tempo(120) + FOUR, words("rit.") + FOUR, words("a tempo") + FOUR))
    # v² falls evenly from 120² to 90² over the bar: its seconds are 2 s / (1 + 3/4) * 2.
    assert score.tempo_map.seconds(8.0) - score.tempo_map.seconds(4.0) == pytest.approx(4 * 2 * 0.5 / 1.75)
    lengths = score.tempo_map.seconds_per_beat[1:-1]
    assert (lengths[1:] >= lengths[:-1]).all()
    half = 120 * math.sqrt(1 - 0.5 * (1 - 0.75**2))
    assert bpm_at(score, 6.01) == pytest.approx(half, rel=0.02)
    assert bpm_at(score, 8.0) == pytest.approx(120)
    assert score.warnings == ()


@pytest.mark.parametrize(
    ("text", "bpm"),
    [
        ("poco rit.", 102),
        ("molto rallentando", 72),
        ("accel.", 150),
        ("molto accel.", 180),
        ("poco a poco accel.", 150),
        ("stringendo", 150),
        ("riten.", 90),
        ("senza rit.", 120),
        ("string quartet", 120),
        ("dolce", 120),
    ],
)
def test_what_the_words_lead_to(text: str, bpm: float) -> None:
    score = read(measures(attributes() + tempo(120) + words(text) + FOUR, *[FOUR] * 5))
    assert bpm_at(score, 20.0) == pytest.approx(bpm)


def test_a_ritenuto_holds_back_at_once() -> None:
    score = read(measures(attributes() + tempo(120) + note("C4", 2) + words("riten.") + note("C4", 2)))
    assert [(t.onset_beats, t.beats_per_minute) for t in score.tempo_map.tempos] == [
        (0.0, pytest.approx(120)),
        (2.0, pytest.approx(90)),
    ]


def test_a_change_leads_to_the_slower_tempo_that_follows_and_not_to_a_faster_one() -> None:
    slower = read(measures(attributes() + tempo(120) + words("rit.") + FOUR, tempo(60) + FOUR))
    assert slower.tempo_map.seconds(4.0) == pytest.approx(4 * 2 * 0.5 / 1.5)
    faster = read(measures(attributes() + tempo(120) + words("rit.") + FOUR, tempo(140) + FOUR))
    assert faster.tempo_map.seconds(4.0) == pytest.approx(4 * 2 * 0.5 / 1.75)
    assert bpm_at(faster, 4.0) == pytest.approx(140)


def test_a_change_that_nothing_ends_lasts_four_bars() -> None:
    score = read(measures(attributes() + tempo(120) + words("rit.") + FOUR, *[FOUR] * 9))
    assert bpm_at(score, 15.9) > 90.0
    assert bpm_at(score, 16.0) == pytest.approx(90)
    assert len(score.tempo_map.tempos) == 65


def test_dashes_say_how_far_it_reaches() -> None:
    begins = (
        "<direction><direction-type><words>rit.</words></direction-type>"
        '<direction-type><dashes type="start" number="1"/></direction-type></direction>'
    )
    stops = direction('<dashes type="stop" number="1"/>')
    score = read(measures(attributes() + tempo(120) + begins + note("C4", 2) + stops + note("C4", 2), FOUR))
    assert bpm_at(score, 1.9) > 90.0
    assert bpm_at(score, 2.0) == pytest.approx(90)


def test_a_tempo_leads_back_to_the_number_and_tempo_primo_to_the_first() -> None:
    score = read(
        measures(
            attributes() + tempo(120) + FOUR,
            tempo(80) + FOUR,
            words("accel.") + FOUR,
            words("a tempo") + FOUR,
            words("Tempo I") + FOUR,
        )
    )
    assert bpm_at(score, 12.0) == pytest.approx(80)
    assert bpm_at(score, 16.0) == pytest.approx(120)


def test_words_with_a_number_of_their_own_are_that_number() -> None:
    score = read(measures(attributes() + tempo(120) + words("rit.", '<sound tempo="50"/>') + FOUR))
    assert [t.beats_per_minute for t in score.tempo_map.tempos] == [pytest.approx(50)]


def test_words_of_several_parts_are_one() -> None:
    one = measures(attributes() + tempo(120) + words("rit.") + FOUR, words("a tempo") + FOUR)
    assert read(one, one).tempo_map.tempos == read(one).tempo_map.tempos


def test_a_ritardando_before_a_repeat_is_made_each_time_and_left_behind() -> None:
    score = read(
        measures(
            attributes() + tempo(120) + REPEAT_BEGINS + FOUR,
            ending("1", "start") + words("rit.") + FOUR
            + ending("1", "stop", '<repeat direction="backward"/>'),
            ending("2", "start") + FOUR + ending("2", "stop"),
        )
    )  # fmt: skip
    assert [bpm_at(score, beat) for beat in (0.0, 8.0, 12.0)] == [pytest.approx(120)] * 3
    assert bpm_at(score, 7.9) < 100


def test_a_fermata_holds_all_parts_by_half_of_its_note() -> None:
    held = measures(attributes() + tempo(120) + note("C5", 2) + note("D5", 2, inner=fermata()), FOUR)
    moving = measures(attributes() + FOUR, FOUR)
    score = read(held, moving)
    # The last quarter of the other part waits: what moves before it keeps its tempo.
    lower = [round(one.onset_s, 4) for one in score.notes if one.part == 1]
    assert lower[:5] == [0.0, 0.5, 1.0, 1.5, 2.5]
    assert score.tempo_map.seconds(8.0) == pytest.approx(4.5)
    assert score.warnings == ()


def test_fermatas_of_several_parts_hold_once_and_each_time_it_is_played() -> None:
    bar = note("C5", 2) + note("D5", 2, inner=fermata())
    two = measures(attributes() + tempo(120) + bar + barline('<repeat direction="backward"/>'), FOUR)
    score = read(two, two)
    assert [round(one.onset_s, 4) for one in score.notes if one.part == 0][:5] == [0.0, 1.0, 2.5, 3.5, 5.0]


@pytest.mark.parametrize(
    ("shape", "seconds"), [("normal", 1.5), ("angled", 1.25), ("square", 2.0), ("odd", 1.5)]
)
def test_the_shape_of_a_fermata_says_how_long(shape: str, seconds: float) -> None:
    score = read(measures(attributes() + tempo(120) + note("C5", 2) + note("D5", 2, inner=fermata(shape))))
    assert score.duration_s == pytest.approx(1.0 + seconds)


def test_rests_and_bar_lines_are_held_too() -> None:
    rest = note("r", 2, inner=fermata())
    score = read(measures(attributes() + tempo(120) + note("C5", 2) + rest, FOUR))
    assert onsets(score)[1] == pytest.approx(2.5)
    line = read(measures(attributes() + tempo(120) + FOUR + barline("<fermata/>"), FOUR))
    assert onsets(line)[3:5] == [1.5, 2.25]


def test_a_fermata_adds_four_seconds_at_most() -> None:
    score = read(measures(attributes() + tempo(30) + note("C5", 4, inner=fermata("double-square"))))
    assert score.duration_s == pytest.approx(8.0 + 4.0)


def test_a_fermata_within_a_ritardando_holds_what_is_slow_by_then() -> None:
    score = read(
        measures(
            attributes() + tempo(120) + words("rit.") + note("C4", 3) + note("C4", 1, inner=fermata()),
            words("a tempo") + FOUR,
        )
    )
    plain = 4 * 2 * 0.5 / 1.75
    assert plain + 0.25 < score.tempo_map.seconds(4.0) < plain + 0.34
    assert bpm_at(score, 4.0) == pytest.approx(120)


def test_a_breath_is_of_the_note_and_a_caesura_stops_all() -> None:
    score = read(
        measures(
            attributes() + tempo(120) + note("C4", 2, inner=articulations("breath-mark"))
            + note("C4", 2, inner=articulations("caesura")),
            FOUR,
        )
    )  # fmt: skip
    assert [round(one.duration_s, 4) for one in score.notes][:2] == [0.875, 0.75]
    assert onsets(score)[:3] == [0.0, 1.0, 2.25]


def test_what_bends_a_pitch_is_told() -> None:
    score = read(measures(attributes() + note("C4", 2, inner=articulations("falloff")) * 2))
    assert [warning.message for warning in score.warnings] == ["a falloff: not played, and 1 more"]


def test_very_many_changes_of_tempo_are_refused() -> None:
    bar = words("rit.") + note("C4", 2) + words("a tempo") + note("C4", 2)
    data = document(measures(attributes() + bar, *[bar] * 20))
    with pytest.raises(ScoreLimitError, match="changes of tempo"):
        read_score(data, limits=Limits(events=100))
