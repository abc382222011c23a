"""Fields of a document that is read generously: what cannot be used is left out, and told with its path.

A field that is missing is not told of; one that is there and is null, of another type or out of range is.
"""

import math
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import compress
from typing import cast

import numpy as np

from reina.music.arrays import BoolArray, FloatArray
from reina.music.warnings import WarningLog

JsonObject = dict[str, object]

LEFT_OUT = "field_left_out"
LONGEST_SHOWN = 30
_NUMBER = re.compile(r"\s*[+-]?\d{1,17}(\.\d{0,20})?([eE][+-]?\d{1,3})?\s*", re.ASCII)


@dataclass(frozen=True)
class Span:
    """The numbers that a field may hold.

    Attributes:
        low: The least.
        high: The greatest.
        whole: Whether they are whole numbers.
    """

    low: float
    high: float
    whole: bool = False

    def __contains__(self, value: float) -> bool:
        return self.low <= value <= self.high and (not self.whole or value == math.floor(value))

    def __str__(self) -> str:
        return f"a {'whole ' if self.whole else ''}number from {self.low:,g} to {self.high:,g}"


def to_number(value: object) -> float:
    """Return a number, or one written as text (``"56"``), as float; NaN for anything else."""
    if isinstance(value, str):
        return float(value) if _NUMBER.fullmatch(value) else math.nan
    if isinstance(value, bool) or not isinstance(value, int | float):
        return math.nan
    try:
        return float(value)
    except OverflowError:
        return math.inf


def shown(value: object) -> str:
    """Return a value as a message quotes it, shortened."""
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return "a list"
    if value is None or isinstance(value, bool):
        return {None: "null", True: "true", False: "false"}[value]
    if isinstance(value, str):
        quoted = repr(value if len(value) <= LONGEST_SHOWN else value[:LONGEST_SHOWN] + "…")
        # A character that cannot be printed takes up to ten.
        return quoted if len(quoted) <= 2 * LONGEST_SHOWN else quoted[: 2 * LONGEST_SHOWN] + "…"
    return f"{to_number(value):.6g}"


def path_part(key: str) -> str:
    """Return a key of the document as a path quotes it, shortened."""
    return key if len(key) <= LONGEST_SHOWN else key[:LONGEST_SHOWN] + "…"


@dataclass(frozen=True)
class Entry:
    """An object of the document.

    Attributes:
        value: The object.
        path: Where it stands, "" for the document.
        log: Takes what is left out.
    """

    value: JsonObject
    path: str
    log: WarningLog

    def place(self, key: str) -> str:
        """Return the path of a field."""
        return f"{self.path}/{path_part(key)}" if self.path else path_part(key)

    def leave_out(self, key: str, expected: str) -> None:
        """Tell that a field is not what is `expected`."""
        self.log.add(
            LEFT_OUT,
            self.place(key),
            f"is {shown(self.value[key])}; {expected} would be right; it was left out",
        )

    def number(self, key: str, span: Span) -> float | None:
        """Return a number of `span`, or None."""
        if key not in self.value:
            return None
        value = to_number(self.value[key])
        if value in span:
            return value
        self.leave_out(key, str(span))
        return None

    def text(self, key: str) -> str:
        """Return a text without the space about it, "" if there is none."""
        value = self.value.get(key, "")
        if isinstance(value, str):
            return value.strip()
        self.leave_out(key, "a text")
        return ""

    def flag(self, key: str) -> bool:
        """Return a truth value, False if there is none."""
        value = self.value.get(key, False)
        if isinstance(value, bool):
            return value
        self.leave_out(key, "true or false")
        return False

    def entry(self, key: str) -> "Entry":
        """Return an object, an empty one if there is none."""
        value = self.value.get(key, {})
        if not isinstance(value, dict):
            self.leave_out(key, "an object")
            value = {}
        return Entry(cast("JsonObject", value), self.place(key), self.log)

    def entries(self, key: str, *, kind: str = LEFT_OUT, most: int | None = None) -> "Entries":
        """Return the objects of a list, at most the first `most`; `kind` tells of what is no object."""
        value = self.value.get(key, [])
        if not isinstance(value, list):
            self.leave_out(key, "a list")
            value = []
        listed = cast("list[object]", value)
        if most is not None and len(listed) > most:
            self.log.add(LEFT_OUT, self.place(key), f"only the first {most:,} of {len(listed):,} are read")
            listed = listed[:most]
        return entries_of(listed, self.place(key), self.log, kind=kind)

    def tell_unknown(self, known: Iterable[str]) -> None:
        """Tell of the fields that the form does not have."""
        _tell_unknown(set(self.value).difference(known), self.place, self.log)


@dataclass(frozen=True)
class Entries:
    """The objects of a list, whose fields are read as columns.

    Attributes:
        values: N objects.
        indices: Their places in the list.
        path: Where the list stands.
        log: Takes what is left out.
    """

    values: Sequence[JsonObject]
    indices: Sequence[int]
    path: str
    log: WarningLog

    def __len__(self) -> int:
        return len(self.values)

    def entry(self, row: int) -> Entry:
        """Return one of the objects."""
        return Entry(self.values[row], self.place(row), self.log)

    def place(self, row: int) -> str:
        """Return the path of one of the objects."""
        return f"{self.path}/{self.indices[row]}"

    def only(self, rows: BoolArray) -> "Entries":
        """Return those for which `rows`, (N,) bool, holds."""
        if np.all(rows):
            return self
        chosen = rows.tolist()
        return Entries(
            list(compress(self.values, chosen)), list(compress(self.indices, chosen)), self.path, self.log
        )

    def read(
        self, key: str, span: Span, number_of: Callable[[object], float] = to_number
    ) -> tuple[FloatArray, list[int]]:
        """Return a field as (N,) float64, NaN where there is none, and the rows where it cannot be used.

        Args:
            key: The field.
            span: What it may be.
            number_of: Reads what is no number itself; NaN if it cannot.
        """
        missing = math.nan
        raw = [value.get(key, missing) for value in self.values]
        numbers = [value if type(value) is float or type(value) is int else missing for value in raw]
        try:
            column = np.array(numbers, dtype=np.float64)
        except OverflowError:
            column = np.array([to_number(value) for value in numbers], dtype=np.float64)
        doubtful = ~((column >= span.low) & (column <= span.high))
        if span.whole:
            doubtful |= column != np.floor(column)
        faults: list[int] = []
        for row in np.flatnonzero(doubtful).tolist():
            if raw[row] is missing:
                continue
            number = number_of(raw[row])
            column[row] = number if number in span else math.nan
            if number not in span:
                faults.append(row)
        return column, faults

    def column(self, key: str, span: Span) -> FloatArray:
        """Return a field as (N,) float64, NaN where there is none or it was left out."""
        column, faults = self.read(key, span)
        self.leave_out(key, faults, str(span))
        return column

    def leave_out(self, key: str, rows: Iterable[int], expected: str) -> None:
        """Tell that a field of some of the objects is not what is `expected`."""
        for row in rows:
            if self.log.room(LEFT_OUT):
                self.entry(row).leave_out(key, expected)
            else:
                self.log.add(LEFT_OUT, self.path, "")

    def tell_missing(self, key: str) -> None:
        """Tell of the objects that lack what they are there for."""
        for row, value in enumerate(self.values):
            if key not in value:
                self.log.add(LEFT_OUT, self.place(row), f"has no {key}; it was left out")

    def tell_unknown(self, known: Iterable[str]) -> None:
        """Tell of the fields that the form does not have, each once."""
        keys: set[str] = set()
        keys.update(*self.values)
        _tell_unknown(keys.difference(known), self._first, self.log)

    def _first(self, key: str) -> str:
        """Return the path of the first object's field of this name."""
        row = next(row for row, value in enumerate(self.values) if key in value)
        return self.entry(row).place(key)


def entries_of(listed: Sequence[object], path: str, log: WarningLog, *, kind: str = LEFT_OUT) -> Entries:
    """Return the objects of `listed`; what is none is told as `kind`."""
    rows = [index for index, value in enumerate(listed) if isinstance(value, dict)]
    if len(rows) < len(listed):
        for index, value in enumerate(listed):
            if not isinstance(value, dict):
                log.add(
                    kind, f"{path}/{index}", f"is {shown(value)}; an object would be right; it was left out"
                )
    return Entries([cast("JsonObject", listed[index]) for index in rows], rows, path, log)


def _tell_unknown(keys: set[str], place: Callable[[str], str], log: WarningLog) -> None:
    for key in sorted(keys):
        if log.room("unknown_field"):
            log.add("unknown_field", place(key), "is no field of this form; it was left out")
        else:
            log.add("unknown_field", "", "")
