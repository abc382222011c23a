"""Rows of Reina beside a named peer: what the benchmarks tell, and docs/benchmarks.md makes a table of.

A benchmark calls `tell`; run by itself it prints the rows, run by run.py they are collected too.
docs/benchmarks.md is written from docs/benchmarks.json and from nothing else: ``python
tests/benchmarks/table.py`` does so.
"""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

ROOT = Path(__file__).parents[2]
DOCUMENT = ROOT / "docs/benchmarks.json"
PAGE = ROOT / "docs/benchmarks.md"
COLLECTED = "REINA_BENCH_COLLECTED"
"""The environment's name of the file that rows and bounds are added to, a line of JSON each."""
SHORT = os.environ.get("REINA_BENCH_SHORT") == "1"
"""Whether the short form is run: the same rows from smaller inputs, in fewer rounds."""
EQUAL = 1.05
"""Up to this ratio neither is ahead."""

Ahead = Literal["reina", "peer", "equal"]
T = TypeVar("T")


@dataclass(frozen=True)
class Row:
    """A figure of Reina and the same figure of a peer, from one run.

    Attributes:
        area: What it belongs to; a table for each.
        what: What was measured, and of how much.
        unit: Of both figures.
        reina: Reina's figure.
        peer: The peer's name.
        version: The peer's version; empty where it is not installed.
        theirs: The peer's figure; None where it could not be taken.
        better: Which of two figures is the better one.
        notes: What the reader has to know besides, or why there is no figure.
    """

    area: str
    what: str
    unit: str
    reina: float
    peer: str
    version: str
    theirs: float | None
    better: Literal["lower", "higher"] = "lower"
    notes: str = ""

    @property
    def ratio(self) -> float | None:
        """How many times as good Reina is: above 1 Reina is ahead, below 1 the peer."""
        if self.theirs is None:
            return None
        over, under = (self.theirs, self.reina) if self.better == "lower" else (self.reina, self.theirs)
        return over / under if under else None

    @property
    def ahead(self) -> Ahead | None:
        """Who has the better figure; None without one of the peer's."""
        if self.theirs is None:
            return None
        low, high = sorted((self.reina, self.theirs))
        if high <= EQUAL * low:
            return "equal"
        return "reina" if (self.reina == low) == (self.better == "lower") else "peer"

    def to_json(self) -> dict[str, Any]:
        """All of it, with the ratio and who is ahead."""
        return {**asdict(self), "ratio": self.ratio, "ahead": self.ahead}

    @classmethod
    def from_json(cls, document: dict[str, Any]) -> Row:
        """What `to_json` gave."""
        return cls(**{key: value for key, value in document.items() if key not in {"ratio", "ahead"}})

    def __str__(self) -> str:
        """The row as a benchmark prints it."""
        return f"{self.what}: Reina {figure(self.reina)}, {self.peer} {self._theirs()}: {self.verdict()}"

    def verdict(self) -> str:
        """Who is ahead, in words."""
        ratio = self.ratio
        if self.ahead is None:
            return "no figure"
        if self.ahead == "equal":
            return "equal"
        name = "Reina" if self.ahead == "reina" else self.peer
        if not ratio:
            return f"{name} ahead"
        return f"{name} ahead, {figure(max(ratio, 1 / ratio))} times"

    def _theirs(self) -> str:
        return f"{figure(self.theirs)} {self.unit}" if self.theirs is not None else f"({self.notes})"


@dataclass(frozen=True)
class Bound:
    """A figure beside what it may be at most."""

    benchmark: str
    what: str
    value: float
    most: float
    unit: str

    @property
    def held(self) -> bool:
        """Whether it is no more."""
        return self.value <= self.most


def figure(value: float) -> str:
    """A figure for people: three digits, no exponent unless it is very small."""
    if value == 0 or abs(value) >= 100:
        return f"{value:,.0f}"
    if abs(value) < 1e-3:
        return f"{value:.1e}"
    return f"{value:.3g}"


def tell(*rows: Row) -> None:
    """Print rows, and add them to what is collected."""
    for row in rows:
        print(f"  {row}", flush=True)
        collect("rows", row.to_json())


def collect(kind: Literal["rows", "bounds"], entry: dict[str, Any]) -> None:
    """Add an entry to what is collected, where somebody collects."""
    if name := os.environ.get(COLLECTED):
        with Path(name).open("a", encoding="utf-8") as file:
            file.write(json.dumps({kind: entry}) + "\n")


def collected(text: str) -> tuple[list[Row], list[Bound]]:
    """The rows and bounds of what was collected."""
    entries: list[dict[str, Any]] = [json.loads(line) for line in text.splitlines()]
    return (
        [Row.from_json(entry["rows"]) for entry in entries if "rows" in entry],
        [Bound(**entry["bounds"]) for entry in entries if "bounds" in entry],
    )


def turns(rounds: int, *runs: Callable[[], T]) -> list[tuple[T, ...]]:
    """Run all in turn, so many rounds, and return what each gave in every round."""
    found = [[run() for run in runs] for _ in range(rounds)]
    return list(zip(*found, strict=True))


def alternate(rounds: int, *runs: Callable[[], T], key: Callable[[T], float]) -> list[T]:
    """Run all in turn, so many rounds, and return the best of each, by the lowest of a key."""
    return [min(each, key=key) for each in turns(rounds, *runs)]


def dump(
    rows: Sequence[Row], bounds: Sequence[Bound], about: dict[str, str], *, short: bool
) -> dict[str, Any]:
    """The document: what it was measured on, the rows, the bounds."""
    return {
        "form": "short" if short else "whole",
        "about": about,
        "rows": [row.to_json() for row in rows],
        "bounds": [asdict(bound) for bound in bounds],
    }


def markdown(document: dict[str, Any]) -> str:
    """The page, from the document alone."""
    rows = [Row.from_json(row) for row in document["rows"]]
    bounds = [Bound(**bound) for bound in document["bounds"]]
    command = "make bench SHORT=1" if document["form"] == "short" else "make bench"
    lines = [
        "<!-- Written by `make bench` from benchmarks.json; do not edit. -->",
        "# Beside others",
        "",
        f"`{command}` measured Reina and each peer in one run on one machine, turn by turn, and wrote this",
        "page. A ratio says how many times as good who is ahead is; within five per cent both are equal.",
        "The times are those of this machine, the ratios are what stands. What is measured is told in",
        "[figures.md](figures.md#beside-others).",
        "",
        *_grid(("", ""), [(name, value) for name, value in document["about"].items()]),
        "",
        _summary(rows),
    ]
    for area in dict.fromkeys(row.area for row in rows):
        heads = ("what", "unit", "Reina", "peer", "the peer's", "ahead", "")
        chosen = [row for row in rows if row.area == area]
        lines += ["", f"## {area}", "", *_grid(heads, [_cells(row) for row in chosen])]
    if bounds:
        cells = [
            (bound.benchmark, bound.what, f"{figure(bound.value)} {bound.unit}", _most(bound))
            for bound in bounds
        ]
        heads = ("benchmark", "what", "measured", "at most")
        lines += ["", "## Beside their bounds", "", *_grid(heads, cells)]
    return "\n".join(lines) + "\n"


def _summary(rows: Sequence[Row]) -> str:
    told = {ahead: [row for row in rows if row.ahead == ahead] for ahead in ("reina", "peer", "equal")}
    peers = ", ".join(dict.fromkeys(row.peer for row in told["peer"]))
    text = f"Reina is ahead in {len(told['reina'])} of {len(rows)} rows, equal in {len(told['equal'])}"
    text += f"; a peer is ahead in {len(told['peer'])}" + (f" ({peers})." if peers else ".")
    missing = list(dict.fromkeys(f"{row.peer} ({row.notes})" for row in rows if row.theirs is None))
    return text + (f" Not measured: {', '.join(missing)}." if missing else "")


def _cells(row: Row) -> tuple[str, ...]:
    verdict = f"**{row.verdict()}**" if row.ahead == "peer" else row.verdict()
    theirs = figure(row.theirs) if row.theirs is not None else "–"
    peer = f"{row.peer} {row.version}".rstrip()
    return row.what, row.unit, figure(row.reina), peer, theirs, verdict, row.notes


def _most(bound: Bound) -> str:
    return f"{figure(bound.most)} {bound.unit}" + ("" if bound.held else ", **missed**")


def _grid(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    lines = [heads, ["---"] * len(heads), *rows]
    return ["| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |" for cells in lines]


def write(document: dict[str, Any]) -> None:
    """Keep the document, and the page that is made of it."""
    DOCUMENT.write_text(json.dumps(document, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    PAGE.write_text(markdown(document), encoding="utf-8")


if __name__ == "__main__":
    write(json.loads(DOCUMENT.read_text(encoding="utf-8")))
