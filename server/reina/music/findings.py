"""Warnings as a musician is told of them: each kind once, counted, in plain words, with its details."""

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Literal, TypeAlias

from reina.music.warnings import ScoreWarning, Values

About: TypeAlias = Literal["choice", "playing", "file", "song", "show"]
"""Who plays what; what became of a part; the score's file; the recording; the show."""
Weight: TypeAlias = Literal["cut", "repaired", "note"]
"""Music is missing; something was set right; good to know."""
_WEIGHTS: tuple[Weight, ...] = ("cut", "repaired", "note")


@dataclass(frozen=True)
class Finding:
    """What is to be told of one kind.

    Attributes:
        kind: As the warnings have it; with `count` and `values` all that another language's words need.
        about: What it is about.
        weight: How much it matters.
        count: How many things it is about.
        values: What the words hold beside the count.
        text: The words, without a full stop.
        player: The place in the cast of the player whom it concerns, from 0; None for nobody.
        details: The warnings.
    """

    kind: str
    about: About
    weight: Weight
    count: int
    values: Values
    text: str
    player: int | None = None
    details: tuple[ScoreWarning, ...] = ()


@dataclass(frozen=True)
class Words:
    """What is said of a kind.

    Attributes:
        about: What it is about.
        weight: How much it matters.
        many: What is said of several.
        one: What is said of one.
    """

    about: About
    weight: Weight
    many: str
    one: str

    def __call__(self, count: int, values: Values) -> str:
        """Return the words for a count and the values that they hold."""
        said = {name: "none" if value == 0 else value for name, value in values.items()}
        return (self.many if count > 1 else self.one).format_map({**said, "count": count})


@cache
def finding_words() -> Mapping[str, Words]:
    """Return the words of finding_words.toml for each ``kind`` and ``kind/side``."""
    text = (resources.files("reina.music") / "finding_words.toml").read_text(encoding="utf-8")
    return {kind: Words(**{"one": row["many"], **row}) for kind, row in tomllib.loads(text).items()}


def findings_of(
    warnings: Iterable[ScoreWarning], *, player: int | None = None, instrument: str = "instrument"
) -> tuple[Finding, ...]:
    """Gather warnings by their kind and values; what matters most first, else in the order of the first.

    A kind that has no words of its own, as an installed instrument may tell of, is told in those of its first
    warning.

    Args:
        warnings: What was told.
        player: The place in the cast of the player whom they concern.
        instrument: What that player plays, as it is said: ``trumpet``.
    """
    groups: dict[tuple[str, tuple[tuple[str, str | int], ...]], list[ScoreWarning]] = {}
    for warning in warnings:
        groups.setdefault((warning.kind, tuple(sorted(warning.values.items()))), []).append(warning)
    found = [
        told_finding(
            group[0].kind,
            sum(warning.count for warning in group),
            {**group[0].values, "instrument": instrument} if player is not None else group[0].values,
            player=player,
            details=tuple(group),
        )
        for group in groups.values()
    ]
    return tuple(sorted(found, key=lambda finding: _WEIGHTS.index(finding.weight)))


def told_finding(
    kind: str,
    count: int,
    values: Values,
    *,
    player: int | None = None,
    details: tuple[ScoreWarning, ...] = (),
) -> Finding:
    """Return a finding with its words.

    Args:
        kind: As the table of words has it, without its side.
        count: How many things it is about.
        values: What its words hold; ``side`` chooses among them.
        player: As `Finding` has it.
        details: As `Finding` has them.
    """
    table = finding_words()
    words = table.get(f"{kind}/{values.get('side', '')}") or table.get(kind)
    if words is None:
        message = details[0].message if details else kind.replace("_", " ")
        text = message[:1].upper() + message[1:] + (f" ({count} times)" if count > 1 else "")
        return Finding(kind, "playing", "note", count, values, text, player, details)
    return Finding(kind, words.about, words.weight, count, values, words(count, values), player, details)
