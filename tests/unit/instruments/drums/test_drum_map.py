"""What each key strikes, by the kind of kit."""

import pytest
from tests.unit.instruments.drums.scores import drum_score

from reina.instruments.drums.drum_map import drum_map, kit_of, strike
from reina.instruments.drums.hit import PIECES
from reina.music.controls import Control

KITS = ("gm", "gm2", "gs", "orchestra", "brush", "xg", "electronic")


def bank(value: int) -> Control:
    return Control("controller", 0.0, 0.0, 9, 0, value)


@pytest.mark.parametrize(
    ("key", "piece"),
    [
        (35, "kick"), (36, "kick"), (38, "snare"), (40, "snare"), (41, "tom_floor"), (43, "tom_floor"),
        (45, "tom_mid"), (47, "tom_mid"), (48, "tom_high"), (50, "tom_high"), (42, "hi_hat"), (44, "hi_hat"),
        (46, "hi_hat"), (49, "crash_left"), (57, "crash_right"), (51, "ride"), (53, "ride"), (59, "ride"),
        (52, "china"), (55, "splash"), (56, "cowbell"),
    ],
)  # fmt: skip
def test_general_midis_keys_strike_their_pieces(key: int, piece: str) -> None:
    assert drum_map("gm")[key].piece == piece


def test_every_key_of_general_midi_is_known_and_every_piece_has_one() -> None:
    kit = drum_map("gm")
    assert set(range(35, 82)) <= set(kit)
    assert {said.piece for said in kit.values()} - {""} == set(PIECES)


def test_techniques_of_the_hi_hat_the_snare_and_the_ride() -> None:
    kit = drum_map("gm")
    assert [kit[key].technique for key in (42, 44, 46, 37)] == ["closed", "chick", "open", "cross_stick"]
    assert [kit[key].zone for key in (51, 53, 59)] == ["bow", "bell", "edge"]
    assert drum_map("electronic")[40].technique == "rim_shot"


@pytest.mark.parametrize("kit", KITS)
def test_what_no_piece_makes_has_a_name(kit: str) -> None:
    for said in drum_map(kit).values():
        assert bool(said.piece) != bool(said.sound)


def test_a_key_that_no_table_has_is_a_sound() -> None:
    assert strike("gm", 3).sound == "key 3"


@pytest.mark.parametrize(
    ("keys", "program", "controls", "kit"),
    [
        ({36, 38, 42}, None, (), "gm"),
        ({36, 38, 42}, 0, (bank(120),), "gm2"),
        ({36, 38, 42}, 0, (bank(127),), "xg"),
        ({36, 41, 57}, 48, (), "orchestra"),
        ({36, 39}, 40, (), "brush"),
        ({36, 38, 22}, None, (), "electronic"),
        ({36, 38, 26}, None, (Control("controller", 0.0, 0.0, 9, 4, 90),), "electronic"),
        ({36, 38, 26, 31}, None, (), "gs"),
    ],
)
def test_the_kind_of_kit_by_bank_program_and_keys(
    keys: set[int], program: int | None, controls: tuple[Control, ...], kit: str
) -> None:
    score = drum_score([(0.0, key) for key in sorted(keys)], program=program, controls=controls)
    assert kit_of(score, 0, keys) == kit
