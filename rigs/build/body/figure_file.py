"""What a figure is made from: its parameter file, `figures/<name>.toml`."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

FIGURES = Path(__file__).parents[1] / "figures"

Colour = tuple[float, float, float]


@dataclass(frozen=True)
class FigureFile:
    """A figure's parameters; colours are sRGB shares as the models' materials take them.

    Attributes:
        name: Of its rig, and its folder under rigs/.
        sex: ``female`` or ``male``: which of MakeHuman's macro targets are taken.
        races: Shares of MakeHuman's race targets.
        shape: Its sliders, 0…1.
        both_sides: Targets with ``{}`` for the side's letter, and how strongly.
        details: Targets, and how strongly.
        skin: The skin's base tone.
        brow: Colour of the brows.
        lash_length: Of the source's lashes.
        hair: The hair's style.
        hair_tint: Its colour.
        iris_inner: The iris's colour at the pupil.
        iris_outer: The iris's colour at its edge.
        outfit: What it wears.
        colours: Of each part of the outfit.
    """

    name: str
    sex: str
    races: dict[str, float]
    shape: dict[str, float]
    both_sides: dict[str, float]
    details: dict[str, float]
    skin: Colour
    brow: Colour
    lash_length: float
    hair: str
    hair_tint: Colour
    iris_inner: Colour
    iris_outer: Colour
    outfit: str
    colours: dict[str, Colour]


def read_figure(path: Path) -> FigureFile:
    """Read a parameter file.

    Raises:
        KeyError: Something is not in it.
    """
    content: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
    if content["sex"] not in ("female", "male"):
        raise ValueError(f"{path}: sex is 'female' or 'male', not {content['sex']!r}")
    iris = content.pop("iris")
    colours = {name: _colour(value) for name, value in content.pop("colours").items()}
    for key in ("skin", "brow", "hair_tint"):
        content[key] = _colour(content[key])
    return FigureFile(
        **content, iris_inner=_colour(iris["inner"]), iris_outer=_colour(iris["outer"]), colours=colours
    )


def figure_files() -> list[FigureFile]:
    """All figures, in the order of their names."""
    return [read_figure(path) for path in sorted(FIGURES.glob("*.toml"))]


def _colour(value: list[float]) -> Colour:
    red, green, blue = value
    return red, green, blue
