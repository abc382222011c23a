"""Who plays a score where nobody has said so, and why nobody plays the rest."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest
from tests.unit.instruments.scores import melody, score_of

from reina.instruments import (
    INSTRUMENTS,
    MAX_PLAYERS,
    Cast,
    Casting,
    casting_reasons,
    find_cast,
    unplayed_parts,
)

if TYPE_CHECKING:
    from reina.music import Score

KINDS = {name: INSTRUMENTS[name] for name in ("trumpet", "cornet", "flugelhorn")}
PLAYERS = dict.fromkeys(KINDS, ("trumpeter", "soloist"))
HIGH, LOW, LOWER, LOWEST = (melody([pitch + step for step in (0, 2, 4, 5, 7)]) for pitch in (70, 65, 60, 56))
BASS = melody([36, 38, 40, 41, 43])


def found(score: Score) -> Cast:
    return find_cast(score, KINDS, PLAYERS)


def cast(*parts: list[tuple[float, float, int]], names: str) -> list[tuple[str, str, str]]:
    """Of parts by their names: who plays which on what."""
    score = score_of(*parts, names=names.split(", "))
    return [(score.parts[one.part or 0].name, one.instrument, one.player) for one in found(score).castings]


def why_not(*parts: list[tuple[float, float, int]], names: str) -> dict[str, str]:
    score = score_of(*parts, names=names.split(", "))
    return {score.parts[one.part].name: one.reason for one in unplayed_parts(score, found(score), KINDS)}


def test_of_one_trumpet_the_trumpeter_plays_it_whatever_else_there_is() -> None:
    assert cast(HIGH, LOW, BASS, names="Flute, Trumpet, Bass") == [("Trumpet", "trumpet", "trumpeter")]
    assert cast(HIGH, names="Cornet solo") == [("Cornet solo", "trumpet", "trumpeter")]


def test_of_no_trumpet_the_part_that_suits_best_is_played_as_before() -> None:
    score = score_of(HIGH, BASS, names=["Violin", "Cello"])
    assert [one.part for one in found(score).castings] == [KINDS["trumpet"].rank_parts(score)[0].part]
    drums = score_of(BASS, names=["Drums"], drums=0)
    assert [one.part for one in found(drums).castings] == [0]
    assert casting_reasons(drums, found(drums), KINDS) == (("a part for drums, played on the trumpet",),)


def test_two_trumpets_are_two_players_of_different_figures() -> None:
    assert cast(HIGH, LOW, BASS, names="Trumpet 1, Trumpet 2, Tuba") == [
        ("Trumpet 1", "trumpet", "trumpeter"),
        ("Trumpet 2", "trumpet", "soloist"),
    ]


def test_parts_are_in_the_order_of_their_desks() -> None:
    names = [name for name, _, _ in cast(LOW, HIGH, LOWER, names="Trumpet 2, Trumpet 1, Trumpet 3")]
    assert names == ["Trumpet 1", "Trumpet 2", "Trumpet 3"]


def test_parts_without_names_are_known_by_their_programs() -> None:
    score = score_of(HIGH, LOW, LOWER, programs=[56, 59, 73])
    assert [one.part for one in found(score).castings] == [0, 1]


def test_a_big_band_has_four_trumpets_and_a_fifth_is_heard_alone() -> None:
    parts = [melody([70 - 3 * k + s for s in (0, 2, 4, 5, 7)]) for k in range(5)]
    names = "Trumpet 1, Trumpet 2, Trumpet 3, Trumpet 4, Trumpet 5, Alto Sax, Trombone 1"
    players = cast(*parts, LOW, LOWER, names=names)
    assert [name for name, _, _ in players] == [f"Trumpet {desk}" for desk in (1, 2, 3, 4)]
    assert [player for _, _, player in players] == ["trumpeter", "soloist", "trumpeter", "soloist"]
    told = why_not(*parts, LOW, LOWER, names=names)
    assert told["Trumpet 5"] == f"{MAX_PLAYERS} play at once at most; it is heard"
    assert told["Alto Sax"] == "no player for saxophone yet; it is heard"
    assert told["Trombone 1"] == "no player for trombone yet; it is heard"


def test_of_a_brass_quintet_the_two_trumpets_play() -> None:
    names = "Trumpet in Bb 1, Trumpet in Bb 2, Horn in F, Trombone, Tuba"
    assert len(cast(HIGH, LOW, LOWER, LOWEST, BASS, names=names)) == 2
    assert set(why_not(HIGH, LOW, LOWER, LOWEST, BASS, names=names)) == {"Horn in F", "Trombone", "Tuba"}


def test_each_plays_the_instrument_that_the_part_is_named_after() -> None:
    assert cast(HIGH, LOW, LOWER, names="Cornet 1, Trumpet, Flugelhorn") == [
        ("Trumpet", "trumpet", "trumpeter"),
        ("Cornet 1", "cornet", "soloist"),
        ("Flugelhorn", "flugelhorn", "trumpeter"),
    ]


def test_who_doubles_another_in_unison_is_heard_and_not_seen() -> None:
    names = "Trumpet 1, Flugelhorn, Trumpet 2"
    assert [name for name, _, _ in cast(HIGH, HIGH, LOW, names=names)] == ["Trumpet 1", "Trumpet 2"]
    told = why_not(HIGH, HIGH, LOW, names=names)["Flugelhorn"]
    assert told == "100% of its notes are “Trumpet 1”'s too; it is heard"
    octave = [(onset, end, pitch - 12) for onset, end, pitch in HIGH]
    assert len(cast(HIGH, octave, names="Trumpet, Flugelhorn")) == 2


def test_what_is_played_only_where_another_rests_is_no_second_player() -> None:
    later = [(onset + 5.0, end + 5.0, pitch) for onset, end, pitch in LOW]
    names = "Trumpet, Trumpet (muted)"
    assert cast(HIGH, later, names=names) == [("Trumpet", "trumpet", "trumpeter")]
    told = why_not(HIGH, later, names=names)["Trumpet (muted)"]
    assert told.startswith("it plays only where “Trumpet” rests, as one player's music in two parts does")
    # Two desks that answer each other are two players.
    assert len(cast(HIGH, later, names="Trumpet 1, Trumpet 2")) == 2
    # With others on the stage the two parts are one player's.
    score = score_of(HIGH, later, LOW, names=["Trumpet 1", "Trumpet 1 muted", "Trumpet 2"])
    castings = found(score).castings
    assert [(one.part, one.joined_parts) for one in castings] == [(0, (1,)), (2, ())]
    assert "“Trumpet 1 muted” is played together with it" in casting_reasons(score, found(score), KINDS)[0][1]


def test_an_effect_and_what_lies_out_of_range_are_no_players() -> None:
    long = melody([70 + step for step in range(12)] * 5)
    assert len(cast(long, LOW[:1], names="Trumpet 1, Trumpet 2")) == 1
    assert why_not(long, LOW[:1], names="Trumpet 1, Trumpet 2")["Trumpet 2"].startswith("only 1 note, beside")
    told = why_not(HIGH, BASS, names="Trumpet 1, Trumpet 2")["Trumpet 2"]
    assert told == "only 0% of its notes are a trumpet's; it is heard"
    told = why_not(HIGH, BASS, names="Trumpet, Trumpet or bass")["Trumpet or bass"]
    assert told == "no player for bass yet; it is heard"


def test_names_of_other_instruments_are_no_trumpets_whatever_their_program() -> None:
    score = score_of(HIGH, LOW, names=["Trumpet", "Violin 2"], programs=[56, 56])
    assert len(found(score).castings) == 1
    assert unplayed_parts(score, found(score), KINDS)[0].reason == "no player for violin yet; it is heard"


def test_a_cast_that_somebody_chose_is_told_about_too() -> None:
    score = score_of(HIGH, LOW, names=["Trumpet 1", "Trumpet 2"])
    alone = found(score).changed(joined_parts=(1,))
    assert (len(alone.castings), alone.auto) == (1, False)
    first = found(score).changed(part=1)
    assert [one.part for one in first.castings] == [1, 0]
    reasons = unplayed_parts(score, Cast((first.castings[0],)), KINDS)
    assert "nobody was cast for it" in reasons[0].reason


@pytest.mark.parametrize("sequence", [None, 2])
def test_a_found_cast_says_that_it_was_found_and_of_which_sequence(sequence: int | None) -> None:
    score = score_of(HIGH, LOW, names=["Trumpet 1", "Trumpet 2"])
    cast = find_cast(score, KINDS, PLAYERS, sequence=sequence)
    assert (cast.auto, cast.is_to_be_found, cast.sequence) == (True, False, sequence)
    assert cast.changed(sequence=5).is_to_be_found
    assert cast.found_anew().is_to_be_found
    # Of another sequence with a wish for the first player that one plays alone.
    assert len(cast.changed(sequence=5, transposition=2).castings) == 1


@pytest.mark.parametrize(
    ("key", "played", "why"),
    [
        (38, Casting(part=0), "drums; nobody was cast for them; it is heard"),
        (82, Casting(part=0), "the drum kit has none of its sounds; it is heard"),
        (38, Casting(part=2, instrument="drums"), "other drums are played; it is heard"),
    ],
)
def test_why_nobody_plays_drums_is_said_as_it_is(key: int, played: Casting, why: str) -> None:
    score = score_of(
        HIGH, [(0.0, 0.1, key)], [(0.0, 0.1, 36)], names=["Trumpet", "Drums A", "Drums B"], drums=1
    )
    score = replace(score, parts=(*score.parts[:2], replace(score.parts[2], is_drums=True)))
    told = {one.part: one.reason for one in unplayed_parts(score, Cast((played,)), INSTRUMENTS)}
    assert told[1] == why


def test_a_drummer_plays_a_part_for_drums() -> None:
    score = score_of(HIGH, [(0.0, 0.1, 38)], names=["Trumpet", "Drums"], drums=1)
    drummer = Cast((Casting(part=1, instrument="drums"),))
    assert casting_reasons(score, drummer, INSTRUMENTS) == (("a part for drums",),)


@pytest.mark.parametrize(
    ("others", "joined"),
    [
        ([[36, 36, 49], [42, 42, 42, 46]], (0, 1)),
        # Snare 2 beside a snare is another drummer's; so is what is mostly hand percussion.
        ([[36, 38], [42, 42]], (1,)),
        ([[36, 56], [56, 60, 61, 62]], (0,)),
    ],
    ids=["a kit in three parts", "two drummers", "a percussionist"],
)
def test_a_kit_that_is_spread_over_parts_is_one_drummers(
    others: list[list[int]], joined: tuple[int, ...]
) -> None:
    keys = [*others, [38] * 6]
    score = score_of(*(melody(part) for part in keys), names=["Drums A", "Drums B", "Snare"])
    score = replace(score, parts=tuple(replace(part, is_drums=True) for part in score.parts))
    players = dict.fromkeys(INSTRUMENTS, ("trumpeter", "soloist"))
    (drummer,) = find_cast(score, INSTRUMENTS, players).castings
    assert (drummer.part, drummer.joined_parts) == (2, joined)
