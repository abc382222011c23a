"""Where the reader of a part is, and what holds there."""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING

from reina.music.musicxml import tables
from reina.music.musicxml.element import Element, number_of
from reina.music.musicxml.instruments import ScoreInstrument, ScorePart
from reina.music.musicxml.model import DynamicMark, Place, WrittenMeasure, WrittenPart

if TYPE_CHECKING:
    from reina.music.warnings import WarningLog

MAX_BEATS = 10_000
"""Quarter notes of one measure, one duration."""


class PartState:
    """What holds at the place of a part that is being read.

    Args:
        listed: What the list of parts says of it.
        measures: The score's measures, which all parts fill in together.
        log: Is told of repairs.
    """

    def __init__(self, listed: ScorePart, measures: list[WrittenMeasure], log: WarningLog) -> None:
        self.listed = listed
        self.measures = measures
        self.log = log
        self.part = WrittenPart()
        self.measure = 0
        self.cursor = 0.0
        """Quarter notes since the measure began."""
        self.divisions = 1.0
        """What a quarter note is divided into."""
        self.muted = False
        """Whether a mute is in."""
        self.wedges: dict[str, tuple[Place, int]] = {}
        """Hairpins that have begun, by number: where, and 1 for a crescendo, -1 for a diminuendo."""
        self.dashed: dict[str, int] = {}
        """Dashes after words for a change of tempo, by number: which of the part's changes that is."""
        self.measure_place = ""
        self._instruments = dict(listed.instruments)
        self._default = next(iter(self._instruments), "")
        self._told: Counter[str] = Counter()
        self._first_told: dict[str, str] = {}

    @property
    def place(self) -> Place:
        """Where the next note would stand."""
        return self.measure, self.cursor

    @property
    def now(self) -> WrittenMeasure:
        """The measure that is being read."""
        return self.measures[self.measure]

    def where(self, element: Element) -> str:
        """The place of an element, for messages."""
        return f"{self.measure_place}, line {element.line}"

    def tell(self, element: Element, what: str) -> None:
        """Tell of something that is not played; of each the first place alone, and how many there are."""
        self._told[what] += 1
        self._first_told.setdefault(what, self.where(element))

    def tell_counts(self) -> None:
        """Log what was told."""
        for what, count in self._told.items():
            more = f", and {count - 1} more" if count > 1 else ""
            self.log.add("not_played", self._first_told[what], f"{what}: not played{more}")

    def instrument(self, identity: str) -> ScoreInstrument:
        """Return an instrument as it is now; the part's first where none is named."""
        known = self._instruments.get(identity) or self._instruments.get(self._default)
        return known or ScoreInstrument()

    def change_instrument(self, identity: str, instrument: ScoreInstrument) -> None:
        """Have an instrument be another from here on."""
        known = identity if identity in self._instruments else self._default or identity
        self._instruments[known] = instrument
        self._default = self._default or known

    def duration(self, element: Element) -> float:
        """Return a duration in quarter notes, 0 where it holds none."""
        value = element.number("duration")
        if value is None or value < 0 or value / self.divisions > MAX_BEATS:
            self.log.add("bad_duration", self.where(element), f"a <{element.name}> without a usable duration")
            return 0.0
        return value / self.divisions

    def dynamic(self, name: str, place: Place) -> None:
        """Take a dynamic by its sign."""
        if name in tables.LEVELS:
            self.part.dynamics.append(DynamicMark(place, tables.LEVELS[name]))
        elif name in tables.ACCENTS:
            self.part.dynamics.append(DynamicMark(place, None, tables.ACCENTS[name]))
        elif name in tables.ACCENT_THEN_LEVEL:
            accent, level = tables.ACCENT_THEN_LEVEL[name]
            self.part.dynamics.append(DynamicMark(place, level, accent))


def times_of(element: Element) -> frozenset[int]:
    """Return on which playings of its measure something holds; none: on all."""
    return frozenset(
        int(number) for number in re.findall(r"\d{1,3}", element.attributes.get("time-only", ""))
    )


def loudness_of(text: str) -> float | None:
    """Return the velocity, 0..1, of a percentage as MusicXML's attribute ``dynamics`` has it, or None."""
    percent = number_of(text)
    if percent is None or percent < 0:
        return None
    return min(max(percent / 100 * tables.FULL_DYNAMICS, 1 / 127), 1.0)
