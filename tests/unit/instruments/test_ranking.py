"""Which part the trumpet plays, and why."""

import pytest
from tests.unit.instruments.scores import melody, score_of

from reina.instruments import INSTRUMENTS
from reina.instruments.part_names import desk_of_name, kinds_of_name
from reina.instruments.ranking import monophony

TRUMPET = INSTRUMENTS["trumpet"]
TUNE = melody([65, 67, 69, 70, 72])
CHORDS = [(onset, onset + 0.45, pitch) for onset in (0.0, 0.5, 1.0, 1.5) for pitch in (60, 64, 67)]
BASS = melody([36, 38, 40, 41, 43])


TRUMPETS = """
Trumpet, TRUMPET 1, Bb Trumpet, Trumpets, Tpt., Tpt 2, Trp1, 1st Trpt, Trompete in B, Trompeten, Trompette,
Trompeta, Tromba, Trombe I, Trąbka, Trumpetti, Trombita, trubka, Труба, Trompet, トランペット, ﾄﾗﾝﾍﾟｯﾄ, 小号,
小號, 트럼펫, Τρομπέτα, חצוצרה, Clarino I, Solo Trumpet, Piccolo Trumpet"""


@pytest.mark.parametrize("name", [name.strip() for name in TRUMPETS.split(",")])
def test_names_of_the_trumpet(name: str):
    assert "trumpet" in kinds_of_name(name)


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("Trombone", "other"),
        ("Posaune", "other"),
        ("Horn in F", "other"),
        ("Cornet", "cornet"),
        ("Kornett 1", "cornet"),
        ("Flügelhorn", "flugelhorn"),
        ("Flugelhorn", "flugelhorn"),
        ("Euphonium", "euphonium"),
        ("Tuba", "tuba"),
        ("Brass Section", "brass"),
        ("Melodie", "melody"),
        ("メロディ", "melody"),
        ("Klavier", "other"),
        ("Flöte", "other"),
        ("ピアノ", "other"),
    ],
)
def test_names_of_others(name: str, kind: str):
    assert kind in kinds_of_name(name)
    assert "trumpet" not in kinds_of_name(name)


@pytest.mark.parametrize(
    ("name", "desk"),
    [
        ("Trumpet", None),
        ("Trumpet 1", 1),
        ("Tpt.2", 2),
        ("Tromba II", 2),
        ("3rd Trumpet", 3),
        ("Trompete IV", 4),
        ("Track 12", None),
    ],
)
def test_desks(name: str, desk: int | None):
    assert desk_of_name(name) == desk


def test_by_program():
    score = score_of(TUNE, TUNE, TUNE, programs=[0, 56, 40])
    ranking = TRUMPET.rank_parts(score)
    assert ranking[0].part == 1
    assert any("its sound is Trumpet, program 56" in reason for reason in ranking[0].reasons)


def test_by_name():
    score = score_of(TUNE, TUNE, names=["Violin", "Trompette"])
    ranking = TRUMPET.rank_parts(score)
    assert ranking[0].part == 1
    assert any("Trompette" in reason for reason in ranking[0].reasons)


def test_by_range_and_one_note_at_a_time_where_nothing_is_said():
    ranking = TRUMPET.rank_parts(score_of(CHORDS, BASS, TUNE))
    assert [entry.part for entry in ranking] == [2, 0, 1]
    assert "100% one note at a time (+2.0)" in ranking[0].reasons


def test_a_name_goes_before_a_program_and_the_first_desk_before_the_second():
    assert TRUMPET.rank_parts(score_of(TUNE, TUNE, names=["Lead", "Trumpet"], programs=[61, 0]))[0].part == 1
    assert TRUMPET.rank_parts(score_of(TUNE, TUNE, names=["Trumpet 2", "Trumpet 1"]))[0].part == 1
    assert TRUMPET.rank_parts(score_of(TUNE, TUNE, names=["Trumpet", "Trumpet"]))[0].part == 0


def test_drums_come_last():
    ranking = TRUMPET.rank_parts(score_of(TUNE, BASS, drums=0))
    assert ranking[-1].part == 0
    assert ranking[-1].reasons[0].startswith("drums")


def test_a_part_of_few_notes_is_not_preferred_for_being_clean():
    assert TRUMPET.rank_parts(score_of(TUNE[:1], melody([65, 67] * 20)))[0].part == 1


def test_a_made_up_name_counts_for_nothing():
    score = score_of(TUNE)
    assert not any("named" in reason for reason in TRUMPET.rank_parts(score)[0].reasons)


def test_every_part_is_ranked_with_reasons_that_add_up():
    for ranking in TRUMPET.rank_parts(
        score_of(CHORDS, BASS, TUNE, names=["Piano", "Bass", "Solo"], programs=[0, 32])
    ):
        weights = [float(reason.rsplit("(", 1)[1].rstrip(")")) for reason in ranking.reasons]
        assert sum(weights) == pytest.approx(ranking.score, abs=0.05 * len(weights))
        assert [abs(weight) for weight in weights] == sorted(
            (abs(weight) for weight in weights), reverse=True
        )


def test_others_of_the_family_choose_for_themselves():
    score = score_of(TUNE, BASS, melody([50, 53, 55]), names=["Trumpet", "Tuba", "Euphonium"])
    assert [INSTRUMENTS[name].rank_parts(score)[0].part for name in ("trumpet", "tuba", "euphonium")] == [
        0,
        1,
        2,
    ]


@pytest.mark.parametrize("instrument", ["trumpet", "cornet", "flugelhorn"])
def test_each_horn_ranks_its_own_part_best(instrument: str):
    names = ["Trumpet", "Cornet", "Flugelhorn"]
    for programs in ([], [56, 56, 56]):
        score = score_of(TUNE, TUNE, TUNE, names=names, programs=programs)
        best = INSTRUMENTS[instrument].rank_parts(score)[0]
        assert names[best.part].lower() == instrument
        # And of the three, none wants it more.
        part = [
            next(entry.score for entry in other.rank_parts(score) if entry.part == best.part)
            for other in INSTRUMENTS.values()
            if other.rig
        ]
        assert max(part) == best.score
        assert part.count(best.score) == 1


def test_monophony():
    assert monophony(score_of(TUNE).notes) == 1.0
    assert monophony(score_of(CHORDS).notes) == pytest.approx(1 - 8 / 11)
    legato = [(0.0, 0.55, 60), (0.5, 1.05, 62), (1.0, 1.5, 64)]
    assert monophony(score_of(legato).notes) == 1.0
