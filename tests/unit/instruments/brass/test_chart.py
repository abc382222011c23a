"""The fingering chart and the acoustics behind it."""

import csv
import math
from pathlib import Path

import pytest

import reina.instruments
from reina.instruments import pitch_name
from reina.instruments.brass import ValvedBrass
from reina.instruments.brass.chart import read_valves, show_valves, three_valve_chart
from reina.instruments.brass.family import FAMILY

TRUMPET = FAMILY["trumpet"]
CSV = Path(reina.instruments.__file__).parent / "brass" / "fingerings.csv"

WELL_KNOWN = """
F♯3:123 G3:13 B♭3:1 C4:0 C♯4:123 D4:13 E♭4:23 E4:12 F4:1 F♯4:2 G4:0 A♭4:23 A4:12 B♭4:1 B4:2 C5:0 C♯5:12 D5:1
E5:0 F5:1 G5:0 A5:12 C6:0"""
"""What every method for trumpet begins with, by written pitch."""


def test_the_chart_has_every_playable_pitch():
    model = TRUMPET.model
    assert (model.lowest, model.highest) == (52, 89)
    assert list(model.chart) == list(range(52, 90))


def test_the_chart_is_the_table():
    with CSV.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 38
    for row in rows:
        entry = TRUMPET.model.chart[int(row["sounding_midi"])]
        assert int(row["written_midi"]) == int(row["sounding_midi"]) + 2
        assert entry.primary == read_valves(row["primary"])
        assert entry.alternates == tuple(read_valves(v) for v in row["alternates"].split(";") if v)


def test_well_known_fingerings():
    by_name = {pitch_name(written): entry.primary for written, entry in three_valve_chart().items()}
    for name, valves in (pair.split(":") for pair in WELL_KNOWN.split()):
        assert by_name[name] == read_valves(valves), name


def test_valves_are_read_and_shown():
    assert read_valves("0") == ()
    assert read_valves("123") == (1, 2, 3)
    assert show_valves((1, 3)) == "1-3"
    assert show_valves(()) == "open"
    for wrong in ("", "31", "11", "x"):
        with pytest.raises(ValueError, match=r"."):
            read_valves(wrong)


@pytest.mark.parametrize("name", FAMILY)
def test_every_fingering_of_every_chart_sounds_its_pitch(name: str):
    instrument = FAMILY[name]
    assert isinstance(instrument, ValvedBrass)
    tube = instrument.model.tube
    for pitch, entry in instrument.model.chart.items():
        assert abs(tube.cents(pitch, entry.primary)) < 60
        for valves in entry.alternates:
            assert abs(tube.cents(pitch, valves)) < 50


def test_the_primaries_follow_from_the_acoustics():
    # Of all eight combinations the usual one is nearly the best in tune among those with the fewest valves.
    tube = TRUMPET.model.tube
    combinations = [read_valves(text) for text in ("0", "1", "2", "3", "12", "13", "23", "123")]
    for pitch, entry in TRUMPET.model.chart.items():
        in_tune = [valves for valves in combinations if abs(tube.cents(pitch, valves)) < 50]
        assert entry.primary in in_tune
        assert set(entry.alternates) <= set(in_tune)


def test_harmonics_and_cents_by_hand():
    tube = TRUMPET.model.tube
    assert [tube.harmonic(pitch, ()) for pitch in (58, 65, 70, 74, 77, 82)] == [2, 3, 4, 5, 6, 8]
    assert tube.cents(74, ()) == pytest.approx(1200 * math.log2(5 / 4) - 400)
    assert tube.cents(65, ()) == pytest.approx(1200 * math.log2(3 / 2) - 700)
    # Valves that are in tune alone are too short together.
    low_c_sharp = tube.cents(59, (1, 2, 3))
    assert 30 < low_c_sharp < 60
    assert tube.lowering((1, 2, 3)) < 600


def test_the_third_slide_brings_low_c_sharp_and_d_into_tune():
    tube = TRUMPET.model.tube
    d, c_sharp = tube.slide_for(60, (1, 3)), tube.slide_for(59, (1, 2, 3))
    assert 0 < d < c_sharp < 1
    assert tube.cents(60, (1, 3), d) == pytest.approx(0, abs=1e-9)
    assert tube.cents(59, (1, 2, 3), c_sharp) == pytest.approx(0, abs=1e-9)
    assert tube.slide_for(58, ()) == 0
    assert tube.slide_for(61, (2, 3)) < 0.1


def test_the_family():
    held = [name for name, instrument in FAMILY.items() if instrument.rig]
    assert held == ["trumpet", "cornet", "flugelhorn"]
    assert set(FAMILY) == {
        "trumpet",
        "c_trumpet",
        "cornet",
        "euphonium",
        "flugelhorn",
        "piccolo_trumpet",
        "tuba",
    }
    euphonium, tuba = FAMILY["euphonium"], FAMILY["tuba"]
    assert isinstance(euphonium, ValvedBrass)
    assert isinstance(tuba, ValvedBrass)
    # B♭ on the open horn, in every size; C below it with 1-3 or the fourth valve.
    assert euphonium.model.chart[46].primary == tuba.model.chart[34].primary == ()
    assert euphonium.model.chart[41].primary == (4,)
    assert (1, 3) in euphonium.model.chart[41].alternates
    assert FAMILY["cornet"].written_pitch(60) == 62
    assert FAMILY["piccolo_trumpet"].written_pitch(70) == 60
    assert [len(instrument.parameters) for instrument in FAMILY.values()] == [
        instrument.valve_count + 2 for instrument in FAMILY.values()
    ]


def test_parameters():
    assert [parameter.path for parameter in TRUMPET.parameters] == [
        "trumpet/valve/1",
        "trumpet/valve/2",
        "trumpet/valve/3",
        "trumpet/slide/3",
        "trumpet/mute",
    ]
    numbers = [parameter for parameter in TRUMPET.parameters if parameter.type == "number"]
    assert all((parameter.minimum, parameter.maximum) == (0, 1) for parameter in numbers)


def test_pitch_names():
    assert [pitch_name(number) for number in (0, 52, 60, 61, 70, 89)] == [
        "C-1",
        "E3",
        "C4",
        "C♯4",
        "B♭4",
        "F6",
    ]
