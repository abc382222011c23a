"""The fingering chart: which valves sound a pitch, the usual ones first."""

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

Valves = tuple[int, ...]
"""Numbers of the valves that are down, ascending; () is open."""


def read_valves(text: str) -> Valves:
    """Read valves as charts write them: ``"12"``, ``"0"`` for open.

    Raises:
        ValueError: If it is none.
    """
    valves = tuple(int(digit) for digit in text if digit != "0")
    if not text or list(valves) != sorted(set(valves)):
        raise ValueError(f"{text!r} is no fingering; 0, 2 or 123 would be")
    return valves


def show_valves(valves: Valves) -> str:
    """Return valves as players say them: ``"1-2"``, ``"open"``."""
    return "-".join(map(str, valves)) or "open"


@dataclass(frozen=True)
class ChartEntry:
    """How one pitch is fingered.

    Attributes:
        primary: The usual fingering.
        alternates: Others, the more usual first.
    """

    primary: Valves
    alternates: tuple[Valves, ...]


@cache
def three_valve_chart() -> Mapping[int, ChartEntry]:
    """Return the chart of B♭ trumpet and whatever reads its fingerings, by written MIDI number."""
    text = resources.files("reina.instruments.brass").joinpath("fingerings.csv").read_text("utf-8")
    return {
        int(row["written_midi"]): ChartEntry(
            read_valves(row["primary"]),
            tuple(read_valves(valves) for valves in row["alternates"].split(";") if valves),
        )
        for row in csv.DictReader(io.StringIO(text))
    }
