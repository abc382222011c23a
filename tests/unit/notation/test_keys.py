"""Keys: of files, of notes, of transposing instruments."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.unit.instruments.scores import melody, score_of
from tests.unit.notation.names import numbers

from reina.music import KeySignature, Score, read_score
from reina.notation import Key, key_at, keys_of
from reina.notation.keys import MAJOR, MINOR, estimate_key

EXAMPLES = Path(__file__).parents[3] / "examples" / "scores"


def with_keys(pitches: list[int], *signatures: KeySignature) -> Score:
    score = score_of(melody(pitches))
    return replace(score, key_signatures=signatures)


@pytest.mark.parametrize(
    ("file", "name"),
    [
        ("prince-of-denmarks-march.mid", "D major"),
        ("trumpet-duet.mid", "D major"),
        ("carnival-of-venice.mid", "E♭ major"),
        ("ode-to-joy.json", "B♭ major"),
        ("amazing-grace.json", "F major"),
        ("taps.mid", "B♭ major"),
        ("chromatic-scale.mid", "no key"),
    ],
)
def test_the_examples_are_in_their_keys(file: str, name: str):
    assert keys_of(read_score((EXAMPLES / file).read_bytes(), filename=file))[0].name == name


@pytest.mark.parametrize("profile", [MAJOR, MINOR])
def test_music_that_is_as_a_key_is_found_in_it(profile: tuple[float, ...]):
    for tonic in range(12):
        key = estimate_key(np.roll(profile, tonic))
        assert 7 * key.tonic % 12 == tonic
        assert key.is_minor == (profile is MINOR)
        assert key.source == "notes"


TUNES = [
    ("Twinkle", "C5 C5 G5 G5 A5 A5 G5 F5 F5 E5 E5 D5 D5 C5", "C major"),
    ("Greensleeves", "A4 C5 D5 E5 F♯5 E5 D5 B4 G4 A4 B4 C5 A4 A4 G♯4 A4 B4 G♯4 E4", "A minor"),
    ("When the Saints", "B♭4 D5 E♭5 F5 B♭4 D5 E♭5 F5 B♭4 D5 E♭5 F5 D5 B♭4 D5 C5", "B♭ major"),
    ("God Rest Ye Merry", "E4 E4 B4 B4 A4 G4 F♯4 E4 D4 E4 F♯4 G4 A4 B4", "E minor"),
    ("Ode to Joy", "F♯5 F♯5 G5 A5 A5 G5 F♯5 E5 D5 D5 E5 F♯5 F♯5 E5 E5", "D major"),
]


@pytest.mark.parametrize(("tune", "names", "key"), TUNES, ids=[tune for tune, _, _ in TUNES])
def test_tunes_are_found_in_their_keys(tune: str, names: str, key: str):
    assert keys_of(score_of(melody(numbers(names).tolist())))[0].name == key


def test_a_key_of_the_file_holds_from_the_beginning():
    keys = keys_of(with_keys([60, 62], KeySignature(0.5, -3), KeySignature(1.0, 4, is_minor=True)))
    assert [(key.onset_beats, key.name, key.source) for key in keys] == [
        (0.0, "E♭ major", "file"),
        (1.0, "C♯ minor", "file"),
    ]
    assert key_at(keys, 0.99).fifths == -3
    assert key_at(keys, 1.0).fifths == 4


def test_c_major_alone_is_believed_only_where_the_notes_agree():
    c_major = KeySignature(0.0, 0)
    in_c, in_e = [60, 62, 64, 65, 67, 69, 71, 72], [64, 66, 68, 69, 71, 73, 75, 76]
    assert keys_of(with_keys(in_c, c_major))[0].source == "file"
    doubted = keys_of(with_keys(in_e, c_major))
    assert [(key.name, key.source) for key in doubted] == [("E major", "notes")]
    assert keys_of(with_keys(in_e, KeySignature(0.0, 1)))[0].name == "G major"
    assert keys_of(with_keys(in_e, c_major, KeySignature(1.0, 4)))[0].name == "C major"
    assert keys_of(with_keys(list(range(60, 73)), c_major))[0].source == "file"


def test_drums_are_in_no_key():
    tune = melody(numbers("C5 C5 G5 G5 A5 A5 G5 F5 F5 E5 E5 D5 D5 C5").tolist())
    drums = melody([42, 42, 46, 49, 51, 42, 54, 56] * 20)
    score = score_of(tune, drums, programs=[56, None], drums=1)
    assert keys_of(score)[0].name == "C major"


@pytest.mark.parametrize(
    ("fifths", "semitones", "written"),
    [(0, 2, 2), (-2, 2, 0), (2, 2, 4), (4, 2, 6), (5, 2, -5), (6, 2, -4), (0, -10, 2), (0, 7, 1), (0, 9, 3)],
)
def test_a_written_key_is_transposed_with_the_instrument(fifths: int, semitones: int, written: int):
    assert Key(0.0, fifths).transposed(semitones).fifths == written


def test_no_key_has_no_signature_for_any_instrument():
    none = keys_of(score_of(melody(list(range(54, 80)))))[0]
    assert (none.source, none.fifths, none.transposed(2).fifths) == ("none", 0, 0)
