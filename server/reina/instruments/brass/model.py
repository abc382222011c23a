"""One kind of brass instrument, as data."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib import resources
from typing import Any

from reina.instruments.brass.acoustics import Tube
from reina.instruments.brass.chart import ChartEntry, Valves, read_valves, three_valve_chart
from reina.instruments.ranking import Suitability


@dataclass(frozen=True)
class BrassModel:
    """A kind of brass instrument; the tables are ``<instrument>.toml``.

    Attributes:
        name: For programs: ``trumpet``.
        title: For people: ``B♭ trumpet``.
        rig: Name of its rig, or "" if it has none yet.
        written_above_sounding: Semitones from a sounding pitch to the one written for the player.
        chart_above_sounding: Semitones from a sounding pitch to the one under which it stands in the
            three-valve chart.
        lowest: Lowest playable sounding pitch.
        highest: Highest playable sounding pitch.
        tube: Its acoustics.
        substitutes: Fingerings that a fourth valve takes the place of, as in 1-3 by 4.
        below_chart: Fingerings of chart pitches below the chart, where a fourth valve reaches further down.
        suitability: What parts it plays.
    """

    name: str
    title: str
    rig: str
    written_above_sounding: int
    chart_above_sounding: int
    lowest: int
    highest: int
    tube: Tube
    substitutes: Mapping[Valves, Valves]
    below_chart: Mapping[int, Valves]
    suitability: Suitability

    @property
    def valve_count(self) -> int:
        """How many valves it has."""
        return len(self.tube.valve_lengths_m)

    @cached_property
    def chart(self) -> Mapping[int, ChartEntry]:
        """Its fingerings by sounding pitch, of every playable one."""
        return {pitch: self._entry(pitch) for pitch in range(self.lowest, self.highest + 1)}

    def has_fingering(self, pitch: int) -> bool:
        """Return whether its chart says how a sounding pitch is played."""
        place = pitch + self.chart_above_sounding
        return place in self.below_chart or place in three_valve_chart()

    def _entry(self, pitch: int) -> ChartEntry:
        place = pitch + self.chart_above_sounding
        if place in self.below_chart:
            return ChartEntry(self.below_chart[place], ())
        entry = three_valve_chart()[place]
        substitute = self.substitutes.get(entry.primary)
        if substitute is None:
            return entry
        return ChartEntry(substitute, (entry.primary, *entry.alternates))


def load_model(package: str, file: str) -> BrassModel:
    """Load a table from a package's data.

    Raises:
        KeyError: If the table lacks something.
        ValueError: If its range is not covered by its chart.
    """
    table = tomllib.loads(resources.files(package).joinpath(file).read_text("utf-8"))
    model = _model(table)
    missing = [p for p in range(model.lowest, model.highest + 1) if not model.has_fingering(p)]
    if missing:
        raise ValueError(f"{package}/{file}: no fingering in its chart for {missing}")
    return model


def _model(table: Mapping[str, Any]) -> BrassModel:
    tube, parts = table["tube"], table["parts"]
    lowest, highest = table["range"]["lowest"], table["range"]["highest"]
    fourth = table.get("fourth_valve", {})
    return BrassModel(
        name=table["name"],
        title=table["title"],
        rig=table.get("rig", ""),
        written_above_sounding=table["written_above_sounding"],
        chart_above_sounding=table["chart_above_sounding"],
        lowest=lowest,
        highest=highest,
        tube=Tube(
            open_length_m=tube["open_length_m"],
            valve_lengths_m=tuple(tube["valve_lengths_m"]),
            fundamental=tube["fundamental"],
            slide_travel_m=tube["slide_travel_m"],
        ),
        substitutes={
            read_valves(old): read_valves(new) for old, new in fourth.get("substitutes", {}).items()
        },
        below_chart={
            int(place): read_valves(valves) for place, valves in fourth.get("below_chart", {}).items()
        },
        suitability=Suitability(
            programs={int(program): weight for program, weight in parts["programs"].items()},
            names=dict(parts["names"]),
            lowest=lowest,
            highest=highest,
        ),
    )
