"""Names of pitches, against those that composers and textbooks write."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.notation.names import number, spelled

from reina.notation import Key, both_names, named, spell
from reina.notation.spelling import alteration

SHARPS, FLATS = "FCGDAEB", "BEADGCF"


def scale(key: Key) -> list[str]:
    """The letters of a key's scale with their accidentals, from C up, as its signature has them."""
    altered = SHARPS[: key.fifths] if key.fifths > 0 else FLATS[: -key.fifths]
    sign = "♯" if key.fifths > 0 else "♭"
    return [letter + (sign if letter in altered else "") for letter in "CDEFGAB"]


@pytest.mark.parametrize("fifths", range(-7, 8))
def test_scales_in_all_keys_take_the_names_of_the_signature(fifths: int):
    names = sorted((f"{name}{octave}" for name in scale(Key(0.0, fifths)) for octave in (4, 5)), key=number)
    up_and_down = " ".join([*names, *reversed(names)])
    assert spelled(up_and_down, Key(0.0, fifths)) == up_and_down


@pytest.mark.parametrize("fifths", range(-7, 5))
def test_minor_scales_rise_over_the_raised_sixth_and_seventh(fifths: int):
    key = Key(0.0, fifths, is_minor=True)
    natural = scale(key)
    raise_by_one = {"♭": "", "": "♯"}
    tonic = "CDEFGAB".index("FCGDAEB"[(key.tonic + 1) % 7])
    steps = [natural[(tonic + step) % 7] for step in range(8)]
    melodic = [name[0] + raise_by_one[name[1:]] if at in (5, 6) else name for at, name in enumerate(steps)]

    def rising(names: list[str]) -> list[str]:
        placed: list[str] = []
        octave = 4
        for name in names:
            while placed and number(f"{name}{octave}") <= number(placed[-1]):
                octave += 1
            placed.append(f"{name}{octave}")
        return placed

    line = " ".join([*rising(melodic), *reversed(rising(steps)[:-1])])
    assert spelled(line, key) == line


PASSAGES = [
    ("the chromatic scale", Key(0.0, 0), "C4 C♯4 D4 D♯4 E4 F4 F♯4 G4 G♯4 A4 B♭4 B4 C5"),
    ("and down", Key(0.0, 0), "C5 B4 B♭4 A4 A♭4 G4 F♯4 F4 E4 E♭4 D4 D♭4 C4"),
    ("Für Elise", Key(0.0, 0, is_minor=True), "E5 D♯5 E5 D♯5 E5 B4 D5 C5 A4 C4 E4 A4 B4 E4 G♯4 B4 C5"),
    ("the same, marked as C major", Key(0.0, 0), "E5 D♯5 E5 D♯5 E5 B4 D5 C5 A4 C4 E4 A4 B4 E4 G♯4 B4 C5"),
    ("Toccata in D minor", Key(0.0, -1, is_minor=True), "A5 G5 A5 G5 F5 E5 D5 C♯5 D5"),
    ("Hall of the Mountain King", Key(0.0, 2, is_minor=True), "B3 C♯4 D4 E4 F♯4 D4 F♯4 E♯4 C♯4 E♯4 E4 C4 E4"),
    ("Flight of the Bumblebee", Key(0.0, 0, is_minor=True), "E6 D♯6 D6 C♯6 D6 C♯6 C6 B5 C6 B5 B♭5 A5 A♭5 G5"),
    ("Carnival of Venice", Key(0.0, -1), "C5 D5 C5 B4 C5 D5 C5 B♭4 A4 B♭4 G4 F♯4 G4 A4 B♭4"),
    ("Haydn's concerto, third movement", Key(0.0, -3), "E♭5 B♭4 E♭5 F5 G5 A♭5 G5 F♯5 G5 E♭5 A4 B♭4"),
    ("a neighbour below", Key(0.0, 1), "D5 C♯5 D5 B4 A♯4 B4 G4"),
    ("blues thirds and sevenths", Key(0.0, 0), "C5 E♭5 E5 G5 B♭5 G5 E♭5 C5"),
    ("a dominant of the dominant", Key(0.0, -4), "E♭5 D5 E♭5 C5 A♭4 B♭4 C5"),
    ("a Neapolitan", Key(0.0, -3, is_minor=True), "C5 D♭5 F5 A♭5 G5 B4 C5"),
    ("a diminished seventh", Key(0.0, 1, is_minor=True), "E5 D♯5 F♯5 A5 C6 B5 A5 G5 F♯5 E5"),
    ("Caprice 24", Key(0.0, 0, is_minor=True), "A5 A5 C6 B5 A5 E6 E5 G♯5 F♯5 E5 A5"),
]


KNOWN_WRONG = {
    "Hall of the Mountain King": [("E♯4", "F4")],
    "Flight of the Bumblebee": [("D♯6", "E♭6")],
}
"""Falling chromatic steps that their composers write with sharps."""


@pytest.mark.parametrize(("passage", "key", "names"), PASSAGES, ids=[passage for passage, _, _ in PASSAGES])
def test_well_known_passages(passage: str, key: Key, names: str):
    pairs = zip(names.split(), spelled(names, key).split(), strict=True)
    assert [pair for pair in pairs if pair[0] != pair[1]] == KNOWN_WRONG.get(passage, [])


def test_what_is_spelled_right_of_all_passages():
    """The figure that docs/notation.md tells."""
    pairs = [
        pair
        for _, key, names in PASSAGES
        for pair in zip(names.split(), spelled(names, key).split(), strict=True)
    ]
    right = sum(true == got for true, got in pairs)
    assert right / len(pairs) > 0.97


@pytest.mark.parametrize("fifths", range(-4, 5))
def test_a_transposing_part_is_spelled_as_its_own_key_has_it(fifths: int):
    """Written a tone higher it has the same intervals, but where that would need two accidentals."""
    rng = np.random.default_rng(fifths + 5)
    pitches = np.cumsum(rng.integers(-3, 4, 60)) + 70
    beats = np.arange(60, dtype=np.float64) * 0.5
    keys = [Key(0.0, fifths)]
    sounding = spell(pitches, beats, keys)
    written = spell(pitches + 2, beats, keys, semitones=2)
    assert np.mean(written - sounding == 2) > 0.85
    assert keys[0].transposed(2).fifths == fifths + 2


def test_after_a_change_of_key_the_new_one_holds():
    pitches = np.array([66, 66, 66])
    keys = [Key(0.0, 2), Key(1.0, -6), Key(2.0, 1)]
    names = spell(pitches, np.array([0.0, 1.0, 8.0], dtype=np.float64), keys)
    assert [named(66, name) for name in names.tolist()] == ["F♯4", "G♭4", "F♯4"]


@given(
    pitches=st.lists(st.integers(0, 127), max_size=60),
    fifths=st.integers(-7, 7),
    is_minor=st.booleans(),
    semitones=st.integers(-48, 48),
)
def test_every_name_sounds_its_pitch_and_has_one_accidental_at_most(
    pitches: list[int], fifths: int, is_minor: bool, semitones: int
):
    array = np.array(pitches, dtype=np.int64)
    names = spell(
        array, np.arange(len(array), dtype=np.float64), [Key(0.0, fifths, is_minor)], semitones=semitones
    )
    for pitch, name in zip(pitches, names.tolist(), strict=True):
        assert 7 * name % 12 == pitch % 12
        assert abs(alteration(name)) <= 1
        text = named(pitch, name)
        if pitch >= 13:
            assert number(text) == pitch


def test_charts_name_black_keys_twice():
    assert [both_names(pitch) for pitch in (54, 55, 70, 72)] == [
        ("F♯3", "G♭3"),
        ("G3",),
        ("A♯4", "B♭4"),
        ("C5",),
    ]
